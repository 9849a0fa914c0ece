// SPDX-License-Identifier: Apache-2.0
#include "lightcal/photometry/area_illuminance.h"

#include <cmath>
#include <numbers>

namespace lightcal {

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

double LuxPerCandelaOfLine(Metres length, Metres distance) {
  const double d = distance.value();
  const double t = length.value() / 2.0;
  const double to_end = std::hypot(t, d);
  return 0.5 * (1.0 / to_end / to_end + std::atan(t / d) / t / d);
}

double LuxPerNitOfTube(Metres length, Metres radius, Metres distance) {
  const double h = distance / radius;
  const double l = length / (2.0 * radius);
  const double to_far_edge = std::hypot(1.0 + h, l);   // sqrt(X)
  const double to_near_edge = std::hypot(h - 1.0, l);  // sqrt(Y)
  const double product = to_far_edge * to_near_edge;
  const double sum = 1.0 + h * h + l * l;  // X - 2H
  const double a = std::sqrt((h - 1.0) / (h + 1.0));
  const double k = to_far_edge / to_near_edge;
  // c atan(k a) - atan(a), c = sum/product, without subtracting: c - 1, k - 1 and the difference of
  // arctangents are each written as a quotient of positive terms.
  const double c_minus_1 = 4.0 * h * h / (product * (sum + product));
  const double k_minus_1 = 4.0 * h / (to_near_edge * (to_far_edge + to_near_edge));
  const double difference =
      c_minus_1 * std::atan(k * a) + std::atan(a * k_minus_1 / (1.0 + k * a * a));
  const double root = std::sqrt((h - 1.0) * (h + 1.0));
  return 2.0 / h * (std::atan(l / root) + l * difference);
}

}  // namespace lightcal
