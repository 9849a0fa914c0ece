// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/camera/spectral_mismatch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "lightcal/colorimetry/cri.h"
#include "lightcal/colorimetry/illuminants.h"
#include "lightcal/colorimetry/rendering_input.h"
#include "lightcal/core/uncertain.h"
#include "measured_lamps.h"

namespace lightcal::test {
namespace {

constexpr double kMostWhiteLedRms = 0.02;

std::string Word(LampClass lamp) {
  return std::string(kLampClassWords[static_cast<std::size_t>(lamp)]);
}

// Every camera looking at every lamp: seen[camera][lamp].
struct Bench {
  std::vector<MeasuredLamp> lamps = MeasuredLamps();
  std::vector<CameraSensitivities> sensitivities = MeasuredCameras();
  std::vector<SpectralCamera> cameras;
  std::vector<std::vector<LampSeen>> seen;

  Bench() {
    for (const CameraSensitivities& one : sensitivities) {
      auto camera = SpectralCamera::Make(one);
      EXPECT_TRUE(camera) << one.camera;
      if (!camera) continue;
      std::vector<LampSeen> row;
      for (const MeasuredLamp& lamp : lamps) {
        const auto answer = camera->See(lamp.spectrum);
        EXPECT_TRUE(answer) << one.camera << " " << lamp.name;
        row.push_back(answer.value_or(LampSeen{}));
      }
      cameras.push_back(std::move(*camera));
      seen.push_back(std::move(row));
    }
  }
};

const Bench& TheBench() {
  static const Bench bench;
  return bench;
}

// Errors of all cameras at the lamps of one class, relative, with the interval they are to lie in.
struct Score {
  double before2 = 0.0, after2 = 0.0;
  int count = 0, inside = 0, cameras_worse = 0;
  [[nodiscard]] double Before() const { return std::sqrt(before2 / count); }
  [[nodiscard]] double After() const { return std::sqrt(after2 / count); }
};

void Add(const LampSeen& lamp, const MismatchFactor& factor, Score& score) {
  const double before = 1.0 / lamp.factor - 1.0;
  const double after = factor.At(Mireds(lamp.mired)) / lamp.factor - 1.0;
  score.before2 += before * before;
  score.after2 += after * after;
  ++score.count;
  if (std::abs(after) <= kZ95 * factor.sigma) ++score.inside;
}

// The class's lamps but this one: what the factor that judges it is fitted on. The measured lamps,
// and for classes of fewer than three the library's own spectra of other names.
MismatchFactor FactorWithout(const Bench& bench, std::size_t camera, std::size_t left_out) {
  const LampClass lamp = bench.lamps[left_out].lamp;
  std::vector<LampSeen> rest;
  for (std::size_t i = 0; i < bench.lamps.size(); ++i) {
    if (i != left_out && bench.lamps[i].lamp == lamp) rest.push_back(bench.seen[camera][i]);
  }
  if (rest.size() < 3) {
    const auto own = IlluminantSpectrum(bench.lamps[left_out].name);
    for (const Spectrum& spectrum : LampSpectra(lamp)) {
      if (own && own->values == spectrum.values) continue;
      rest.push_back(bench.cameras[camera].See(spectrum).value_or(LampSeen{}));
    }
  }
  const auto factor = FitMismatchFactor(lamp, rest);
  EXPECT_TRUE(factor);
  return factor.value_or(MismatchFactor{});
}

std::map<LampClass, Score> LeaveEachLampOut(const Bench& bench) {
  std::map<LampClass, Score> scores;
  for (std::size_t c = 0; c < bench.cameras.size(); ++c) {
    std::map<LampClass, Score> own;
    for (std::size_t i = 0; i < bench.lamps.size(); ++i) {
      Add(bench.seen[c][i], FactorWithout(bench, c, i), own[bench.lamps[i].lamp]);
    }
    for (const auto& [lamp, score] : own) {
      Score& all = scores[lamp];
      all.before2 += score.before2;
      all.after2 += score.after2;
      all.count += score.count;
      all.inside += score.inside;
      if (score.After() > score.Before() * (1.0 + 1e-9)) ++all.cameras_worse;
    }
  }
  return scores;
}

TEST(SpectralMismatch, TheBenchHolds52CamerasAndEveryMeasuredLamp) {
  EXPECT_EQ(TheBench().cameras.size(), 52U);
  EXPECT_EQ(TheBench().lamps.size(), 22U);
}

TEST(SpectralMismatch, WhiteLedsAreClassedByTheirR9) {
  for (const MeasuredLamp& lamp : TheBench().lamps) {
    const bool white = lamp.lamp == LampClass::kWhiteLed;
    if (!white && lamp.lamp != LampClass::kHighCriLed) continue;
    const auto input = PrepareRendering(lamp.spectrum);
    ASSERT_TRUE(input) << lamp.name;
    EXPECT_EQ(ColorRenderingOf(*input).R[8] < 70.0, white) << lamp.name;
  }
}

TEST(SpectralMismatch, AFactorLinearInMiredReadsWhiteLedsWithinTwoPercentOverAllCameras) {
  auto scores = LeaveEachLampOut(TheBench());
  std::printf("%-14s lamps x cameras  rms uncorrected  rms left out  inside  cameras worse\n",
              "class");
  for (const auto& [lamp, score] : scores) {
    std::printf("%-14s %15d %15.2f %% %11.2f %% %6.1f %% %7d\n", Word(lamp).c_str(), score.count,
                100.0 * score.Before(), 100.0 * score.After(), 100.0 * score.inside / score.count,
                score.cameras_worse);
    EXPECT_LE(score.After(), score.Before() * (1.0 + 1e-9)) << Word(lamp) << ": never worse";
    EXPECT_GE(score.inside, 0.95 * score.count) << Word(lamp);
  }
  const Score& white = scores[LampClass::kWhiteLed];
  EXPECT_LE(white.After(), kMostWhiteLedRms);
  EXPECT_EQ(white.cameras_worse, 0);
}

TEST(SpectralMismatch, TheFactorsOfTheCieTablesHoldForLampsThatInstrumentsMeasured) {
  const Bench& bench = TheBench();
  std::map<LampClass, Score> scores;
  for (std::size_t c = 0; c < bench.cameras.size(); ++c) {
    std::map<LampClass, MismatchFactor> factors;
    for (std::size_t k = 0; k < kLampClassWords.size(); ++k) {
      const auto factor = bench.cameras[c].FactorFor(static_cast<LampClass>(k));
      ASSERT_TRUE(factor);
      factors[static_cast<LampClass>(k)] = *factor;
    }
    for (std::size_t i = 0; i < bench.lamps.size(); ++i) {
      if (bench.lamps[i].name.starts_with("LED-")) continue;
      Add(bench.seen[c][i], factors[bench.lamps[i].lamp], scores[bench.lamps[i].lamp]);
    }
  }
  int inside = 0, count = 0;
  for (const auto& [lamp, score] : scores) {
    std::printf("%-14s %5d: %.2f %% -> %.2f %%, inside %d\n", Word(lamp).c_str(), score.count,
                100.0 * score.Before(), 100.0 * score.After(), score.inside);
    EXPECT_LE(score.After(), score.Before() * (1.0 + 1e-9)) << Word(lamp);
    inside += score.inside;
    count += score.count;
  }
  EXPECT_GE(inside, 0.95 * count);
}

// Of a camera that nobody measured: leave each lamp out over all cameras at once.
TEST(SpectralMismatch, TheGenericFactorHoldsNinetyFivePercentOfCamerasAndLamps) {
  const Bench& bench = TheBench();
  std::map<LampClass, Score> scores;
  for (const auto& row : bench.seen) {
    for (std::size_t i = 0; i < bench.lamps.size(); ++i) {
      Add(row[i], GenericMismatch(bench.lamps[i].lamp), scores[bench.lamps[i].lamp]);
    }
  }
  for (const auto& [lamp, score] : scores) {
    std::printf("generic %-14s %5d: %.2f %% -> %.2f %%, inside %.1f %%\n", Word(lamp).c_str(),
                score.count, 100.0 * score.Before(), 100.0 * score.After(),
                100.0 * score.inside / score.count);
    EXPECT_LE(score.After(), score.Before() * (1.0 + 1e-9)) << Word(lamp);
    EXPECT_GE(score.inside, 0.95 * score.count) << Word(lamp);
    // No wider than four times what was found.
    EXPECT_LE(GenericMismatch(lamp).sigma, 4.0 * score.After()) << Word(lamp);
  }
}

TEST(SpectralMismatch, ColourTemperaturesOfCamerasLieWithinTheirSigma) {
  const Bench& bench = TheBench();
  std::map<LampClass, std::vector<double>> errors;  // mired
  for (std::size_t i = 0; i < bench.lamps.size(); ++i) {
    const auto xyz = XyzFromSpectrum(bench.lamps[i].spectrum);
    ASSERT_TRUE(xyz);
    const double truth = MiredsOfLamp(XyFromXyz(*xyz)).value();
    for (const auto& row : bench.seen) {
      errors[bench.lamps[i].lamp].push_back(row[i].mired - truth);
    }
  }
  for (const auto& [lamp, all] : errors) {
    const double sigma = GenericColorSigma(lamp).value();
    double sum = 0.0;
    int inside = 0;
    for (const double error : all) {
      sum += error * error;
      if (std::abs(error) <= kZ95 * sigma) ++inside;
    }
    const auto count = static_cast<double>(all.size());
    std::printf("colour %-14s rms %.1f mired, sigma %.1f, inside %.1f %%\n", Word(lamp).c_str(),
                std::sqrt(sum / count), sigma, 100.0 * inside / count);
    EXPECT_LE(std::sqrt(sum / count), sigma) << Word(lamp);
    EXPECT_GE(inside, 0.95 * count) << Word(lamp);
  }
}

TEST(SpectralMismatch, DaylightIsReadExactly) {
  const auto daylight = IlluminantSpectrum("D65");
  ASSERT_TRUE(daylight);
  for (const SpectralCamera& camera : TheBench().cameras) {
    const auto raw = camera.ChannelsOf(*daylight);
    ASSERT_TRUE(raw);
    EXPECT_NEAR((*raw)[1], 1.0, 1e-12);
    EXPECT_NEAR(camera.See(*daylight)->factor, 1.0, 1e-12);
  }
}

TEST(SpectralMismatch, AKnownSpectrumLeavesOnlyTheSensitivitiesOwnError) {
  const auto lamp = IlluminantSpectrum("LED-B5");
  ASSERT_TRUE(lamp);
  const SpectralCamera& camera = TheBench().cameras.front();
  const auto factor = camera.FactorFor(*lamp);
  ASSERT_TRUE(factor);
  EXPECT_DOUBLE_EQ(factor->At(Mireds(10.0)), camera.See(*lamp)->factor);
  EXPECT_DOUBLE_EQ(factor->sigma, kKnownSpectrumSigma);
}

TEST(SpectralMismatch, ASensorWithTheEyesOwnCurvesNeedsNoCorrection) {
  CameraSensitivities eye;
  eye.camera = "colorimeter";
  for (int nm = 380; nm <= 780; nm += 5) {
    const Xyz at = ColorMatchingAt(Nanometres(nm));
    eye.channels[0].push_back(at.X);
    eye.channels[1].push_back(at.Y);
    eye.channels[2].push_back(at.Z);
  }
  const auto camera = SpectralCamera::Make(eye);
  ASSERT_TRUE(camera);
  for (const MeasuredLamp& lamp : TheBench().lamps) {
    // Interpolated every 5 nm against CIE's every 1 nm.
    EXPECT_NEAR(camera->See(lamp.spectrum)->factor, 1.0, 1e-3) << lamp.name;
  }
}

TEST(SpectralMismatch, AFactorIsALineThroughLampsThatLieOnOne) {
  std::vector<LampSeen> lamps;
  for (const double mired : {150.0, 200.0, 250.0, 300.0, 400.0}) {
    lamps.push_back({mired, 1.1 - 2e-4 * mired});
  }
  const auto factor = FitMismatchFactor(LampClass::kWhiteLed, lamps);
  ASSERT_TRUE(factor);
  EXPECT_NEAR(factor->At(Mireds(222.0)), 1.1 - 2e-4 * 222.0, 1e-12);
  EXPECT_NEAR(factor->At(Mireds(900.0)), 1.1 - 2e-4 * 400.0, 1e-12) << "held at the last lamp";
  EXPECT_LT(factor->sigma, 1e-12);
}

TEST(SpectralMismatch, LampsThatDoNotAgreeLeaveTheLuminanceAlone) {
  const std::vector<LampSeen> lamps = {{200.0, 1.05}, {250.0, 0.95}, {300.0, 1.05}, {350.0, 0.96}};
  const auto factor = FitMismatchFactor(LampClass::kWhiteLed, lamps);
  ASSERT_TRUE(factor);
  EXPECT_DOUBLE_EQ(factor->At(Mireds(250.0)), 1.0);
  EXPECT_GT(factor->sigma, 0.04);
}

TEST(SpectralMismatch, OneLampTellsNoFactor) {
  const std::vector<LampSeen> lamps = {{200.0, 1.05}};
  const auto factor = FitMismatchFactor(LampClass::kWhiteLed, lamps);
  ASSERT_TRUE(factor);
  EXPECT_DOUBLE_EQ(factor->At(Mireds(200.0)), 1.0);
  EXPECT_GT(factor->sigma, 0.05);
  EXPECT_FALSE(FitMismatchFactor(LampClass::kWhiteLed, {}));
}

TEST(CameraSensitivities, AreRefusedWhereTheyAreNone) {
  const auto refused = [](const std::string& text) {
    const auto camera = CameraSensitivitiesFromJson(text, "camera.json");
    return !camera && camera.error().code == "bad_sensitivities";
  };
  const std::string head = R"({"spectral_data":{"index":{"main":["R","G","B"]},"data":{"main":)";
  EXPECT_TRUE(refused("{"));
  EXPECT_TRUE(refused("[]"));
  EXPECT_TRUE(refused(head + R"({}}}})"));
  EXPECT_TRUE(refused(head + R"({"400":[1,1,1],"700":[1,1]}}}})"));
  EXPECT_TRUE(refused(head + R"({"400":[1,1,1],"500":[1,1,1],"700":[1,1,1]}}}})")) << "spacing";
  EXPECT_TRUE(refused(head + R"({"450":[1,1,1],"700":[1,1,1]}}}})")) << "range";
  EXPECT_TRUE(refused(head + R"({"400":[0,1,1],"700":[0,1,1]}}}})")) << "blind";
  EXPECT_FALSE(refused(head + R"({"400":[1,1,1],"700":[1,1,1]}}}})"));
}

}  // namespace
}  // namespace lightcal::test
