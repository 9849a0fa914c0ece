// SPDX-License-Identifier: Apache-2.0
// The forward models against brute force (B1): any distance from a thousandth of the size to a
// million sizes, any place, any turn of the meter.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <utility>

#include "brute_force.h"
#include "lightcal/light/models/disk_source.h"
#include "lightcal/light/models/polygon_source.h"
#include "lightcal/light/models/rect_source.h"
#include "lightcal/light/models/sphere_source.h"
#include "lightcal/light/models/tube_source.h"

namespace lightcal {
namespace {

using test::BruteReceiver;
using test::Real;

using std::numbers::pi;

class Scenes {
 public:
  explicit Scenes(std::uint64_t seed) : random_(seed) {}
  double Uniform(double a, double b) { return a + (b - a) * uniform_(random_); }
  double LogUniform(double a, double b) { return a * std::pow(b / a, uniform_(random_)); }
  Vec3 Direction() {
    const double z = Uniform(-1, 1);
    const double f = Uniform(0, 2 * pi);
    const double s = std::sqrt(1 - z * z);
    return {s * std::cos(f), s * std::sin(f), z};
  }
  // Turned toward the source's middle, by anything up to and beyond its horizon, often near it.
  Vec3 Normal(const Vec3& position, double size) {
    const double d = Length(position);
    const Vec3 toward = position * (-1.0 / d);
    const Vec3 side = [&] {
      const Vec3 c = Cross(toward, Direction());
      return c * (1.0 / Length(c));
    }();
    const double reach = std::min(1.5, size / d);
    const double angle =
        Uniform(0, 1) < 0.5 ? Uniform(0, 0.5 * pi) : 0.5 * pi + reach * Uniform(-1.2, 1.2);
    const Vec3 n = toward * std::cos(angle) + side * std::sin(angle);
    return n * (1.0 / Length(n));
  }

 private:
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> uniform_;
};

BruteReceiver Wide(const Receiver<double>& at) {
  return {{at.position[0], at.position[1], at.position[2]},
          {at.normal[0], at.normal[1], at.normal[2]}};
}

// Within 1e-10 of the truth, or 1e-13 of what the whole source would give at normal incidence where
// the horizon leaves a sliver.
void ExpectClose(double found, Real truth, double whole, const Receiver<double>& at,
                 const std::string& scene) {
  const double error = static_cast<double>(std::abs(found - truth));
  EXPECT_LE(error, 1e-10 * static_cast<double>(truth) + 1e-13 * whole)
      << scene << " found " << found << " truth " << static_cast<double>(truth) << " at "
      << at.position[0] << " " << at.position[1] << " " << at.position[2] << " n " << at.normal[0]
      << " " << at.normal[1] << " " << at.normal[2];
}

constexpr int kScenes = 1000;

TEST(Models, ARectangleIsItsIntegralEverywhere) {
  Scenes scenes(1);
  for (int i = 0; i < kScenes; ++i) {
    const RectSource rect{1.0, scenes.LogUniform(0.05, 1.0)};
    const double size = std::hypot(rect.half_width, rect.half_height);
    Vec3 direction = scenes.Direction();
    direction[2] = std::abs(direction[2]);
    Receiver<double> at{direction * (size * scenes.LogUniform(1e-3, 1e6)), {}};
    at.normal = scenes.Normal(at.position, size);
    const double area = 4.0 * rect.half_width * rect.half_height;
    const Real truth = test::BruteRect(rect.half_width, rect.half_height, Wide(at)) / area;
    const double d2 = Dot(at.position, at.position);
    ExpectClose(LuxPerCandela(rect, at), truth, 1.0 / std::max(d2, area), at, "rect");
  }
}

TEST(Models, ARectangleWithoutWidthIsALinesIntegralEverywhere) {
  Scenes scenes(11);
  for (int i = 0; i < kScenes; ++i) {
    Vec3 direction = scenes.Direction();
    direction[2] = std::abs(direction[2]);
    Receiver<double> at{direction * scenes.LogUniform(1e-3, 1e6), {}};
    at.normal = scenes.Normal(at.position, 1.0);
    const Real truth = test::BruteLine(1.0, Wide(at)) / 2;
    // Beside it a line gives the more the nearer, as 1/distance.
    const double whole = 1.0 / std::max(Dot(at.position, at.position), 1e-6);
    ExpectClose(LuxPerCandela(RectSource{1.0, 0.0}, at), truth, whole, at, "along x");
    std::swap(at.position[0], at.position[1]);
    std::swap(at.normal[0], at.normal[1]);
    ExpectClose(LuxPerCandela(RectSource{0.0, 1.0}, at), truth, whole, at, "along y");
  }
}

TEST(Models, ADiskIsItsIntegralEverywhere) {
  Scenes scenes(2);
  for (int i = 0; i < kScenes; ++i) {
    Vec3 direction = scenes.Direction();
    direction[2] = std::abs(direction[2]);
    Receiver<double> at{direction * scenes.LogUniform(1e-3, 1e6), {}};
    at.normal = scenes.Normal(at.position, 1.0);
    const Real truth = test::BruteDisk(1.0, Wide(at)) / pi;
    const double d2 = Dot(at.position, at.position);
    ExpectClose(LuxPerCandela(DiskSource{1.0}, at), truth, 1.0 / std::max(d2, 1.0), at, "disk");
  }
}

TEST(Models, APolygonIsItsIntegralEverywhere) {
  Scenes scenes(3);
  for (int i = 0; i < kScenes; ++i) {
    const int corners = 3 + i % 4;
    std::vector<std::array<double, 2>> polygon;
    std::vector<std::array<Real, 2>> wide;
    double area = 0.0;
    for (int k = 0; k < corners; ++k) {  // on an ellipse: convex
      const double f = 2.0 * pi * (k + scenes.Uniform(0, 0.8)) / corners;
      polygon.push_back({0.3 + std::cos(f), 0.6 * std::sin(f) - 0.1});
      wide.push_back({polygon.back()[0], polygon.back()[1]});
    }
    for (int k = 0; k < corners; ++k) {
      const auto& a = polygon[k];
      const auto& b = polygon[(k + 1) % corners];
      area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    }
    Vec3 direction = scenes.Direction();
    direction[2] = std::abs(direction[2]);
    Receiver<double> at{direction * scenes.LogUniform(1e-3, 1e6), {}};
    at.normal = scenes.Normal(at.position, 1.0);
    const Real truth = test::BrutePolygon(wide, Wide(at)) / area;
    const double d2 = Dot(at.position, at.position);
    ExpectClose(PolygonLuxPerCandela<double>(polygon, at), truth, 1.0 / std::max(d2, area), at,
                "polygon");
  }
}

TEST(Models, ASphereIsItsIntegralEverywhere) {
  Scenes scenes(4);
  for (int i = 0; i < kScenes; ++i) {
    Receiver<double> at{scenes.Direction() * (1.0 + scenes.LogUniform(1e-3, 1e6)), {}};
    at.normal = scenes.Normal(at.position, 1.0);
    const Real truth = test::BruteSphere(1.0, Wide(at)) / pi;
    const double d2 = Dot(at.position, at.position);
    ExpectClose(LuxPerCandela(SphereSource{1.0}, at), truth, 1.0 / d2, at, "sphere");
  }
}

TEST(Models, ATubeIsItsIntegralEverywhere) {
  Scenes scenes(5);
  for (int i = 0; i < kScenes; ++i) {
    const TubeSource tube{scenes.LogUniform(0.1, 30.0), 1.0};
    const double size = std::hypot(tube.half_length, tube.radius);
    Receiver<double> at;
    if (i % 2 == 0) {  // near the mantle, anywhere along it and beyond its ends
      const double away = 1.0 + scenes.LogUniform(1e-3, 10.0);
      const double f = scenes.Uniform(0, 2 * pi);
      at.position = {tube.half_length * scenes.Uniform(-1.5, 1.5), away * std::cos(f),
                     away * std::sin(f)};
    } else {
      at.position = scenes.Direction() * (size * scenes.LogUniform(1.0, 1e6));
    }
    at.normal = scenes.Normal(at.position, size);
    const double strength = 4.0 * tube.radius * tube.half_length;
    const Real truth = test::BruteTube(tube.half_length, tube.radius, Wide(at)) / strength;
    const double d2 = Dot(at.position, at.position);
    ExpectClose(LuxPerCandela(tube, at), truth, 1.0 / std::max(d2, strength), at, "tube");
  }
}

}  // namespace
}  // namespace lightcal
