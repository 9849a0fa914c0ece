// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/locus_table.h"

#include "lightcal/colorimetry/planckian.h"
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

LocusTable::LocusTable() {
  const double h = kStepMireds;
  LocusPoint from = PlanckianLocusAt(Mireds(0.0));
  for (int i = 0; i <= kSegments; ++i) {
    nodes[i] = {from.uv.u, from.uv.v, from.du, from.dv};
    if (i == kSegments) break;
    const LocusPoint to = PlanckianLocusAt(Mireds((i + 1) * h));
    segments[i] = {
        Hermite(from.uv.u, h * from.du, h * h * from.d2u, to.uv.u, h * to.du, h * h * to.d2u),
        Hermite(from.uv.v, h * from.dv, h * h * from.d2v, to.uv.v, h * to.dv, h * h * to.d2v)};
    from = to;
  }
}

const LocusTable& Locus() {
  static const LocusTable table;
  return table;
}

}  // namespace lightcal::locus
