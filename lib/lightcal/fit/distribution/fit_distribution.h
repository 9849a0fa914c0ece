// SPDX-License-Identifier: Apache-2.0
// Intensity measured in many directions -> the lamp's distribution and how sure it is.
#pragma once

#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/core/vec3.h"
#include "lightcal/light/intensity_sample.h"
#include "lightcal/light/intensity_table.h"

namespace lightcal {

// The same samples, in the same order, as they would be if one thing that is not known exactly were
// one standard deviation off. Shifts are independent of one another; shifts of one name add up to
// one line of the budget.
struct DistributionShift {
  std::string name;  // "camera", "lamp_position"
  std::vector<IntensitySample> samples;
};

struct DistributionData {
  std::string light;
  Vec3 aim{0.0, 0.0, -1.0};              // gamma = 0; the frame is that of AxesOfAim
  std::vector<IntensitySample> samples;  // sigma_cd = 0: not used
  std::vector<DistributionShift> shifts;
  double scale_sd = 0.0;  // relative, common to all samples
};

struct FittedDistribution {
  // Type C, C every 5 degrees, gamma from 0 to the end of the covered cone: the widest whose rim
  // was seen at every azimuth. Nothing is said of directions beyond.
  IntensityTable table;
  double covered_deg = 0.0;         // half angle of that cone
  double interpolated_share = 0.0;  // of the flux, where nothing was seen inside it: the board
  Uncertain peak_cd{};              // largest node of the table
  Uncertain flux_lm{};              // within the covered cone
  int samples = 0, rejected = 0;    // rejected: six robust sigmas off, as things on a wall are
  int degrees_of_freedom = 0;       // used samples minus the surface's coefficients
  double rms_relative = 0.0;        // of the used samples about the surface, over max(I, 2 % peak)
  double spacing_deg = 0.0;         // of the knots
  // Relative standard deviations by cause: the names of shifts, "noise", "misfit", "scale".
  struct Part {
    std::string name;
    double peak = 0.0, flux = 0.0;
  };
  std::vector<Part> budget{};
  Warnings warnings{};  // interpolated_directions, wall_uneven
};

// Non-negative bicubic B-splines (fit/intensity_surface.h) over the azimuthal equidistant chart
// about the aim; knots and smoothing by generalised cross validation. Samples weigh as
// 1/(sigma^2 + (0.3 % max(I, 2 % of the peak))^2), so that dark directions count too.
// Holds for smooth beams wider than about three degrees.
// Refused: axis_not_covered (the aim does not lie within what was seen on every side),
// too_few_directions (fewer than 100 usable samples).   Failed: no_convergence.
[[nodiscard]] Result<FittedDistribution> FitDistribution(const DistributionData& data);

}  // namespace lightcal
