#include "runner/study/unit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace seapile::study {
namespace {

using std::numbers::pi;

double in(std::string_view text, std::string_view unit) {
  const UnitResult result = read_quantity(text, unit);
  EXPECT_EQ(result.problem, "") << text;
  return result.value;
}

TEST(Quantity, ConvertsToTheUnitOfTheField) {
  EXPECT_EQ(in("0.06 m/s", "m/s"), 0.06);
  EXPECT_EQ(in("6 cm/s", "m/s"), 0.06);
  EXPECT_EQ(in("3.6 km/h", "m/s"), 1);
  EXPECT_EQ(in("12 mm", "m"), 0.012);
  EXPECT_EQ(in("250 um", "m"), 250e-6);
  EXPECT_EQ(in("250 µm", "m"), 250e-6);
  EXPECT_EQ(in("20 Hz", "Hz"), 20);
  EXPECT_EQ(in("0.5 kHz", "Hz"), 500);
  EXPECT_EQ(in("20 1/s", "Hz"), 20);
  EXPECT_EQ(in("5 ms", "s"), 0.005);
  EXPECT_EQ(in("2 min", "s"), 120);
  EXPECT_EQ(in("1.5 t/m3", "kg/m3"), 1500);
  EXPECT_EQ(in("1.5 g/cm^3", "kg/m3"), 1500);
  EXPECT_EQ(in("1500 kg/m³", "kg/m3"), 1500);
  EXPECT_EQ(in("9.81 m/s²", "m/s2"), 9.81);
  EXPECT_EQ(in("9.81 m s^-2", "m/s2"), 9.81);
  EXPECT_EQ(in("80 %", "-"), 0.8);
  for (const char* water : {"1e-6 m2/s", "1 mm2/s", "1 mm²/s", "1 cSt"}) EXPECT_EQ(in(water, "m2/s"), 1e-6) << water;
}

TEST(Quantity, WhiteSpaceIsFree) {
  EXPECT_EQ(in("0.06m/s", "m/s"), 0.06);
  EXPECT_EQ(in("  0.06   m / s  ", "m/s"), 0.06);
}

// An id must not depend on how a number is spelled.
TEST(Quantity, PowersOfTenLoseNoBit) {
  for (int i = 1; i < 2000; ++i) {
    const std::string millimetres = std::to_string(i) + ".7 mm";
    EXPECT_EQ(in(millimetres, "m"), std::stod(std::to_string(i) + ".7e-3")) << millimetres;
  }
  EXPECT_EQ(in("19.2 mm", "m"), 1.92e-2);
  EXPECT_EQ(in("11.2e0 mm", "m"), 1.12e-2);
  EXPECT_EQ(in("0.1e1 km", "m"), 1000);
}

TEST(Quantity, DegreesAreTheRadiansThatTheSpecsWrite) {
  EXPECT_EQ(in("60 deg", "rad"), pi / 3);
  EXPECT_EQ(in("60°", "rad"), pi / 3);
  EXPECT_EQ(in("10 deg", "rad"), pi / 18);
  EXPECT_EQ(in("90 deg", "rad"), pi / 2);
  EXPECT_EQ(in("180 deg", "rad"), pi);
  EXPECT_EQ(in("1.25 rad", "rad"), 1.25);
}

TEST(Quantity, ZeroIsZeroInEveryUnit) {
  EXPECT_EQ(in("0 mm", "m"), 0);
  EXPECT_EQ(in("0.00e-9 mm", "m"), 0);
}

TEST(Quantity, AnotherDimensionIsAProblem) {
  for (const char* text : {"1 s", "1 m/s", "1 m2", "1 kg", "1 deg", "1 %", "1 -"}) {
    EXPECT_NE(read_quantity(text, "m").problem, "") << text;
  }
}

TEST(Quantity, WhatIsNoNumberWithAUnitIsAProblem) {
  for (const char* text :
       {"",     " ",    "m",       "1",    "1 mmm",  "1 M",   "NaN m",   "inf m",    "-inf m", "0x10 m", "+1 m", ".5 m",
        "1. m", "01 m", "1 m m m", "1 m/", "1 m//s", "1,5 m", "1e400 m", "1e-400 m", "1 m 2",  "1 m^",   "1 /m/"}) {
    EXPECT_NE(read_quantity(text, "m").problem, "") << text;
  }
}

TEST(Quantity, SuggestsWhatWasMeant) {
  EXPECT_EQ(read_quantity("1.2", "m").nearest, "1.2 m");
  EXPECT_EQ(read_quantity("60", "rad").nearest, "60 deg");
  EXPECT_EQ(read_quantity("0.5", "-").nearest, "0.5");
  EXPECT_EQ(read_quantity("0.06 m/sec", "m/s").nearest, "0.06 m/s");
  EXPECT_EQ(read_quantity("5 s", "m/s").nearest, "0.06 m/s");
}

TEST(NumberText, IsShortAndReadsBackAsTheSameDouble) {
  EXPECT_EQ(number_text(1500), "1500");
  EXPECT_EQ(number_text(0.06), "0.06");
  EXPECT_EQ(number_text(5e-4), "0.0005");
  EXPECT_EQ(number_text(-0.0), "0");
  for (const double number : {pi, 1e-300, 1.0 / 3, 123456789.123}) EXPECT_EQ(std::stod(number_text(number)), number);
}

TEST(QuantityOfAnyKind, KeepsTheUnitThatWasWritten) {
  Quantity quantity;
  EXPECT_EQ(read_quantity(" 44.3 kPa ", quantity).problem, "");
  EXPECT_EQ(quantity.value, 44.3);
  EXPECT_EQ(quantity.unit, "kPa");
  EXPECT_EQ(read_quantity("-1e-3 J/m", quantity).problem, "");
  EXPECT_EQ(quantity.value, -1e-3);
  EXPECT_EQ(quantity.unit, "J/m");
}

TEST(QuantityOfAnyKind, IsRefusedWithoutNumberOrUnit) {
  Quantity quantity;
  EXPECT_EQ(read_quantity("", quantity).problem, "is a string without a number");
  EXPECT_EQ(read_quantity("kPa", quantity).problem, "is a string without a number");
  EXPECT_EQ(read_quantity("44.3", quantity).problem, "is a number in quotes");
  EXPECT_EQ(read_quantity("44.3 kPaa", quantity).problem, "has an unknown unit \"kPaa\"");
  EXPECT_EQ(read_quantity("44.3 kPaa", quantity).nearest, "44.3 kPa");
  EXPECT_EQ(read_quantity("1e400 Pa", quantity).problem, "overflows or is too small");
}

TEST(Convert, LosesNoBitByPowersOfTen) {
  EXPECT_EQ(convert({44.3, "kPa"}, "Pa").value, 44300);
  EXPECT_EQ(convert({19.2, "mm"}, "m").value, 0.0192);
  EXPECT_EQ(convert({5, "%"}, "-").value, 0.05);
  EXPECT_EQ(convert({2, "kJ/m"}, "J/m").value, 2000);
  EXPECT_EQ(convert({3, ""}, "Pa").value, 3);
  EXPECT_EQ(convert({44300, "N/m2"}, "kPa").value, 44.3);
  EXPECT_EQ(convert({7.2, "km/h"}, "m/s").value, 2);
  EXPECT_DOUBLE_EQ(convert({pi / 3, "rad"}, "deg").value, 60);
}

TEST(Convert, RefusesAnotherKindAndWhatIsNoUnit) {
  EXPECT_EQ(convert({1, "m"}, "Pa").problem, "is in m, which is not a unit for Pa");
  EXPECT_EQ(convert({1, "m"}, "furlong").problem, "has an unknown unit \"furlong\"");
  EXPECT_EQ(convert({1, "furlong"}, "furlong").value, 1);
  EXPECT_EQ(convert({1, "N/m"}, "Pa").problem, "is in N/m, which is not a unit for Pa");
}

}  // namespace
}  // namespace seapile::study
