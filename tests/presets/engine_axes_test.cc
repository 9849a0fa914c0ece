// SPDX-License-Identifier: Apache-2.0
// The golden map: where a lamp at (1, 2, 3) m that looks along +X, +Y or down stands in each
// engine, from each engine's own statement of its axes.
#include "lightcal/presets/engine_axes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lightcal/light/lamp_axes.h"
#include "lightcal/presets/unreal_light.h"

namespace lightcal::test {
namespace {

constexpr Vec3 kRight = {1, 0, 0};    // ours: east
constexpr Vec3 kForward = {0, 1, 0};  // ours: north
constexpr Vec3 kUp = {0, 0, 1};

TEST(EngineAxes, GoldenMapOfAPoint) {
  const Vec3 lamp = {1, 2, 3};
  EXPECT_EQ(PositionIn(EngineAxes::kZUp, lamp), (Vec3{1, 2, 3}));
  EXPECT_EQ(PositionIn(EngineAxes::kYUp, lamp), (Vec3{1, 3, -2}));
  EXPECT_EQ(PositionIn(EngineAxes::kZUpLeftHanded, lamp), (Vec3{100, -200, 300}));
  EXPECT_EQ(PositionIn(EngineAxes::kYUpLeftHanded, lamp), (Vec3{1, 3, 2}));
}

// engines.md 5.3: glTF (x,y,z) -> UE (x,z,y)*100.
TEST(EngineAxes, UnrealAgreesWithItsOwnGltfImporter) {
  const Vec3 lamp = {0.3, -1.7, 2.2};
  const Vec3 gltf = PositionIn(EngineAxes::kYUp, lamp);
  const Vec3 unreal = PositionIn(EngineAxes::kZUpLeftHanded, lamp);
  EXPECT_DOUBLE_EQ(unreal[0], gltf[0] * 100.0);
  EXPECT_DOUBLE_EQ(unreal[1], gltf[2] * 100.0);
  EXPECT_DOUBLE_EQ(unreal[2], gltf[1] * 100.0);
}

// A turn of the axes keeps handedness, a mirror flips it.
TEST(EngineAxes, LeftHandedEnginesAreMirroredAndOthersTurned) {
  const auto handedness = [](EngineAxes axes) {
    return Dot(Cross(DirectionIn(axes, kRight), DirectionIn(axes, kForward)),
               DirectionIn(axes, kUp));
  };
  EXPECT_EQ(handedness(EngineAxes::kZUp), 1.0);
  EXPECT_EQ(handedness(EngineAxes::kYUp), 1.0);
  EXPECT_EQ(handedness(EngineAxes::kZUpLeftHanded), -1.0);
  EXPECT_EQ(handedness(EngineAxes::kYUpLeftHanded), -1.0);
}

// The documented matrix of FRotator, written out from its Euler angles, must give the axes back.
TEST(UnrealRotator, ItsMatrixGivesBackForwardRightAndUp) {
  const double rad = std::numbers::pi / 180.0;
  for (const Vec3& aim : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, -1}, Vec3{0, 0, 1},
                          Vec3{0.6, -0.64, -0.48}, Vec3{-1, 0, 0}, Vec3{-0.36, 0.48, 0.8}}) {
    const LampAxes lamp = AxesOfAim(aim);
    const Vec3 forward = DirectionIn(EngineAxes::kZUpLeftHanded, lamp.aim);
    const Vec3 right = DirectionIn(EngineAxes::kZUpLeftHanded, lamp.c0);
    const Vec3 up = DirectionIn(EngineAxes::kZUpLeftHanded, lamp.c90);
    const UnrealRotator r = UnrealRotatorFromAxes(forward, right, up);
    const double sp = std::sin(r.pitch_deg * rad), cp = std::cos(r.pitch_deg * rad);
    const double sy = std::sin(r.yaw_deg * rad), cy = std::cos(r.yaw_deg * rad);
    const double sr = std::sin(r.roll_deg * rad), cr = std::cos(r.roll_deg * rad);
    const Vec3 x = {cp * cy, cp * sy, sp};
    const Vec3 y = {sr * sp * cy - cr * sy, sr * sp * sy + cr * cy, -sr * cp};
    const Vec3 z = {-(cr * sp * cy + sr * sy), cy * sr - cr * sp * sy, cr * cp};
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(x[i], forward[i], 1e-12);
      EXPECT_NEAR(y[i], right[i], 1e-12);
      EXPECT_NEAR(z[i], up[i], 1e-12);
    }
  }
}

TEST(UnrealRotator, GoldenAngles) {
  const auto of = [](const Vec3& aim) {
    const LampAxes lamp = AxesOfAim(aim);
    return UnrealRotatorFromAxes(DirectionIn(EngineAxes::kZUpLeftHanded, lamp.aim),
                                 DirectionIn(EngineAxes::kZUpLeftHanded, lamp.c0),
                                 DirectionIn(EngineAxes::kZUpLeftHanded, lamp.c90));
  };
  EXPECT_DOUBLE_EQ(of({1, 0, 0}).yaw_deg, 0.0);
  EXPECT_DOUBLE_EQ(of({1, 0, 0}).roll_deg, 0.0);
  EXPECT_DOUBLE_EQ(of({0, 1, 0}).yaw_deg, -90.0);  // our north is Unreal's -Y
  EXPECT_DOUBLE_EQ(of({0, 0, -1}).pitch_deg, -90.0);
  EXPECT_NEAR(of({0.8, 0, 0.6}).pitch_deg, 36.8698976, 1e-6);
}

}  // namespace
}  // namespace lightcal::test
