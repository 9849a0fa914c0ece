// SPDX-License-Identifier: Apache-2.0
// One row of the least-squares problem and the law every cost shares.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <type_traits>

#include "lightcal/fit/model/light_by_tilt.h"
#include "lightcal/fit/model/off_axis_pose.h"
#include "lightcal/light/axial_shape.h"

namespace lightcal::fit {

// The parameters, in this order everywhere: natural logarithm of the axial intensity, the distance
// offset, the ambient illuminance, of the walls' light (light/wall_prior.h) ln b and the slope, and
// ln of the scale of one instrument among several, and the tilts of the aim (aim_error.h). Units
// are those of the rows (the solver scales lengths and illuminances); b stays in 1/m^2.
enum Parameter : std::uint8_t {
  kLnIntensity = 0,
  kDistanceOffset = 1,
  kAmbient = 2,
  kLnWalls = 3,
  kWallsSlope = 4,
  kLnScale = 5,
  kAimX = 6,
  kAimY = 7,
};
inline constexpr int kParameters = 8;
// Without those that one instrument and a lamp that shines evenly do not have.
inline constexpr int kWithoutScale = 5;

// How a reading m of a meter that should see E counts, over its sigma.
enum class RowForm : std::uint8_t {
  kLog,       // (ln m - ln E)/sigma, sigma relative: positive readings
  kLinear,    // (m - E)/sigma, sigma in lux: readings near or below zero, lamp-off readings
  kCensored,  // max(0, ln m - ln E)/sigma: the meter was over range, the truth is at least m
};

// That residual. False where logarithms have none: the model is not above 0.
template <class T>
[[nodiscard]] bool WhitenedResidual(RowForm form, double measured, double sigma, const T& predicted,
                                    T* residual) {
  using std::log;
  if (form == RowForm::kLinear) {
    *residual = (measured - predicted) / sigma;
    return true;
  }
  if (!(predicted > T(0.0))) return false;
  if constexpr (std::is_same_v<T, double>) {
    *residual = std::log(measured / predicted) / sigma;
  } else {
    *residual = (std::log(measured) - log(predicted)) / sigma;
  }
  if (form == RowForm::kCensored && !(*residual > T(0.0))) *residual = T(0.0);
  return true;
}

// The light from the walls in one row: E_walls = exp(ln I + ln b + slope x + constant).
struct WallsOfRow {
  double x = 0.0;         // ln(d / 3 m)
  double constant = 0.0;  // bend x^2, and ln of the solver's unit of length squared
  double scatter = 0.0;  // sqrt(rows) times 1 sigma of ln E_walls at its place, whose rows share it
  int place = 0;         // which, of the estimation's
  int rows = 1;          // that are there
};

struct ReadingRow {
  using Form = RowForm;
  Form form = Form::kLog;
  std::optional<WallsOfRow> walls;
  AxialShape shape;
  std::optional<OffAxisPose> off_axis;  // instead of shape and distance
  double distance = 1.0;
  double direct_gain = 1.0;   // cosine of the tilt; 0 for a reading without the lamp
  double bounce = 0.0;        // illuminance from the room's walls per candela, known
  double ambient_gain = 1.0;  // 0 where a shadow-card reading was subtracted
  double measured = 0.0;
  double sigma = 1.0;
  double own_sigma = 1.0;    // of it, what is not scatter of the walls' light, nor the lamp's own
  double uneven = 0.0;       // 1 sigma of ln I towards this meter (uneven_light.h)
  double calibration = 0.0;  // 1 sigma, relative, of all rows of one instrument alike
  double scale = 0.0;        // how much of ln of the scale is in it: 0 of another instrument
  int instrument = 0;
  std::shared_ptr<const LightByTilt> by_aim;  // null: 1
  bool data_sheet = false;                    // what the manufacturer prints
  bool picture = false;                       // what a camera read
};

// Illuminance per candela: cos(tilt) g(r)/r^2 + bounce, r = d + d0, g the axial shape factor; off
// the axis of a source with size and aim its exact form.
template <class T>
[[nodiscard]] T LuxPerCandela(const ReadingRow& row, const T& distance_offset) {
  if (row.off_axis) {
    return row.direct_gain * LuxPerCandela(*row.off_axis, distance_offset) + row.bounce;
  }
  const T r = row.distance + distance_offset;
  return row.direct_gain * AxialShapeFactor(row.shape, r) / (r * r) + row.bounce;
}

// The same, and of a row without the lamp what is known of the walls alone.
template <class T>
[[nodiscard]] T LampPerCandela(const ReadingRow& row, const T& distance_offset) {
  return row.direct_gain > 0.0 ? LuxPerCandela(row, distance_offset) : T(row.bounce);
}

// Of the walls, per candela; 0 in rows that see none of their light.
template <class T>
[[nodiscard]] T WallsPerCandela(const ReadingRow& row, const T* theta) {
  using std::exp;
  if (!row.walls) return T(0.0);
  return exp(theta[kLnWalls] + theta[kWallsSlope] * row.walls->x + row.walls->constant);
}

// The direct light over that of the stated aim, by the aim's tilts, and its derivatives by
// differences over a quarter of a degree: tables and cones have kinks.
struct PartByAim {
  double value = 1.0;
  std::array<double, 2> slope{};
  std::array<double, 3> bend{};  // xx, yy, xy
};
[[nodiscard]] inline PartByAim PartByAimAt(const ReadingRow& row, double x, double y) {
  constexpr double kStep = 0.0044;
  const auto& part = *row.by_aim;
  const double at = part(x, y);
  const double right = part(x + kStep, y), left = part(x - kStep, y);
  const double up = part(x, y + kStep), down = part(x, y - kStep);
  const double both = part(x + kStep, y + kStep) + part(x - kStep, y - kStep);
  const double square = kStep * kStep;
  return {at,
          {(right - left) / (2.0 * kStep), (up - down) / (2.0 * kStep)},
          {(right - 2.0 * at + left) / square, (up - 2.0 * at + down) / square,
           (both - right - left - up - down + 2.0 * at) / (2.0 * square)}};
}

// What the instrument makes of all it sees: 1 where its scale is no parameter.
template <class T>
[[nodiscard]] T ScaleOfRow(const ReadingRow& row, const T* theta) {
  using std::exp;
  return row.scale > 0.0 ? exp(row.scale * theta[kLnScale]) : T(1.0);
}

// E = (exp(ln I) (illuminance per candela + walls) + ambient) scale. theta: kParameters of T, which
// is double or an automatic-differentiation scalar.
template <class T>
[[nodiscard]] T RowIlluminance(const ReadingRow& row, const T* theta) {
  using std::exp;
  T per_candela = LampPerCandela(row, theta[kDistanceOffset]);
  if constexpr (std::is_same_v<T, double>) {
    if (row.by_aim) {
      per_candela =
          row.bounce + (per_candela - row.bounce) * (*row.by_aim)(theta[kAimX], theta[kAimY]);
    }
  }
  if (row.walls) per_candela += WallsPerCandela(row, theta);
  const T seen = exp(theta[kLnIntensity]) * per_candela + row.ambient_gain * theta[kAmbient];
  return ScaleOfRow(row, theta) * seen;
}

// What a row adds to the least-squares problem (least_squares.h).
template <class T>
[[nodiscard]] bool RowResidual(const ReadingRow& row, const T* theta, T* residual) {
  return WhitenedResidual(row.form, row.measured, row.sigma, RowIlluminance(row, theta), residual);
}

// The same with its derivatives by the first N parameters (all, or kWithoutScale), and where asked
// its second ones (`bend`, N^2 of them, the lower triangle alone written).
template <int N>
[[nodiscard]] bool RowResidual(const ReadingRow& row, const double* theta, double* residual,
                               double* gradient, double* bend = nullptr);

}  // namespace lightcal::fit
