// SPDX-License-Identifier: Apache-2.0
#include "lightcal/tradeoff/timing.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "lightcal/core/statistics.h"

namespace lightcal::tradeoff {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kFewestRuns = 4;     // the first of them only warms caches
constexpr double kPatience = 5.0;  // times the time asked for

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

struct Series {
  std::array<std::vector<double>, kStages> stages;
  std::vector<double> totals;

  void Add(const StageSeconds& seconds) {
    double total = 0.0;
    for (std::size_t i = 0; i < kStages; ++i) {
      stages[i].push_back(seconds[i]);
      total += seconds[i];
    }
    totals.push_back(total);
  }

  [[nodiscard]] RunTimes Summary() {  // reorders
    RunTimes out;
    out.runs = static_cast<int>(totals.size());
    if (totals.empty()) return out;
    for (std::size_t i = 0; i < kStages; ++i) {
      out.median[i] = Quantile(stages[i], 0.5);
      out.stage_low[i] = Quantile(stages[i], 0.25);
      out.stage_high[i] = Quantile(stages[i], 0.75);
      out.total += out.median[i];
    }
    out.least = *std::ranges::min_element(totals);
    out.low = Quantile(totals, 0.25);
    out.high = Quantile(totals, 0.75);
    return out;
  }
};

struct Spread {
  double median, low, high;
  int runs;
};

double ErrorOfMedian(const Spread& s) {
  constexpr double kQuartilesOverSd = 1.349, kMedianOverMean = 1.2533;
  return kMedianOverMean * (s.high - s.low) / kQuartilesOverSd / std::sqrt(std::max(1, s.runs));
}

bool Differ(const Spread& a, const Spread& b) {
  constexpr double kSure = 3.0;  // standard errors
  return std::abs(a.median - b.median) > kSure * std::hypot(ErrorOfMedian(a), ErrorOfMedian(b));
}

}  // namespace

Result<std::vector<Measured>> MeasureInTurn(const Runner& run,
                                            std::span<const AccuracyProfile> profiles,
                                            const TimingRules& rules, const Watch& watch,
                                            const Settled& settled) {
  std::vector<Measured> out(profiles.size());
  std::vector<Series> series(profiles.size());
  std::vector<bool> done(profiles.size(), false);
  Outcome first;
  const Clock::time_point start = Clock::now();
  for (int round = 0; round < rules.most_runs; ++round) {
    const double by_time = SecondsSince(start) / rules.seconds;
    const double by_runs = static_cast<double>(round) / rules.least_runs;
    if (round >= rules.least_runs && by_time >= 1.0) break;
    if (round >= kFewestRuns && by_time >= kPatience) break;
    for (std::size_t i = 0; i < profiles.size(); ++i) {
      if (watch.stopped()) return Failed("interrupted", "tradeoff", "stopped; nothing was written");
      if (out[i].refused || done[i]) continue;
      auto outcome = run(profiles[i]);
      if (round == 0) {  // the first run of each warms caches
        out[i].profile = profiles[i];
        // The first profile is what the others are measured against.
        if (!outcome && i == 0) return Propagate(std::move(outcome));
        if (i == 0) first = *outcome;
        if (!outcome) {
          out[i].refused = outcome.error();
          continue;
        }
        done[i] = i > 0 && settled && settled(i, first, *outcome);
        out[i].lights = std::move(outcome->lights);
        continue;
      }
      if (outcome) series[i].Add(outcome->seconds);
    }
    watch.progress(std::min({1.0, by_runs, std::max(by_time, by_runs / 2.0)}));
  }
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i].times = done[i] ? out[0].times : series[i].Summary();
  }
  watch.progress(1.0);
  return out;
}

bool TimesOverlap(const RunTimes& a, const RunTimes& b) {
  return a.low <= b.high && b.low <= a.high;
}

bool TimesDiffer(const RunTimes& a, const RunTimes& b) {
  return Differ({a.total, a.low, a.high, a.runs}, {b.total, b.low, b.high, b.runs});
}

bool TimesDiffer(const RunTimes& a, const RunTimes& b, Stage stage) {
  const auto i = static_cast<std::size_t>(stage);
  return Differ({a.median[i], a.stage_low[i], a.stage_high[i], a.runs},
                {b.median[i], b.stage_low[i], b.stage_high[i], b.runs});
}

}  // namespace lightcal::tradeoff
