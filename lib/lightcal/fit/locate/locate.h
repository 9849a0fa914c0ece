// SPDX-License-Identifier: Apache-2.0
// Where a lamp stands, from lux readings at known places.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/fit/estimate_light.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"

namespace lightcal::fit {

// A reading that contradicts all others.
struct LeftOut {
  int observation = 0;
  std::string correction;  // what would agree: "x = 0.12 m rather than 1.2"; empty: nothing likely
};

struct LampLocation {
  Vec3 position_m{};
  std::array<double, 9> covariance_m2{};  // of the position, row by row
  LocatedLamp known;
  std::vector<LeftOut> left_out;
  LightEstimate estimate;  // d0 = 0: distances count from the position found
};

// Whether this light's position is to be found: it has none, and readings give theirs.
[[nodiscard]] bool NeedsLocating(const Observations& observations, const LightDescription& light);

// Fits E_i = I ((n_i.v_i/r_i)/r_i^2 + walls(r_i)) + E0 (v_i = lamp - meter, walls as in
// light/wall_prior.h) for I, the lamp's position, where the model has walls their light, and where
// lamp-off readings or, without walls, six readings tell it, E0, from a closed form where the
// layout has one and a scan of directions and distances. Readings without a normal face the lamp;
// readings that give a distance alone join with an offset of their own, N(0, (0.15 d_min)^2).
// Points and spheres shine evenly, disks and rectangles as cos from their aim, by their exact form
// where `model.shape` says that their size counts. One that
// contradicts the others is left out or named (one_mistake.h); beside `near`, those that were left
// out there. Each of model.walls is weighed by its evidence, the answer mean and covariance of
// all. `model` adds what the effect gate decided (head size, influences that widen). Refused, each
// with the reading that would help most: cocircular (meters of one normal on one circle or line),
// mirror_ambiguous (two places explain the readings), position_unknown (fewer than four readings),
// underdetermined (scaled condition beyond 1000, or a position no better known than half its
// distance). Refused also: model_misfit (one_mistake.h), position_unknown (kinds whose beam has a
// shape), aim_unknown (disk, rect), over_range, no_valid_readings, no_position (no place explains
// the normals).
[[nodiscard]] Result<LampLocation> LocateLamp(const Observations& observations,
                                              const LightDescription& light,
                                              const ForwardModel& model,
                                              const LampLocation* near = nullptr);

// The observations as seen from a lamp at this place: distances and tilts filled in.
[[nodiscard]] Observations PlaceObservations(Observations observations, const Vec3& lamp_m);

}  // namespace lightcal::fit
