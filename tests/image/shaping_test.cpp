#include "image/shaping.hpp"

#include <gtest/gtest.h>

#include "image/text.hpp"
#include "image/utf8.hpp"

namespace hibi {
namespace {

/// The glyphs of a text in the order in which they stand in the line, from the left.
std::vector<const Glyph*> glyphs_of(const Fonts& fonts, std::u32string_view text) {
    std::vector<const Glyph*> glyphs;
    for (const TextRun& run : split_into_runs(fonts, text, false))
        for (const ShapedGlyph& g : shape(fonts, text, run).glyphs) glyphs.push_back(g.glyph);
    return glyphs;
}

/// Text of the runs from the left.
std::vector<std::u32string> runs_of(const Fonts& fonts, std::u32string_view text) {
    std::vector<std::u32string> runs;
    for (const TextRun& run : split_into_runs(fonts, text, false))
        runs.emplace_back(text.substr(run.begin, run.end - run.begin));
    return runs;
}

TEST(Shaping, ArabicLettersJoin) {
    const Fonts fonts;
    const auto alone = glyphs_of(fonts, U"ب"), three = glyphs_of(fonts, U"ببب");
    ASSERT_EQ(three.size(), 3u);
    EXPECT_NE(three[0], alone[0]) << "final";
    EXPECT_NE(three[1], alone[0]) << "medial";
    EXPECT_NE(three[2], alone[0]) << "initial";
    EXPECT_NE(three[1], three[0]);
    EXPECT_EQ(glyphs_of(fonts, U"لا").size(), 1u) << "lam and alef are one glyph";
}

TEST(Shaping, HebrewRunsFromTheRight) {
    const Fonts fonts;
    const auto word = glyphs_of(fonts, U"שלום");
    ASSERT_EQ(word.size(), 4u);
    EXPECT_EQ(word[0], glyphs_of(fonts, U"ם")[0]);
    EXPECT_EQ(word[3], glyphs_of(fonts, U"ש")[0]);
}

TEST(Shaping, TheFirstLetterGivesTheDirectionOfTheLine) {
    const Fonts fonts;
    const auto from_left = runs_of(fonts, U"Test 7: כסר ab");
    ASSERT_EQ(from_left.size(), 3u);
    EXPECT_EQ(from_left[0], U"Test 7: ");
    EXPECT_EQ(from_left[2], U" ab");
    const auto from_right = runs_of(fonts, U"כסר Plate 2");
    EXPECT_EQ(from_right.front(), U"Plate 2");
    EXPECT_EQ(from_right.back(), U"כסר");
}

TEST(Shaping, BracketsAreMirroredInTextFromTheRight) {
    const Fonts fonts;
    const auto text = glyphs_of(fonts, U"ש(ש)");
    ASSERT_EQ(text.size(), 4u);
    EXPECT_EQ(text[0], &fonts.glyph(Fonts::inter, fonts.index(Fonts::inter, U'(')));
    EXPECT_EQ(text[2], &fonts.glyph(Fonts::inter, fonts.index(Fonts::inter, U')')));
}

TEST(Shaping, DevanagariVowelSignsStandWhereTheyBelong) {
    const Fonts fonts;
    const auto syllable = glyphs_of(fonts, U"कि");
    ASSERT_EQ(syllable.size(), 2u);
    EXPECT_EQ(syllable[1], glyphs_of(fonts, U"क")[0]) << "the sign i is written after it, but drawn before";
    EXPECT_EQ(glyphs_of(fonts, U"क्ष").size(), 1u) << "a conjunct";
}

TEST(Shaping, AccentsTakeNoWidth) {
    const Typesetter type;
    for (const auto& [base, with_mark] :
         {std::pair("น", "น้"), {"e", "e\u0301"}, {"ш", "ш\u0301"}, {"か", "か\u3099"}})
        EXPECT_NEAR(type.width(base, {}), type.width(with_mark, {}), 0.4) << with_mark;
}

TEST(Shaping, DecomposedKoreanIsTheSameAsComposed) {
    const Fonts fonts;
    EXPECT_EQ(glyphs_of(fonts, U"\u1112\u1161\u11ab\u1100\u116e\u11a8"), glyphs_of(fonts, U"한국"));
}

TEST(Shaping, ATextInChineseMixesNoJapaneseShapesIn) {
    const Fonts fonts;
    for (const TextRun& run : split_into_runs(fonts, U"压缩试验：混凝土梁的断裂", false))
        EXPECT_EQ(run.font, Fonts::droid);
    for (const TextRun& run : split_into_runs(fonts, U"片持ち梁の破壊", false)) {
        EXPECT_EQ(run.font, Fonts::ipaex);
        EXPECT_TRUE(run.plain);
    }
}

TEST(Shaping, LatinTextKeepsItsLayoutWhateverStandsBesideIt) {
    const Typesetter type;
    double sum = 0;
    for (const char* letter : {"A", "V", "A", " ", "T", "o"}) sum += type.width(letter, {});
    EXPECT_DOUBLE_EQ(type.width("AVA To", {}), sum);
    EXPECT_NEAR(type.width("AVA To ชน", {}), sum + type.width(" ", {}) + type.width("ชน", {}), 1e-9);
}

TEST(Shaping, InvisibleCharactersNeedNoGlyph) {
    const Typesetter type;
    EXPECT_NEAR(type.width("a\u200eb\u2060c", {}), type.width("abc", {}), 1e-9);
    EXPECT_NO_THROW(require_glyphs("\u2068שלום\u2069 \u202babc\u202c ⚠\ufe0f"));
}

TEST(Shaping, AMissingGlyphIsFoundWhereItStands) {
    const Fonts fonts;
    try {
        split_into_runs(fonts, U"शक 🔨", false);
        FAIL();
    } catch (const MissingGlyph& missing) {
        EXPECT_EQ(missing.at, 3u);
        EXPECT_NE(std::string(missing.what()).find("U+1F528"), std::string::npos);
    }
}

}  // namespace
}  // namespace hibi
