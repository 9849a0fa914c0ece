// SPDX-License-Identifier: Apache-2.0
// Time of one CCT and Duv, one exact locus point, one spectrum, and of the locus table's first use.
// Robertson's and Ohno's methods stand beside them as yardsticks. Aim: at most 150 ns an evaluation
// near the locus, 40 ns in a batch.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "cct_yardsticks.h"
#include "lightcal/colorimetry/cct.h"
#include "lightcal/colorimetry/cct_batch.h"
#include "lightcal/colorimetry/daylight.h"
#include "lightcal/colorimetry/planckian.h"
#include "lightcal/colorimetry/spectrum.h"

namespace {

using namespace lightcal;

// Chromaticities of 1-40 kK, log-uniform, |Duv| up to `duv`, in random order.
std::vector<Xy> RandomColors(double duv) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> mireds(25.0, 1000.0), offset(-duv, duv);
  std::vector<Xy> all;
  for (int i = 0; i < 4096; ++i) {
    all.push_back(XyFromCct(KelvinFromMireds(Mireds(mireds(random))), offset(random)));
  }
  return all;
}

void CctNearTheLocus(benchmark::State& state) {
  const auto colors = RandomColors(0.05);
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(CctFromXy(colors[i++ % colors.size()]));
}
BENCHMARK(CctNearTheLocus);

void CctBatchNearTheLocus(benchmark::State& state) {
  const auto colors = RandomColors(0.05);
  std::vector<CctResult> results(colors.size());
  for (auto _ : state) {
    CctBatch(colors, results);
    benchmark::DoNotOptimize(results.data());
    benchmark::ClobberMemory();
  }
  state.counters["per_point"] = benchmark::Counter(
      static_cast<double>(colors.size()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(CctBatchNearTheLocus);

// Time of a yardstick, and its largest error against the exact answer as the counter.
template <class Method>
void Yardstick(benchmark::State& state) {
  const Method method;
  const auto colors = RandomColors(0.05);
  double worst = 0.0;
  for (const Xy& c : colors) {
    const double exact = CctFromXy(c).temperature.value();
    const double answer = method.KelvinOf(Uv1960FromXy(c));
    if (answer > 0.0) worst = std::max(worst, std::abs(answer / exact - 1.0));  // 0: no answer
  }
  state.counters["worst_percent"] = 100.0 * worst;
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(method.KelvinOf(Uv1960FromXy(colors[i++ % colors.size()])));
  }
}
BENCHMARK(Yardstick<Robertson31>);
BENCHMARK(Yardstick<OhnoTable>);

// Colours the answer to which is "no CCT": the whole locus is searched.
void CctFarFromTheLocus(benchmark::State& state) {
  const Xy colors[] = {{0.15, 0.06}, {0.2, 0.7}, {0.35, 0.15}, {0.332, 0.1858}};
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(CctFromXy(colors[i++ % std::size(colors)]));
}
BENCHMARK(CctFarFromTheLocus);

void Jacobian(benchmark::State& state) {
  const auto colors = RandomColors(0.02);
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(CctJacobianAt(colors[i++ % colors.size()]));
}
BENCHMARK(Jacobian);

void ExactLocusPoint(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(PlanckianLocusAt(Mireds(153.8)));
}
BENCHMARK(ExactLocusPoint)->Unit(benchmark::kMicrosecond);

void XyzOfA1NmSpectrum(benchmark::State& state) {
  const Spectrum d65 = *DaylightSpectrum(Kelvin(6504));
  for (auto _ : state) benchmark::DoNotOptimize(XyzFromSpectrum(d65));
}
BENCHMARK(XyzOfA1NmSpectrum)->Unit(benchmark::kMicrosecond);

}  // namespace

int main(int argc, char** argv) {
  const auto start = std::chrono::steady_clock::now();
  benchmark::DoNotOptimize(CctFromXy({0.3127, 0.3290}));
  const std::chrono::duration<double, std::milli> first = std::chrono::steady_clock::now() - start;
  benchmark::Initialize(&argc, argv);
  benchmark::AddCustomContext("first CCT of a process, ms", std::to_string(first.count()));
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
