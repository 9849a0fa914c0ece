// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/panorama/turn_north.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace lightcal {

Vec3 TurnedNorth(const Vec3& d, Radians north) {
  const double c = std::cos(north.value()), s = std::sin(north.value());
  return {c * d[0] - s * d[1], s * d[0] + c * d[1], d[2]};
}

void TurnNorth(Radians north, Dome& dome) {
  const double columns = north.value() / (2.0 * std::numbers::pi) * dome.width;
  const double whole = std::floor(columns + 1e-9);
  const auto part = static_cast<float>(std::max(0.0, columns - whole));
  const auto shift = static_cast<int>(std::fmod(whole, dome.width)) + dome.width;
  const auto turn = [&](std::vector<float>& values, int channels) {
    std::vector<float> row(static_cast<std::size_t>(dome.width) * channels);
    for (int y = 0; y < dome.height; ++y) {
      float* const at = &values[static_cast<std::size_t>(y) * row.size()];
      std::copy_n(at, row.size(), row.begin());
      for (int x = 0; x < dome.width; ++x) {
        const int left = (x + shift) % dome.width, right = (left + 1) % dome.width;
        for (int c = 0; c < channels; ++c) {
          const float a = row[static_cast<std::size_t>(left * channels + c)];
          const float b = row[static_cast<std::size_t>(right * channels + c)];
          at[x * channels + c] = (1.0F - part) * a + part * b;
        }
      }
    }
  };
  turn(dome.samples, dome.channels);
  turn(dome.nits, 1);
}

AzimuthElevation AnglesOf(const Vec3& d) {
  return {DegreesFromRadians(Radians(std::atan2(d[0], d[1]))),
          DegreesFromRadians(Radians(std::atan2(d[2], std::hypot(d[0], d[1]))))};
}

}  // namespace lightcal
