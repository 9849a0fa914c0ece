// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/table_cone.h"

#include <algorithm>
#include <cmath>

#include "lightcal/presets/engine_cone.h"

namespace lightcal {
namespace {

// A point of the axial intensity against the beam.
TableSubstitute PointInstead(const BeamProfile& beam) {
  TableSubstitute out;
  double ours = 0.0, theirs = 0.0;
  for (std::size_t i = 1; i < beam.angle_rad.size(); ++i) {
    const double low = beam.angle_rad[i - 1], high = beam.angle_rad[i];
    const double ring = std::cos(low) - std::cos(high);
    ours += ring;
    theirs += ring * 0.5 * (beam.mean[i - 1] + beam.mean[i]);
    out.worst = std::max({out.worst, std::abs(1.0 - beam.least[i]), std::abs(1.0 - beam.most[i])});
  }
  out.flux = ours / theirs;
  return out;
}

double Strays(double worst, double flux) { return worst + std::abs(flux - 1.0); }

}  // namespace

std::optional<TableSubstitute> SubstituteForTable(const IntensityTable& table) {
  const auto beam = ProfileOf(table);
  if (!beam) return std::nullopt;
  const TableSubstitute point = PointInstead(*beam);
  const EngineCone cone = RefitCone(EngineConeLaw::kSquared, *beam);
  if (Strays(point.worst, point.flux) <= Strays(cone.worst, cone.flux)) return point;
  return TableSubstitute{cone.cone, cone.worst, cone.flux};
}

}  // namespace lightcal
