// SPDX-License-Identifier: Apache-2.0
// Rows F01 to F19: too few readings, wrong ones, impossible ones.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "hard_case.h"

namespace lightcal::test::hard {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kZ95 = 1.959963984540054;

TEST(HardCaseF, F01TwoReadingsAtOneDistanceGiveTheIntensityAlone) {
  const Answer answer = KeySession("point", kDarkBulb).At(0.5, 190).At(0.5, 194).Run();
  ExpectAnswered(answer);
  EXPECT_NEAR(Value(answer, "intensity_cd"), 0.25 * std::sqrt(190.0 * 194.0), 0.01);
  EXPECT_TRUE(IsPrior(answer, "distance_offset"));
  EXPECT_TRUE(IsPrior(answer, "ambient"));
}

TEST(HardCaseF, F02OneReadingIsEnoughAndWide) {
  const Answer answer = KeySession("point", kDarkBulb).At(0.5, 192).Run();
  ExpectAnswered(answer);
  EXPECT_NEAR(Value(answer, "intensity_cd"), 48.0, 1e-9);
  // ln I: the meter's 5 %, 1 % from reading to reading, and twice the bulb's 3 cm of 50.
  EXPECT_NEAR(std::log(Lamp(answer)["intensity_cd"]["high95"].get<double>() / 48.0),
              kZ95 * std::hypot(0.05, 0.01, 0.12), 0.01);
  EXPECT_TRUE(IsPrior(answer, "distance_offset"));
}

TEST(HardCaseF, F03NoReadingIsRefused) { ExpectRefused(KeySession().Run(), "no_readings"); }

TEST(HardCaseF, F04DuplicateDistancesGiveTheMean) {
  const Answer answer =
      KeySession("point", kDarkBulb).At(2, 10).At(2, 10.2).At(2, 9.9).At(2, 10.1).Run();
  ExpectAnswered(answer);
  EXPECT_NEAR(Value(answer, "intensity_cd"), 4.0 * std::pow(10 * 10.2 * 9.9 * 10.1, 0.25), 1e-6);
  EXPECT_TRUE(IsPrior(answer, "distance_offset"));
}

TEST(HardCaseF, F05DistancesTooCloseLeaveThePriorInCharge) {
  const Answer answer =
      KeySession("point", kDarkBulb).At(1, 100).At(1.05, 91.2).At(1.1, 82.1).Run();
  ExpectAnswered(answer);
  EXPECT_LT(U95(answer, "intensity_cd") / Value(answer, "intensity_cd"), 0.7);
  EXPECT_TRUE(IsPrior(answer, "distance_offset"));
  EXPECT_TRUE(IsPrior(answer, "ambient"));
}

// 100 cd at six distances, the readings at `wrong` three times too bright.
Answer SixReadings(const std::vector<int>& wrong) {
  KeySession session("point", kDark);
  int i = 0;
  for (const double d : {0.5, 0.7, 1.0, 1.4, 2.0, 2.8}) {
    double lux = 100.0 / (d * d);
    for (const int w : wrong) lux *= w == i ? 3.0 : 1.0;
    ++i;
    session.At(d, lux);
  }
  return session.Run();
}

TEST(HardCaseF, F06OneOutlierInSixMovesNothing) {
  for (int wrong = 0; wrong < 6; ++wrong) {
    const Answer answer = SixReadings({wrong});
    ExpectWarned(answer, "row_rejected");
    EXPECT_NEAR(Value(answer, "intensity_cd"), 100.0, 2.0) << wrong;
    EXPECT_THAT(Rejected(answer), ElementsAre(wrong));
  }
}

TEST(HardCaseF, F07TwoOutliersInSixMoveLittle) {
  for (int a = 0; a < 6; ++a) {
    for (int b = a + 1; b < 6; ++b) {
      const Answer answer = SixReadings({a, b});
      // Neighbours that err together are no blunders: another lamp may shine.
      if (b == a + 1) {
        ExpectRefused(answer, "model_misfit");
        continue;
      }
      ExpectWarned(answer, "row_rejected");
      EXPECT_NEAR(Value(answer, "intensity_cd"), 100.0, 3.0) << a << " " << b;
    }
  }
}

TEST(HardCaseF, F08TwoOfFourAreNamedAndNonePicked) {
  const Answer answer =
      KeySession("point", kDarkBulb).At(1, 100).At(1, 100.5).At(1, 150).At(1, 151).Run();
  ExpectWarned(answer, "bimodal");
  EXPECT_THAT(Rejected(answer), ElementsAre());
  EXPECT_LT(Lamp(answer)["intensity_cd"]["low95"].get<double>(), 100.0);
  EXPECT_GT(Lamp(answer)["intensity_cd"]["high95"].get<double>(), 151.0);
}

TEST(HardCaseF, F09AReadingOfZeroCounts) {
  const Answer answer = KeySession("point", kDarkBulb).At(0.5, 400).At(1, 100).At(20, 0).Run();
  ExpectAnswered(answer);
  EXPECT_NEAR(Value(answer, "intensity_cd"), 100.0, 5.0);
  EXPECT_EQ(Lamp(answer)["fit"]["used"], 3);
}

TEST(HardCaseF, F10ANegativeDifferenceKeepsItsSign) {
  // 100 cd in 100 lx of other light: 16 m away 0.4 lx are left, and 2 % of 100 lx hide them.
  const auto card = [](KeySession& session, double d, double lit, double dark) {
    session.At(d, lit, "sigma_relative = 0.02")
        .At(d, dark, "shadow_card = true\nsigma_relative = 0.02");
  };
  KeySession near_and_far;
  card(near_and_far, 0.5, 500.0, 100.0);
  card(near_and_far, 16.0, 98.9, 100.1);
  const Answer kept = near_and_far.Run();
  ExpectWarned(kept, "negative_difference");
  EXPECT_EQ(Lamp(kept)["fit"]["used"], 4);
  EXPECT_LT(Lamp(kept)["intensity_cd"]["low95"].get<double>(), 100.0);
  EXPECT_GT(Lamp(kept)["intensity_cd"]["high95"].get<double>(), 100.0);

  KeySession lost;
  card(lost, 1.0, 100.0, 101.0);
  const Answer limit = lost.Run();
  ExpectWarned(limit, "upper_limit");
  EXPECT_EQ(Lamp(limit)["intensity_cd"]["low95"], 0.0);
}

TEST(HardCaseF, F11WhatIsNoNumberIsRejectedAndCounted) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    // A person's typing error is shown to the person.
    ExpectRefused(KeySession().At(0.5, 192).At(1, bad).Run(), "bad_session");
  }
  KeySession session("point", kDarkBulb);
  session.Journal(R"({"light":"key","distance_m":0.5,"illuminance_lx":192})");
  for (const char* bad : {"NaN", "1e999", "null"}) {
    session.Journal(R"({"light":"key","distance_m":1,"illuminance_lx":)" + std::string(bad) + "}");
  }
  const Answer answer = session.Run();
  ExpectWarned(answer, "bad_reading");
  EXPECT_EQ(answer.document["warnings"].size(), 4U) << answer.document["warnings"];
  EXPECT_NEAR(Value(answer, "intensity_cd"), 48.0, 1e-9);
}

TEST(HardCaseF, F12ADistanceOfZeroIsRejected) {
  ExpectRefused(KeySession().At(0.5, 192).At(0, 5000).Run(), "bad_session");
  const Answer answer = KeySession("point", kDarkBulb)
                            .Journal(R"({"light":"key","distance_m":0.5,"illuminance_lx":192})")
                            .Journal(R"({"light":"key","distance_m":0,"illuminance_lx":5000})")
                            .Run();
  ExpectWarned(answer, "bad_reading");
  EXPECT_NEAR(Value(answer, "intensity_cd"), 48.0, 1e-9);
}

TEST(HardCaseF, F13ANegativeDistanceIsRefused) {
  ExpectRefused(KeySession().At(0.5, 192).At(-1, 48).Run(), "bad_session");
  ExpectRefused(
      KeySession().Journal(R"({"light":"key","distance_m":-1,"illuminance_lx":48})").Run(),
      "no_readings");
}

TEST(HardCaseF, F14AReadingInsideTheLampIsRejected) {
  const Answer globe = KeySession("sphere", "diameter_m = 0.2").At(0.5, 192).At(1e-6, 1e5).Run();
  ExpectWarned(globe, "row_rejected");
  EXPECT_THAT(Rejected(globe), ElementsAre(1));
  // A lamp without a size has no inside, but no one knows a distance of a micrometre.
  const Answer point = KeySession("point", kDarkBulb).At(0.5, 192).At(1e-6, 1e5).Run();
  ExpectWarned(point, "row_rejected");
  EXPECT_NEAR(Value(point, "intensity_cd"), 48.0, 1e-9);
  ExpectRefused(KeySession().At(1e-6, 1e5).Run(), "no_valid_readings");
  // At 2 mm an error of a centimetre decides.
  ExpectRefused(KeySession().At(2e-3, 1e5).Run(), "underdetermined");
}

TEST(HardCaseF, F15CentimetresAmongMetresAreNamed) {
  const Answer answer =
      KeySession().At(0.5, 192).At(1, 48).At(2, 12).At(150, 21.3).At(300, 5.3).Run();
  ExpectRefused(answer, "units_ambiguous");
  const std::string message = answer.document["error"]["message"];
  EXPECT_THAT(message, HasSubstr("readings 3 and 4"));
  EXPECT_THAT(message, HasSubstr("cm"));
}

TEST(HardCaseF, F16FeetAndFootcandlesAreAskedAbout) {
  const Answer candles = KeySession().At(0.5, 192).At(1, 48).At(2, 12 / 10.764).Run();
  ExpectRefused(candles, "units_ambiguous");
  const Answer feet = KeySession().At(0.5, 192).At(1 / 0.3048, 48).At(2, 12).Run();
  ExpectRefused(feet, "units_ambiguous");
  // One ratio, two readings of it: both are named.
  const std::string message = candles.document["error"]["message"];
  EXPECT_THAT(message, HasSubstr("footcandles"));
  EXPECT_THAT(message, HasSubstr("feet"));
}

TEST(HardCaseF, F17AmbientAHundredTimesTheLampIsWide) {
  const std::string now = "time = \"2026-03-01T10:00:00Z\"";  // no daylight drifts between them
  const auto run = [&](const char* lines) {
    return KeySession("point", lines)
        .At(1, 101, "sigma_relative = 0.001\n" + now)
        .At(1, 100, "shadow_card = true\nsigma_relative = 0.001\n" + now)
        .Run();
  };
  const Answer answer = run(kDarkBulb);
  ExpectAnswered(answer);
  EXPECT_NEAR(Value(answer, "intensity_cd"), 1.0, 1e-6);
  EXPECT_GE(U95(answer, "intensity_cd") / kZ95, 0.14);
  // Among walls the card hides some of their light: 4 lx of 100, more than the lamp gives.
  ExpectWarned(run(""), "upper_limit");
}

TEST(HardCaseF, F18LightThatGrowsWithDistanceIsRefused) {
  ExpectRefused(KeySession().At(0.5, 100).At(1, 200).At(2, 390).Run(), "increasing_with_distance");
  ExpectRefused(KeySession("point", kDarkBulb).At(0.5, 100).At(1, 98).At(2, 97).Run(),
                "model_misfit");
  ExpectWarned(KeySession().At(0.5, 100).At(1, 98).At(2, 97).Run(), "slow_falloff");
  ExpectWarned(KeySession().At(0.5, 100).At(1, 98).Run(), "slow_falloff");
}

TEST(HardCaseF, F19PerfectReadingsKeepAnUncertainty) {
  const Answer answer =
      KeySession("point", kDarkBulb).At(0.5, 400).At(1, 100).At(2, 25).At(4, 6.25).Run();
  ExpectAnswered(answer);
  EXPECT_NEAR(Value(answer, "intensity_cd"), 100.0, 1e-6);
  EXPECT_GT(U95(answer, "intensity_cd"), 1.0);
  EXPECT_NEAR(Lamp(answer)["fit"]["chi2_dof"].get<double>(), 0.0, 1e-12);
}

}  // namespace
}  // namespace lightcal::test::hard
