// SPDX-License-Identifier: Apache-2.0
#include "match/behind_gels.h"

#include <cmath>
#include <optional>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "match/match_answer.h"

namespace lightcal::app {
namespace {

Uncertain PercentPassed(const match::Match& match) {
  const auto percent = [](double stops) { return 100.0 * std::exp2(-stops); };
  Uncertain out{percent(match.stops_lost), 0.0, std::nullopt, std::nullopt};
  if (!match.intervals) return out;
  const Uncertain& stops = match.intervals->stops_lost;
  out.low = percent(stops.high.value_or(match.stops_lost));
  out.high = percent(stops.low.value_or(match.stops_lost));
  out.u95 = (*out.high - *out.low) / 2.0;
  return out;
}

Node UncertainNode(double value, const std::optional<Uncertain>& interval) {
  Node node = {{"value", value}};
  if (!interval) return node;
  node.Put("u95", interval->u95);
  node.Put("low95", interval->low);
  node.Put("high95", interval->high);
  return node;
}

}  // namespace

Result<std::vector<BehindGels>> PutBehindGels(const Spectrum& lamp, bool measured,
                                              const std::string& words, const std::string& gel_file,
                                              Console& console) {
  auto choice = ReadGelChoice(words, gel_file, console);
  if (!choice) return Propagate(std::move(choice));
  match::MatchRequest request;
  request.lamp = request.target = lamp;
  request.lamp_measured = request.target_measured = measured;
  if (choice->stacks.size() > 1) request.draws = 0;
  std::vector<BehindGels> all;
  for (const auto& stack : choice->stacks) {
    auto match = match::MatchOfStack(request, choice->set.gels, stack);
    if (!match) return Propagate(std::move(match));
    BehindGels one;
    one.title = StackTitle(stack, choice->set);
    for (const std::size_t gel : stack) one.ids.push_back(choice->set.gels[gel].id);
    one.spectrum = SpectrumBehind(lamp, match->transmittance);
    one.match = *std::move(match);
    all.push_back(std::move(one));
  }
  return all;
}

Node ThroughNode(const BehindGels& behind) {
  const match::Match& match = behind.match;
  const auto& u = match.intervals;
  const Uncertain passed = PercentPassed(match);
  Node node = {{"gels", behind.ids},
               {"Y_percent", UncertainNode(passed.value, u ? std::optional(passed) : std::nullopt)},
               {"stops_lost",
                UncertainNode(match.stops_lost, u ? std::optional(u->stops_lost) : std::nullopt)}};
  if (match.cct.valid()) {
    node.Put("cct_K", UncertainNode(match.cct.temperature.value(), u ? u->cct_K : std::nullopt));
    node.Put("duv", UncertainNode(match.cct.duv, u ? u->duv : std::nullopt));
  }
  return node;
}

std::string ThroughText(const BehindGels& behind) {
  const Uncertain passed = PercentPassed(behind.match);
  return "behind " + behind.title + ": " + RoundedText(passed.value, 3) + " % of the light" +
         (passed.u95 > 0.0 ? " ± " + RoundedText(passed.u95, 2) : "") + ", " +
         RoundedText(behind.match.stops_lost, 2) + " stops lost";
}

}  // namespace lightcal::app
