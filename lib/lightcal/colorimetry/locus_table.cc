// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/locus_table.h"

#include "lightcal/core/units.h"

namespace lightcal::locus {
namespace {

// The quintic with given value, slope and curvature at t = 0 (p, a, e) and t = 1 (q, b, f).
Quintic Hermite(double p, double a, double e, double q, double b, double f) {
  const double rise = q - p - a - e / 2;
  const double slope = b - a - e;
  const double bend = f - e;
  return {{p, a, e / 2, 10 * rise - 4 * slope + bend / 2, -15 * rise + 7 * slope - bend,
           6 * rise - 3 * slope + bend / 2}};
}

}  // namespace

void LocusTable::LearnNode(std::size_t i) const {
  const std::lock_guard lock(learning_);
  if (node_known_[i].load(std::memory_order_relaxed)) return;
  exact_[i] = PlanckianLocusAt(Mireds(static_cast<double>(i) * kStepMireds));
  nodes_[i] = {exact_[i].uv.u, exact_[i].uv.v, exact_[i].du, exact_[i].dv};
  node_known_[i].store(true, std::memory_order_release);
}

void LocusTable::LearnSegment(std::size_t i) const {
  static_cast<void>(NodeAt(static_cast<int>(i)));
  static_cast<void>(NodeAt(static_cast<int>(i) + 1));
  const std::lock_guard lock(learning_);
  if (segment_known_[i].load(std::memory_order_relaxed)) return;
  const double h = kStepMireds;
  const LocusPoint& from = exact_[i];
  const LocusPoint& to = exact_[i + 1];
  segments_[i] = {
      Hermite(from.uv.u, h * from.du, h * h * from.d2u, to.uv.u, h * to.du, h * h * to.d2u),
      Hermite(from.uv.v, h * from.dv, h * h * from.d2v, to.uv.v, h * to.dv, h * h * to.d2v)};
  segment_known_[i].store(true, std::memory_order_release);
}

const LocusTable& Locus() {
  static const LocusTable table;
  return table;
}

}  // namespace lightcal::locus
