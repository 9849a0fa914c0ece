// SPDX-License-Identifier: Apache-2.0
// Rows F20 to F33: bounds, scales, time, and meters at the end of their range.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <random>
#include <vector>

#include "hard_case.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/fit/model/prepare.h"
#include "lightcal/fit/model/solve.h"
#include "lightcal/fit/model/starts.h"
#include "lightcal/fit/model/uncertainty.h"
#include "lightcal/photometry/lamp_flicker.h"
#include "synthetic_dng.h"

namespace lightcal::test::hard {
namespace {

using testing::ElementsAre;

// What the solver is handed of 4 readings of a lamp `light` times as strong.
fit::Prepared PreparedAt(double light) {
  fit::Observations observations;
  int index = 0;
  for (const auto& [d, lux] :
       std::vector<std::array<double, 2>>{{0.5, 410}, {1, 99}, {2, 25.3}, {4, 6.2}}) {
    fit::Observation row;
    row.index = index++;
    row.distance_m = d;
    row.measured_lx = row.raw_lx = lux * light;
    row.sigma_lx = 0.02 * lux * light;
    observations.rows.push_back(row);
  }
  observations.readings = index;
  return fit::Prepare(observations, fit::ForwardModel{});
}

TEST(HardCaseF, F20FaintAndFierceLampsAreOneProblem) {
  const auto run = [](double light, const char* room) {
    return KeySession("point", room)
        .At(0.5, 410 * light)
        .At(1, 99 * light)
        .At(2, 25.3 * light)
        .At(4, 6.2 * light)
        .Run();
  };
  const fit::Prepared solved = PreparedAt(1.0);
  for (const double light : {1e-8, 1e10}) {  // 1e-6 and 1e12 cd
    for (const bool dark : {false, true}) {
      const char* room = dark ? kDark : "";
      const Answer middle = run(1.0, room);
      const Answer other = run(light, room);
      ExpectAnswered(other);
      const auto ratio = [&](auto value, const char* key) {
        return value(other, key) / value(middle, key);
      };
      EXPECT_NEAR(ratio(U95, "intensity_cd") / light, 1.0, 1e-10) << room;
      EXPECT_NEAR(ratio(Value, "intensity_cd") / light, 1.0, 1e-10) << room;
      EXPECT_NEAR(ratio(Value, "distance_offset_m"), 1.0, 1e-9) << room;
      if (!dark) continue;  // among walls no ambient light is fitted
      EXPECT_NEAR(ratio(U95, "ambient_lx") / light, 1.0, 1e-10);
    }
    // Scaled alike before the solver sees them: its iterations are the same.
    const fit::Prepared scaled = PreparedAt(light);
    for (std::size_t i = 0; i < solved.estimation.rows.size(); ++i) {
      EXPECT_NEAR(scaled.estimation.rows[i].measured / solved.estimation.rows[i].measured, 1.0,
                  1e-14);
      EXPECT_NEAR(scaled.estimation.rows[i].sigma / solved.estimation.rows[i].sigma, 1.0, 1e-14);
    }
  }
}

TEST(HardCaseF, F21AnOffsetAtItsBoundIsSaid) {
  // d0 = -0.95 of the nearest reading's distance.
  for (const char* room : {"", kDark}) {
    const auto run = [&](double nearest, const std::vector<double>& distances) {
      KeySession session("point", room);
      for (const double d : distances) {
        session.At(nearest * d, 100.0 / ((d - 0.95) * (d - 0.95)), "sigma_relative = 0.001");
      }
      return session.Run();
    };
    const Answer two = run(0.2, {1.0, 1.1});
    ExpectWarned(two, "bound_active");
    EXPECT_NEAR(Value(two, "distance_offset_m"), -0.18, 1e-3);
    // No lamp starts so far before its mount, and three or more distances contradict the bound.
    ExpectRefused(run(1.0, {1.0, 1.1}), "model_misfit");
    ExpectRefused(run(1.0, {1.0, 1.1, 1.5, 2.0}), "model_misfit");
  }
}

// Rows of I = 1 and d0 = 0.03 in the solver's own units, each with its own sigma.
fit::Estimation FourRows(const std::vector<double>& sigmas) {
  fit::Estimation estimation;
  double d = 0.4;
  for (const double sigma : sigmas) {
    fit::ReadingRow row;
    row.distance = d;
    row.measured = std::exp(0.01 * std::sin(9.0 * d)) / ((d + 0.03) * (d + 0.03));
    row.sigma = sigma;
    estimation.rows.push_back(row);
    d *= 2.0;
  }
  estimation.rules[fit::kLnIntensity].free = true;
  estimation.rules[fit::kDistanceOffset] = {true, 0.0, 0.06};
  estimation.least_distance_offset = -0.36;
  return estimation;
}

TEST(HardCaseF, F22AHundredStartsEndAtOneOptimum) {
  const fit::Estimation estimation = FourRows({0.01, 0.01, 0.01, 0.01});
  const auto best = fit::Solve(estimation, fit::ClosedFormStart(estimation, 0.0));
  ASSERT_TRUE(best.has_value());
  std::mt19937_64 random(22);
  std::uniform_real_distribution<double> uniform;
  for (int i = 0; i < 100; ++i) {
    // The mirror image of d0 among them: d0 < -d_min/2 fits 1/d^2 from the other side.
    const fit::Theta start = {6.0 * uniform(random) - 3.0, 1.36 * uniform(random) - 0.355, 0.0};
    const auto found = fit::Solve(estimation, start);
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR((*found)[0], (*best)[0], 1e-8);
    EXPECT_NEAR((*found)[1], (*best)[1], 1e-8);
  }
}

TEST(HardCaseF, F23AmbientAtItsBoundHasAOneSidedInterval) {
  const Answer answer =
      KeySession("point", kDark).At(0.5, 400).At(1, 100).At(2, 25).At(4, 6.2).Run();
  ExpectAnswered(answer);
  const json& ambient = Lamp(answer)["ambient_lx"];
  EXPECT_EQ(ambient["low95"], 0.0);
  EXPECT_GT(ambient["high95"].get<double>(), 0.0);
  EXPECT_GE(ambient["value"].get<double>(), 0.0);
}

// Groups of `each` readings at ten distances, `groups` times; or each group's mean of ln E alone.
// Distances are exact: what all rows of one share adds up to more than either's rounding.
void WriteJournal(const TempDir& folder, int groups, int each, bool averaged) {
  const std::string lamp = "lightcal = 1\n[[light]]\nname = \"key\"\nkind = \"point\"\n";
  folder.Write("session.toml", lamp + "distance_sigma_m = 0\n" + kDarkBulb);
  std::mt19937_64 random(24);
  std::normal_distribution<double> normal;
  std::string journal;
  const auto line = [&](double d, double lux, double sigma) {
    journal += R"({"light":"key","distance_m":)" + Text(d) + R"(,"illuminance_lx":)" + Text(lux) +
               R"(,"sigma_relative":)" + Text(sigma) + "}\n";
  };
  for (int g = 0; g < groups; ++g) {
    const double d = 0.5 * (1 + g % 10);
    double sum = 0.0;
    for (int i = 0; i < each; ++i) {
      const double ln = std::log(100.0 / (d * d)) + 0.05 * normal(random);
      sum += ln;
      if (!averaged) line(d, std::exp(ln), 0.05);
    }
    if (averaged) line(d, std::exp(sum / each), 0.05 / std::sqrt(static_cast<double>(each)));
  }
  folder.Write("readings.jsonl", journal);
}

TEST(HardCaseF, F24AHundredThousandReadingsAreTheirMeans) {
  const TempDir all;
  const TempDir means;
  WriteJournal(all, 1000, 100, false);
  WriteJournal(means, 1000, 100, true);
  const auto fit = [](const TempDir& folder) {
    return Ask({"fit", folder.path(), "-o", folder.path() + "/light.json"});
  };
  const Answer a = fit(all);
  const Answer b = fit(means);
  ExpectAnswered(a);
  EXPECT_EQ(Lamp(a)["fit"]["used"], 100000);
  EXPECT_NEAR(Value(a, "intensity_cd") / Value(b, "intensity_cd"), 1.0, 1e-9);
  EXPECT_NEAR(U95(a, "intensity_cd") / U95(b, "intensity_cd"), 1.0, 1e-4);
}

TEST(HardCaseF, F25WeightsOverTwelveDecadesKeepTheCovariance) {
  // Two rows of sigma 1e-6 and two of 1: the truth by 2 x 2 normal equations in long double.
  fit::Estimation estimation = FourRows({1e-6, 1.0, 1e-6, 1.0});
  estimation.rules[fit::kDistanceOffset].prior_sd = 0.0;
  const auto theta = fit::Solve(estimation, fit::ClosedFormStart(estimation, 0.0));
  ASSERT_TRUE(theta.has_value());
  fit::UncertaintyInput input;
  input.estimation = &estimation;
  input.theta = *theta;
  const auto covariance = fit::EstimateCovariance(input);
  ASSERT_TRUE(covariance.has_value());
  long double a = 0.0L, b = 0.0L, c = 0.0L;
  for (const fit::ReadingRow& row : estimation.rows) {
    const long double weight = 1.0L / (static_cast<long double>(row.sigma) * row.sigma);
    const long double slope = -2.0L / (row.distance + (*theta)[fit::kDistanceOffset]);
    a += weight;
    b += weight * slope;
    c += weight * slope * slope;
  }
  const long double determinant = a * c - b * b;
  EXPECT_NEAR((*covariance)[0] / static_cast<double>(c / determinant), 1.0, 1e-6);
  EXPECT_NEAR((*covariance)[fit::kParameters + 1] / static_cast<double>(a / determinant), 1.0,
              1e-6);
}

TEST(HardCaseF, F26IdenticalReadingsAreNotCertain) {
  const Answer answer = KeySession().At(1, 100).At(1, 100).At(1, 100).Run();
  ExpectAnswered(answer);
  EXPECT_GT(U95(answer, "intensity_cd"), 1.0);
  ExpectRefused(KeySession().At(1, 100, "sigma_relative = 0").Run(), "bad_session");
  // A meter that shows 0.0 five times knows it to its last digit, not better.
  const Answer dark = KeySession().At(1, 0).At(1, 0).At(1, 0).Run();
  ExpectWarned(dark, "upper_limit");
  EXPECT_GE(Lamp(dark)["intensity_cd"]["high95"].get<double>(),
            1.96 * 0.1 / std::sqrt(12.0) / std::sqrt(3.0) * 0.99);
}

TEST(HardCaseF, F27AnOverloadedMeterSaysAtLeast) {
  // 400 lx is the truth at 0.5 m; the meter ended at 199.9.
  const Answer answer =
      KeySession("point", kDarkBulb).At(0.5, 199.9, "over_range = true").At(1, 100).At(2, 25).Run();
  ExpectAnswered(answer);
  EXPECT_NEAR(Value(answer, "intensity_cd"), 100.0, 1.0);
  ExpectRefused(KeySession().At(0.5, 199.9, "over_range = true").Run(), "over_range");
  // A limit that says nothing changes nothing: it took the corners out of a room.
  KeySession room("point", "fixture = \"bulb\"\n");
  room.At(1, 120).At(2, 30).At(3, 13.3333);
  const json without = Lamp(room.Run())["intensity_cd"];
  const json with = Lamp(room.At(1, 1, "over_range = true").Run())["intensity_cd"];
  for (const char* end : {"value", "low95", "high95"}) {
    EXPECT_NEAR(double(with[end]) / double(without[end]), 1.0, 0.01) << end << without << with;
  }
}

TEST(HardCaseF, F28AMeterBelowItsRangeSaysAtMost) {
  const Answer answer = KeySession("point", kDarkBulb)
                            .At(0.5, 400)
                            .At(1, 100)
                            .At(20, 0.5, "under_range = true")
                            .Run();
  ExpectAnswered(answer);
  EXPECT_NEAR(Value(answer, "intensity_cd"), 100.0, 1.0);
  ExpectWarned(KeySession().At(1, 0.5, "under_range = true").Run(), "upper_limit");
}

std::string At(int minute) {
  return "time = \"2026-01-01T10:" + std::string(minute < 10 ? "0" : "") + std::to_string(minute) +
         ":00Z\"";
}

TEST(HardCaseF, F29ALampThatWarmsUpIsSaid) {
  const std::vector<double> places = {0.5, 1, 2, 2, 1, 0.5, 1, 2};
  KeySession warming("point", kDark);
  KeySession steady("point", kDark);
  KeySession one_place("point", kDark);
  std::mt19937_64 random(29);
  std::normal_distribution<double> normal;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double lux = 100.0 / (places[i] * places[i]);
    const double noise = 1.0 + 0.001 * normal(random);
    const double droop = 1.0 - 0.01 * static_cast<double>(i);
    warming.At(places[i], lux * noise * droop, At(static_cast<int>(i)));
    steady.At(places[i], lux * noise, At(static_cast<int>(i)));
    one_place.At(1.0, 100.0 * noise * droop, At(static_cast<int>(i)));
  }
  ExpectWarned(warming.Run(), "drift");
  ExpectWarned(one_place.Run(), "drift");
  EXPECT_EQ(warming.Run({"--strict"}).exit_code, 3);
  const Answer calm = steady.Run();
  ExpectAnswered(calm);
  EXPECT_FALSE(Warns(calm, "drift"));
}

// A lamp read at 4 to 9 places with 3 % noise and a time each: whether drift is told.
bool DriftIsToldOfSteadyLamp(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> place(0.5, 4.0);
  Session session;
  session.surroundings = Surroundings::kDark;
  session.lights.emplace_back().name = "key";
  const int count = 4 + static_cast<int>(random() % 6);
  for (int i = 0; i < count; ++i) {
    Reading reading;
    reading.light = "key";
    const double d = place(random);
    reading.distance = Metres(d);
    reading.illuminance = Lux(100.0 / (d * d) * std::exp(0.03 * normal(random)));
    reading.sigma_relative = 0.03;  // of each alone; an unnamed meter repeats within 1 %
    reading.time = "2026-01-01T10:0" + std::to_string(i) + ":00Z";
    session.readings.emplace_back().reading = reading;
  }
  const auto fitted = FitSession(session, FitSettings{});
  EXPECT_TRUE(fitted.has_value());
  return fitted && std::any_of(fitted->warnings.begin(), fitted->warnings.end(),
                               [](const Warning& w) { return w.code == "drift"; });
}

TEST(HardCaseF, F29SteadyLampsAreSeldomAccused) {
  std::mt19937_64 random(2929);
  int accused = 0;
  for (int i = 0; i < 1000; ++i) accused += DriftIsToldOfSteadyLamp(random) ? 1 : 0;
  EXPECT_LE(accused, 5);
}

TEST(HardCaseF, F30AClockThatWentBackIsSaid) {
  const auto run = [](int first, int second, int third) {
    return KeySession().At(0.5, 192, At(first)).At(1, 48, At(second)).At(2, 12, At(third)).Run();
  };
  ExpectWarned(run(10, 5, 20), "clock_backwards");
  ExpectWarned(run(5, 10, 10), "duplicate_time");
  const Answer in_order = run(5, 10, 20);
  EXPECT_FALSE(Warns(in_order, "clock_backwards") || Warns(in_order, "duplicate_time"));
  EXPECT_NEAR(Value(run(10, 5, 20), "intensity_cd"), Value(in_order, "intensity_cd"), 1e-12);
}

TEST(HardCaseF, F31OneFrameOfAPulsingLampIsRefused) {
  const LampFlicker lamp{100.0, 0.05};
  const double periods = 0.2;
  // The rule (1 - D)/n, and the worst moment of a 1/500 s frame: a whole pulse or none.
  EXPECT_NEAR((1.0 - lamp.duty) / periods, 4.75, 1e-12);
  EXPECT_NEAR(WorstFlickerError(lamp, Seconds(1.0 / 500.0)), 4.0, 1e-12);

  const TempDir folder;
  SyntheticCamera camera;
  camera.width = camera.height = 96;
  SyntheticExposure exposure;
  exposure.true_time_s = exposure.label_time_s = 1.0 / 500.0;
  const Words files = WriteDngBracket(folder.path(), "f", camera, {exposure},
                                      [](int, int) { return XyzOf(500.0); });
  const std::string output = folder.path() + "/lum.exr";
  ExpectRefused(Ask({"merge", files.at(0), "-o", output, "--pwm", "100,0.05"}),
                "flicker_unsafe_shutter");
  EXPECT_FALSE(std::filesystem::exists(output));
  ExpectAnswered(Ask({"merge", files.at(0), "-o", output, "--mains", "none"}));
}

TEST(HardCaseF, F32AGrazingMeterSaysNothing) {
  ExpectRefused(KeySession().At(0.5, 192, "tilt_deg = 90").Run(), "bad_session");
  ExpectWarned(KeySession().At(0.5, 0.3, "tilt_deg = 89.9").Run(), "upper_limit");
  // Lying flat at the lamp's own height.
  const Answer edge = KeySession("point", "position_m = [0, 0, 1]").Flat({1, 0, 1}, 5).Run();
  ExpectRefused(edge, "no_valid_readings");
}

TEST(HardCaseF, F33AMeterThatFacesAwayIsRefused) {
  for (const char* tilt : {"tilt_deg = 120", "tilt_deg = -120", "tilt_deg = 180"}) {
    ExpectRefused(KeySession().At(0.5, 192, tilt).Run(), "bad_session");
  }
  // Facing up above the lamp, beside one that sees it.
  const Answer answer =
      KeySession("point", "position_m = [0, 0, 1]").Flat({0, 0, 2}, 100).Flat({0, 0, 0}, 100).Run();
  ExpectWarned(answer, "row_rejected");
  EXPECT_THAT(Rejected(answer), ElementsAre(0));
}

}  // namespace
}  // namespace lightcal::test::hard
