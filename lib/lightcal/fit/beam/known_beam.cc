// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/beam/known_beam.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units.h"

namespace lightcal::fit {
namespace {

constexpr double kNearAxis = 1.0;  // half angles
constexpr double kOpenBeam = 2.5;  // ends of its interval
constexpr double kNoEdge = 0.9;    // of the axis, at the widest angle read: no edge was seen

// An angle as a person sets it.
double SetAngle(double degrees) {
  const double step = degrees < 10.0 ? 1.0 : 5.0;
  return std::max(step, std::round(degrees / step) * step);
}

// Where the draws differ most, in parts of the axis: its strength is not the question.
double MissingAngle(const BeamProfile& profile) {
  const auto most = std::ranges::max_element(profile.part_sd);
  const auto at = static_cast<std::size_t>(most - profile.part_sd.begin());
  return SetAngle(std::min(80.0, profile.gamma_deg[at]));
}

// What a person can do about angles that are a good part of the beam.
std::string CureOfAngles(const BeamRows& rows, double half_deg) {
  constexpr double kGoodPart = 0.08;
  double most = 0.0;
  for (const BeamRow& row : rows.readings.rows)
    most = std::max(most, row.angle_sd / kRadiansPerDegree);
  if (rows.placed || most < kGoodPart * half_deg) return {};
  return "; its angles are good to " + RoundedText(most, 2) +
         " degrees: read along a straight line across the beam and give places, or set the angles "
         "more exactly and say so by {light.off_axis_sigma}";
}

// Of the axis's intensity, at the widest angle that was read.
struct SeenOut {
  double gamma_deg = 0.0, part = 1.0;
};

SeenOut FarthestSeen(const BeamRows& rows, const BeamProfile& profile) {
  SeenOut out;
  for (std::size_t i = 0; i < rows.readings.rows.size(); ++i) {
    if (!rows.readings.rows[i].lit) continue;
    out.gamma_deg = std::max(out.gamma_deg, profile.gamma_rad[i] / kRadiansPerDegree);
  }
  const auto above = std::ranges::lower_bound(profile.gamma_deg, out.gamma_deg);
  const auto at = std::min<std::size_t>(static_cast<std::size_t>(above - profile.gamma_deg.begin()),
                                        profile.candela.size() - 1);
  out.part = profile.candela[at] / profile.candela.front();
  return out;
}

}  // namespace

tl::unexpected<Error> NothingNearAxis(double nearest_rad, std::optional<double> wide_deg,
                                      const std::string& light) {
  return Refused("beam_unknown", light,
                 "nothing was read nearer than " + RoundedText(nearest_rad / kRadiansPerDegree, 2) +
                     " degrees to the axis" +
                     (wide_deg ? " of a beam " + RoundedText(*wide_deg, 2) + " degrees wide" : "") +
                     ": read at 0 degrees too, straight before the lamp");
}

Result<void> CheckKnownBeam(const BeamRows& rows, const BeamProfile& profile,
                            const std::string& light) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < rows.readings.rows.size(); ++i) {
    if (rows.readings.rows[i].lit)
      nearest = std::min(nearest, profile.gamma_rad[i] / kRadiansPerDegree);
  }
  const double half = 0.5 * profile.beam_deg.value;
  if (nearest > std::max(2.0, kNearAxis * half)) {
    return NothingNearAxis(nearest * kRadiansPerDegree, 2.0 * half, light);
  }
  const Uncertain& beam = profile.beam_deg;
  const SeenOut seen = FarthestSeen(rows, profile);
  if (profile.family != "even" && rows.readings.sheet.empty() && seen.part > kNoEdge) {
    return Refused("beam_unknown", light,
                   "at " + RoundedText(seen.gamma_deg, 2) +
                       " degrees off the axis, the farthest that was read, it shines as in the "
                       "middle (" +
                       PercentText(seen.part) +
                       "): where its beam ends no reading tells; read farther out, until half is "
                       "left, or give the data sheet's {light.beam}");
  }
  if (profile.family == "even" || *beam.high <= kOpenBeam * *beam.low) return {};
  return Refused("beam_unknown", light,
                 "the readings leave the beam angle open from " + RoundedText(*beam.low, 2) +
                     " to " + RoundedText(*beam.high, 2) + " degrees: read at " +
                     RoundedText(MissingAngle(profile), 3) +
                     " degrees off the axis too, or give the data sheet's {light.beam}" +
                     CureOfAngles(rows, half));
}

}  // namespace lightcal::fit
