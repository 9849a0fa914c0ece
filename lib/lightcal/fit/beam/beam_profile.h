// SPDX-License-Identifier: Apache-2.0
// The shape of a beam from readings in and around it: families compared by evidence.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/fit/beam/beam_problem.h"
#include "lightcal/light/fixture.h"
#include "lightcal/light/wall_prior.h"

namespace lightcal::fit {

struct BeamReadings {
  std::vector<BeamRow> rows;        // in a frame whose z is the aim as stated or first guessed
  std::vector<SheetRow> sheet;      // of the data sheet's beam and field angles
  std::vector<OffsetPart> offsets;  // what the lamp's offset may be; empty = 0, exactly
  std::optional<WallPrior> walls;
  std::array<ParameterRule, 2> aim{};  // its tilts about x and y
  bool may_be_even = false;            // a lamp that need not have a beam
};

// One family, and how much the readings are for it.
struct BeamFamilyShare {
  std::string name;
  double share = 0.0;
  double leave_one_out = 0.0;  // rms of each lit row predicted by the others, over its sigma
};

// One draw of what the lamp may be.
struct BeamDraw {
  double axial_cd = 0.0, flux_lm = 0.0, beam_deg = 0.0, field_deg = 0.0;
  std::vector<double> candela;  // at the profile's angles
};

// (ln I(0), d0, ln b, slope) of a mixture, their covariance, and its share of all.
struct BeamMoments {
  double share = 1.0;
  std::array<double, 4> theta{};
  std::array<double, 16> covariance{};
};

struct BeamProfile {
  std::vector<double> gamma_deg;  // 0 to 90
  std::vector<double> candela;    // median of the draws, axial_cd at 0
  std::vector<double> candela_sd;
  std::vector<double> part_sd;     // of the intensity there over the axis's
  std::vector<double> pattern_sd;  // of that over the peak's
  Uncertain axial_cd{}, flux_lm{}, beam_deg{}, field_deg{};  // full angles; axis's half and tenth
  double axial_sd_ln = 0.0;
  std::vector<BeamFamilyShare> families;  // likeliest first
  std::string family;                     // of the largest share
  double monotone_share = 0.0;            // of the smooth curve's draws, after evidence
  std::array<double, 2> aim{}, aim_sd{};  // tilts found
  BeamMoments whole;
  std::vector<BeamMoments> by_offset;  // of each that the lamp may have, likeliest first
  std::vector<double> predicted_lx, walls_lx, gamma_rad;  // beside the rows, of the likeliest
  double chi2 = 0.0;                                      // of the rows, of the likeliest
  double degrees_of_freedom = 0.0;  // rows minus the directions that the readings told
};

// Fits every family under every offset, weighs them by their evidence (Laplace: posterior mode,
// curvature, priors; the same rows for all) and draws from the mixture. Within the smooth curves
// those draws count alone that never rise from the axis outwards, where the readings are more for
// them than their prior is (encompassing prior: the share of such draws after over that before).
// Fails: no_convergence.
[[nodiscard]] Result<BeamProfile> FitBeamProfile(const BeamReadings& readings,
                                                 const std::string& light);

}  // namespace lightcal::fit
