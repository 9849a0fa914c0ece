// SPDX-License-Identifier: Apache-2.0
// lightcal camera: the absolute scale of a camera that is 15 % less sensitive than its ISO says.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "camera_fixture.h"

namespace lightcal::test {
namespace {

using nlohmann::json;

constexpr double kPi = std::numbers::pi;

class CameraCommand : public CameraFolder {
 protected:
  // A spot meter's reading of a grey wall of this luminance.
  std::string Spot(const std::string& stem, double nits, double read_as, std::uint64_t seed,
                   const std::string& more = "") {
    Shoot(stem, Steady(4, 8.0, seed),
          [=](int x, int y) { return XyzOf(x < 120 && y < 90 ? nits : 5.0); });
    return Frames("scale", stem + "_*.dng",
                  "rect = [20, 20, 80, 50]\nlamp_class = \"daylight\"\nluminance_nits = " +
                      std::to_string(read_as) + "\n" + more);
  }
};

double ConstantOf(const json& profile) { return profile["scale"]["full_scale_constant"]; }

TEST_F(CameraCommand, OneSpotReadingAddsLessThanOnePercentToTheScale) {
  const json profile = Profile(Spot("spot", 300.0, 300.0, 7));
  EXPECT_NEAR(ConstantOf(profile) / kTrueConstant, 1.0, 0.01);
  EXPECT_EQ(profile["scale"]["readings"].at(0)["kind"], "spot");

  const StepWedge wedge = merge::Wedge(camera_);
  Shoot("scene", Steady(4, 8.0, 21), wedge.Scene());
  const json merged = MergeLast({"--lamp-class", "daylight"});
  EXPECT_EQ(merged["scale"]["source"], "camera");
  EXPECT_EQ(merged["noise"]["source"], "camera");
  const double u95 = merged["scale"]["u95_relative"];
  EXPECT_LT(u95, 0.16);
  const auto picture = merge::ReadExr(Out());
  for (int patch = 2; patch < 8; ++patch) {
    const double found = merge::PatchMean(picture, wedge, patch);
    EXPECT_NEAR(found / wedge.nits[static_cast<std::size_t>(patch)], 1.0, 0.01) << patch;
  }
  const json unknown_lamp = MergeLast({});
  EXPECT_GT(double(unknown_lamp["scale"]["u95_relative"]), u95) << "any lamp may be in the scene";
}

TEST_F(CameraCommand, OneLuxReadingOfACardAddsLessThanTwoPercent) {
  const double lux = 1500.0, reflectance = 0.18;
  Shoot("card", Steady(), [&](int, int) { return XyzOf(lux * reflectance / kPi); });
  const json profile = Profile(Frames("scale", "card_*.dng",
                                      "illuminance_lx = 1500\nreflectance = 0.18\n"
                                      "lamp_class = \"daylight\"\n"));
  EXPECT_NEAR(ConstantOf(profile) / kTrueConstant, 1.0, 0.02);
  EXPECT_EQ(profile["scale"]["readings"].at(0)["kind"], "card");
}

// A sky of L (1 + cos theta)/2 through an equisolid fisheye of 180 degrees: E = 5/6 pi L.
TEST_F(CameraCommand, OneLuxReadingBesideAFisheyePictureAddsLessThanTwoPercent) {
  camera_ = merge::Camera(160, 160);
  camera_.sensitivity = kSensitivity;
  constexpr double kNits = 500.0;
  Shoot("sky", Steady(), [](int x, int y) {
    const double r = std::hypot(x + 0.5 - 80.0, y + 0.5 - 80.0) / 80.0;
    if (r > 1.0) return XyzOf(0.5);
    const double theta = 2.0 * std::asin(r * std::sin(kPi / 4.0));
    return XyzOf(kNits * 0.5 * (1.0 + std::cos(theta)));
  });
  const json profile =
      Profile(Frames("scale", "sky_*.dng",
                     "illuminance_lx = " + std::to_string(5.0 / 6.0 * kPi * kNits) +
                         "\nprojection = \"equisolid\"\nfov_deg = 180\n"
                         "lamp_class = \"daylight\"\n"));
  EXPECT_NEAR(ConstantOf(profile) / kTrueConstant, 1.0, 0.02);
  EXPECT_EQ(profile["scale"]["readings"].at(0)["kind"], "picture");
}

TEST_F(CameraCommand, ReadingsByTwoMetersAreSurerThanOneAndBySameMeterHardly) {
  const std::string meters =
      "[[meter]]\nname = \"a\"\nsigma_relative = 0.05\n"
      "[[meter]]\nname = \"b\"\nsigma_relative = 0.05\n";
  const std::string one = Spot("one", 300.0, 306.0, 7, "meter = \"a\"\n");
  const std::string again = Spot("two", 900.0, 918.0, 8, "meter = \"a\"\n");
  const std::string other = Spot("three", 900.0, 882.0, 9, "meter = \"b\"\n");
  const double sigma = Profile(meters + one)["scale"]["sigma_relative"];
  const double same = Profile(meters + one + again)["scale"]["sigma_relative"];
  const json two = Profile(meters + one + other);
  EXPECT_LT(same, sigma);
  EXPECT_GT(same, 0.05);
  EXPECT_LT(double(two["scale"]["sigma_relative"]), 0.8 * sigma);
  EXPECT_NEAR(ConstantOf(two) / kTrueConstant, 1.0, 0.01);
  EXPECT_FALSE(merge::Warns(two, "scale_readings_disagree"));
}

TEST_F(CameraCommand, ReadingsThatContradictEachOtherAreNamedAndWidenTheInterval) {
  const std::string one = Spot("one", 300.0, 300.0, 7), off = Spot("two", 900.0, 1200.0, 8);
  const json profile = Profile(one + off);
  EXPECT_TRUE(merge::Warns(profile, "scale_readings_disagree"));
  EXPECT_GT(double(profile["scale"]["sigma_relative"]), 0.1);
}

TEST_F(CameraCommand, TheIntervalCoversShuttersThatJitter) {
  int covered = 0;
  constexpr int kTrials = 10;
  for (int i = 0; i < kTrials; ++i) {
    const auto series = ExposureSeries(1.0 / 1024, 4, 2.0, 8.0, 0.03, 100 + i);
    Shoot("jitter", series, [](int, int) { return XyzOf(300.0); });
    const json profile = Profile(
        Frames("scale", "jitter_*.dng",
               "luminance_nits = 300\nsigma_relative = 0.001\nlamp_class = \"daylight\"\n"));
    const double off = std::log(ConstantOf(profile) / kTrueConstant);
    if (std::abs(off) < 1.96 * double(profile["scale"]["sigma_relative"])) ++covered;
  }
  EXPECT_GE(covered, kTrials - 1);
}

TEST_F(CameraCommand, WithoutAReadingTheScaleIsWhatIsoSpeedsPromiseAndSaysSo) {
  Shoot("noise", Steady(), merge::Wedge(camera_).Scene());
  const json profile = Profile(Frames("noise", "noise_*.dng"));
  EXPECT_DOUBLE_EQ(ConstantOf(profile), 120.0);
  EXPECT_FALSE(profile["scale"].contains("readings") && !profile["scale"]["readings"].empty());
  EXPECT_EQ(MergeLast({})["scale"]["source"], "iso_prior");
}

TEST_F(CameraCommand, WhatCannotGiveAScaleIsRefusedByName) {
  const std::string card = Shoot("card", Steady(), merge::Wedge(camera_).Scene());
  ExpectRefused(Frames("scale", card, "illuminance_lx = 900\n"), "reflectance_missing");
  ExpectRefused(Frames("scale", card), "bad_session");
  ExpectRefused(Frames("scale", card, "luminance_nits = 20\n"), "patch_uneven");
  ExpectRefused(Frames("scale", card, "luminance_nits = 20\nrect = [170, 0, 20, 20]\n"),
                "bad_region");
  ExpectRefused(Frames("scale", card, "luminance_nit = 20\n"), "unknown_key");
  ExpectRefused(Frames("flat", card, "luminance_nits = 20\n"), "bad_session");
  ExpectRefused(Frames("scale", card, "luminance_nits = 20\nmeter = \"x\"\n"), "unknown_meter");
  ExpectRefused("[[light]]\nname = \"a\"\nkind = \"point\"\n", "no_camera_frames");
  Shoot("bright", Steady(), [](int, int) { return XyzOf(1e7); });
  ExpectRefused(Frames("scale", "bright_*.dng", "luminance_nits = 20\n"), "all_saturated");
}

}  // namespace
}  // namespace lightcal::test
