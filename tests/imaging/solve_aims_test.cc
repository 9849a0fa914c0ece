// SPDX-License-Identifier: Apache-2.0
// Aims found from features whose truth is drawn here: directions, lens and noise.
#include "lightcal/imaging/panorama/solve_aims.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "lightcal/core/vec3.h"
#include "lightcal/imaging/panorama/panorama.h"

namespace lightcal {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr int kWidth = 640, kHeight = 480, kViews = 8, kPlaces = 1500, kTrials = 10;
constexpr double kWide = 75.0 * kDegree, kNoisePx = 0.05;
const double kFocal = kWidth / 2.0 / std::tan(kWide / 2.0);
const double kRim = std::hypot(kWidth, kHeight) / 2.0;

// What a tilted lens adds to a place, in rims (Brown's decentring).
struct Tilt {
  double p = 0.0, q = 0.0;
};

struct Trial {
  AimQuestion question;
  std::vector<CameraAxes> axes;
};

CameraAxes Product(const CameraAxes& a, const CameraAxes& b) {
  CameraAxes product{};
  for (std::size_t i = 0; i < 3; ++i) {
    product[i] = b[0] * a[i][0] + b[1] * a[i][1] + b[2] * a[i][2];
  }
  return product;
}

CameraAxes Transposed(const CameraAxes& a) {
  return {Vec3{a[0][0], a[1][0], a[2][0]}, Vec3{a[0][1], a[1][1], a[2][1]},
          Vec3{a[0][2], a[1][2], a[2][2]}};
}

CameraAxes Looking(double yaw, double pitch, double roll) {
  const double cy = std::cos(yaw), sy = std::sin(yaw), cp = std::cos(pitch), sp = std::sin(pitch);
  const Vec3 level{cy, -sy, 0.0}, forward{sy * cp, cy * cp, sp}, upright = Cross(level, forward);
  return {level * std::cos(roll) - upright * std::sin(roll), forward,
          upright * std::cos(roll) + level * std::sin(roll)};
}

Vec3 RandomDirection(std::mt19937& random, double height) {
  std::normal_distribution<double> normal;
  const double x = normal(random), y = normal(random), z = height * normal(random);
  const Vec3 v{x, y, z};
  return v * (1.0 / Length(v));
}

// Where the lens draws it, in rims from the middle.
std::array<double, 2> Drawn(const Vec3& seen, const Tilt& tilt) {
  const double ideal_u = kFocal * seen[0] / seen[1] / kRim;
  const double ideal_v = kFocal * seen[2] / seen[1] / kRim;
  double u = ideal_u, v = ideal_v;
  for (int round = 0; round < 20; ++round) {
    const double s2 = u * u + v * v, p = tilt.p, q = tilt.q;
    const double du = p * (s2 + 2.0 * u * u) + 2.0 * q * u * v;
    const double dv = q * (s2 + 2.0 * v * v) + 2.0 * p * u * v;
    u = ideal_u - du;
    v = ideal_v - dv;
  }
  return {u, v};
}

Trial Draw(unsigned seed, const Tilt& tilt) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> jitter(-2.0 * kDegree, 2.0 * kDegree);
  Trial trial;
  trial.question.view = {Projection::kRectilinear, kWidth, kHeight, Radians(kWide)};
  std::vector<Vec3> places;
  std::vector<PictureFeature> looks(kPlaces);
  for (PictureFeature& look : looks) {
    places.push_back(RandomDirection(random, 0.4));
    double sum = 0.0;
    for (float& v : look.descriptor) {
      v = static_cast<float>(std::abs(normal(random)));
      sum += double{v} * double{v};
    }
    for (float& v : look.descriptor) v /= static_cast<float>(std::sqrt(sum));
    look.strength = 1.0F;
  }
  for (int view = 0; view < kViews; ++view) {
    const double yaw = view * 45.0 * kDegree + jitter(random), pitch = jitter(random);
    const CameraAxes axes = Looking(yaw, pitch, jitter(random));
    trial.axes.push_back(axes);
    trial.question.names.push_back("view " + std::to_string(view + 1));
    auto& features = trial.question.features.emplace_back();
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Vec3 seen{Dot(axes[0], places[i]), Dot(axes[1], places[i]), Dot(axes[2], places[i])};
      if (seen[1] <= 0.1) continue;
      const auto [u, v] = Drawn(seen, tilt);
      const double x = kWidth / 2.0 + kRim * u + kNoisePx * normal(random);
      const double y = kHeight / 2.0 - kRim * v + kNoisePx * normal(random);
      if (x < 0.0 || x > kWidth || y < 0.0 || y > kHeight) continue;
      features.push_back(looks[i]);
      features.back().x = static_cast<float>(x);
      features.back().y = static_cast<float>(y);
    }
  }
  return trial;
}

// Of each view, in degrees, after the turn that brings all nearest to the truth.
std::vector<double> ErrorsDeg(const SolvedAims& solved, const Trial& trial) {
  const CameraAxes whole = Product(Transposed(solved.axes[0]), trial.axes[0]);
  std::vector<Vec3> off;
  Vec3 mean{};
  for (std::size_t view = 0; view < trial.axes.size(); ++view) {
    const CameraAxes left =
        Product(Transposed(Product(solved.axes[view], whole)), trial.axes[view]);
    off.push_back(Vec3{left[2][1] - left[1][2], left[0][2] - left[2][0], left[1][0] - left[0][1]} *
                  0.5);
    mean = mean + off.back() * (1.0 / kViews);
  }
  std::vector<double> errors;
  for (const Vec3& turn : off) errors.push_back(Length(turn - mean) / kDegree);
  return errors;
}

// The share of its told u95 below which 95 % of the aims' errors lie.
double Needed(const Tilt& tilt) {
  std::vector<double> shares;
  for (unsigned seed = 1; seed <= kTrials; ++seed) {
    const Trial trial = Draw(seed, tilt);
    const auto solved = SolveAims(trial.question);
    if (!solved) {
      ADD_FAILURE() << solved.error().message;
      return 0.0;
    }
    const std::vector<double> errors = ErrorsDeg(*solved, trial);
    for (std::size_t view = 0; view < errors.size(); ++view) {
      shares.push_back(errors[view] / solved->u95_deg[view]);
    }
  }
  std::ranges::sort(shares);
  return shares[shares.size() * 95 / 100];
}

TEST(SolveAims, TheToldIntervalIsAsWideAsTheErrors) {
  const double needed = Needed({});
  EXPECT_GT(needed, 0.4);
  EXPECT_LT(needed, 1.2);
}

// Half a pixel at the rim, which the lens that is fitted does not know.
TEST(SolveAims, ATiltedLensWidensTheInterval) {
  const double needed = Needed({.p = 0.001, .q = -0.0007});
  EXPECT_GT(needed, 0.2);
  EXPECT_LT(needed, 1.0);
}

}  // namespace
}  // namespace lightcal
