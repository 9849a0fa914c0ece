// SPDX-License-Identifier: Apache-2.0
// A lamp that may be several things, fitted as each of them.
#pragma once

#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/fit/estimate_light.h"
#include "lightcal/fit/model/hypotheses.h"
#include "lightcal/fit/model/prepare.h"
#include "lightcal/fit/model/robust.h"

namespace lightcal::fit {

// The lamp as one hypothesis has it.
struct Candidate {
  LampHypothesis hypothesis;
  Estimation estimation;
  Theta squared{};  // its squared-loss optimum
  double ln_prior = 0.0;
  double ln_probability = 0.0;  // of hypothesis and rows
  RobustEstimate estimate;
  Covariance covariance{};
};

// Every hypothesis of the model solved, the likeliest first; where readings contradict it, the
// likeliest of the robust estimates, a blunder being one reading in fifty. Readings
// that ask for an offset beyond two standard deviations of its prior widen it, with the warning
// prior_conflict, and leave the other hypotheses out. Refused: model_misfit, where they ask for one
// beyond four of them and 0.6 m between places that are both told. Fails as Solve.
[[nodiscard]] Result<std::vector<Candidate>> SolveCandidates(const Prepared& prepared,
                                                             const ForwardModel& model,
                                                             const Observations& observations,
                                                             const std::string& light,
                                                             Warnings& warnings);

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
// it: dimmed, aged, or another lamp. The likeliest first. `sheet` in the solver's units.
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
