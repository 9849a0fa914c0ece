// SPDX-License-Identifier: Apache-2.0
// The fit's optimum. Table: six distances and readings, sigma, the priors' standard deviations of
// the offset and of the ambient light, ln I of the start, ln I of the optimum.
#include <limits>
#include <vector>

#include "lightcal/fit/model/solve.h"
#include "lightcal/fit/model/starts.h"
#include "own.h"
#include "solver_problem.h"

namespace page {
namespace {

using lightcal::SolverChoice;
namespace fit = lightcal::fit;

fit::Estimation EstimationOf(const SolverProblem& problem) {
  fit::Estimation estimation;
  for (int i = 0; i < kReadings; ++i) {
    fit::ReadingRow row;
    row.distance = problem.distance[i];
    row.measured = problem.measured[i];
    row.sigma = problem.sigma;
    estimation.rows.push_back(row);
  }
  estimation.rules[fit::kLnIntensity].free = true;
  estimation.rules[fit::kDistanceOffset] = {true, 0.0, problem.offset_sd};
  estimation.rules[fit::kAmbient] = {true, 0.0, problem.ambient_sd};
  estimation.least_distance_offset = -0.3;
  return estimation;
}

}  // namespace

void OwnSolver(const std::vector<Numbers>& table) {
  constexpr double kNoAnswer = std::numeric_limits<double>::infinity();
  std::vector<fit::Estimation> all;
  std::vector<fit::Theta> starts;
  for (const Numbers& row : table) {
    const SolverProblem problem = SolverProblemOf(row);
    all.push_back(EstimationOf(problem));
    starts.push_back({problem.start_ln_intensity, 0.0, 0.0});
  }
  const Rows rows(table, ErrorScale::kAbsolute);
  for (const auto& [name, choice] : {std::pair{"full", SolverChoice::kFull},
                                     {"quick", SolverChoice::kQuick},
                                     {"loose", SolverChoice::kLoose}}) {
    for (fit::Estimation& one : all) one.choice.solver = choice;
    rows.PrintEach("lightcal", name, [&](std::size_t i) {
      const auto theta = fit::Solve(all[i], starts[i]);
      return theta ? (*theta)[fit::kLnIntensity] : kNoAnswer;
    });
  }
  rows.PrintEach("lightcal", "for samples", [&](std::size_t i) {
    const auto theta = fit::SolveCoarsely(all[i], starts[i], fit::kLastStep);
    return theta ? (*theta)[fit::kLnIntensity] : kNoAnswer;
  });
  rows.PrintEach("lightcal", "closed form",
                 [&](std::size_t i) { return fit::ScanStart(all[i])[fit::kLnIntensity]; });
}

}  // namespace page
