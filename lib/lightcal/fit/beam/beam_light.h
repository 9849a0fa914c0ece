// SPDX-License-Identifier: Apache-2.0
// A lamp whose readings off its axis tell how it shines in every direction.
#pragma once

#include <optional>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/fit/estimate_light.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/light/intensity_table.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"

namespace lightcal::fit {

// Whether readings stand off the axis of a lamp whose shape nobody stated: a point or a spot
// without outer_deg, by off_axis_deg, or by the places of readings and lamp (of a lamp whose
// aim is not known, from kFewestForBeam of them on; of a point that need not have a beam, where
// they span more than five degrees).
[[nodiscard]] bool NeedsProfile(const Observations& observations, const LightDescription& light);

struct BeamLight {
  IntensityTable table;    // axial, type C about the aim; ends where it is dark or at 90 degrees
  LightEstimate estimate;  // its ln I is that of the table's peak
  Uncertain flux_lm{};
  MeasuredBeam beam;
  std::optional<Vec3> aim;  // unit; where the lamp's place is known
  Radians aim_sd{0.0};
  bool even = false;           // it shines alike in all directions
  bool surely_a_beam = false;  // no blunder in a bulb's readings would look like it
  bool flat_cone = false;      // the readings are not against the spot of spot_beam.h
  // 1 sigma of the intensity at an angle over the axis's.
  std::vector<double> gamma_deg{}, part_sd{};
  std::vector<double> pattern_sd{};  // as MeasuredDistribution has it
};

// m = I(gamma) cr/r^2 + walls + E0, I(gamma) by families compared by evidence (beam_profile.h), r
// from the place moved d0 behind the aim. The aim as stated is right within kAimSigmaDegrees where
// places tell, and angles of both signs within a degree; angles of one sign count from the beam's
// own axis. The walls' light does not follow the beam: off its axis it is as on it, within half
// (1 sigma of its logarithm). The data sheet's beam_deg and field_deg are priors, within a tenth.
// Refused: beam_unknown (nothing read near the axis, or readings that leave the beam open by more
// than a factor of two and a half; it names the angle that is missing), beam_unlike (readings that
// lie on no curve about the axis).   Fails: no_convergence.
[[nodiscard]] Result<BeamLight> FitBeamLight(const Observations& observations,
                                             const LightDescription& light,
                                             const ForwardModel& model);

// Full angle at half of the largest that the readings show as they stand; what PlanForward takes
// for the walls' prior before the fit.
[[nodiscard]] Radians RoughBeam(const Observations& observations, const LightDescription& light);

// The interval of its peak, by `factor` and by what adds to its logarithm.
void WidenPeak(double factor, double relative_sd, LightEstimate& estimate);

// What was found beside intensity, offset and diagnostics.
void FillBeamLight(BeamLight&& found, FittedLight& out);

}  // namespace lightcal::fit
