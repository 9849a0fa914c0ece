// SPDX-License-Identifier: Apache-2.0
// Observations of one light -> the rows and parameter rules the solver works on.
#pragma once

#include <vector>

#include "lightcal/fit/estimate_light.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/fit/model/solve.h"

namespace lightcal::fit {

// The solver's units: geometric means of the light's own distances and illuminances, so that a lamp
// a thousand times brighter or farther away takes the same steps.
struct Scales {
  double length_m = 1.0;
  double illuminance_lx = 1.0;
};

// What EstimateLight works on, all of it in solver units.
struct Prepared {
  Estimation estimation;
  std::vector<int> observation;  // of each row
  int own_rows = 0;              // rows that are an observation; after them what cards hid
  Scales scales;
  double shortest = 1.0;  // in solver units
  int lit_rows = 0;
  int distances = 0;
  bool ambient_told = false;  // by lamp-off readings
};

// Rows with their gains and sigmas, and which parameters are free under which prior: d0 from two
// distinct distances on, E0 where lamp-off readings tell it, or four distinct distances where no
// wall shines, the scale of the instrument that read most beside another's. What a card hid the
// lamp from measures the walls.
[[nodiscard]] Prepared Prepare(const Observations& observations, const ForwardModel& model);

}  // namespace lightcal::fit
