// SPDX-License-Identifier: Apache-2.0
#include "lightcal/tradeoff/recommend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/tradeoff/knobs.h"

namespace lightcal::tradeoff {
namespace {

// A setting whose runs overlap the cheapest's passes for as cheap, up to this much by the medians.
constexpr double kAsCheap = 1.2;

std::string MillisecondsText(double seconds) { return RoundedText(1e3 * seconds, 3) + " ms"; }

bool Meets(const Setting& setting, const Study& study, const std::vector<double>& limits) {
  if (setting.measured.refused) return false;
  const std::vector<double> differences = SignedDifferences(study, setting.measured);
  for (std::size_t i = 0; i < limits.size(); ++i) {
    if (std::abs(differences[i]) > limits[i]) return false;
  }
  return true;
}

std::size_t KnobsMoved(const Setting& setting) {
  std::size_t moved = 0;
  for (std::size_t k = 0; k < setting.levels.size(); ++k) {
    if (setting.levels[k] != Knobs()[k].usual) ++moved;
  }
  return moved;
}

// Among settings that meet the limits (at least one) the cheapest; of those as cheap as it the most
// accurate, then the one that moves the fewest knobs.
const Setting* CheapestOf(const std::vector<const Setting*>& settings) {
  const auto cheapest = std::ranges::min_element(
      settings, {}, [](const Setting* s) { return s->measured.times.total; });
  const Setting* best = *cheapest;
  for (const Setting* one : settings) {
    const RunTimes &own = one->measured.times, &least = (*cheapest)->measured.times;
    if (TimesOverlap(own, least) && own.total <= kAsCheap * least.total &&
        std::pair(one->error.relative, KnobsMoved(*one)) <
            std::pair(best->error.relative, KnobsMoved(*best))) {
      best = one;
    }
  }
  return best;
}

// Where its time goes, and what its worst light's uncertainty comes from.
std::string LimitText(const Setting& setting) {
  const StageSeconds& stages = setting.measured.times.median;
  const auto longest = std::ranges::max_element(stages);
  std::string text = "; most of the time goes into " +
                     std::string(kStageWords[static_cast<std::size_t>(longest - stages.begin())]) +
                     " (" + MillisecondsText(*longest) + ")";
  const auto& lights = setting.measured.lights;
  const auto light = std::ranges::find(lights, setting.error.light, &LightFigures::name);
  if (light == lights.end() || light->limit.empty()) return text;
  return text + ", and the uncertainty of " + light->name + " comes mostly from " + light->limit;
}

// What the others are judged by: it holds whatever none of them does.
Setting StrictestOf(const Study& study) {
  Setting strictest;
  strictest.levels.assign(Knobs().size(), 0);
  strictest.measured = study.reference;
  strictest.error = ErrorOf(DifferencesFrom(study.reference.lights, study.reference.lights));
  strictest.verdict = Verdict::kFree;
  strictest.usual = study.usual.measured.times;
  return strictest;
}

// Where its values are near and its interval is not.
std::string IntervalText(const Setting& setting) {
  if (std::abs(setting.u_change) <= kSafeShare) return "";
  return ", its 95 % interval " + PercentText(std::abs(setting.u_change)) +
         (setting.u_change < 0.0 ? " too narrow" : " too wide");
}

}  // namespace

std::vector<double> SignedDifferences(const Study& study, const Measured& measured) {
  std::vector<double> out;
  for (const Difference& d : DifferencesFrom(study.reference.lights, measured.lights)) {
    out.push_back(d.relative);
  }
  return out;
}

double SavedShare(const RunTimes& usual, const RunTimes& own) {
  return TimesDiffer(usual, own) ? std::max(0.0, 1.0 - own.total / usual.total) : 0.0;
}

Result<void> RecommendIfItSaves(const Runner& run, const TimingRules& rules, const Watch& watch,
                                const Setting& candidate, bool usual_holds, Study& study) {
  study.recommended = candidate;
  study.saved_share = 0.0;
  if (candidate.levels == study.usual.levels) return {};
  const std::array profiles = {study.usual.measured.profile, candidate.measured.profile};
  auto measured = MeasureInTurn(run, profiles, rules, watch);
  if (!measured) return Propagate(std::move(measured));
  study.saved_share = SavedShare((*measured)[0].times, (*measured)[1].times);
  if (usual_holds && study.saved_share < kLeastSaved) {
    study.recommended = study.usual;
    study.saved_share = 0.0;
    return {};
  }
  study.usual.measured.times = study.recommended.usual = (*measured)[0].times;
  study.recommended.measured.times = (*measured)[1].times;
  return {};
}

Result<void> Recommend(const Runner& run, const Question& question,
                       const std::vector<double>& limits, const Watch& watch, Study& study) {
  std::vector<const Setting*> all = AllSettings(study);
  std::erase_if(all, [](const Setting* s) { return s->measured.refused.has_value(); });
  const auto holds = [&](const Setting& one) {
    if (question.budget_s && one.measured.times.total > *question.budget_s) return false;
    if (!question.budget_s) return Meets(one, study, limits);
    return one.error.relative <= question.tolerance_relative &&
           std::abs(one.u_change) <= kSafeShare;
  };
  for (const SweepRow& row : study.rows) {  // cheap by chance alone
    if (!(row.saves_s > 0.0) && holds(study.usual)) std::erase(all, &row.setting);
  }
  std::vector<const Setting*> fit;
  std::ranges::copy_if(all, std::back_inserter(fit), [&](const Setting* s) { return holds(*s); });
  if (!fit.empty() && question.budget_s) {
    study.recommended = **std::ranges::min_element(fit, {}, [](const Setting* s) {
      return std::pair(s->error.relative, std::abs(s->u_change));
    });
    study.saved_share = SavedShare(study.recommended.usual, study.recommended.measured.times);
    return {};
  }
  if (!fit.empty()) {
    const Setting candidate = *CheapestOf(fit);
    return RecommendIfItSaves(run, question.sure, watch, candidate, holds(study.usual), study);
  }
  if (!question.budget_s && question.knobs.empty()) {
    return RecommendIfItSaves(run, question.sure, watch, StrictestOf(study), false, study);
  }
  const Setting* nearest = all.front();  // the usual one does not hold: they are all there
  for (const Setting* one : all) {
    const bool late = question.budget_s && one->measured.times.total > *question.budget_s;
    const bool nearest_late =
        question.budget_s && nearest->measured.times.total > *question.budget_s;
    if (std::pair(late, late ? one->measured.times.total : one->error.relative) <
        std::pair(nearest_late,
                  nearest_late ? nearest->measured.times.total : nearest->error.relative)) {
      nearest = one;
    }
  }
  return Refused("no_setting", "tradeoff",
                 "no setting stays within " + PercentText(question.tolerance_relative) +
                     (question.budget_s ? " in " + MillisecondsText(*question.budget_s) : "") +
                     "; the nearest (" + NameOf(nearest->levels) + ") takes " +
                     MillisecondsText(nearest->measured.times.total) + " and is " +
                     PercentText(nearest->error.relative) + " off in the " +
                     std::string(nearest->error.quantity) + " of " + nearest->error.light +
                     IntervalText(*nearest) + LimitText(*nearest));
}

}  // namespace lightcal::tradeoff
