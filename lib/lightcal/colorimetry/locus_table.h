// SPDX-License-Identifier: Apache-2.0
// The exact locus costs 471 exponentials a point. Here it is a piecewise quintic Hermite polynomial
// in mireds through exact points with exact first and second derivatives. Shared by the searches of
// one colour (cct.cc) and of many (cct_batch.cc).
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <mutex>

#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal/colorimetry/planckian.h"

namespace lightcal::locus {

inline constexpr double kDuvLimit = 0.05 + 1e-9;
inline constexpr double kColdestKelvin = 1000.0 - 1e-6;
// Hotter than 1e12 K: no computed xy can tell from infinity.
inline constexpr double kInfinityMireds = 1e-6;
inline constexpr double kStepMireds = 5.0;
inline constexpr int kSegments = 500;  // 0 to 2500 mired, infinity to 400 K

struct Curve {  // position and derivatives by the segment's parameter t in [0, 1]
  double u, v, du, dv, d2u, d2v;
};

struct Quintic {
  std::array<double, 6> c;

  // In pairs: half the depth of Horner's chain.
  [[nodiscard]] double Value(double t) const {
    const double t2 = t * t;
    return (c[0] + c[1] * t) + t2 * ((c[2] + c[3] * t) + t2 * (c[4] + c[5] * t));
  }
  [[nodiscard]] double First(double t) const {
    const double t2 = t * t;
    return (c[1] + 2 * c[2] * t) + t2 * ((3 * c[3] + 4 * c[4] * t) + t2 * (5 * c[5]));
  }
  [[nodiscard]] double Second(double t) const {
    return (2 * c[2] + 6 * c[3] * t) + t * t * (12 * c[4] + 20 * c[5] * t);
  }
};

struct Segment {
  Quintic u, v;

  [[nodiscard]] Curve At(double t) const {
    return {u.Value(t), v.Value(t), u.First(t), v.First(t), u.Second(t), v.Second(t)};
  }
};

struct Node {
  double u, v, du, dv;
  // Positive while the nearest point lies at more mireds.
  [[nodiscard]] double Ahead(Uv1960 p) const { return (p.u - u) * du + (p.v - v) * dv; }
};

// Each part is computed when it is first asked for (10 us; all of them 5 ms, of which one colour
// asks for a thirtieth), then shared. Used by several threads at once.
class LocusTable {
 public:
  // At kStepMireds times `i`, 0 to kSegments.
  [[nodiscard]] const Node& NodeAt(int i) const {
    const auto at = static_cast<std::size_t>(i);
    if (!node_known_[at].load(std::memory_order_acquire)) LearnNode(at);
    return nodes_[at];
  }
  // From node i to node i + 1.
  [[nodiscard]] const Segment& SegmentAt(int i) const {
    const auto at = static_cast<std::size_t>(i);
    if (!segment_known_[at].load(std::memory_order_acquire)) LearnSegment(at);
    return segments_[at];
  }

 private:
  void LearnNode(std::size_t i) const;
  void LearnSegment(std::size_t i) const;

  mutable std::mutex learning_;  // held by who writes below
  mutable std::array<std::atomic<bool>, kSegments + 1> node_known_{};
  mutable std::array<std::atomic<bool>, kSegments> segment_known_{};
  mutable std::array<LocusPoint, kSegments + 1> exact_{};
  mutable std::array<Node, kSegments + 1> nodes_{};
  mutable std::array<Segment, kSegments> segments_{};
};

[[nodiscard]] const LocusTable& Locus();

}  // namespace lightcal::locus
