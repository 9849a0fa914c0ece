// SPDX-License-Identifier: Apache-2.0
// The truth the merge is judged by, judged itself.
#include "synthetic_camera.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightcal::test {
namespace {

struct Moments {
  double mean = 0.0, variance = 0.0;
};
// Of DN above black at the green pixels.
Moments GreenMoments(const SyntheticCamera& camera, const SyntheticExposure& exposure,
                     double nits) {
  const auto picture = Expose(camera, exposure, [nits](int, int) { return XyzOf(nits); });
  double sum = 0.0, squares = 0.0;
  int n = 0;
  for (int y = 0; y < camera.height; ++y) {
    for (int x = (y + 1) % 2; x < camera.width; x += 2) {
      const double v = picture[y * camera.width + x] - camera.black_dn;
      sum += v;
      squares += v * v;
      ++n;
    }
  }
  const double mean = sum / n;
  return {mean, (squares - n * mean * mean) / (n - 1)};
}

// At fraction f of saturation: mean f (white - black), variance g mean + g^2 read^2 + 1/12.
TEST(SyntheticCamera, MeanAndVarianceAreThoseOfPhotonsAndReadNoise) {
  const SyntheticCamera camera;
  const SyntheticExposure exposure;
  const double gain = (camera.white_dn - camera.black_dn) / camera.full_well_e;
  for (const double fraction : {0.0, 1e-4, 5e-4, 1e-3, 0.01, 0.5}) {
    const Moments got = GreenMoments(camera, exposure, fraction * SaturatingNits(camera, exposure));
    const double mean = fraction * (camera.white_dn - camera.black_dn);
    const double variance = gain * mean + std::pow(gain * camera.read_noise_e, 2) + 1.0 / 12;
    const double n = camera.width * camera.height / 2.0;
    EXPECT_NEAR(got.mean, mean, 4.0 * std::sqrt(variance / n)) << fraction;
    EXPECT_NEAR(got.variance / variance, 1.0, 4.0 * std::sqrt(2.0 / n) + 0.003) << fraction;
  }
}

TEST(SyntheticCamera, LabelsErrAndTheTrueTimeExposes) {
  SyntheticExposure exposure;
  const double at_64th = SaturatingNits({}, exposure);
  exposure.label_time_s = 1.0 / 15;
  EXPECT_DOUBLE_EQ(SaturatingNits({}, exposure), at_64th);
  EXPECT_NEAR(at_64th, 78.0 * 64.0 / (0.65 * 100.0 / 64.0), 1e-9);
  EXPECT_DOUBLE_EQ(DialLabel(1.0 / 64), 1.0 / 60);
  EXPECT_DOUBLE_EQ(DialLabel(1.0 / 2048), 1.0 / 2000);
  EXPECT_DOUBLE_EQ(DialLabel(32.0), 30.0);
  EXPECT_DOUBLE_EQ(DialLabel(std::exp2(-17.0 / 3)), 1.0 / 50);
}

TEST(SyntheticCamera, TheKneeTakesWhatItSaysAtFullWellAndNothingBelowFourFifths) {
  SyntheticCamera camera;
  const SyntheticExposure exposure;
  camera.knee_relative = 0.01;
  const double saturating = SaturatingNits(camera, exposure);
  const double range = camera.white_dn - camera.black_dn;
  EXPECT_NEAR(GreenMoments(camera, exposure, 0.7 * saturating).mean / range, 0.7, 1e-4);
  EXPECT_NEAR(GreenMoments(camera, exposure, 0.95 * saturating).mean / range,
              0.95 - 0.01 * std::pow(0.75, 2), 1e-4);
}

TEST(SyntheticCamera, BeyondSaturationItStaysWhiteHoweverBrightTheScene) {
  SyntheticCamera camera;
  camera.knee_relative = 0.01;
  const SyntheticExposure exposure;
  for (const double times : {1.1, 2.0, 5.0, 100.0, 1e5}) {
    const Moments green = GreenMoments(camera, exposure, times * SaturatingNits(camera, exposure));
    EXPECT_NEAR(green.mean / (camera.white_dn - camera.black_dn), 1.0, 1e-4) << times;
  }
}

TEST(SyntheticCamera, PixelsKeepTheirGainFromFrameToFrame) {
  SyntheticCamera camera;
  camera.prnu_relative = 0.05;
  SyntheticExposure first, second;
  second.seed = 2;
  const double nits = 0.5 * SaturatingNits(camera, first);
  const auto scene = [nits](int, int) { return XyzOf(nits); };
  const auto a = Expose(camera, first, scene), b = Expose(camera, second, scene);
  EXPECT_NE(a, b);
  double covariance = 0.0, mean = 0.0;
  int n = 0;
  for (std::size_t i = 1; i < static_cast<std::size_t>(camera.width); i += 2) mean += a[i];
  mean /= camera.width / 2.0;
  for (std::size_t i = 1; i < static_cast<std::size_t>(camera.width); i += 2, ++n) {
    covariance += (a[i] - mean) * (b[i] - mean);
  }
  const double signal = mean - camera.black_dn;
  EXPECT_NEAR(std::sqrt(covariance / n) / signal, 0.05, 0.008);
}

TEST(SyntheticCamera, TheSameSeedExposesTheSamePicture) {
  SyntheticCamera camera;
  camera.width = camera.height = 32;
  const auto scene = [](int x, int) { return XyzOf(x); };
  EXPECT_EQ(Expose(camera, {}, scene), Expose(camera, {}, scene));
}

TEST(StepWedge, PatchesFillThePictureInOrder) {
  StepWedge wedge;
  wedge.nits = LogSteps(0.05, 1e5, 48);
  EXPECT_EQ(wedge.nits.size(), 48U);
  EXPECT_DOUBLE_EQ(wedge.nits.front(), 0.05);
  EXPECT_NEAR(wedge.nits.back(), 1e5, 1e-6);
  EXPECT_EQ(wedge.PatchAt(0, 0), 0);
  EXPECT_EQ(wedge.PatchAt(599, 399), 47);
  EXPECT_EQ(wedge.PatchAt(599, 0), 7);
}

}  // namespace
}  // namespace lightcal::test
