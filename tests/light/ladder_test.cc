// SPDX-License-Identifier: Apache-2.0
// B2: the level that a bound picks never errs by more than the tolerance. LIGHTCAL_LADDER_SCENES=N
// in the environment sets the number of scenes of each kind (the nightly size is 1000000).
#include "lightcal/light/models/ladder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <random>

#include "brute_force.h"

namespace lightcal {
namespace {

constexpr double kTolerances[] = {5e-2, 1e-2, 1e-3, 1e-4, 1e-6, 1e-9};

long SceneCount() {
  const char* text = std::getenv("LIGHTCAL_LADDER_SCENES");
  return text != nullptr ? std::atol(text) : 20000;
}

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double Uniform(double a, double b) { return a + (b - a) * uniform_(engine_); }
  double LogUniform(double a, double b) { return a * std::pow(b / a, uniform_(engine_)); }
  Vec3 Direction() {
    const double z = Uniform(-1, 1);
    const double f = Uniform(0, 2 * std::numbers::pi);
    const double s = std::sqrt(1 - z * z);
    return {s * std::cos(f), s * std::sin(f), z};
  }

 private:
  std::mt19937_64 engine_;
  std::uniform_real_distribution<double> uniform_;
};

// Every level that any tolerance picks is judged once by brute force, against the least tolerance
// that picks it.
template <class Source>
void Judge(const Source& source, const Receiver<double>& at,
           const std::function<test::Real(const test::BruteReceiver&)>& truth, long& judged) {
  LadderLevel last = LadderLevel::kExact;
  test::Real exact = -1;
  for (int i = 5; i >= 0; --i) {
    const LadderLevel level = ChooseLevel(source, at, kTolerances[i]);
    if (level == LadderLevel::kExact || level == last) continue;
    last = level;
    if (exact < 0) {
      exact = truth({{at.position[0], at.position[1], at.position[2]},
                     {at.normal[0], at.normal[1], at.normal[2]}});
    }
    ++judged;
    const double found = LuxPerCandelaAt(level, source, at);
    const auto error = static_cast<double>(std::abs(found / exact - 1));
    ASSERT_LE(error, kTolerances[i])
        << "level " << static_cast<int>(level) << " at " << at.position[0] << " " << at.position[1]
        << " " << at.position[2] << " n " << at.normal[0] << " " << at.normal[1] << " "
        << at.normal[2];
  }
}

TEST(Ladder, OfARectangleKeepsItsTolerance) {
  Random random(41);
  long judged = 0;
  for (long i = 0; i < SceneCount() && !HasFatalFailure(); ++i) {
    const RectSource rect{1.0, random.LogUniform(0.02, 1.0)};
    const double size = std::hypot(rect.half_width, rect.half_height);
    Vec3 direction = random.Direction();
    direction[2] = std::abs(direction[2]);
    const Receiver<double> at{direction * (size * random.LogUniform(1.0, 1e3)), random.Direction()};
    Judge(
        rect, at,
        [&](const test::BruteReceiver& r) {
          return test::BruteRect(rect.half_width, rect.half_height, r) /
                 (4 * static_cast<test::Real>(rect.half_width) * rect.half_height);
        },
        judged);
  }
  EXPECT_GT(judged, SceneCount() / 4);
}

TEST(Ladder, OfADiskKeepsItsTolerance) {
  Random random(42);
  long judged = 0;
  for (long i = 0; i < SceneCount() && !HasFatalFailure(); ++i) {
    Vec3 direction = random.Direction();
    direction[2] = std::abs(direction[2]);
    const Receiver<double> at{direction * random.LogUniform(1.0, 1e3), random.Direction()};
    Judge(
        DiskSource{1.0}, at,
        [](const test::BruteReceiver& r) {
          return test::BruteDisk(1, r) / std::numbers::pi_v<test::Real>;
        },
        judged);
  }
  EXPECT_GT(judged, SceneCount() / 5);
}

TEST(Ladder, OfATubeKeepsItsTolerance) {
  Random random(43);
  long judged = 0;
  for (long i = 0; i < SceneCount() && !HasFatalFailure(); ++i) {
    const TubeSource tube{1.0, random.LogUniform(1e-3, 1.0)};
    const double away = tube.radius * (1.0 + random.LogUniform(0.05, 1e3));
    const double f = random.Uniform(0, 2 * std::numbers::pi);
    const double x =
        random.Uniform(0, 1) < 0.7 ? random.Uniform(-1.5, 1.5) : random.LogUniform(0.1, 100.0);
    const Receiver<double> at{{x, away * std::cos(f), away * std::sin(f)}, random.Direction()};
    Judge(
        tube, at,
        [&](const test::BruteReceiver& r) {
          return test::BruteTube(tube.half_length, tube.radius, r) / (4 * tube.radius);
        },
        judged);
  }
  EXPECT_GT(judged, SceneCount() / 10);
}

}  // namespace
}  // namespace lightcal
