// SPDX-License-Identifier: Apache-2.0
// What the light from the walls scatters beside its law: once at a place, however often the place
// is read.
#pragma once

#include <vector>

#include "lightcal/fit/model/observations.h"
#include "lightcal/fit/model/solve.h"

namespace lightcal::fit {

// A row that sees walls.
struct ReadingOfWalls {
  bool lit = false;  // beside the lamp's own light
  WallsOfRow* walls = nullptr;
  const Observation* at = nullptr;
};

// Tells them which of them stand at one place: nearer together than a quarter of the distance. n of
// them are as good as one: each takes sqrt(n) times its scatter.
void ShareScatter(std::vector<ReadingOfWalls> readings);

// Gives each row's sigma the scatter of the light from the walls, and of the lamp's own to its
// sides, by their shares at theta. The largest change of one, relative.
double SettleScatter(Estimation& estimation, const Theta& theta);

}  // namespace lightcal::fit
