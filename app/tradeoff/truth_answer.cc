// SPDX-License-Identifier: Apache-2.0
#include "truth_answer.h"

#include <algorithm>

#include "lightcal/core/numbers_text.h"

namespace lightcal::app {
namespace {

using tradeoff::TruthRow;

constexpr const char* kStrictest = "strictest";
// Behind an interval of each of hundreds of replicas: tells a width to 3 %, what counts to less.
constexpr int kDraws = 1000;

const TruthRow& RowOf(const std::vector<TruthRow>& rows, const std::string& name) {
  return *std::ranges::find(rows, name, &TruthRow::name);
}

}  // namespace

std::vector<tradeoff::Named> SettingsForTruth(const tradeoff::Study& study) {
  std::vector<tradeoff::Named> out = {{kStrictest, study.reference.profile}};
  const auto add = [&](const tradeoff::Setting& setting) {
    const AccuracyProfile& profile = setting.measured.profile;
    if (setting.measured.refused || profile.estimator.interval_samples > kDraws) return;
    const std::string name = tradeoff::NameOf(setting.levels);
    if (std::ranges::find(out, name, &tradeoff::Named::name) == out.end()) {
      out.push_back({name, profile});
    }
  };
  add(study.usual);
  for (const tradeoff::SweepRow& row : study.rows) {
    if (row.in_play) add(row.setting);
  }
  for (const tradeoff::Setting& one : study.combinations) add(one);
  for (tradeoff::Named& one : out) {
    int& draws = one.profile.estimator.interval_samples;
    draws = std::min(draws, kDraws);
  }
  return out;
}

std::vector<std::vector<std::string>> TruthCells(const std::vector<TruthRow>& rows) {
  std::vector<std::vector<std::string>> cells = {
      {"setting", "mean off truth", "rms off truth", "95 % interval holds it", "light"}};
  for (const TruthRow& row : rows) {
    if (row.replicas == 0) continue;
    cells.push_back({row.name, PercentText(row.mean), PercentText(row.rms),
                     std::to_string(row.held) + " of " + std::to_string(row.intervals), row.light});
  }
  return cells;
}

std::string TruthSentence(const tradeoff::Study& study, const std::vector<TruthRow>& rows) {
  const TruthRow& strict = RowOf(rows, kStrictest);
  const std::string name = tradeoff::NameOf(study.recommended.levels);
  const auto recommended = std::ranges::find(rows, name, &TruthRow::name);
  if (recommended == rows.end()) return "";
  return "Judged by the truth of a synthetic twin, read " + std::to_string(recommended->replicas) +
         " times: the recommended setting is " + PercentText(recommended->rms) +
         " off (the strictest " + PercentText(strict.rms) +
         "), and its 95 % interval holds the truth in " +
         PercentText(recommended->held_share(), 3) + " (" + PercentText(strict.held_share(), 3) +
         ").";
}

records::Node TruthNode(const TruthRow& row) {
  return {{"name", row.name},           {"replicas", row.replicas},
          {"refused", row.refused},     {"light", row.light},
          {"mean_relative", row.mean},  {"rms_relative", row.rms},
          {"intervals", row.intervals}, {"intervals_that_hold_the_truth", row.held}};
}

}  // namespace lightcal::app
