// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <string>

#include "lightcal/core/file_name.h"
#include "lightcal/core/nearest_word.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/stops.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/core/units_text.h"

namespace lightcal {
namespace {

TEST(UnitsText, LengthsAcceptTheUnitsPeopleType) {
  EXPECT_DOUBLE_EQ(ParseLength("0.5m")->value(), 0.5);
  EXPECT_DOUBLE_EQ(ParseLength("50cm")->value(), 0.5);
  EXPECT_DOUBLE_EQ(ParseLength("20in")->value(), 0.508);
  EXPECT_DOUBLE_EQ(ParseLength("2ft")->value(), 0.6096);
  EXPECT_DOUBLE_EQ(ParseLength("2")->value(), 2.0);
}

TEST(UnitsText, AFootcandleIsALumenPerSquareFoot) {
  EXPECT_NEAR(ParseIlluminance("17.8fc")->value(), 191.597, 1e-3);
  EXPECT_DOUBLE_EQ(ParseIlluminance("192lx")->value(), 192.0);
}

// 2.5 lx x 2^10 under C = 250, 3.4 under C = 340 (ISO 2720).
TEST(UnitsText, AnIncidentMetersExposureValueIsTwoIlluminances) {
  for (const char* ev : {"EV10", "10EV", "ev 10", "10 EV"}) {
    const auto refused = ParseIlluminance(ev);
    ASSERT_FALSE(refused.has_value()) << ev;
    EXPECT_NE(refused.error().message.find("2560 lx under its flat receptor"), std::string::npos)
        << refused.error().message;
    EXPECT_NE(refused.error().message.find("3482 lx under its dome"), std::string::npos);
  }
  EXPECT_NE(ParseIlluminance("f/5.6").error().message.find("a shutter and an ISO"),
            std::string::npos);
}

TEST(UnitsText, TimesMayBeFractions) {
  EXPECT_DOUBLE_EQ(ParseDuration("1/60")->value(), 1.0 / 60.0);
  EXPECT_DOUBLE_EQ(ParseDuration("60s")->value(), 60.0);
  EXPECT_DOUBLE_EQ(ParseFNumber("f/2.8").value(), 2.8);
}

TEST(UnitsText, WrongUnitsAndNotANumberAreUsageErrors) {
  EXPECT_EQ(ParseLength("3lx").error().kind, ErrorKind::kUsage);
  EXPECT_FALSE(ParseLength("nan").has_value());
  EXPECT_FALSE(ParseLength("inf").has_value());
  EXPECT_FALSE(ParseLength("").has_value());
  EXPECT_FALSE(ParseDuration("1/0").has_value());
  EXPECT_FALSE(ParseLength("1e999m").has_value());
}

TEST(NumbersText, ShortestTextReadsBackExactly) {
  EXPECT_EQ(ShortestText(0.1), "0.1");
  EXPECT_EQ(ShortestText(-0.0), "0");
  EXPECT_EQ(ParseNumber(ShortestText(1.0 / 3.0)), 1.0 / 3.0);
}

TEST(NumbersText, DecimalCommasAreReadOnlyWhenAskedFor) {
  EXPECT_EQ(ParseNumber("1,34E+00", true), 1.34);
  EXPECT_FALSE(ParseNumber("1,34E+00").has_value());
  EXPECT_FALSE(ParseNumber("1.234,5", true).has_value());
  EXPECT_FALSE(ParseNumber("12 lx").has_value());
}

TEST(NearestWord, FindsTheTypoAndOnlyTheTypo) {
  constexpr std::array<std::string_view, 3> kKnown = {"distance_m", "illuminance_lx", "tilt_deg"};
  EXPECT_EQ(NearestWord("distnace_m", kKnown), "distance_m");
  EXPECT_EQ(NearestWord("ilumninance_lx", kKnown), "illuminance_lx");
  EXPECT_EQ(NearestWord("zebra", kKnown), "");
  constexpr std::array<std::string_view, 2> kShort = {"x", "ym"};
  EXPECT_EQ(NearestWord("m", kShort), "ym") << "which has a letter of it; x has none";
}

TEST(Uncertain, ALogNormalIntervalHoldsItsEnds) {
  const Uncertain u = UncertainFromLog(std::log(48.0), 0.3);
  EXPECT_NEAR(u.value, 48.0, 1e-12);
  EXPECT_NEAR(*u.low * *u.high, 48.0 * 48.0, 1e-9);
  EXPECT_NEAR(u.u95, (*u.high - *u.low) / 2.0, 1e-12);
}

TEST(Stops, AreHalfTheLogarithmOfTheEnds) {
  EXPECT_NEAR(*HalfWidthStops({100.0, 0.0, 50.0, 200.0}), 1.0, 1e-15);
  EXPECT_NEAR(*HalfWidthStops({100.0, 25.0, {}, {}}), 0.5 * std::log2(125.0 / 75.0), 1e-15);
  const Uncertain u = UncertainFromLog(std::log(48.0), 0.1);
  EXPECT_NEAR(*HalfWidthStops(u), StopsOfSd(0.1), 1e-12);
  EXPECT_FALSE(HalfWidthStops({1.0, 1.0, 0.0, 2.0})) << "an upper limit";
}

TEST(FileName, OneThatDiffersInCaseAloneIsTaken) {
  std::set<std::string> taken;
  EXPECT_EQ(DistinctFileName("lamp-Key", taken), "lamp-Key");
  EXPECT_EQ(DistinctFileName("lamp-key", taken), "lamp-key_");
  EXPECT_EQ(DistinctFileName("lamp-fill", taken), "lamp-fill");
}

}  // namespace
}  // namespace lightcal
