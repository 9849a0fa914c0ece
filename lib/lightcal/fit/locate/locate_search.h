// SPDX-License-Identifier: Apache-2.0
// The search for a lamp's place: rows in units of the layout, every minimum they have. Internal to
// locate.cc and locate_refusals.cc.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "lightcal/fit/estimate_light.h"
#include "lightcal/fit/locate/next_placement.h"
#include "lightcal/fit/locate/placed_solve.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/light/wall_prior.h"

namespace lightcal::fit {

// All of it in the frame's units.
struct PlacedProblem {
  PlacedEstimation estimation;
  std::vector<int> observation;  // of each row
  PlacedFrame frame;
  std::optional<Vec3> near;  // where the lamp is known to be about
  double ambient_start = 0.0;
  bool ambient_told = false;
  int lit = 0;
  int card_rows = 0;  // at the end of the rows: what cards left of readings that stand before them
};

struct PlacedSolution {
  PlacedTheta theta{};
  double chi_squared = std::numeric_limits<double>::infinity();
};

[[nodiscard]] inline Vec3 LampOf(const PlacedTheta& theta) {
  return {theta[kPlacedX], theta[kPlacedY], theta[kPlacedZ]};
}
// Whether a reading stands by its own place, not by a distance.
[[nodiscard]] inline bool IsPlaced(const Observation& o) {
  return o.lit && o.measured_from_center && o.position_m;
}

// The rows as one prior of the walls' light has them: its rules, bend and scatter.
void SetWalls(const WallPrior& prior, PlacedEstimation& estimation);

// E0 is free where lamp-off readings tell it, or, where no wall shines, beside six readings under
// the prior that it cannot exceed the dimmest; d0 where readings give distances alone; the walls'
// light under one normal of all that the lamp may be, its scatter as of a reading half of which is
// theirs. `near_m`: where the lamp is known to be
// about; the mean direction to its readings counts from there, 0 without it.
[[nodiscard]] PlacedProblem PlacedProblemOf(const Observations& observations,
                                            const LightDescription& light,
                                            const ForwardModel& model,
                                            const Vec3* near_m = nullptr);

// How the lamp shines more to one side than to another (sd along x, y, z), about the mean direction
// to its readings; where problem.near is not told, from 0.
void AddGradient(const Vec3& sd, PlacedProblem& problem);

// The minima that these starts lead to, best first.
[[nodiscard]] std::vector<PlacedSolution> SolveFrom(const PlacedEstimation& estimation,
                                                    const std::vector<PlacedTheta>& starts);

// Every minimum that the starts lead to, best first: found with the ambient light held, then with
// it free from each place that may still win (beside it, hopeless starts creep for a long time).
[[nodiscard]] std::vector<PlacedSolution> SearchPlace(const PlacedProblem& problem);

// Lamps at the distances usual in rooms that the readings bear as well as the best of 19 in 20
// cases: what a layout leaves open. `least`: the best's chi-squared.
[[nodiscard]] std::vector<PlacedSolution> OpenPlaces(const PlacedProblem& problem, double least);

// Whether two solutions are one.
[[nodiscard]] bool AtOnePlace(const PlacedTheta& a, const PlacedTheta& b);

}  // namespace lightcal::fit
