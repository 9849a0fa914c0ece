// SPDX-License-Identifier: Apache-2.0
// Observations of one light -> (ln I, d0, E0) with covariance and diagnostics.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/fit/model/budget.h"
#include "lightcal/fit/model/monte_carlo.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/fit/model/uncertainty.h"
#include "lightcal/light/axial_shape.h"
#include "lightcal/light/fixture.h"
#include "lightcal/light/wall_prior.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal::fit {

// ln I, I in cd, by the lamp's data sheet; 1 sigma. `far_sd`: of lamps that are farther off it than
// that tells (WithSheet); 0: sd tells of all.
struct SheetIntensity {
  double ln_cd = 0.0, sd = 0.0;
  double far_sd = 0.0;
};

// What the effect gate decided for this light's forward model.
struct ForwardModel {
  bool distance_law = true;                // false: directional and dome, E = I cos(tilt) + E0
  AxialShape shape;                        // kPoint where the finite size is off
  double surface_radius_m = 0.0;           // added to distances taken from a sphere's surface
  bool tilt = true;                        // cosine of the tilt
  double head_radius_m = 0.0;              // of the meter, where its size matters
  double haze_per_m = 0.0;                 // stated extinction of the air, where it matters
  bool fit_offset = true;                  // false: d0 = 0, exactly
  bool fit_ambient = true;                 // false: E0 = 0, and lamp-off readings say nothing
  std::vector<double> bounce_per_candela;  // lx/cd beside the observations; empty = none
  std::vector<WallHypothesis> walls;       // light from the walls, to be fitted; empty = none
  bool over_ground = false;                // of the ground alone
  std::vector<LampMake> makes;             // what the lamp may be, where walls is empty
  std::vector<OffsetPart> offsets;         // of such a lamp; empty = 15 % of the shortest distance
  std::vector<Consider> considered;        // influences that widen the interval
  std::optional<SheetIntensity> sheet;     // beside a person's readings
  bool judge_misfit = true;                // false: the rows follow a shape that was found in them
  std::optional<Vec3> gradient_sd;         // of a lamp whose place is sought (uneven_light.h)
  std::vector<double> uneven;              // of one whose place is known, beside the observations
  std::string_view uneven_part = "uneven_light";  // of the interval, by that name
  EstimatorChoice choice{};
};

// 1 sigma of the distance offset's prior, as a fraction of the shortest distance, where nothing is
// known of the lamp.
inline constexpr double kOffsetPriorRelative = 0.15;

struct LnInterval {
  double low = 0.0, high = 0.0;
};

struct LightEstimate {
  Theta theta{};  // ln I, d0, E0 in cd, m, lx; ln b and the slope of the walls' light
  Covariance covariance{};
  FitDiagnostics diagnostics;
  std::vector<ResidualRow> residuals;
  std::vector<VariancePart> variance_parts;  // of ln I
  bool ambient_free = false;
  // Of several things that the lamp may be: the 95 % interval of ln I, which need not be normal.
  std::optional<LnInterval> ln_interval;
  // The same of the readings alone, where a data sheet is heard too.
  std::optional<LnInterval> ln_by_readings;
  // How likely what a data sheet prints is this lamp's; 0: none, or the readings deny it.
  double sheet_held = 0.0;
  std::vector<double> walls_per_candela;  // lx/cd beside the observations; empty = none fitted
  std::vector<LampInRoom> in_room;        // what lamp and room may be; empty = one normal, no walls
  // The readings cannot tell the intensity from 0: an upper limit replaces it.
  std::optional<double> upper_limit;
  std::optional<SampledEstimate> sampled;  // where it was asked for
  Warnings warnings;                       // row_rejected, prior_conflict, bimodal, ...
};

// Fits E = I (cos(tilt) g(r)/r^2 + walls) + E0, r = d + d0, walls as in light/wall_prior.h.
//   d0 under the prior of the lamp's fixture, at or above -0.9 d_min; a posterior beyond two prior
//   standard deviations widens the prior to the offset the readings ask for, with the warning
//   prior_conflict. E0 is 0 unless lamp-off readings tell it, or, where no wall shines, four
//   distinct distances. A lamp that may be several things is fitted as each of them; the answer is
//   the mixture by their evidence: its median, its quantiles, its covariance about them. A data
//   sheet's intensity is a prior that one lamp in twenty is not held by (WithSheet), where
//   it lies within two standard deviations of the readings' and tells a third as much.
// Refused: no_valid_readings, over_range (no reading within the meter's range), model_misfit.
[[nodiscard]] Result<LightEstimate> EstimateLight(const Observations& observations,
                                                  const ForwardModel& model,
                                                  const std::string& light,
                                                  const std::optional<SamplingRule>& sampling = {});

// Refused: underdetermined (a strength open by more than a factor of 1000 each way), out_of_range
// (a lamp that no number can hold).
[[nodiscard]] Result<void> CheckKnown(const LightEstimate& estimate, const std::string& light);

}  // namespace lightcal::fit
