// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/gate.h"

#include <algorithm>
#include <array>

#include "lightcal/core/nearest_word.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/light/effects/effect_table.h"

namespace lightcal {
namespace {

std::string Percent(double relative) { return RoundedText(100.0 * relative, 2) + " %"; }

std::string_view TreatmentText(Treatment treatment) {
  switch (treatment) {
    case Treatment::kModelled:
      return "modelled";
    case Treatment::kFitted:
      return "taken up by a fitted parameter";
    case Treatment::kWidens:
      return "it widens the interval";
    case Treatment::kInsideSigma:
      return "it stays inside the meter's sigma";
    case Treatment::kUnknown:
      break;
  }
  return "not simulated";
}

void SwitchOn(GatedEffect& effect) {
  const Treatment treatment = effect.finding.treatment;
  effect.ignored = false;
  effect.state = treatment == Treatment::kFitted ? GateState::kFitted : GateState::kOn;
  effect.reason = "up to " + Percent(effect.finding.bound) + ", " +
                  std::string(TreatmentText(treatment)) + ": " + effect.finding.reason;
  if (treatment == Treatment::kUnknown) effect.state = GateState::kOff;
}

void SwitchOff(GatedEffect& effect, std::string why) {
  effect.state = GateState::kOff;
  effect.reason = std::move(why);
}

void Decide(std::vector<GatedEffect>& effects, double tolerance) {
  std::vector<GatedEffect*> order;
  for (GatedEffect& effect : effects) order.push_back(&effect);
  std::stable_sort(order.begin(), order.end(), [](const GatedEffect* a, const GatedEffect* b) {
    return a->finding.bound < b->finding.bound;
  });
  double sum = 0.0;
  for (GatedEffect* effect : order) {
    const double bound = effect->finding.bound;
    if (effect->finding.treatment != Treatment::kUnknown && sum + bound <= tolerance) {
      sum += bound;
      effect->ignored = true;
      SwitchOff(*effect, "at most " + Percent(bound) + ", and all effects left off together " +
                             Percent(sum) + ": " + effect->finding.reason);
    } else {
      SwitchOn(*effect);
    }
  }
}

Result<GatedEffect*> Find(std::vector<GatedEffect>& effects, std::string_view name) {
  const auto at = std::find_if(effects.begin(), effects.end(),
                               [&](const GatedEffect& e) { return e.name == name; });
  if (at != effects.end()) return &*at;
  std::vector<std::string_view> names;
  for (const GatedEffect& effect : effects) names.push_back(effect.name);
  const std::string nearest = NearestWord(name, names);
  return WrongUsage("effects",
                    "unknown effect \"" + std::string(name) + "\"" +
                        (nearest.empty() ? std::string() : "; did you mean \"" + nearest + "\"?"));
}

void Force(GatedEffect& effect, bool on) {
  effect.forced = true;
  effect.ignored = false;
  if (!on) return SwitchOff(effect, "switched off by name: " + effect.finding.reason);
  // Naming this one states that distances reach the surface.
  if (effect.name == "sphere_surface") effect.finding.treatment = Treatment::kModelled;
  SwitchOn(effect);
}

Result<void> Override(std::vector<GatedEffect>& effects, std::string_view text) {
  while (!text.empty()) {
    const std::size_t comma = std::min(text.find(','), text.size());
    const std::string_view word = TrimBlanks(text.substr(0, comma));
    text.remove_prefix(std::min(text.size(), comma + 1));
    if (word.empty()) continue;
    const bool off = word.front() == '-';
    const std::string_view name = off || word.front() == '+' ? word.substr(1) : word;
    Result<GatedEffect*> effect = Find(effects, name);
    if (!effect) return tl::unexpected(std::move(effect).error());
    Force(**effect, !off);
  }
  return {};
}

}  // namespace

Result<std::vector<GatedEffect>> GateEffects(const Scene& scene, double tolerance,
                                             std::string_view overrides) {
  std::vector<GatedEffect> effects;
  for (const Effect& effect : kEffects) {
    GatedEffect gated;
    gated.name = effect.name;
    gated.cost_ns = effect.cost_ns;
    gated.finding = effect.find(scene);
    effects.push_back(std::move(gated));
  }
  if (overrides == "none") {
    for (GatedEffect& effect : effects) SwitchOff(effect, "all effects are switched off");
    return effects;
  }
  Decide(effects, tolerance);
  if (overrides == "all") {
    for (GatedEffect& effect : effects) SwitchOn(effect);
    return effects;
  }
  if (overrides.empty() || overrides == "auto") return effects;
  if (auto done = Override(effects, overrides); !done) {
    return tl::unexpected(std::move(done).error());
  }
  return effects;
}

}  // namespace lightcal
