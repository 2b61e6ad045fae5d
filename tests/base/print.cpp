#include "slipscale/base/print.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace slipscale;

TEST(Format, PutsValuesIntoPatternsOfAnyLength) {
  EXPECT_EQ(format("{} of {}, {:.3g}", 3, "four", 0.12345), "3 of four, 0.123");
  EXPECT_EQ(format("{}", std::string(5000, 'x')), std::string(5000, 'x'));
  EXPECT_EQ(format("{{}}"), "{}");
}

TEST(Engineering, FourDigitsAndAPrefix) {
  EXPECT_EQ(engineering(3.2e-9, "s"), "3.200 ns");
  EXPECT_EQ(engineering(32e-9, "s"), "32.00 ns");
  EXPECT_EQ(engineering(2.1e11, "Pa"), "210.0 GPa");
  EXPECT_EQ(engineering(1, "m"), "1.000 m");
  EXPECT_EQ(engineering(-0.00015, "m"), "-150.0 µm");
  EXPECT_EQ(engineering(0, "m"), "0 m");
}

TEST(Engineering, RoundingUpTakesTheNextPrefix) {
  EXPECT_EQ(engineering(999.96, "Pa"), "1.000 kPa");
  EXPECT_EQ(engineering(999.94, "Pa"), "999.9 Pa");
  EXPECT_EQ(engineering(9.99996e-4, "s"), "1.000 ms");
}

TEST(Engineering, NoPrefixWhereItWouldMislead) {
  EXPECT_EQ(engineering(2e-6, "m^2"), "2e-06 m^2");
  EXPECT_EQ(engineering(1200, "kg/m^3"), "1200 kg/m^3");
  EXPECT_EQ(engineering(0.25, "1"), "0.25");
  EXPECT_EQ(engineering(2.5e5, "m/s^2"), "250.0 km/s^2");
  EXPECT_EQ(engineering(std::nan(""), "s"), "nan s");
  EXPECT_EQ(engineering(1e40, "s"), "1.000e+40 s");
}

TEST(Table, ColumnsAreAlignedAndTheHeadingUnderlined) {
  EXPECT_EQ(table({{"what", "value"}, {"step", "3.2 ns"}, {"a longer one", "1"}}),
            "what           value\n"
            "------------  ------\n"
            "step          3.2 ns\n"
            "a longer one       1\n");
}

TEST(Table, WideLettersCountOnceAndRowsMayBeShort) {
  EXPECT_EQ(table({{"a", "µm"}, {"b"}, {"c", "1234"}}),
            "a    µm\n"
            "-  ----\n"
            "b\n"
            "c  1234\n");
  EXPECT_EQ(table({}), "");
}

TEST(ApartFrom, HasTheDigitsThatTell) {
  EXPECT_EQ(apart_from(0.5, 0.25, 4), "0.25");
  EXPECT_EQ(apart_from(0.5, 0.4999999, 4), "0.4999999");
  EXPECT_EQ(apart_from(0.5, 0.5, 4), "0.5");
  EXPECT_EQ(apart_from(1.25e-8, 1.2500001e-8, 4), "1.2500001e-08");
  EXPECT_NE(apart_from(1, std::nextafter(1.0, 2.0), 3), "1");
}
