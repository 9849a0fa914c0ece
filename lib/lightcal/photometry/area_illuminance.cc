// SPDX-License-Identifier: Apache-2.0
#include "lightcal/photometry/area_illuminance.h"

#include <cmath>
#include <numbers>

namespace lightcal {
namespace {

constexpr double kThinTubeDistance = 1e4;  // in radii

// int over the half length t of a line of width 2R, both halves.
double LuxPerNitOfLine(double half_length, double radius, double d) {
  return 2.0 * radius *
         (half_length / (d * d + half_length * half_length) + std::atan(half_length / d) / d);
}

}  // namespace

double LuxPerNitOfSphere(Metres radius, Metres distance) {
  const double s = radius / distance;
  return std::numbers::pi * s * s;
}

double LuxPerNitOfDisk(Metres radius, Metres distance) {
  const double s = radius.value() / std::hypot(radius.value(), distance.value());
  return std::numbers::pi * s * s;
}

double LuxPerNitOfRect(Metres width, Metres height, Metres distance) {
  const double a = width.value() / 2.0;
  const double b = height.value() / 2.0;
  const double to_a = std::hypot(a, distance.value());
  const double to_b = std::hypot(b, distance.value());
  return 2.0 * (a / to_a * std::atan(b / to_a) + b / to_b * std::atan(a / to_b));
}

double LuxPerNitOfTube(Metres length, Metres radius, Metres distance) {
  const double h = distance / radius;
  if (h > kThinTubeDistance) {
    return LuxPerNitOfLine(length.value() / 2.0, radius.value(), distance.value());
  }
  const double l = length.value() / (2.0 * radius.value());
  const double x = (1.0 + h) * (1.0 + h) + l * l;
  const double y = (1.0 - h) * (1.0 - h) + l * l;
  const double root = std::sqrt((h - 1.0) * (h + 1.0));
  const double ratio = (h - 1.0) / (h + 1.0);
  const double mantle =
      (x - 2.0 * h) / (h * std::sqrt(x) * std::sqrt(y)) * std::atan(std::sqrt(x / y * ratio)) -
      std::atan(std::sqrt(ratio)) / h;
  return 2.0 * (std::atan(l / root) / h + l * mantle);
}

}  // namespace lightcal
