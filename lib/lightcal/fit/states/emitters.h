// SPDX-License-Identifier: Apache-2.0
// The emitters of a fixture, from the spectra that were read at its states: every spectrum it gives
// is a mixture of theirs by amounts that are not negative.
#pragma once

#include <vector>

#include "lightcal/records/fitted_light.h"

namespace lightcal::fit {

// S_i = sum over k of a_ik e_k,  a, e >= 0: of the numbers of emitters the smallest whose mixtures
// give every reading within what a spectrometer repeats, 0.5 % of the reading's rms, or within 1.5
// times that reading's own noise (found in what is left: noise differs from sample to sample, an
// emitter that was missed does not), at most 3 %. Readings that are least mixed stand for emitters
// at first and grow, alternately with the amounts, only as far as the readings ask for: what no
// reading shows alone is found as near to the readings as they allow, which is not always all of
// it.
//   Sources: Kumar, Sindhwani, Kambadur, "Fast conical hull algorithms for near-separable
//   non-negative matrix factorization", ICML 2013 (where to begin); Cichocki and Phan, "Fast local
//   algorithms for large scale nonnegative matrix and tensor factorizations", IEICE Trans. E92-A
//   (2009) (hierarchical alternating least squares).
struct EmitterMixtures {
  std::vector<std::vector<double>> emitters;  // peak 1; empty: the readings do not tell them
  std::vector<std::vector<double>> amounts;   // a row a reading
  double residual = 0.0;                      // rms of what is left, each over its reading's rms
};
// Rows of samples on one grid of equal steps, none negative, each with some light. Told only where
// there are more readings than emitters: as many readings as emitters mix to anything.
[[nodiscard]] EmitterMixtures EmitterMixturesOf(const std::vector<std::vector<double>>& readings);

// Those of the states of `light` that have spectra: sets `emitters` and each such state's
// `emitter_amounts`. Without them: fewer than two such states, or no fewer emitters than states.
void FindEmitters(FittedLight& light);

// min over x >= 0 of |A x - b|, by A'A (row after row) and A'b.   Source: Lawson and Hanson,
// Solving Least Squares Problems (1974), 23.3; on the normal equations.
[[nodiscard]] std::vector<double> NonNegativeLeastSquares(const std::vector<double>& gram,
                                                          const std::vector<double>& product);

}  // namespace lightcal::fit
