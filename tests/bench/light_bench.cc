// SPDX-License-Identifier: Apache-2.0
// What one evaluation of an area light costs, exact, by the ladder, and at a fixed level.
#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "lightcal/light/models/ladder.h"
#include "lightcal/light/models/source_model.h"

namespace {

using namespace lightcal;

constexpr std::size_t kScenes = 4096;
const RectSource kRect{0.8, 0.6};  // half diagonal 1

// Meters from 1 to 100 half diagonals away, log-uniform, anywhere before the rectangle, turned up
// to 80 degrees off its middle.
std::vector<Receiver<double>> Scenes(double near, double far) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform;
  std::vector<Receiver<double>> scenes;
  while (scenes.size() < kScenes) {
    const double z = uniform(random);
    const double f = 2.0 * std::numbers::pi * uniform(random);
    const double s = std::sqrt(1.0 - z * z);
    const double d = near * std::pow(far / near, uniform(random));
    const Vec3 out = {s * std::cos(f), s * std::sin(f), z};
    const double tz = 2.0 * uniform(random) - 1.0;
    const double tf = 2.0 * std::numbers::pi * uniform(random);
    const double ts = std::sqrt(1.0 - tz * tz);
    const Vec3 normal = {ts * std::cos(tf), ts * std::sin(tf), tz};
    if (-Dot(normal, out) > 0.17) scenes.push_back({out * d, normal});
  }
  return scenes;
}

void BM_RectExact(benchmark::State& state) {
  const auto scenes = Scenes(1.0, 100.0);
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(LuxPerCandela(kRect, scenes[++i % kScenes]));
}
BENCHMARK(BM_RectExact);

// The contour everywhere: what exact costs without the switch to quadrature far away.
void BM_RectContour(benchmark::State& state) {
  const auto scenes = Scenes(1.0, 7.9);
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(LuxPerCandela(kRect, scenes[++i % kScenes]));
}
BENCHMARK(BM_RectContour);

void BM_RectLadder(benchmark::State& state) {
  const auto scenes = Scenes(1.0, 100.0);
  const double tolerance = std::pow(10.0, -static_cast<double>(state.range(0)));
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(LuxPerCandela(kRect, scenes[++i % kScenes], tolerance));
  }
}
BENCHMARK(BM_RectLadder)->Arg(1)->Arg(2)->Arg(3)->Arg(4)->Arg(6)->Arg(9);

void BM_RectFixed(benchmark::State& state) {
  const auto scenes = Scenes(1.0, 100.0);
  const auto level = static_cast<LadderLevel>(state.range(0));
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(LuxPerCandelaAt(level, kRect, scenes[++i % kScenes]));
  }
}
BENCHMARK(BM_RectFixed)->DenseRange(0, 3);

template <class Source>
void BM_Exact(benchmark::State& state, Source source) {
  const auto scenes = Scenes(2.0, 100.0);
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(LuxPerCandela(source, scenes[++i % kScenes]));
}
BENCHMARK_CAPTURE(BM_Exact, point, PointSource{});
BENCHMARK_CAPTURE(BM_Exact, sphere, SphereSource{1.0});
BENCHMARK_CAPTURE(BM_Exact, disk, DiskSource{1.0});
BENCHMARK_CAPTURE(BM_Exact, tube, TubeSource{1.0, 0.02});

void BM_TubeLadder(benchmark::State& state) {
  const auto scenes = Scenes(1.0, 100.0);
  const double tolerance = std::pow(10.0, -static_cast<double>(state.range(0)));
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        LuxPerCandela(TubeSource{1.0, 0.02}, scenes[++i % kScenes], tolerance));
  }
}
BENCHMARK(BM_TubeLadder)->Arg(1)->Arg(2)->Arg(4)->Arg(9);

}  // namespace

BENCHMARK_MAIN();
