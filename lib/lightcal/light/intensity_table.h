// SPDX-License-Identifier: Apache-2.0
// A measured distribution: luminous intensity by direction, as photometric files hold it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/core/units.h"
#include "lightcal/core/vec3.h"
#include "lightcal/light/intensity_grid.h"

namespace lightcal {

// Between the nodes: along a plane linear, or the cubic through them with three-point slopes, never
// below zero; from plane to plane linear. Outside the range of the nodes, nothing. On smooth lobes
// 5 degrees cubic errs by 0.12 % of the peak (p95), 5 degrees linear by 3.3 %.
enum class TableInterpolation : std::uint8_t { kLinear, kCubic };

class IntensityTable {
 public:
  // Refused: bad_table (counts that do not match, angles that do not increase or leave their range,
  // intensities below 0 or not finite, none above 0, a turn of C planes that does not close).
  [[nodiscard]] static Result<IntensityTable> Make(IntensityGrid grid, std::string_view where);

  [[nodiscard]] const IntensityGrid& grid() const { return grid_; }
  [[nodiscard]] TableSymmetry symmetry() const { return symmetry_; }

  // Intensity towards a direction of the lamp's frame, any length above 0.
  [[nodiscard]] Candela Towards(const Vec3& direction,
                                TableInterpolation way = TableInterpolation::kLinear) const;
  [[nodiscard]] Candela At(Radians c, Radians gamma,
                           TableInterpolation way = TableInterpolation::kLinear) const;

  // How far the linear interpolant may lie from a smooth lobe through the same nodes, towards a
  // direction: along a plane, and likewise from plane to plane,
  //   4 t (1 - t) max|f''| h^2/8   of the four nodes around, step h, t its part; 0 at a node.
  // Every second node of four luminaires' files (sample_data/photometric): 95 to 99.8 % of the
  // nodes between lie within 2.2 times it; what linear and cubic differ by, 2.2 times, holds 75 %
  // of those whose nodes are then 10 degrees apart.
  [[nodiscard]] Candela InterpolationErrorTowards(const Vec3& direction) const;
  [[nodiscard]] Candela InterpolationErrorAt(Radians c, Radians gamma) const;
  // The largest step between two nodes of a plane.
  [[nodiscard]] Radians LargestStep() const;

  // The integral of the interpolant over the sphere, to rounding:
  //   Phi = sum of planes w_j int I_j(theta) sin(theta) dtheta,
  // theta from the pole of the type's planes, w_j half the angle to both neighbouring planes.
  [[nodiscard]] Lumens Flux(TableInterpolation way = TableInterpolation::kLinear) const;

  struct Peak {
    Candela intensity;  // the largest node
    Radians c, gamma;   // where; the first of several
  };
  // cd, of its nodes.
  [[nodiscard]] double least_cd() const { return *std::ranges::min_element(values_); }
  [[nodiscard]] const Peak& peak() const { return peak_; }

  // The same distribution `factor` > 0 times as bright.
  [[nodiscard]] IntensityTable Scaled(double factor) const;

 private:
  IntensityTable() = default;
  void Lay();
  void FindSlopes();
  void FindPeak();
  [[nodiscard]] std::optional<double> Opposite(double azimuth, std::size_t theta) const;
  [[nodiscard]] double AlongPlane(std::size_t plane, std::size_t index, double part,
                                  TableInterpolation way) const;
  [[nodiscard]] double Folded(double azimuth) const;
  [[nodiscard]] double AtPole(double azimuth, double theta, TableInterpolation way) const;
  // |d2 I/d theta2| at a node by its neighbours along the plane; 0 at the plane's ends.
  [[nodiscard]] double BendAt(std::size_t plane, std::size_t theta) const;
  [[nodiscard]] double ErrorAtPole(double azimuth, double theta) const;
  [[nodiscard]] double Node(std::size_t plane, std::size_t theta) const {
    return values_[plane * theta_.size() + theta];
  }

  // The planes pass through a pole (type C -Z, B -Y, A +X); theta counts from it.
  IntensityGrid grid_;
  TableSymmetry symmetry_ = TableSymmetry::kNone;
  std::vector<double> azimuth_;  // rad, ascending, a full turn closed
  std::vector<double> theta_;    // rad, ascending
  std::vector<double> values_;   // cd, by azimuth, then theta
  std::vector<double> slopes_;   // cd/rad along theta
  Peak peak_;
};

// Full angle of the main lobe at `level` (0.5 beam, 0.1 field) of the peak, in the plane of C and
// C + 180 degrees: from nadir, or from zenith where the peak lies nearer to it, both ways out to
// where the intensity last falls below the level after that half-plane's own maximum. A side that
// never reaches the level counts 0, one that never falls below it 180 degrees.
[[nodiscard]] Radians LobeWidth(const IntensityTable& table, Radians c, double level,
                                TableInterpolation way = TableInterpolation::kLinear);

// Widths of the lobe in two sections square to each other, and their mean. Of a lamp that shines
// along its axis, or to both sides of it (a batwing): about the axis, as LobeWidth, in the planes
// of `turn` and turn + 90 degrees, which are the widest and narrowest ones of an oblong lobe that
// lies across its file's planes, C0-C180 and C90-C270 of any other. Of one that shines beside its
// axis alone (less than half the peak on the axis and opposite to the peak): about the middle of
// its peak, away from the axis and across. Source: CIE S 017, beam angle (about the direction of
// the largest intensity).
struct LobeWidths {
  Radians mean, along, across;
  bool beside_axis = false;
  Radians turn{0.0};  // C of `along`, within -45 to 45 degrees
};
[[nodiscard]] LobeWidths LobeWidthsAt(const IntensityTable& table, double level);

// The interpolant of any type, read at C planes and gammas: full turn, 0..180 degrees. c_deg and
// gamma_deg as a type C grid has them.   Fails: as Make.
[[nodiscard]] Result<IntensityTable> SampledAsTypeC(const IntensityTable& table,
                                                    std::vector<double> c_deg,
                                                    std::vector<double> gamma_deg,
                                                    TableInterpolation way);

}  // namespace lightcal
