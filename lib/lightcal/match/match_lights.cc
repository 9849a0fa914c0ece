// SPDX-License-Identifier: Apache-2.0
#include "lightcal/match/match_lights.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <tuple>
#include <utility>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/core/joined.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/parallel.h"
#include "lightcal/match/match_intervals.h"
#include "lightcal/match/match_scene.h"
#include "lightcal/match/stack_search.h"

namespace lightcal::match {
namespace {

// What a person notices of a match's other sides.
constexpr double kNoticedDifference = 0.05;
constexpr double kNoticedStops = 0.05;
constexpr double kNoticedSsi = 1.0;
constexpr double kMostSsi = 100.0;
constexpr std::size_t kRankedFirst = 96;
constexpr std::size_t kMostRanked = 4000;  // beyond, a front is nothing anybody would hang

double DecidingOf(const Match& match) {
  return match.camera ? match.camera->median : match.observer;
}

// Differences nobody tells apart are one step; in a step fewer gels come first, then more light.
double StepOf(double difference) { return std::floor(difference / kNoticedDifference); }
bool ComesFirst(const Match& a, const Match& b) {
  const auto key = [](const Match& match) {
    return std::tuple(StepOf(DecidingOf(match)), match.gels.size(), match.stops_lost,
                      DecidingOf(match));
  };
  return key(a) < key(b);
}

// Fewer gels, and a difference that nobody tells from the other's though a step may end between.
bool NeedsFewerForTheSame(const Match& a, const Match& b) {
  return a.gels.size() < b.gels.size() && DecidingOf(a) <= DecidingOf(b) + kNoticedDifference;
}

void Rank(std::vector<Match>& all) {
  std::ranges::sort(all, ComesFirst);
  for (auto one = all.begin(); one != all.end(); ++one) {
    const auto before = std::find_if(
        all.begin(), one, [&](const Match& other) { return NeedsFewerForTheSame(*one, other); });
    std::rotate(before, one, std::next(one));
  }
}

// `other` comes later, and has nothing to say for itself.
bool IsBetteredBy(const Match& other, const Match& better) {
  return better.gels.size() <= other.gels.size() &&
         better.stops_lost <= other.stops_lost + kNoticedStops &&
         better.ssi >= other.ssi - kNoticedSsi;
}

struct Front {
  std::vector<Match> matches;
  bool whole = false;  // no further stack can belong among the first `count`
};

// The first `count` of the ranked stacks within reach that none before them betters.
Front FrontOf(const MatchScene& scene, const StackSearch& search, std::size_t count,
              std::size_t ranked) {
  std::vector<Match> all(search.best.size());
  ParallelFor(static_cast<int>(all.size()), [&](int i) {
    all[static_cast<std::size_t>(i)] =
        scene.Describe(search.best[static_cast<std::size_t>(i)].gels);
  });
  std::erase_if(all, [&](const Match& one) { return one.delta_uv > scene.request.reach; });
  Rank(all);
  Front front;
  for (Match& one : all) {
    if (front.matches.size() == count) break;
    const bool bettered = std::ranges::any_of(
        front.matches, [&](const Match& better) { return IsBetteredBy(one, better); });
    if (!bettered) front.matches.push_back(std::move(one));
  }
  // Against the lamp as it is, gels can only gain in SSI.
  const bool needs_none = std::ranges::any_of(front.matches, [](const Match& match) {
    return match.gels.empty() && match.ssi >= kMostSsi - kNoticedSsi;
  });
  // The step of the farthest stack ranked may go on beyond it, and one of fewer gels follow it.
  const bool step_ended =
      front.matches.empty() || StepOf(DecidingOf(front.matches.back()) + kNoticedDifference) <
                                   StepOf(search.best.back().difference);
  front.whole = (front.matches.size() == count && step_ended) || search.best.size() < ranked ||
                needs_none || ranked >= kMostRanked;
  return front;
}

Match BestOfOneGel(const MatchScene& scene) {
  std::vector<std::pair<double, std::size_t>> singles;
  for (std::size_t gel = 0; gel < scene.gels.size(); ++gel) {
    singles.emplace_back(DecidingDifference(scene, scene.gels[gel].transmittance), gel);
  }
  return scene.Describe({std::ranges::min_element(singles)->second});
}

// In the list's order, in place of the last where the list is full.
void AddBestOfOneGel(const MatchScene& scene, std::size_t count, std::vector<Match>& matches) {
  const bool has_single =
      std::ranges::any_of(matches, [](const Match& match) { return match.gels.size() <= 1; });
  if (has_single || count < 2 || scene.gels.empty() || scene.request.most_gels < 1) return;
  Match single = BestOfOneGel(scene);
  if (single.delta_uv > scene.request.reach) return;
  if (matches.size() == count) matches.pop_back();
  const auto after = std::ranges::find_if(matches, [&](const Match& match) {
    return ComesFirst(single, match) || NeedsFewerForTheSame(single, match);
  });
  matches.insert(after, std::move(single));
}

tl::unexpected<Error> Unreachable(const MatchScene& scene, std::span<const Gel> gels,
                                  const StackSearch& search) {
  const Match nearest = scene.Describe(search.nearest_uv);
  std::vector<std::string> names;
  for (const std::size_t gel : nearest.gels) names.push_back(GelTitle(gels[gel]));
  const CctResult& cct = nearest.cct;
  const std::string color =
      cct.valid() ? RoundedText(cct.temperature.value(), 4) + " K, Duv " + DuvText(cct.duv)
                  : "x " + RoundedText(nearest.xy.x, 3) + ", y " + RoundedText(nearest.xy.y, 3);
  return Refused(
      "unreachable", "target",
      "no stack of these gels brings the lamp within " + RoundedText(scene.request.reach, 2) +
          " of it in u'v': a gel only takes light away, and the lamp lacks what the target has. "
          "The nearest is " +
          (names.empty() ? std::string("no gel at all") : Joined(names, " + ")) +
          ", which leaves " + RoundedText(nearest.delta_uv, 2) + " (" + color +
          "); take another lamp, or {match.reach} to see what there is");
}

}  // namespace

Result<MatchAnswer> MatchLights(const MatchRequest& request, std::span<const Gel> gels) {
  auto scene = MatchScene::Make(request, gels);
  if (!scene) return Propagate(std::move(scene));
  const auto count = static_cast<std::size_t>(std::max(1, request.count));
  StackSearch search;
  Front front;
  for (std::size_t ranked = std::max(kRankedFirst, 8 * count); !front.whole; ranked *= 8) {
    search = FindNearestStacks(*scene, ranked);
    if (search.least_delta_uv > request.reach) return Unreachable(*scene, gels, search);
    front = FrontOf(*scene, search, count, ranked);
  }
  MatchAnswer answer;
  answer.matches = std::move(front.matches);
  if (answer.matches.empty()) answer.matches.push_back(scene->Describe(search.nearest_uv));
  AddBestOfOneGel(*scene, count, answer.matches);
  answer.unfiltered = scene->Describe({});
  answer.stacks = search.stacks;
  answer.target_xy = XyFromXyz(*XyzFromSpectrum(request.target));
  answer.target_cct = CctFromXy(answer.target_xy);
  if (request.draws > 0) {
    const MatchDraws draws(*scene);
    const int described = static_cast<int>(answer.matches.size()) + 1;
    const Progress drawing = PartOf(request.progress, kSearchShare, 1.0);
    CountedProgress counted(drawing, described);
    ParallelFor(described, [&](int i) {
      Match& match = i == 0 ? answer.unfiltered : answer.matches[static_cast<std::size_t>(i) - 1];
      match.intervals = draws.Of(match);
      counted.Done();
    });
  }
  return answer;
}

Result<Match> MatchOfStack(const MatchRequest& request, std::span<const Gel> gels,
                           const std::vector<std::size_t>& stack) {
  auto scene = MatchScene::Make(request, gels);
  if (!scene) return Propagate(std::move(scene));
  Match match = scene->Describe(stack);
  if (request.draws > 0) match.intervals = MatchDraws(*scene).Of(match);
  return match;
}

}  // namespace lightcal::match
