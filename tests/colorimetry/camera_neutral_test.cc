// SPDX-License-Identifier: Apache-2.0
// Truth: the neutral that the same matrices give a known light.
#include "lightcal/colorimetry/camera_neutral.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lightcal/colorimetry/cct.h"

namespace lightcal {
namespace {

// A made-up camera: Bradford-like responses that drift between its two calibration lights.
CameraMatrices Camera() {
  CameraMatrices camera;
  camera.warm = {{{0.95, -0.30, -0.06}, {-0.45, 1.28, 0.18}, {-0.05, 0.17, 0.62}}};
  camera.cool = {{{0.88, -0.25, -0.08}, {-0.40, 1.22, 0.20}, {-0.07, 0.20, 0.58}}};
  return camera;
}

std::array<double, 3> NeutralOf(const CameraMatrices& camera, Xy light) {
  const Matrix3 m = CameraMatrixAt(camera, CctFromXy(light).temperature);
  const Xyz c = XyzFromXyAtUnitY(light);
  std::array<double, 3> n{};
  for (std::size_t i = 0; i < 3; ++i) n[i] = m[i][0] * c.X + m[i][1] * c.Y + m[i][2] * c.Z;
  return n;
}

TEST(CameraNeutral, ReturnsTheLightThatMadeIt) {
  const CameraMatrices camera = Camera();
  for (double kelvin = 2000.0; kelvin < 12'000.0; kelvin *= 1.1) {
    for (const double duv : {-0.01, 0.0, 0.01}) {
      const Xy light = XyFromCct(Kelvin(kelvin), duv);
      const auto found = XyFromCameraNeutral(camera, NeutralOf(camera, light));
      ASSERT_TRUE(found) << kelvin << " " << duv;
      EXPECT_NEAR(found->x, light.x, 2e-7) << kelvin << " " << duv;
      EXPECT_NEAR(found->y, light.y, 2e-7) << kelvin << " " << duv;
    }
  }
}

TEST(CameraNeutral, DoesNotDependOnItsScale) {
  const auto neutral = NeutralOf(Camera(), {0.44, 0.40});
  const auto once = XyFromCameraNeutral(Camera(), neutral);
  const auto tenfold =
      XyFromCameraNeutral(Camera(), {10 * neutral[0], 10 * neutral[1], 10 * neutral[2]});
  EXPECT_NEAR(once->x, tenfold->x, 1e-12);
}

TEST(CameraMatrix, IsLinearInReciprocalTemperatureAndClampedOutside) {
  const CameraMatrices camera = Camera();
  const double middle =
      2.0 / (1.0 / camera.warm_temperature.value() + 1.0 / camera.cool_temperature.value());
  EXPECT_NEAR(CameraMatrixAt(camera, Kelvin(middle))[0][0], 0.915, 1e-12);
  EXPECT_DOUBLE_EQ(CameraMatrixAt(camera, Kelvin(1500))[0][0], 0.95);
  EXPECT_DOUBLE_EQ(CameraMatrixAt(camera, Kelvin(20'000))[0][0], 0.88);
}

TEST(CameraNeutral, WithoutAColorIsRefused) {
  EXPECT_EQ(XyFromCameraNeutral(Camera(), {0.5, 0.0, 0.5}).error().code, "bad_neutral");
  EXPECT_EQ(XyFromCameraNeutral(CameraMatrices{}, {0.5, 1.0, 0.5}).error().code, "bad_neutral");
}

}  // namespace
}  // namespace lightcal
