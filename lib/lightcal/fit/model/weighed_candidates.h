// SPDX-License-Identifier: Apache-2.0
// What a lamp may be, each as probable as its readings leave it, and the one answer of them all.
#pragma once

#include <vector>

#include "lightcal/fit/estimate_light.h"
#include "lightcal/fit/model/candidates.h"

namespace lightcal::fit {

// The others solved with the rows that carried the first; only the first where its readings leave
// doubt of themselves.
void KeepComparable(std::vector<Candidate>& candidates);

// Probability of each; those that explain nothing go.
[[nodiscard]] std::vector<double> SharesOf(std::vector<Candidate>& candidates);

// What is in question, and how probable each of it is.
struct WeighedCandidates {
  std::vector<Candidate> candidates;
  std::vector<double> shares;
  double held = 0.0;  // of them, by the data sheet
};

// Each candidate twice, by Bayes' rule for normal variables: with ln I also N(sheet), and, for one
// lamp in twenty, as it was, its ln I anywhere from a twentieth of the sheet's intensity to 1.2 of
// it: dimmed, aged, or another lamp. A third time with far_sd where the sheet has one, the oftener
// the better the readings know. The likeliest first. `sheet` in the solver's units.
[[nodiscard]] WeighedCandidates WithSheet(const SheetIntensity& sheet,
                                          const std::vector<Candidate>& candidates,
                                          const std::vector<double>& shares);

// Each in its room, as light.json keeps it, but in the solver's units; those of less than a
// hundredth are left out. Empty where some see walls and some do not, and of one alone without.
[[nodiscard]] std::vector<LampInRoom> InRoom(const std::vector<Candidate>& candidates,
                                             const std::vector<double>& shares);

// Fills median, quantiles and covariance of the mixture, and what not knowing the lamp adds to the
// variance of ln I (unknown_lamp).
void Mix(const std::vector<Candidate>& candidates, const std::vector<double>& shares,
         LightEstimate& out);

}  // namespace lightcal::fit
