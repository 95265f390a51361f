#include "image/text.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace hibi {
namespace {

std::string message_of(const std::string& text) {
    try {
        require_glyphs(text);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

TEST(Text, JapaneseGreekAndPunctuationHaveGlyphs) {
    EXPECT_EQ(message_of("片持ち平板の曲げ破壊（MPS法） ひび — ν = 0.3, 10⁻⁶, µm, × · −"), "");
}

TEST(Text, ManyScriptsHaveGlyphs) {
    for (const char* text : {"한국어 외팔보",
                             "压缩试验：断裂",
                             "壓縮試驗",
                             "مرحبا بالعالم، ٣",
                             "שבר בלוח",
                             "क्षैतिज धरन।",
                             "การแตกหัก น้ำ",
                             "Θραύση πλάκας",
                             "Разрушение балки ґ",
                             "ফাটল",
                             "ਦਰਾੜ",
                             "તિરાડ",
                             "ଫାଟ",
                             "விரிசல்",
                             "పగులు",
                             "ಬಿರುಕು",
                             "വിള്ളൽ",
                             "ඉරිතැලීම",
                             "ຮອຍແຕກ",
                             "ស្នាមប្រេះ",
                             "အက်ကွဲ",
                             "ბზარი",
                             "ճաք",
                             "ስንጥቅ",
                             "vết nứt",
                             "شکستگی",
                             "→ ⇒ ∑ ∮ √ ✔ ⚠ ①"})
        EXPECT_EQ(message_of(text), "") << text;
}

TEST(Text, WordsThatNobodyCanChangeShowABoxForWhatIsMissing) {
    EXPECT_EQ(with_boxes("plain"), "plain");
    EXPECT_EQ(with_boxes("out/🔨/שלום\n"), "out/□/שלום ");
    EXPECT_EQ(message_of(with_boxes("ab\xff")), "");
}

TEST(Text, ShorteningLeavesNoLetterWithoutItsSigns) {
    const Typesetter type;
    const std::string title = "दरारदरारदरा";
    for (double width = 20; width < 70; width += 1) {
        const std::string cut = type.shortened(title, {.size = 12}, width);
        EXPECT_LE(type.width(cut, {.size = 12}), width);
        EXPECT_TRUE(cut == title || title.substr(cut.size() - 3).find("ा") != 0) << cut;
    }
}

TEST(Text, AMissingGlyphIsAnErrorNamingTheCharacter) {
    const std::string message = message_of("crack 😀");
    EXPECT_NE(message.find("😀"), std::string::npos);
    EXPECT_NE(message.find("U+1F600"), std::string::npos);
    EXPECT_NE(message_of("two\nlines").find("U+000A"), std::string::npos);
    EXPECT_NE(message_of("crack 😀"), "");  // and again: nothing half made stays behind
}

TEST(Text, WhatIsNotUtf8IsRefused) {
    EXPECT_NE(message_of("ab\xff").find("byte 3"), std::string::npos);
    for (const char* bad : {"\x80", "\xc0\xaf", "\xe3\x81", "\xe0\x80\xaf", "\xf0\x80\x80\xaf",
                            "\xed\xa0\x80", "\xf4\x90\x80\x80"})
        EXPECT_NE(message_of(bad).find("not UTF-8"), std::string::npos);
}

TEST(Text, TabularDigitsHaveOneWidthAndOrdinaryOnesDoNot) {
    const Typesetter type;
    const TextStyle tabular{.size = 20, .tabular = true};
    EXPECT_DOUBLE_EQ(type.width("t = 11.1", tabular), type.width("t = 28.0", tabular));
    EXPECT_LT(type.width("111", {.size = 20}), type.width("888", {.size = 20}));
}

TEST(Text, ShortenedTextFitsAndEndsWithAnEllipsis) {
    const Typesetter type;
    const TextStyle style{.size = 12};
    const std::string title = "Bending failure 片持ち平板 of a cantilever plate";
    EXPECT_EQ(type.shortened(title, style, 1000), title);
    for (const double width : {10.0, 50.0, 120.0, 200.0}) {
        const std::string cut = type.shortened(title, style, width);
        EXPECT_LE(type.width(cut, style), width);
        EXPECT_TRUE(cut.ends_with("…")) << cut;
    }
}

TEST(Text, LinesBreakAtSpacesAndBetweenJapaneseCharacters) {
    const Typesetter type;
    const TextStyle style{.size = 12};
    const double width = type.width("Bending failure of", style) + 1;
    const std::vector<std::string> lines = type.wrapped("Bending failure of a plate", style, width, 2);
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_EQ(lines[0], "Bending failure of");
    EXPECT_EQ(lines[1], "a plate");
    const auto japanese = type.wrapped("片持ち平板の曲げ破壊", style, type.width("片持ち平", style) + 1, 5);
    ASSERT_EQ(japanese.size(), 3u);
    EXPECT_EQ(japanese[0] + japanese[1] + japanese[2], "片持ち平板の曲げ破壊");
    const auto mixed = type.wrapped("plate片持", style, type.width("plate", style) + 1, 2);
    ASSERT_EQ(mixed.size(), 2u);
    EXPECT_EQ(mixed[0], "plate");
    EXPECT_TRUE(type.wrapped("Bending failure of a plate", style, width / 2, 2)[1].ends_with("…"));
}

}  // namespace
}  // namespace hibi
