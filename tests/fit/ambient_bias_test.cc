// SPDX-License-Identifier: Apache-2.0
// What the readings say of ambient light, which the fit keeps above nothing, draws the intensity by
// less than half of its uncertainty in the dark, hardly where there is light that the readings can
// tell, and leaves the interval honest (DECISIONS 99).
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <tuple>

#include "lamp_twin.h"
#include "lightcal/fit/fit_light.h"

namespace lightcal {
namespace {

using test::LampTruth;
using test::TwinSession;

// Sigma of each reading; ambient light over the lamp's own at the farthest reading.
class AmbientBias : public testing::TestWithParam<std::tuple<double, double>> {};

TEST_P(AmbientBias, SixDistancesKeepAnHonestIntervalWhateverTheLightAround) {
  const auto [sigma, share] = GetParam();
  constexpr int kTwins = 2000;
  std::mt19937_64 random(20261122);
  std::normal_distribution<double> normal;
  double sum = 0.0, sum_of_sd = 0.0;
  int held = 0, ambient_held = 0;
  for (int i = 0; i < kTwins; ++i) {
    LampTruth truth;
    truth.offset_m = 0.06 * normal(random);
    truth.ambient_lx = share * TrueDirect(truth, 5.0);
    TwinSession twin(truth, sigma, random());
    twin.On({0.4, 0.7, 1.2, 2.0, 3.2, 5.0});
    const auto fitted = FitSession(twin.session(), FitSettings{});
    ASSERT_TRUE(fitted.has_value()) << fitted.error().message;
    const FittedLight& light = fitted->lights.lights.front();
    const Uncertain& found = *light.intensity_cd;
    sum += std::log(found.value / truth.intensity_cd);
    sum_of_sd += std::log(*found.high / *found.low) / (2.0 * kZ95);
    held += truth.intensity_cd >= *found.low && truth.intensity_cd <= *found.high ? 1 : 0;
    const Uncertain& ambient = *light.ambient_lx;
    ASSERT_GE(ambient.value, 0.0);
    ambient_held += std::abs(truth.ambient_lx - ambient.value) <= ambient.u95 ? 1 : 0;
  }
  EXPECT_LT(std::abs(sum), (share < 10.0 * sigma ? 0.5 : 0.1) * sum_of_sd)
      << sum / sum_of_sd << " u";
  EXPECT_NEAR(held, 0.95 * kTwins, 0.02 * kTwins);
  EXPECT_GE(ambient_held, 0.93 * kTwins);
}
INSTANTIATE_TEST_SUITE_P(Twins, AmbientBias,
                         testing::Combine(testing::Values(0.01, 0.05),
                                          testing::Values(0.0, 0.001, 0.01, 0.1)));

}  // namespace
}  // namespace lightcal
