// SPDX-License-Identifier: Apache-2.0
// A 95 % interval must hold the truth as often as it says.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>

#include "lamp_twin.h"
#include "lightcal/fit/fit_light.h"

namespace lightcal {
namespace {

using test::LampTruth;
using test::TwinSession;

struct SceneKind {
  std::string name;
  std::vector<double> distances_m;
  double sigma;
  int off_readings;
  bool shadow_card;
  double ambient_share;  // of the direct light at the farthest reading, on average
  double bounce_share;
};
void PrintTo(const SceneKind& kind, std::ostream* out) { *out << kind.name; }

class Coverage : public testing::TestWithParam<SceneKind> {};

TEST_P(Coverage, NinetyFiveOfAHundredIntervalsHoldTheTruth) {
  const SceneKind& kind = GetParam();
  constexpr int kTwins = 1000;
  std::mt19937_64 random(20261121);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  int covered = 0;
  int predicted_within = 0;
  double z_squared = 0.0;
  for (int i = 0; i < kTwins; ++i) {
    LampTruth truth;
    truth.intensity_cd = std::exp(5.0 + 2.0 * normal(random));
    truth.offset_m = 0.03 * normal(random);  // a bulb's
    const double far = TrueDirect(truth, kind.distances_m.back());
    truth.ambient_lx = 2.0 * kind.ambient_share * uniform(random) * far;
    truth.bounce_lx = kind.bounce_share * far;
    TwinSession twin(truth, kind.sigma, random());
    twin.session().lights.front().fixture = Fixture::kBulb;
    twin.On(kind.distances_m);
    for (int k = 0; k < kind.off_readings; ++k) twin.Off();
    if (kind.shadow_card) {
      for (const double d : kind.distances_m) twin.ShadowCard(d);
    }
    auto fitted = FitSession(twin.session(), FitSettings{});
    ASSERT_TRUE(fitted.has_value()) << fitted.error().message;
    const FittedLight& light = fitted->lights.lights.front();
    const Uncertain& found = *light.intensity_cd;
    covered += truth.intensity_cd >= *found.low && truth.intensity_cd <= *found.high ? 1 : 0;
    const double sd = std::log(*found.high / *found.low) / (2.0 * kZ95);
    const double z = std::log(truth.intensity_cd / found.value) / sd;
    z_squared += z * z;

    const double beyond = 1.5 * kind.distances_m.back();
    auto predicted = PredictIlluminance(light, Metres(beyond), kind.sigma);
    ASSERT_TRUE(predicted.has_value());
    const double there = TrueDirect(truth, beyond) + (kind.shadow_card ? 0.0 : truth.ambient_lx);
    predicted_within +=
        there >= *predicted->model_lx.low && there <= *predicted->model_lx.high ? 1 : 0;
  }
  EXPECT_GE(covered, 930);
  EXPECT_LE(covered, 970);
  EXPECT_GE(predicted_within, 930);
  EXPECT_LE(predicted_within, 970);
  const double z_rms = std::sqrt(z_squared / kTwins);
  EXPECT_GE(z_rms, 0.9);
  EXPECT_LE(z_rms, 1.1);
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, Coverage,
    testing::Values(
        SceneKind{"one_reading", {0.5}, 0.05, 0, false, 0.0, 0.0},
        SceneKind{"two_distances", {1, 3}, 0.05, 0, false, 0.0, 0.0},
        SceneKind{"three_distances", {1, 3, 5}, 0.02, 0, false, 0.0, 0.0},
        SceneKind{"four_distances_with_ambient", {0.5, 1, 2, 4}, 0.02, 0, false, 0.2, 0},
        SceneKind{
            "six_distances_in_the_dark", {0.4, 0.7, 1.2, 2, 3.2, 5}, 0.014, 0, false, 0.0, 0.0},
        SceneKind{"lamp_off_readings", {0.5, 1, 2}, 0.02, 2, false, 0.3, 0.0},
        SceneKind{"shadow_cards", {0.5, 1, 2}, 0.02, 0, true, 0.3, 0.1}),
    [](const auto& scene) { return scene.param.name; });

}  // namespace
}  // namespace lightcal
