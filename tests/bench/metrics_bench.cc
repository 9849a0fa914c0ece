// SPDX-License-Identifier: Apache-2.0
// Time of the colour-rendering metrics of one spectrum. Aim: CRI, CIE 224 and TM-30 together under
// 0.1 ms.
#include <benchmark/benchmark.h>

#include <string>

#include "lightcal/colorimetry/color_fidelity.h"
#include "lightcal/colorimetry/cri.h"
#include "lightcal/colorimetry/illuminants.h"
#include "lightcal/colorimetry/rendering_input.h"
#include "lightcal/colorimetry/ssi.h"

namespace {

using namespace lightcal;

Spectrum Light(const std::string& name) { return IlluminantSpectrum(name).value(); }

// From the samples of a spectrum to Ra, R1-R15, Rf, Rg and the 16 bins.
void AllRenderingMetrics(benchmark::State& state, const std::string& name) {
  const Spectrum light = Light(name);
  for (auto _ : state) {
    const RenderingInput input = PrepareRendering(light).value();
    benchmark::DoNotOptimize(ColorRenderingOf(input));
    const ColorFidelity fidelity = ColorFidelityOf(input);
    benchmark::DoNotOptimize(GamutAndBinsOf(fidelity));
  }
}
BENCHMARK_CAPTURE(AllRenderingMetrics, fluorescent_5nm, "FL11")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(AllRenderingMetrics, black_body_1nm, "P3200")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(AllRenderingMetrics, mixed_reference_1nm, "P4500")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(AllRenderingMetrics, daylight_1nm, "D65")->Unit(benchmark::kMicrosecond);

void Prepare(benchmark::State& state) {
  const Spectrum light = Light("D65");
  for (auto _ : state) benchmark::DoNotOptimize(PrepareRendering(light));
}
BENCHMARK(Prepare)->Unit(benchmark::kMicrosecond);

void Cri(benchmark::State& state) {
  const RenderingInput input = PrepareRendering(Light("D65")).value();
  for (auto _ : state) benchmark::DoNotOptimize(ColorRenderingOf(input));
}
BENCHMARK(Cri)->Unit(benchmark::kMicrosecond);

void Fidelity(benchmark::State& state) {
  const RenderingInput input = PrepareRendering(Light("D65")).value();
  for (auto _ : state) benchmark::DoNotOptimize(ColorFidelityOf(input));
}
BENCHMARK(Fidelity)->Unit(benchmark::kMicrosecond);

void Ssi(benchmark::State& state) {
  const Spectrum light = Light("D65");
  const Spectrum reference = Light("D55");
  for (auto _ : state) benchmark::DoNotOptimize(SpectralSimilarity(light, reference));
}
BENCHMARK(Ssi)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
