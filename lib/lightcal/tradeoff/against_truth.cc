// SPDX-License-Identifier: Apache-2.0
#include "lightcal/tradeoff/against_truth.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "lightcal/core/uncertain.h"
#include "lightcal/tradeoff/recommend.h"

namespace lightcal::tradeoff {
namespace {

struct Sums {
  int count = 0, held = 0;
  double sum = 0.0, squares = 0.0;

  void Add(double off, double sd) {
    ++count;
    held += std::abs(off) <= kZ95 * sd ? 1 : 0;
    sum += off;
    squares += off * off;
  }
  [[nodiscard]] double Rms() const { return count > 0 ? std::sqrt(squares / count) : 0.0; }
};

// One profile's errors, a sum a light.
struct Account {
  std::vector<Sums> lights;
  int answered = 0, refused = 0;

  void Add(const std::vector<LightFigures>& truth, const Result<std::vector<LightFigures>>& got) {
    ++(got ? answered : refused);
    for (std::size_t i = 0; got && i < truth.size(); ++i) {
      const auto same = std::ranges::find(*got, truth[i].name, &LightFigures::name);
      if (same == got->end()) continue;
      lights[i].Add(same->ln_strength - truth[i].ln_strength, same->sd_ln);
    }
  }

  [[nodiscard]] TruthRow Row(const std::string& name,
                             const std::vector<LightFigures>& truth) const {
    TruthRow row;
    row.name = name;
    row.replicas = answered;
    row.refused = refused;
    if (lights.empty()) return row;
    const auto worst = std::ranges::max_element(lights, {}, &Sums::Rms);
    row.light = truth[static_cast<std::size_t>(worst - lights.begin())].name;
    row.rms = worst->Rms();
    row.mean = worst->count > 0 ? worst->sum / worst->count : 0.0;
    for (const Sums& light : lights) {
      row.intervals += light.count;
      row.held += light.held;
    }
    return row;
  }
};

}  // namespace

Result<std::vector<TruthRow>> CompareWithTruth(const ReplicaRunner& run,
                                               const std::vector<LightFigures>& truth,
                                               std::span<const Named> profiles,
                                               const ReplicaRules& rules, const Watch& watch) {
  using Clock = std::chrono::steady_clock;
  std::vector<Account> accounts(profiles.size());
  for (Account& account : accounts) account.lights.resize(truth.size());
  const Clock::time_point start = Clock::now();
  for (int replica = 0; replica < rules.replicas; ++replica) {
    const double by_time =
        std::chrono::duration<double>(Clock::now() - start).count() / rules.seconds;
    if (replica >= rules.least && by_time >= 1.0) break;
    for (std::size_t i = 0; i < profiles.size(); ++i) {
      if (watch.stopped()) return Failed("interrupted", "tradeoff", "stopped; nothing was written");
      accounts[i].Add(truth, run(profiles[i].profile, replica));
    }
    const double by_count = static_cast<double>(replica + 1) / rules.replicas;
    watch.progress(std::min(1.0, std::max(by_count, by_time)));
  }
  std::vector<TruthRow> rows;
  for (std::size_t i = 0; i < profiles.size(); ++i) {
    rows.push_back(accounts[i].Row(profiles[i].name, truth));
  }
  return rows;
}

bool HoldsTruth(const TruthRow& own, const TruthRow& strictest, double tolerance) {
  if (own.replicas < strictest.replicas || own.intervals == 0) return false;
  const double more = std::min(tolerance, kSafeShare * strictest.rms);
  if (own.rms > std::hypot(strictest.rms, more)) return false;
  constexpr double kStated = 0.95;
  const double chance = 2.0 * std::sqrt(kStated * (1.0 - kStated) / own.intervals);
  return own.held_share() >= std::min(kStated, strictest.held_share()) - chance;
}

Result<void> RecommendByTruth(const Runner& run, const Question& question, const Watch& watch,
                              const TruthRow& strictest, std::span<const TruthRow> rows,
                              Study& study) {
  const Setting* cheapest = nullptr;
  bool usual_holds = false;
  for (const Setting* one : AllSettings(study)) {
    const auto row = std::ranges::find(rows, NameOf(one->levels), &TruthRow::name);
    if (row == rows.end() || !HoldsTruth(*row, strictest, question.tolerance_relative)) continue;
    usual_holds = usual_holds || one->levels == study.usual.levels;
    if (cheapest == nullptr || one->measured.times.total < cheapest->measured.times.total) {
      cheapest = one;
    }
  }
  if (cheapest == nullptr) return {};
  const Setting candidate = *cheapest;
  return RecommendIfItSaves(run, question.sure, watch, candidate, usual_holds, study);
}

}  // namespace lightcal::tradeoff
