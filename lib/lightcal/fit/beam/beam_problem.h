// SPDX-License-Identifier: Apache-2.0
// Readings in and around a beam whose shape is sought, as rows of the one least-squares problem.
// Internal to this room.
#pragma once

#include <ceres/jet.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lightcal/core/vec3.h"
#include "lightcal/fit/beam/beam_family.h"
#include "lightcal/fit/model/least_squares.h"
#include "lightcal/fit/model/reading_model.h"

namespace lightcal::fit {

// ln I(0), d0, the aim's tilts about the start's x and y (aim ~ z + a x + b y), and of the walls'
// light ln b and the slope (light/wall_prior.h); after them the shape's own.
enum BeamParameter : std::uint8_t {
  kBeamLnIntensity = 0,
  kBeamOffset = 1,
  kBeamAimX = 2,
  kBeamAimY = 3,
  kBeamLnWalls = 4,
  kBeamWallsSlope = 5,
};
inline constexpr int kBeamCommon = 6;

struct BeamRow {
  RowForm form = RowForm::kLog;
  double measured = 0.0;
  double sigma = 1.0;          // relative in logarithms, else lux
  double own_sigma = 1.0;      // of it, what is not scatter of the walls' light
  bool lit = true;             // false: behind a card, the walls alone
  Vec3 from_lamp{};            // metres, in the start's frame
  std::optional<Vec3> normal;  // of the meter; without one it faces the lamp
  double gain = 1.0;           // cosine of a stated tilt
  double angle_sd = 0.0;       // radians: how far the meter may stand from where it says
  std::optional<WallsOfRow> walls;
};

// What a data sheet prints: `level` of the peak at this angle from the axis.
struct SheetRow {
  double gamma = 0.0, level = 0.5, sd = 0.1;
};

template <class T>
struct BeamTowards {
  T gamma, per_candela;
};

// The angle from the axis and E/I(gamma) of a row.
template <class T>
[[nodiscard]] BeamTowards<T> TowardsOf(const BeamRow& row, const T* p) {
  using std::atan2;
  using std::sqrt;
  const T length = sqrt(1.0 + p[kBeamAimX] * p[kBeamAimX] + p[kBeamAimY] * p[kBeamAimY]);
  const Vec3Of<T> aim = {p[kBeamAimX] / length, p[kBeamAimY] / length, 1.0 / length};
  const Vec3Of<T> v = Vec3Of<T>(row.from_lamp + aim * p[kBeamOffset]);
  const T r2 = Dot(v, v);
  const Vec3Of<T> across = Cross(v, aim);
  // Just above 0, where the root has no derivative.
  const T sine = sqrt(Dot(across, across) + 1e-12 * r2);
  T facing = T(row.gain);
  if (row.normal) {
    facing = facing * (-Dot(v, *row.normal)) / sqrt(r2);
    if (!(facing > T(0.0))) facing = T(0.0);
  }
  return {atan2(sine, Dot(v, aim)), facing / r2};
}

// The same meter, turned about the lamp by so much more off the start's axis.
[[nodiscard]] inline BeamRow TurnedAway(BeamRow row, double radians) {
  const Vec3& v = row.from_lamp;
  const double off = std::hypot(v[0], v[1]);
  const Vec3 out = off > 0.0 ? Vec3{v[0] / off, v[1] / off, 0.0} : Vec3{1.0, 0.0, 0.0};
  const double c = std::cos(radians);
  const double s = std::sin(radians);
  const double away = c * off + s * v[2];
  row.from_lamp = {out[0] * away, out[1] * away, c * v[2] - s * off};
  return row;
}

// kOfShape: as many parameters as the shape's family has (BeamShape::kFew or kNodes).
template <int kOfShape>
struct BeamProblem {
  static constexpr int kCount = kBeamCommon + kOfShape;
  BeamShape shape;
  std::array<ParameterRule, kCount> rules;
  std::vector<BeamRow> rows;
  std::span<const SheetRow> sheet;
  double least_offset = 0.0;                  // metres
  static constexpr double kLeastSeen = 1e-4;  // of what was read

  [[nodiscard]] std::size_t RowCount() const {
    return rows.size() + sheet.size() + shape.PriorRows();
  }
  [[nodiscard]] Bounds BoundsOf(int k) const {
    return k == kBeamOffset ? Bounds{least_offset} : Bounds{};
  }
  template <class T>
  [[nodiscard]] T Direct(const BeamRow& row, const T* p) const {
    using std::exp;
    const BeamTowards<T> towards = TowardsOf(row, p);
    return exp(p[kBeamLnIntensity]) * towards.per_candela *
           shape.Intensity(OffAxisBy(towards.gamma), p[kBeamOffset], p + kBeamCommon);
  }
  template <class T>
  [[nodiscard]] static T Walls(const BeamRow& row, const T* p) {
    using std::exp;
    if (!row.walls) return T(0.0);
    return exp(p[kBeamLnIntensity] + p[kBeamLnWalls] + p[kBeamWallsSlope] * row.walls->x +
               row.walls->constant);
  }
  template <class T>
  [[nodiscard]] T Illuminance(const BeamRow& row, const T* p) const {
    return row.lit ? T(Direct(row, p) + Walls(row, p)) : Walls(row, p);
  }
  // Not inlined: its derivatives by 26 parameters are long.
  template <class T>
  [[nodiscard, gnu::noinline]] bool Residual(std::size_t i, const T* p, T* residual) const {
    if (i < rows.size()) {
      const BeamRow& row = rows[i];
      const T seen = Illuminance(row, p);
      // No logarithm of darkness.
      const T lit = row.form == RowForm::kLinear ? seen : T(seen + kLeastSeen * row.measured);
      return WhitenedResidual(row.form, row.measured, row.sigma, lit, residual);
    }
    i -= rows.size();
    if (i < sheet.size()) {
      const T a = shape.read_from.AngleFromStart(OffAxisBy(T(sheet[i].gamma)), p[kBeamOffset]);
      *residual = (shape.Relative(a, p + kBeamCommon) - sheet[i].level) / sheet[i].sd;
      return true;
    }
    *residual = shape.PriorRow(i - sheet.size(), p + kBeamCommon);
    return true;
  }
  // The same and its derivatives. Of a curve's nodes a reading knows four, a row of its smoothness
  // three.
  bool Differentiate(std::size_t i, const double* p, double* residual, double* gradient) const {
    const std::size_t measured = rows.size() + sheet.size();
    if (i >= measured) {
      const std::size_t last = i - measured;
      const std::size_t first = last < 2 ? 0 : last - 2;
      const auto nodes = [&](const auto* at, auto* out) {
        *out = shape.PriorRow(last, at + kBeamCommon);
        return true;
      };
      return DifferentiateBy<3>(nodes, p, 0, first, residual, gradient);
    }
    const auto row = [&](const auto* at, auto* out) { return Residual(i, at, out); };
    if constexpr (kOfShape <= BeamShape::kFew) {
      return DifferentiateByJets<BeamProblem>(row, p, residual, gradient);
    } else {
      return DifferentiateBy<kBeamCommon + BeamShape::kNodesOfAngle>(
          row, p, kBeamCommon, FirstNodeOf(i, p), residual, gradient);
    }
  }

 private:
  // By the first `common` parameters and as many nodes from `first` on as kSome leaves.
  template <int kSome, class Row>
  static bool DifferentiateBy(const Row& row, const double* p, int common, std::size_t first,
                              double* residual, double* gradient) {
    using Jet = ceres::Jet<double, kSome>;
    std::array<int, kSome> known{};
    for (int k = 0; k < kSome; ++k) {
      known[k] = k < common ? k : kBeamCommon + static_cast<int>(first) + k - common;
    }
    std::array<Jet, kCount> at;
    for (int k = 0; k < kCount; ++k) at[k].a = p[k];
    for (int k = 0; k < kSome; ++k) at[known[k]].v[k] = 1.0;
    Jet out(0.0);
    const bool has_value = row(at.data(), &out);
    *residual = out.a;
    std::fill_n(gradient, kCount, 0.0);
    for (int k = 0; k < kSome; ++k) gradient[known[k]] = out.v[k];
    return has_value;
  }
  // Of a reading, or of a data sheet's row.
  [[nodiscard]] std::size_t FirstNodeOf(std::size_t i, const double* p) const {
    const double gamma =
        i < rows.size() ? TowardsOf(rows[i], p).gamma : sheet[i - rows.size()].gamma;
    return shape.FirstNode(shape.read_from.AngleFromStart(OffAxisBy(gamma), p[kBeamOffset]));
  }
};

// Its steps by Gauss and Newton end, and those of 26 parameters are dear (polish.h).
template <int kOfShape>
inline constexpr bool kEndsByNewton<BeamProblem<kOfShape>> = false;

}  // namespace lightcal::fit
