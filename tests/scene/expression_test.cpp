#include "scene/expression.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hibi {
namespace {

Names names() {
    Names n;
    n.params["spacing"] = {0.5, dimension_of("m")};
    n.params["count"] = {4, {}};
    n.params["h"] = {2, dimension_of("m")};  // also the hour
    return n;
}
Names varying() {
    Names n = names();
    n.space = n.time = true;
    return n;
}

double value(const std::string& text) { return Expression(text, names())(Vec3::Zero(), 0); }
double at(const std::string& text, double x, double y, double t) {
    return Expression(text, varying())(Vec3(x, y, 0), t);
}

/// The mistake of an expression, as "characters: message".
std::string mistake(const std::string& text, const Names& n = names()) {
    try {
        Expression(text, n);
    } catch (const ExpressionError& error) {
        return text.substr(error.offset, error.length) + ": " + error.what();
    }
    return "no error";
}

TEST(Expression, NumbersCarryUnitsThatBindClosest) {
    EXPECT_DOUBLE_EQ(value("80 MN"), 8e7);
    EXPECT_DOUBLE_EQ(value("2 MPa m^0.5"), 2e6);
    EXPECT_DOUBLE_EQ(value("2300 kg/m^3"), 2300);
    EXPECT_DOUBLE_EQ(value("2 N*m"), 2);
    EXPECT_DOUBLE_EQ(value("0.5/s"), 0.5);
    EXPECT_DOUBLE_EQ(value("1.5e3µm"), 1.5e-3);
    EXPECT_EQ(Expression("2 m^2", names()).dimension(), dimension_of("m^2"));
    EXPECT_EQ(Expression("1/2 m", names()).dimension(), dimension_of("m^-1"));
    EXPECT_EQ(Expression("3 m/s/s", names()).dimension(), dimension_of("m/s^2"));
}

TEST(Expression, OperatorsBindAsInMathematics) {
    EXPECT_DOUBLE_EQ(value("40 m - spacing"), 39.5);
    EXPECT_DOUBLE_EQ(value("2 + 3*4^2/2 - 1"), 25);
    EXPECT_DOUBLE_EQ(value("-2^2"), -4);
    EXPECT_DOUBLE_EQ(value("2^3^2"), 512);
    EXPECT_DOUBLE_EQ(value("8/4/2"), 1);
    EXPECT_DOUBLE_EQ(value("10 - 4 - 3"), 3);
    EXPECT_DOUBLE_EQ(value("2^-1"), 0.5);
}

TEST(Expression, FunctionsCheckTheDimensionOfWhatTheyGet) {
    EXPECT_DOUBLE_EQ(value("sqrt(4 m^2)"), 2);
    EXPECT_EQ(Expression("sqrt(4 m^2)", names()).dimension(), dimension_of("m"));
    EXPECT_DOUBLE_EQ(value("hypot(3 m, 4 m)"), 5);
    EXPECT_DOUBLE_EQ(value("min(3 m, 4 m, 200 cm)"), 2);
    EXPECT_DOUBLE_EQ(value("max(abs(-7), 3)"), 7);
    EXPECT_DOUBLE_EQ(value("atan2(1 m, 1 m)"), std::numbers::pi / 4);
    EXPECT_DOUBLE_EQ(value("sin(30 deg) + log(exp(2)) + cos(0) + tan(0)"), 3.5);
    EXPECT_DOUBLE_EQ(at("step(t - 1 s)", 0, 0, 0.9) + at("step(t - 1 s)", 0, 0, 1), 1);
    EXPECT_EQ(mistake("sin(2 m)"), "2 m: sin needs a plain number; \"2 m\" is a length");
    EXPECT_EQ(mistake("hypot(1 m, 1 s)"), "1 m, 1 s: cannot mix a length and a time: \"1 m\" and \"1 s\"");
    EXPECT_EQ(mistake("sqrt(1, 2)"), "sqrt(1, : sqrt takes one value");
    EXPECT_EQ(mistake("hypot(1 m)"), "hypot(1 m: hypot takes two values");
}

TEST(Expression, VariesOverPlaceAndTime) {
    EXPECT_DOUBLE_EQ(at("2 MPa * (1 - (y/(10 m))^2) * t/(1 s)", 0, 5, 4), 2e6 * 0.75 * 4);
    EXPECT_DOUBLE_EQ(at("2 MN/s*t", 0, 0, 3), 6e6);
    EXPECT_TRUE(Expression("x + 1 m", varying()).field().varies_in_space());
    EXPECT_FALSE(Expression("x + 1 m", varying()).field().varies_in_time());
    EXPECT_TRUE(Expression("spacing*count", varying()).field().is_constant());
    EXPECT_EQ(mistake("2 m + x"), "x: \"x\" cannot stand here: this value is the same everywhere");
    EXPECT_EQ(mistake("2 s + t"), "t: \"t\" cannot stand here: this value is the same at all times");
}

TEST(Expression, ConditionsCompareAndJoin) {
    EXPECT_TRUE(Expression("x < spacing", varying()).is_condition());
    EXPECT_EQ(at("x < spacing and not y > 1 m or x >= 9 m", 0.4, 0.5, 0), 1);
    EXPECT_EQ(at("x < spacing and not y > 1 m or x >= 9 m", 0.4, 1.5, 0), 0);
    EXPECT_EQ(at("x < spacing and not y > 1 m or x >= 9 m", 9, 1.5, 0), 1);
    EXPECT_EQ(at("(x < 1 m or x > 2 m) and y <= 0", 3, 0, 0), 1);
    EXPECT_EQ(mistake("x < 2", varying()),
              "x < 2: cannot compare a length and a plain number: \"x\" and \"2\"");
    EXPECT_EQ(mistake("0 m < x < 2 m", varying()), "<: two comparisons in a row");
    EXPECT_EQ(mistake("x = 2 m", varying()), "=: unexpected \"=\"");
    EXPECT_EQ(mistake("x and y > 1 m", varying()), "x: \"x\" is a length, not a condition");
    EXPECT_EQ(mistake("1 + (x > 1 m)", varying()), "(x > 1 m): \"(x > 1 m)\" is a condition, not a value");
}

TEST(Expression, DimensionsMustAgree) {
    EXPECT_EQ(mistake("1 m + 1 s"), "1 m + 1 s: cannot add a length and a time: \"1 m\" and \"1 s\"");
    EXPECT_EQ(mistake("2^(1 m)"), "(1 m): an exponent needs a plain number; \"(1 m)\" is a length");
    EXPECT_EQ(mistake("x^t", varying()), "t: an exponent needs a plain number; \"t\" is a time");
    EXPECT_DOUBLE_EQ(value("max(0, -3 m)"), 0);  // a constant zero has every dimension
}

TEST(Expression, MistakesNameTheTokenThatIsWrong) {
    EXPECT_EQ(mistake("5 mpa"), "mpa: unknown unit \"mpa\"");
    EXPECT_EQ(mistake("5 kg/m3"), "m3: unknown name \"m3\"");
    EXPECT_EQ(mistake("40 m - spacng"), "spacng: unknown name \"spacng\"");
    EXPECT_EQ(mistake("1,5 m"), ",: unexpected \",\"");
    EXPECT_EQ(mistake("1.5.3 m"), ".: unexpected \".\"");
    EXPECT_EQ(mistake("2 * (3 + 4"), "(: this parenthesis is never closed");
    EXPECT_EQ(mistake("2 *"), "*: the expression ends too early");
    EXPECT_EQ(mistake("  "), "  : nothing is written here");
    EXPECT_EQ(mistake("3 % 2"), "%: unexpected \"%\"");
    EXPECT_EQ(mistake("3 − 2"), "−: unexpected \"−\"");
    EXPECT_EQ(mistake("spacing spacing"), "spacing: unexpected \"spacing\"");
    EXPECT_EQ(mistake("2 spacing"), "spacing: unknown unit \"spacing\"");
}

TEST(Expression, ANameThatIsAlsoAUnitIsNeverGuessedAt) {
    EXPECT_EQ(mistake("5 m/h"), "h: \"h\" is a unit and a name of this scene alike");
    EXPECT_EQ(mistake("5 m/t", varying()), "t: \"t\" is a unit and a name of this scene alike");
    EXPECT_DOUBLE_EQ(value("5 m - h"), 3);
    EXPECT_DOUBLE_EQ(value("5*h"), 10);
    EXPECT_DOUBLE_EQ(value("5 h"), 5 * 3600);  // letters right behind a number are its unit
}

TEST(Expression, WhatIsNotFiniteIsAnError) {
    EXPECT_EQ(mistake("1e400"), "1e400: \"1e400\" is too large or too small");
    EXPECT_EQ(mistake("1/0"), "1/0: \"1/0\" is not a finite number");
    EXPECT_EQ(mistake("sqrt(-1)"), "sqrt(-1): \"sqrt(-1)\" is not a finite number");
    EXPECT_EQ(mistake("1e300^2"), "1e300^2: \"1e300^2\" is not a finite number");
    EXPECT_EQ(mistake("1e300 Em"), "1e300 Em: \"1e300 Em\" is not a finite number");
}

TEST(Expression, DepthIsLimitedInEveryDirection) {
    for (const std::string once : {"(", "-", "not ", "2^", "sin(", "abs("}) {
        std::string text;
        for (int i = 0; i < 3000 / static_cast<int>(once.size()); ++i) text += once;
        EXPECT_THROW(Expression(text + "1", names()), ExpressionError) << once;
    }
    EXPECT_THROW(Expression(std::string(10'000'000, '('), names()), ExpressionError);
    std::string sum = "1";
    for (int i = 0; i < 1000; ++i) sum += "+x/x";
    EXPECT_DOUBLE_EQ(at(sum, 2, 0, 0), 1001);  // long is not deep
}

TEST(Expression, ABareNumberIsWhatHasNoUnitAndNoOperator) {
    for (const char* text : {"40", "-3.5e2", "+1", ".5"})
        EXPECT_TRUE(Expression(text, names()).is_bare_number()) << text;
    for (const char* text : {"40 m", "2*3", "count", "(2)", "pi"})
        EXPECT_FALSE(Expression(text, names()).is_bare_number()) << text;
}

TEST(Expression, TextFoldsConstantsAndReadsBackTheSame) {
    EXPECT_EQ(Expression("x < 2*spacing", varying()).text(), "x < 1 m");
    EXPECT_EQ(Expression("2 MN/s * t", varying()).text(), "(2000000 N/s)*t");
    for (const char* text :
         {"x - (y - 1 m) < 3 m and (x > 1 m or not y > 2 m)", "-(x/(2 m))^2", "(-2)^(4*t/(1 s))",
          "x/(y/(1 m))/2", "2 m/(t*(3 kg/s))", "1/(t + 1 ms)", "min(x, y, 3 m)*-1.5",
          "x*1e-30 m - 1e30 m^2 + x*y*0", "2^-x^0", "not (x < 1 m and y < 1 m)", "sqrt(x*y) > abs(x - 2 m)",
          "3/(1/(x/(1 m)))", "0.5/s*t"}) {
        const Expression first(text, varying());
        const Expression second(first.text(), varying());
        EXPECT_EQ(second.text(), first.text()) << text;
        const Vec3 X(0.3, 1.7, 0);
        EXPECT_EQ(second(X, 0.25), first(X, 0.25)) << text << " -> " << first.text();
    }
}

TEST(Expression, WhatIsComparedIsEqualWithinASlack) {
    const auto holds = [](const std::string& text, double x, double y) {
        return Expression(text, varying()).holds(Vec3(x, y, 0), 1e-7);
    };
    const double row = 0.05 + 3 * 0.1;  // 0.35000000000000003
    EXPECT_TRUE(holds("y <= 0.35 m", 0, row));
    EXPECT_FALSE(holds("y > 0.35 m", 0, row));
    EXPECT_FALSE(holds("x < 0.35 m", std::nextafter(0.35, 0), 0));
    EXPECT_TRUE(holds("x >= 0.35 m", std::nextafter(0.35, 0), 0));
    EXPECT_TRUE(holds("x < 0.35 m", 0.35 - 2e-7, 0));
    EXPECT_FALSE(holds("x <= 0.35 m", 0.35 + 2e-7, 0));
    // Whatever is compared, and either way round; each comparison for itself.
    for (const char* text :
         {"0.25 m >= hypot(x, y)", "x^2 + y^2 <= 0.0625 m^2", "not hypot(x, y) > 0.25 m",
          "abs(x) - 0.15 m <= 0.2 m - abs(y)", "y/x >= 4/3", "atan2(y, x)*3 >= 3*atan2(4, 3)",
          "x >= 0.15 m and x <= 0.15 m", "x/(1 m) >= 0.15", "3*x - 0.25 m <= y"})
        for (const double rounding : {-1e-16, 0.0, 1e-16})
            EXPECT_TRUE(holds(text, 0.15 + rounding, 0.2)) << text << " " << rounding;
    // What < selects and what >= selects are the whole, and have nothing in common.
    for (const char* pair : {"hypot(x - 1 m, y) {} 2*y", "x*y {} 0.02 m^2", "x {} y"})
        for (double x = 0.05; x < 1; x += 0.1)
            for (double y = 0.05; y < 1; y += 0.1) {
                const std::string text = pair;
                const auto with = [&](const char* sign) {
                    std::string full = text;
                    return holds(full.replace(full.find("{}"), 2, sign), x, y);
                };
                EXPECT_NE(with("<"), with(">=")) << text;
                EXPECT_NE(with(">"), with("<=")) << text;
            }
}

}  // namespace
}  // namespace hibi
