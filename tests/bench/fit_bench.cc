// SPDX-License-Identifier: Apache-2.0
// Time of one fit: what `lightcal fit` spends per lamp once its files are read.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

#include "lightcal/fit/estimate_light.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/fit/model/monte_carlo.h"
#include "lightcal/fit/model/solve.h"
#include "lightcal/fit/model/starts.h"

namespace {

using namespace lightcal;

// A lamp of 1000 cd, d0 3 cm, E0 0.5 lx, read with 1.4 % noise at geometric distances.
Session TwinSession(int readings) {
  Session session;
  session.lights.emplace_back();
  session.lights.back().name = "lamp";
  std::mt19937_64 random(11);
  std::normal_distribution<double> noise(0.0, 0.014);
  for (int i = 0; i < readings; ++i) {
    const double d = 0.5 * std::pow(8.0, i / (readings - 1.0));
    SessionReading row;
    row.reading.light = "lamp";
    row.reading.distance = Metres(d);
    row.reading.illuminance =
        Lux((1000.0 / ((d + 0.03) * (d + 0.03)) + 0.5) * std::exp(noise(random)));
    row.reading.sigma_relative = 0.014;
    session.readings.push_back(row);
  }
  return session;
}

// Three parameters and two priors, in the solver's units.
fit::Estimation SixReadings() {
  fit::Estimation estimation;
  std::mt19937_64 random(11);
  std::normal_distribution<double> noise(0.0, 0.014);
  for (int i = 0; i < 6; ++i) {
    fit::ReadingRow row;
    row.distance = 0.35 * std::pow(8.0, i / 5.0);
    row.measured =
        (1.0 / ((row.distance + 0.02) * (row.distance + 0.02)) + 0.05) * std::exp(noise(random));
    row.sigma = 0.014;
    estimation.rows.push_back(row);
  }
  estimation.rules[fit::kLnIntensity].free = true;
  estimation.rules[fit::kDistanceOffset] = {true, 0.0, 0.05};
  estimation.rules[fit::kAmbient] = {true, 0.0, 0.2};
  estimation.least_distance_offset = -0.3;
  return estimation;
}

// The same with light from walls: five parameters, four priors.
fit::Estimation SixReadingsInARoom() {
  fit::Estimation estimation = SixReadings();
  estimation.rules[fit::kAmbient] = {};
  estimation.rules[fit::kLnWalls] = {true, std::log(0.122), 0.42};
  estimation.rules[fit::kWallsSlope] = {true, -1.05, 0.42};
  for (fit::ReadingRow& row : estimation.rows) {
    const double x = std::log(row.distance / 3.0);
    row.walls = fit::WallsOfRow{x, -0.27 * x * x, 0.07};
    row.measured += 0.122 * std::exp(-1.05 * x - 0.27 * x * x);
    row.own_sigma = row.sigma;
  }
  return estimation;
}

void BM_SolveInFullSixReadingsInARoom(benchmark::State& state) {
  const fit::Estimation estimation = SixReadingsInARoom();
  const fit::Theta start = fit::ScanStart(estimation);
  for (auto _ : state) benchmark::DoNotOptimize(fit::SolveInFull(estimation, start));
}
BENCHMARK(BM_SolveInFullSixReadingsInARoom);

void BM_SolveQuicklySixReadingsInARoom(benchmark::State& state) {
  const fit::Estimation estimation = SixReadingsInARoom();
  const fit::Theta start = fit::ScanStart(estimation);
  for (auto _ : state) benchmark::DoNotOptimize(fit::SolveQuickly(estimation, start));
}
BENCHMARK(BM_SolveQuicklySixReadingsInARoom);

// The Ceres path alone: rows to optimum.
void BM_SolveInFullSixReadings(benchmark::State& state) {
  const fit::Estimation estimation = SixReadings();
  const fit::Theta start = fit::ScanStart(estimation);
  for (auto _ : state) benchmark::DoNotOptimize(fit::SolveInFull(estimation, start));
}
BENCHMARK(BM_SolveInFullSixReadings);

// The path every squared-loss fit tries first.
void BM_SolveQuicklySixReadings(benchmark::State& state) {
  const fit::Estimation estimation = SixReadings();
  const fit::Theta start = fit::ScanStart(estimation);
  for (auto _ : state) benchmark::DoNotOptimize(fit::SolveQuickly(estimation, start));
}
BENCHMARK(BM_SolveQuicklySixReadings);

// Ten thousand samples of it: one block of the adaptive procedure.
void BM_MonteCarloTenThousand(benchmark::State& state) {
  const fit::Estimation estimation = SixReadings();
  fit::UncertaintyInput input;
  input.estimation = &estimation;
  input.theta = *fit::Solve(estimation, fit::ScanStart(estimation));
  for (auto _ : state) {
    benchmark::DoNotOptimize(fit::SampleEstimate(input, {.digits = 2, .largest_blocks = 1}));
  }
}
BENCHMARK(BM_MonteCarloTenThousand)->Unit(benchmark::kMillisecond);

// Gate, checks, start, solve, covariance, diagnostics: the whole answer.
void BM_FitSession(benchmark::State& state) {
  const Session session = TwinSession(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(FitSession(session, FitSettings{}));
}
BENCHMARK(BM_FitSession)->Arg(2)->Arg(3)->Arg(6)->Arg(100);

}  // namespace

BENCHMARK_MAIN();
