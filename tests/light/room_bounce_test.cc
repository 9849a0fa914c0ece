// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/room_bounce.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace lightcal {
namespace {

using std::numbers::pi;

Scene RoomScene(const Vec3& size, double reflectance, const Vec3& lamp) {
  Scene scene;
  scene.position_m = lamp;
  scene.room = RoomBox{size, reflectance};
  return scene;
}

// First bounce of an even lamp by 200 x 200 equal patches on each wall.
double FineFirstBounce(const Scene& scene, const Vec3& meter) {
  constexpr int kFine = 200;
  const Vec3 lamp = *scene.position_m;
  const Vec3 size = scene.room->size_m;
  const Vec3 normal = (lamp - meter) * (1.0 / Length(lamp - meter));
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {0, 1}) {
      const int u = (axis + 1) % 3;
      const int v = (axis + 2) % 3;
      const auto low = [&](int k) { return k == 2 ? 0.0 : -0.5 * size[k]; };
      for (int i = 0; i < kFine; ++i) {
        for (int j = 0; j < kFine; ++j) {
          Vec3 p{};
          p[axis] = low(axis) + side * size[axis];
          p[u] = low(u) + (i + 0.5) / kFine * size[u];
          p[v] = low(v) + (j + 0.5) / kFine * size[v];
          const Vec3 a = p - lamp;
          const Vec3 b = p - meter;
          const double ra = Length(a);
          const double rb = Length(b);
          const double at_meter = std::max(0.0, Dot(normal, b) / rb);
          sum += std::abs(a[axis]) / (ra * ra * ra) * scene.room->reflectance / pi * at_meter *
                 std::abs(b[axis]) / (rb * rb * rb) * size[u] * size[v] / (kFine * kFine);
        }
      }
    }
  }
  return sum;
}

TEST(RoomBounce, ThirtySixGradedPatchesAWallComeCloseToFortyThousand) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform;
  for (int i = 0; i < 20; ++i) {
    const Vec3 size = {3.0 + 3.0 * uniform(random), 3.0 + 3.0 * uniform(random), 2.6};
    const auto inside = [&](double low, double length) {
      return low + 0.4 + (length - 0.8) * uniform(random);
    };
    const Vec3 lamp = {inside(-0.5 * size[0], size[0]), inside(-0.5 * size[1], size[1]),
                       inside(0.0, size[2])};
    const Vec3 meter = {inside(-0.5 * size[0], size[0]), inside(-0.5 * size[1], size[1]),
                        inside(0.0, size[2])};
    const Scene scene = RoomScene(size, 0.5, lamp);
    ScenePose pose;
    pose.position_m = meter;
    pose.distance_m = Length(lamp - meter);
    const double graded = BounceAt(scene, pose).first;
    EXPECT_NEAR(graded / FineFirstBounce(scene, meter), 1.0, 0.2) << i;
  }
}

TEST(RoomBounce, BlackWallsReturnNothing) {
  const Bounce bounce = BounceAt(RoomScene({5, 4, 2.6}, 0.0, {0, 0, 1.2}), ScenePose{});
  EXPECT_EQ(bounce.first, 0.0);
  EXPECT_EQ(bounce.tail, 0.0);
}

TEST(RoomBounce, TheTailIsTheIntegratingRoomsBeyondTheFirstBounce) {
  // Phi rho/(A (1 - rho)) less its first term Phi rho/A.
  const double rho = 0.6;
  const double area = 2.0 * (5 * 4 + 4 * 2.6 + 5 * 2.6);
  const Bounce bounce = BounceAt(RoomScene({5, 4, 2.6}, rho, {0, 0, 1.2}), ScenePose{});
  EXPECT_NEAR(bounce.tail, 4.0 * pi * (rho / (area * (1.0 - rho)) - rho / area), 1e-12);
}

TEST(RoomBounce, ANarrowSpotBouncesLessThanABareBulb) {
  Scene scene = RoomScene({5, 4, 2.6}, 0.5, {0, 0, 1.2});
  const double bare = BounceAt(scene, ScenePose{}).Estimate();
  scene.kind = LightKind::kSpot;
  scene.outer = RadiansFromDegrees(20.0);
  EXPECT_LT(BounceAt(scene, ScenePose{}).Estimate(), 0.3 * bare);
}

}  // namespace
}  // namespace lightcal
