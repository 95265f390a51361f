#include "base/units.hpp"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace hibi {
namespace {

TEST(Units, AtomsGiveTheirSizeInSiAndTheirDimension) {
    const auto megapascal = unit_atom("MPa");
    ASSERT_TRUE(megapascal);
    EXPECT_DOUBLE_EQ(megapascal->value, 1e6);
    EXPECT_EQ(megapascal->dimension, (Dimension{{-1, 1, -2, 0, 0, 0, 0}}));
    EXPECT_DOUBLE_EQ(unit_atom("min")->value, 60);
    EXPECT_DOUBLE_EQ(unit_atom("g")->value, 1e-3);
    EXPECT_TRUE(unit_atom("rad")->dimension.is_plain());
    ASSERT_TRUE(unit_atom("deg"));
    EXPECT_NEAR(unit_atom("deg")->value, 3.14159265358979 / 180, 1e-15);
}

TEST(Units, WhatIsNoPlainMultipleOfSiIsNoUnit) {
    for (const char* text :
         {"", "quark", "mpa", "1", "m2", "m^2", "degC", "celsius", "since", "m s", "dBZ", "."})
        EXPECT_FALSE(unit_atom(text)) << text;
}

TEST(Units, ProductsQuotientsAndBrokenPowers) {
    EXPECT_DOUBLE_EQ(parse_unit("MPa m^0.5")->value, 1e6);
    EXPECT_EQ(parse_unit("MPa m^0.5")->dimension, (Dimension{{-0.5, 1, -2, 0, 0, 0, 0}}));
    EXPECT_EQ(parse_unit("kg/m^3")->dimension, (Dimension{{-3, 1, 0, 0, 0, 0, 0}}));
    EXPECT_EQ(parse_unit("N m")->dimension, parse_unit("J")->dimension);
    EXPECT_EQ(parse_unit("g/cm^3")->value, 1000);  // exactly, whatever the order of the powers
    EXPECT_EQ(parse_unit("1/s")->dimension, (Dimension{{0, 0, -1, 0, 0, 0, 0}}));
    EXPECT_TRUE(parse_unit("")->dimension.is_plain());
    for (const char* text : {"m/", "/s", "m^", "m^x", "kg//m", "m^1e9", "2 m", "1 m 1"})
        EXPECT_FALSE(parse_unit(text)) << text;
}

TEST(Units, MayBeAskedFromSeveralThreadsAtOnce) {
    std::vector<std::thread> threads;
    std::vector<int> right(4);
    for (int k = 0; k < 4; ++k)
        threads.emplace_back([k, &right] {
            for (const char* text : {"mm", "GPa", "kN", "ms", "um", "MJ", "lbf", "psi"})
                right[k] += unit_atom(text).has_value();
        });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(right, std::vector<int>(4, 8));
}

TEST(Units, DimensionsHaveNamesForMessages) {
    EXPECT_EQ(dimension_name(dimension_of("MPa")), "a pressure");
    EXPECT_EQ(dimension_name(dimension_of("kN")), "a force");
    EXPECT_EQ(dimension_name(dimension_of("kg/m")), "in m^-1 kg");
    EXPECT_EQ(si_symbol(dimension_of("GPa")), "Pa");
    EXPECT_EQ(dimension_of(si_symbol(dimension_of("kg m^-1.5"))), dimension_of("kg m^-1.5"));
}

TEST(FormatSi, PicksThePrefixThatFits) {
    EXPECT_EQ(format_si(1.3653e-3, "s", 3), "1.37 ms");
    EXPECT_EQ(format_si(3.53e7, "N", 3), "35.3 MN");
    EXPECT_EQ(format_si(-2.1e8, "Pa", 3), "-210 MPa");
    EXPECT_EQ(format_si(1e3, "J/m^2", 2), "1.0 kJ/m^2");
    EXPECT_EQ(format_si(0, "N", 3), "0 N");
    EXPECT_EQ(format_si(4.2e-7, "m", 2), "420 nm");
}

TEST(FormatSi, RoundsBeforeItChoosesThePrefix) {
    EXPECT_EQ(format_si(999.96, "N", 3), "1.00 kN");
    EXPECT_EQ(format_si(999.4, "N", 3), "999 N");
    EXPECT_EQ(format_si(1000, "N", 3), "1.00 kN");
}

TEST(FormatSi, KeepsUnitsThatTakeNoPrefix) {
    EXPECT_EQ(format_si(1840000, "kg", 3), "1.84e+06 kg");
    EXPECT_EQ(format_si(2300, "kg/m^3", 3), "2300 kg/m^3");
    EXPECT_EQ(format_si(0.012, "rad", 2), "0.012 rad");
    EXPECT_EQ(format_si(0.1, "", 3), "0.100");
    EXPECT_EQ(format_si(800, "m^2", 3), "800 m^2");
    EXPECT_EQ(format_si(7200, "s", 3), "7200 s");
}

TEST(FormatSi, TrimsZerosWhenAsked) {
    EXPECT_EQ(format_si(40, "m", 3, true), "40 m");
    EXPECT_EQ(format_si(0.1, "", 3, true), "0.1");
    EXPECT_EQ(format_si(210e6, "Pa", 3, true), "210 MPa");
}

}  // namespace
}  // namespace hibi
