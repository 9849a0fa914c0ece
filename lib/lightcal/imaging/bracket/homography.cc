// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/homography.h"

#include <cmath>
#include <cstddef>

namespace lightcal {

Homography Homography::After(const Homography& other) const {
  Homography out;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      double sum = 0.0;
      for (std::size_t k = 0; k < 3; ++k) sum += m[3 * i + k] * other.m[3 * k + j];
      out.m[3 * i + j] = sum;
    }
  }
  const double last = out.m[8];
  if (last != 0.0) {
    for (double& value : out.m) value /= last;
  }
  return out;
}

std::optional<Homography> Homography::Inverse() const {
  const double a = m[4] * m[8] - m[5] * m[7], b = m[5] * m[6] - m[3] * m[8],
               c = m[3] * m[7] - m[4] * m[6];
  const double determinant = m[0] * a + m[1] * b + m[2] * c;
  const double corner = m[0] * m[4] - m[1] * m[3];
  if (!(std::abs(determinant) > 1e-12) || !(std::abs(corner) > 1e-12)) return std::nullopt;
  Homography out;
  out.m = {a, m[2] * m[7] - m[1] * m[8], m[1] * m[5] - m[2] * m[4],
           b, m[0] * m[8] - m[2] * m[6], m[2] * m[3] - m[0] * m[5],
           c, m[1] * m[6] - m[0] * m[7], corner};
  for (double& value : out.m) value /= corner;
  return out;
}

Homography Homography::InPlaces(double scale, double x, double y) const {
  const Homography to{{scale, 0.0, x, 0.0, scale, y, 0.0, 0.0, 1.0}};
  const Homography from{
      {1.0 / scale, 0.0, -x / scale, 0.0, 1.0 / scale, -y / scale, 0.0, 0.0, 1.0}};
  return to.After(*this).After(from);
}

double RmsBetween(const Homography& a, const Homography& b, double width, double height) {
  constexpr int kAcross = 12;
  double sum = 0.0;
  for (int j = 0; j < kAcross; ++j) {
    for (int i = 0; i < kAcross; ++i) {
      const double x = (i + 0.5) / kAcross * width, y = (j + 0.5) / kAcross * height;
      const auto [ax, ay] = a(x, y);
      const auto [bx, by] = b(x, y);
      sum += (ax - bx) * (ax - bx) + (ay - by) * (ay - by);
    }
  }
  return std::sqrt(sum / (kAcross * kAcross));
}

}  // namespace lightcal
