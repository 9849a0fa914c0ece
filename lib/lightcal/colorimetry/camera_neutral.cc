// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/camera_neutral.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "lightcal/colorimetry/cct.h"

namespace lightcal {
namespace {

constexpr Xy kD50 = {0.34567, 0.35850};
constexpr double kSettled = 1e-7;
constexpr int kMostPasses = 30;

tl::unexpected<Error> Bad() {
  return Refused("bad_neutral", "camera",
                 "the neutral and the matrices give no colour of light; check that the neutral "
                 "holds three positive numbers (the reciprocals of the white balance)");
}

// Solves m c = neutral by Cramer's rule; absent when m is singular.
std::optional<Xyz> Solve(const Matrix3& m, const std::array<double, 3>& neutral) {
  const auto determinant = [](const Matrix3& a) {
    return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) -
           a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
           a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
  };
  std::array<double, 3> c{};
  const double whole = determinant(m);
  if (whole == 0.0) return std::nullopt;
  for (std::size_t column = 0; column < 3; ++column) {
    Matrix3 replaced = m;
    for (std::size_t row = 0; row < 3; ++row) replaced[row][column] = neutral[row];
    c[column] = determinant(replaced) / whole;
  }
  if (!std::isfinite(c[0] + c[1] + c[2])) return std::nullopt;
  return Xyz{c[0], c[1], c[2]};
}

}  // namespace

Matrix3 CameraMatrixAt(const CameraMatrices& camera, Kelvin temperature) {
  const double warm = 1.0 / camera.warm_temperature.value();
  const double cool = 1.0 / camera.cool_temperature.value();
  const double share =
      warm == cool ? 0.0 : std::clamp((warm - 1.0 / temperature.value()) / (warm - cool), 0.0, 1.0);
  Matrix3 m{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      m[i][j] = camera.warm[i][j] + share * (camera.cool[i][j] - camera.warm[i][j]);
    }
  }
  return m;
}

Result<Xy> XyFromCameraNeutral(const CameraMatrices& camera, const std::array<double, 3>& neutral) {
  if (!std::ranges::all_of(neutral, [](double n) { return n > 0.0 && std::isfinite(n); })) {
    return Bad();
  }
  Xy last = kD50;
  for (int pass = 0; pass < kMostPasses; ++pass) {
    const CctResult cct = CctFromXy(last);
    if (cct.status == CctStatus::kNotAChromaticity) return Bad();
    const auto xyz = Solve(CameraMatrixAt(camera, cct.temperature), neutral);
    if (!xyz || !(xyz->X + xyz->Y + xyz->Z > 0.0)) return Bad();
    Xy next = XyFromXyz(*xyz);
    if (CctFromXy(next).status == CctStatus::kNotAChromaticity) return Bad();
    if (std::abs(next.x - last.x) + std::abs(next.y - last.y) < kSettled) return next;
    if (pass == kMostPasses - 1) next = {(next.x + last.x) / 2.0, (next.y + last.y) / 2.0};
    last = next;
  }
  return last;
}

}  // namespace lightcal
