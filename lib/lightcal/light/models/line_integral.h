// SPDX-License-Identifier: Apache-2.0
// The integral that a line of light makes, in closed form.
#pragma once

#include <cmath>

#include "lightcal/core/vec3.h"
#include "lightcal/light/models/receiver.h"

namespace lightcal::models {

// x - sin x for x >= 0, by its series where the difference cancels.
template <class T>
[[nodiscard]] T ArgumentMinusSine(const T& x) {
  using S = Scalar<T>;
  using std::sin;
  if (x > S(0.5)) return x - sin(x);
  const T x2 = x * x;
  T sum(0);
  for (int k = 15; k >= 3; k -= 2) sum = (S(1) - x2 * sum) / S(k * (k - 1));
  return x * x2 * sum;
}

// int (n0 + t n_along)/(rho^2 + t^2)^2 dt between t1 and t2 = t1 + span, that part of it where n0 +
// t n_along > 0: a line's illuminance without its strength. With D the angle the line subtends and
// C the sum of both ends' angles from the perpendicular, without subtraction of likes:
//   n0 [ (D - sin D) + sin D (1 + cos C) ]/(2 rho^3) + n_along (t2^2 - t1^2)/(2 r1^2 r2^2)
template <class T>
[[nodiscard]] T LineIntegral(const T& n0, const T& n_along, const T& rho2, T t1, T t2, T span) {
  using S = Scalar<T>;
  using std::atan2;
  using std::sqrt;
  const T at_first = n0 + t1 * n_along;
  const T at_last = n0 + t2 * n_along;
  if (!(at_first > S(0)) && !(at_last > S(0))) return T(0);
  if (!(at_first > S(0)) || !(at_last > S(0))) {
    (at_first > S(0) ? t2 : t1) = -n0 / n_along;
    span = t2 - t1;
  }
  const T rho = sqrt(rho2);
  const T r1_2 = rho2 + t1 * t1;
  const T r2_2 = rho2 + t2 * t2;
  const T product = sqrt(r1_2 * r2_2);
  const T ends = t1 * t2;
  const T angle = atan2(T(rho * span), T(rho2 + ends));
  const T left =
      ends > S(0) ? rho2 * (rho2 + t1 * t1 + t2 * t2) / (product + ends) : T(product - ends);
  const T sum = ArgumentMinusSine(angle) + rho * span / product * ((rho2 + left) / product);
  return n0 * sum / (S(2) * rho * rho2) + n_along * span * (t1 + t2) / (S(2) * r1_2 * r2_2);
}

}  // namespace lightcal::models
