// SPDX-License-Identifier: Apache-2.0
// One row of the problem whose lamp stands at an unknown place, and the law its cost follows.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "lightcal/core/vec3.h"
#include "lightcal/fit/model/reading_model.h"

namespace lightcal::fit {

// The parameters, in this order everywhere: ln I, the effective source's place, the ambient
// illuminance, the distance offset of readings that give a distance alone.
enum PlacedParameter : std::uint8_t {
  kPlacedLnIntensity = 0,
  kPlacedX = 1,
  kPlacedY = 2,
  kPlacedZ = 3,
  kPlacedAmbient = 4,
  kPlacedOffset = 5,
};
inline constexpr int kPlacedParameters = 6;
using PlacedTheta = std::array<double, kPlacedParameters>;

struct PlacedRow {
  RowForm form = RowForm::kLog;
  std::optional<Vec3> position;  // of the meter; absent: `distance` from the lamp, facing it
  std::optional<Vec3> normal;    // unit; absent: facing the lamp
  double distance = 1.0;
  double direct_gain = 1.0;   // what tilt, head and source size leave; 0 without the lamp
  double bounce = 0.0;        // illuminance from the room's walls per candela, known
  double ambient_gain = 1.0;  // 0 where a shadow-card reading was subtracted
  double measured = 0.0;
  double sigma = 1.0;  // as of ReadingRow's forms
};

// E = exp(ln I) [ gain (n.v/r) (-a.v/r)/r^2 + bounce ] + ambient,  v = lamp - meter, r = |v|;
// the cosine n.v/r is 1 for a meter that faces the lamp, -a.v/r (a flat Lambertian source shining
// along a) is 1 where no aim is given. False where the meter or the lamp faces away. T is double or
// an automatic-differentiation scalar.
template <class T>
[[nodiscard]] bool PlacedIlluminance(const PlacedRow& row, const std::optional<Vec3>& aim,
                                     const T& ln_intensity, const T* lamp, const T& ambient,
                                     const T& distance_offset, T* lux) {
  using std::exp;
  using std::sqrt;
  T per_candela(row.bounce);
  if (row.direct_gain > 0.0 && row.position) {
    const std::array<T, 3> v = {lamp[0] - (*row.position)[0], lamp[1] - (*row.position)[1],
                                lamp[2] - (*row.position)[2]};
    const auto along = [&v](const Vec3& u) { return v[0] * u[0] + v[1] * u[1] + v[2] * u[2]; };
    const T r2 = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    if (!(r2 > T(0.0))) return false;
    const T r = sqrt(r2);
    T direct = row.direct_gain / r2;
    if (row.normal) {
      const T cosine = along(*row.normal) / r;
      if (!(cosine > T(0.0))) return false;
      direct *= cosine;
    }
    if (aim) {
      const T cosine = -along(*aim) / r;
      if (!(cosine > T(0.0))) return false;
      direct *= cosine;
    }
    per_candela += direct;
  } else if (row.direct_gain > 0.0) {
    const T r = row.distance + distance_offset;
    if (!(r > T(0.0))) return false;
    per_candela += row.direct_gain / (r * r);
  }
  *lux = exp(ln_intensity) * per_candela + row.ambient_gain * ambient;
  return true;
}

}  // namespace lightcal::fit
