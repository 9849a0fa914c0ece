// SPDX-License-Identifier: Apache-2.0
// Time of one CCT and Duv, one exact locus point, one spectrum, and of the locus table's first use.
// Robertson's and Ohno's methods stand beside them as yardsticks. Aim: at most 150 ns an evaluation
// near the locus, 40 ns in a batch.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <random>
#include <string>
#include <vector>

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

// ---- Yardsticks: the two methods in common use, written as published but over double tables ----

// Robertson's 31 isotherms, as unit directions (J. Opt. Soc. Am. 58, 1528 (1968)); the table's
// values come from the exact locus, so without the misprint at 325 mired.
class Robertson31 {
 public:
  Robertson31() {
    for (int i = 0; i < 31; ++i) {
      const double mireds = i <= 10 ? 10.0 * i : 100.0 + 25.0 * (i - 10);
      const LocusPoint at = PlanckianLocusAt(Mireds(mireds));
      const double speed = std::hypot(at.du, at.dv);
      lines_[static_cast<std::size_t>(i)] = {mireds, at.uv.u, at.uv.v, at.du / speed,
                                             at.dv / speed};
    }
  }
  // 0 below 1667 K, where the table ends.
  [[nodiscard]] double KelvinOf(Uv1960 c) const {
    double before = 0.0;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      const Line& l = lines_[i];
      const double ahead = (c.u - l.u) * l.du + (c.v - l.v) * l.dv;
      if (ahead <= 0.0 && i > 0) {
        const double share = before / (before - ahead);
        return 1e6 / (lines_[i - 1].mireds + share * (l.mireds - lines_[i - 1].mireds));
      }
      before = ahead;
    }
    return 0.0;
  }

 private:
  struct Line {
    double mireds, u, v, du, dv;
  };
  std::array<Line, 31> lines_{};
};

// Ohno's search of a table of 0.1 % steps with its triangular and parabolic solutions (LEUKOS 10,
// 47 (2014)).
class OhnoTenthPercent {
 public:
  OhnoTenthPercent() {
    for (double kelvin = 1000.0; kelvin < 1.02e5; kelvin *= 1.001) {
      const Uv1960 uv = UvFromCct(Kelvin(kelvin));
      rows_.push_back({kelvin, uv.u, uv.v});
    }
  }
  [[nodiscard]] double KelvinOf(Uv1960 c) const {
    const auto distance = [&](std::size_t i) {
      return std::hypot(rows_[i].u - c.u, rows_[i].v - c.v);
    };
    std::size_t m = 1;
    double least = 1e9;
    for (std::size_t i = 1; i + 1 < rows_.size(); ++i) {
      const double du = rows_[i].u - c.u;
      const double dv = rows_[i].v - c.v;
      if (du * du + dv * dv < least) {
        least = du * du + dv * dv;
        m = i;
      }
    }
    const Row &p = rows_[m - 1], &q = rows_[m], &n = rows_[m + 1];
    const double dp = distance(m - 1), dq = distance(m), dn = distance(m + 1);
    const double side = std::hypot(n.u - p.u, n.v - p.v);
    const double along = (dp * dp - dn * dn + side * side) / (2.0 * side);
    const double duv = std::sqrt(std::max(0.0, dp * dp - along * along));
    if (duv < 0.002) return p.kelvin + (n.kelvin - p.kelvin) * along / side;
    const double x = (n.kelvin - q.kelvin) * (p.kelvin - n.kelvin) * (q.kelvin - p.kelvin);
    const double a = (p.kelvin * (dn - dq) + q.kelvin * (dp - dn) + n.kelvin * (dq - dp)) / x;
    const double b = -(p.kelvin * p.kelvin * (dn - dq) + q.kelvin * q.kelvin * (dp - dn) +
                       n.kelvin * n.kelvin * (dq - dp)) /
                     x;
    return -b / (2.0 * a);
  }

 private:
  struct Row {
    double kelvin, u, v;
  };
  std::vector<Row> rows_;
};

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
BENCHMARK(Yardstick<OhnoTenthPercent>);

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
