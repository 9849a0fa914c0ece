// SPDX-License-Identifier: Apache-2.0
// One row of the problem whose lamp stands at an unknown place, and the law its cost follows.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <variant>

#include "lightcal/core/vec3.h"
#include "lightcal/fit/model/reading_model.h"
#include "lightcal/light/models/disk_source.h"
#include "lightcal/light/models/rect_source.h"

namespace lightcal::fit {

// The parameters, in this order everywhere: ln I, the effective source's place, the ambient
// illuminance, the distance offset of readings that give a distance alone, of the walls' light
// (light/wall_prior.h) ln b and the slope, and how unevenly the lamp shines: ln I towards the unit
// vector u is ln I + g.(u - middle), g the gradient and middle the mean of u over the readings.
enum PlacedParameter : std::uint8_t {
  kPlacedLnIntensity = 0,
  kPlacedX = 1,
  kPlacedY = 2,
  kPlacedZ = 3,
  kPlacedAmbient = 4,
  kPlacedOffset = 5,
  kPlacedLnWalls = 6,
  kPlacedWallsSlope = 7,
  kPlacedGradientX = 8,
  kPlacedGradientY = 9,
  kPlacedGradientZ = 10,
};
inline constexpr int kPlacedParameters = 11;
using PlacedTheta = std::array<double, kPlacedParameters>;

// The light from the walls in one row, whose distance is to be found:
//   E_walls = exp(ln I + ln b + slope x + bend x^2 + constant),  x = ln(r / 3 m)
struct PlacedWalls : WallsOfRow {
  double ln_unit = 0.0;  // ln of the solver's unit of length over 3 m
  double bend = 0.0;
};

// The face of a flat lamp of known size, in the solver's unit.
struct PlacedFace {
  std::variant<DiskSource, RectSource> outline;
  SourceFrame frame;
};

struct PlacedRow {
  RowForm form = RowForm::kLog;
  std::optional<Vec3> position;  // of the meter; absent: `distance` from the lamp, facing it
  std::optional<Vec3> normal;    // unit; absent: facing the lamp
  double distance = 1.0;
  double tilt_cosine = 1.0;  // stated, where no normal is given
  int instrument = 0;
  double direct_gain = 1.0;        // what tilt, head and source size leave; 0 without the lamp
  double bounce = 0.0;             // illuminance from the room's walls per candela, known
  std::optional<PlacedFace> face;  // absent: a point, or, with an aim, a small flat lamp
  std::optional<PlacedWalls> walls;
  std::optional<Vec3> middle;  // of a lamp that shines unevenly: the mean direction from it
  double ambient_gain = 1.0;   // 0 where a shadow-card reading was subtracted
  double measured = 0.0;
  double sigma = 1.0;      // as of ReadingRow's forms
  double own_sigma = 1.0;  // of it, what is not scatter of the walls' light
};

// Of the walls, per candela, at a distance; 0 in rows that see none of their light.
template <class T>
[[nodiscard]] T WallsPerCandela(const PlacedRow& row, const T& distance, const T* theta) {
  using std::exp;
  using std::log;
  if (!row.walls) return T(0.0);
  const T x = log(distance) + row.walls->ln_unit;
  return exp(theta[kPlacedLnWalls] + (theta[kPlacedWallsSlope] + row.walls->bend * x) * x +
             row.walls->constant);
}

// From the lamp: r of a placed row, the stated distance and its offset of another.
template <class T>
[[nodiscard]] T DistanceOf(const PlacedRow& row, const T* theta) {
  using std::sqrt;
  if (!row.position) return row.distance + theta[kPlacedOffset];
  const std::array<T, 3> v = {theta[kPlacedX] - (*row.position)[0],
                              theta[kPlacedY] - (*row.position)[1],
                              theta[kPlacedZ] - (*row.position)[2]};
  return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

// An automatic-differentiation scalar like T with three derivatives.
template <class T>
struct ByPlaceOf;
template <template <class, int> class Jet, class Number, int kCount>
struct ByPlaceOf<Jet<Number, kCount>> {
  using type = Jet<Number, 3>;
};

// Of the whole face, exactly, at a place in its own frame; the meter faces it where no normal is
// given. Only the place depends on theta: three derivatives, which the chain rule carries on, cost
// a third of all.
template <class T>
[[nodiscard]] T LuxOfFace(const PlacedFace& face, const Vec3Of<T>& at,
                          const std::optional<Vec3>& normal) {
  const auto lux = [&](const auto& place) {
    using S = std::decay_t<decltype(place[0])>;
    using std::sqrt;
    Receiver<S> receiver{place, place * (S(-1.0) / sqrt(Dot(place, place)))};
    if (normal) {
      const Vec3 turned = face.frame.Of(*normal);
      receiver.normal = {S(turned[0]), S(turned[1]), S(turned[2])};
    }
    return std::visit([&](const auto& one) { return LuxPerCandela(one, receiver); }, face.outline);
  };
  if constexpr (std::is_same_v<T, double>) {
    return lux(at);
  } else {
    using ByPlace = typename ByPlaceOf<T>::type;
    const ByPlace here =
        lux(Vec3Of<ByPlace>{ByPlace(at[0].a, 0), ByPlace(at[1].a, 1), ByPlace(at[2].a, 2)});
    T out(here.a);
    for (int k = 0; k < 3; ++k) out.v += here.v[k] * at[k].v;
    return out;
  }
}

// Of the lamp itself, per candela, at the distance r. False where the meter or the lamp faces away.
template <class T>
[[nodiscard]] bool DirectPerCandela(const PlacedRow& row, const std::optional<Vec3>& aim,
                                    const T& r, const T* theta, T* direct) {
  using std::exp;
  if (row.face) {
    Vec3Of<T> at = {T(0.0), T(0.0), r};  // on the axis
    if (row.position) {
      at = row.face->frame.Of(Vec3Of<T>{(*row.position)[0] - theta[kPlacedX],
                                        (*row.position)[1] - theta[kPlacedY],
                                        (*row.position)[2] - theta[kPlacedZ]});
    }
    if (!(at[2] > T(1e-6) * r)) return false;  // behind it, or so near its plane that sums cancel
    *direct = row.direct_gain * LuxOfFace(*row.face, at, row.position ? row.normal : std::nullopt);
    return *direct > T(0.0);
  }
  *direct = row.direct_gain / (r * r);
  if (!row.position) return true;
  const auto along = [&](const Vec3& u) {
    return (theta[kPlacedX] - (*row.position)[0]) * u[0] +
           (theta[kPlacedY] - (*row.position)[1]) * u[1] +
           (theta[kPlacedZ] - (*row.position)[2]) * u[2];
  };
  if (row.normal) {
    const T cosine = along(*row.normal) / r;
    if (!(cosine > T(0.0))) return false;
    *direct *= cosine;
  }
  if (aim) {
    const T cosine = -along(*aim) / r;
    if (!(cosine > T(0.0))) return false;
    *direct *= cosine;
  }
  if (!row.middle) return true;
  T uneven(0.0);
  for (int k = 0; k < 3; ++k) {
    const T towards = ((*row.position)[k] - theta[kPlacedX + k]) / r;
    uneven += theta[kPlacedGradientX + k] * (towards - (*row.middle)[k]);
  }
  *direct *= exp(uneven);
  return true;
}

// Of the light's tilt against the meter's normal.
[[nodiscard]] inline double TiltCosineOf(const PlacedRow& row, const double* theta) {
  if (!row.position || !row.normal) return row.tilt_cosine;
  double along = 0.0;
  for (int k = 0; k < 3; ++k) {
    along += (theta[kPlacedX + k] - (*row.position)[k]) * (*row.normal)[k];
  }
  return along / DistanceOf(row, theta);
}

// E = exp(ln I) [ gain exp(g.(-v/r - middle)) (n.v/r) (-a.v/r)/r^2 + bounce + walls ] + ambient,
// v = lamp - meter, r = |v|; the cosine n.v/r is 1 for a meter that faces the lamp, -a.v/r (a flat
// Lambertian source shining along a) is 1 where no aim is given; of a face of known size the exact
// form stands for all three factors. False where the meter or the lamp faces away. theta:
// kPlacedParameters of T, which is double or an automatic-differentiation scalar.
template <class T>
[[nodiscard]] bool PlacedIlluminance(const PlacedRow& row, const std::optional<Vec3>& aim,
                                     const T* theta, T* lux) {
  using std::exp;
  T per_candela(row.bounce);
  if (row.direct_gain > 0.0 || row.walls) {
    const T r = DistanceOf(row, theta);
    if (!(r > T(0.0))) return false;
    if (row.walls) per_candela += WallsPerCandela(row, r, theta);
    if (row.direct_gain > 0.0) {
      T direct(0.0);
      if (!DirectPerCandela(row, aim, r, theta, &direct)) return false;
      per_candela += direct;
    }
  }
  *lux = exp(theta[kPlacedLnIntensity]) * per_candela + row.ambient_gain * theta[kPlacedAmbient];
  return true;
}

}  // namespace lightcal::fit
