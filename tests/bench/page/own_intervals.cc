// SPDX-License-Identifier: Apache-2.0
// The standard uncertainty of ln I. Table: six distances and readings, sigma, the prior's standard
// deviation of the offset, u(ln I). No ambient light.
#include <cmath>
#include <limits>
#include <vector>

#include "lightcal/fit/model/monte_carlo.h"
#include "lightcal/fit/model/starts.h"
#include "own.h"

namespace page {
namespace {

namespace fit = lightcal::fit;
constexpr int kReadingsEach = 6;
constexpr double kNone = std::numeric_limits<double>::infinity();

fit::Estimation EstimationOf(const Numbers& numbers) {
  fit::Estimation estimation;
  for (int i = 0; i < kReadingsEach; ++i) {
    fit::ReadingRow row;
    row.distance = numbers[2 * i];
    row.measured = numbers[2 * i + 1];
    row.sigma = numbers[12];
    estimation.rows.push_back(row);
  }
  estimation.rules[fit::kLnIntensity].free = true;
  estimation.rules[fit::kDistanceOffset] = {true, 0.0, numbers[13]};
  estimation.least_distance_offset = -0.9 * numbers[0];
  return estimation;
}

std::vector<fit::Estimation> EstimationsOf(const std::vector<Numbers>& table) {
  std::vector<fit::Estimation> all;
  for (const Numbers& row : table) all.push_back(EstimationOf(row));
  return all;
}

fit::UncertaintyInput Solved(const fit::Estimation& estimation) {
  fit::UncertaintyInput input;
  input.estimation = &estimation;
  const auto theta = fit::Solve(estimation, fit::ScanStart(estimation));
  input.theta = theta ? *theta : fit::Theta{};
  return input;
}

void PrintDraws(const Rows& rows, const std::vector<fit::Estimation>& all, int draws) {
  rows.PrintEach("lightcal draws", std::to_string(draws) + " draws", [&](std::size_t i) {
    const auto sampled = fit::SampleEstimate(Solved(all[i]), fit::JustSamples(draws));
    return sampled ? sampled->parameters[fit::kLnIntensity].sd : kNone;
  });
}

}  // namespace

void OwnIntervals(const std::vector<Numbers>& table) {
  const std::vector<fit::Estimation> all = EstimationsOf(table);
  const Rows rows(table, ErrorScale::kRelative);
  rows.PrintEach("lightcal covariance", "linear", [&](std::size_t i) {
    const auto covariance = fit::EstimateCovariance(Solved(all[i]));
    return covariance ? std::sqrt((*covariance)[0]) : kNone;
  });
  for (const int draws : {10'000, 100'000}) PrintDraws(rows, all, draws);
}

void OwnMillionDraws(const std::vector<Numbers>& table) {
  PrintDraws(Rows(table, ErrorScale::kRelative), EstimationsOf(table), 1'000'000);
}

}  // namespace page
