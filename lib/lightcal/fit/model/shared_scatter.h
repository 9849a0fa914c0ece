// SPDX-License-Identifier: Apache-2.0
// What the light from the walls scatters beside its law: once at a place, however often the place
// is read.
#pragma once

#include <vector>

#include "lightcal/fit/model/observations.h"
#include "lightcal/fit/model/solve.h"

namespace lightcal::fit {

// Tells rows that see walls which of them stand at one place: nearer together than a quarter of the
// distance. n of them are as good as one: each takes sqrt(n) times its scatter. `observation`: of
// each row.
void ShareScatter(const std::vector<int>& observation, const Observations& observations,
                  std::vector<ReadingRow>& rows);

// Gives each row's sigma the scatter of the light from the walls, by their share at theta. The
// largest change of one, relative.
double SettleScatter(Estimation& estimation, const Theta& theta);

// ln of the rows' density, up to a constant. Those of one place have the covariance D + s s^T, D of
// what is their own and s the scatter they share: its inverse by Sherman and Morrison, its
// determinant |D| (1 + s^T D^-1 s).
[[nodiscard]] double LnDensity(const Estimation& estimation, const Theta& theta);

}  // namespace lightcal::fit
