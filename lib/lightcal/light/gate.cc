// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/gate.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "lightcal/core/nearest_word.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/light/effects/effect_table.h"

namespace lightcal {
namespace {

std::string_view TreatmentText(Treatment treatment) {
  switch (treatment) {
    case Treatment::kModelled:
      return "modelled";
    case Treatment::kFitted:
      return "taken up by a fitted parameter";
    case Treatment::kWidens:
      return "it widens the interval";
    case Treatment::kInsideSigma:
      break;
  }
  return "it stays inside the meter's sigma";
}

void SwitchOn(GatedEffect& effect) {
  const Treatment treatment = effect.finding.treatment;
  effect.ignored = false;
  effect.state = treatment == Treatment::kFitted ? GateState::kFitted : GateState::kOn;
  effect.reason = "up to " + PercentText(effect.finding.bound) + ", " +
                  std::string(TreatmentText(treatment)) + ": " + effect.finding.reason;
}

void SwitchOff(GatedEffect& effect, std::string why) {
  effect.state = GateState::kOff;
  effect.reason = std::move(why);
}

// Error left by effects that keep `kept` of the light between them.
double Compounded(double kept) {
  return kept > 0.0 ? 1.0 / kept - 1.0 : std::numeric_limits<double>::infinity();
}

bool IsOn(const GatedEffect& effect) { return effect.state != GateState::kOff; }

// `slack` of an effect: what its bound is multiplied by before it may go off.
void Decide(std::vector<GatedEffect>& effects, const std::vector<double>& slack, double tolerance) {
  std::vector<std::size_t> order(effects.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t i) { return slack[i] * effects[i].finding.bound; };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  double kept = 1.0;
  for (const std::size_t i : order) {
    GatedEffect& effect = effects[i];
    const double bound = effect.finding.bound;
    if (!effect.finding.applies) {
      SwitchOff(effect, "not applicable: " + effect.finding.reason);
    } else if (Compounded(kept * (1.0 - std::min(1.0, key(i)))) <= tolerance) {
      kept *= 1.0 - bound;
      effect.ignored = true;
      SwitchOff(effect, "at most " + PercentText(bound) + ", and all effects left off together " +
                            PercentText(Compounded(kept)) + ": " + effect.finding.reason);
    } else {
      SwitchOn(effect);
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

Result<std::vector<GatedEffect>> Gate(const Scene& scene, double tolerance,
                                      std::string_view overrides,
                                      const std::vector<GatedEffect>* before) {
  std::vector<GatedEffect> effects;
  std::vector<double> slack;
  for (const Effect& effect : kEffects) {
    GatedEffect gated;
    gated.name = effect.name;
    gated.key = effect.key;
    gated.finding = effect.find(scene);
    gated.cost_ns = gated.finding.cost_ns.value_or(effect.cost_ns);
    const bool was_on = before != nullptr && IsOn((*before)[effects.size()]);
    slack.push_back(was_on ? 1.0 / kHysteresis : 1.0);
    effects.push_back(std::move(gated));
  }
  if (overrides == "none") {
    for (GatedEffect& effect : effects) SwitchOff(effect, "all effects are switched off");
    return effects;
  }
  Decide(effects, slack, tolerance);
  if (overrides == "all") {
    for (GatedEffect& effect : effects) {
      if (effect.finding.applies) SwitchOn(effect);
    }
    return effects;
  }
  if (overrides.empty() || overrides == "auto") return effects;
  if (auto done = Override(effects, overrides); !done) {
    return tl::unexpected(std::move(done).error());
  }
  return effects;
}

}  // namespace

Result<std::vector<GatedEffect>> GateEffects(const Scene& scene, double tolerance,
                                             std::string_view overrides) {
  return Gate(scene, tolerance, overrides, nullptr);
}

Result<std::vector<GatedEffect>> RegateEffects(const std::vector<GatedEffect>& before,
                                               const Scene& fitted, double tolerance,
                                               std::string_view overrides) {
  return Gate(fitted, tolerance, overrides, &before);
}

bool OutgrewShare(const std::vector<GatedEffect>& before, const std::vector<GatedEffect>& after) {
  for (std::size_t i = 0; i < before.size() && i < after.size(); ++i) {
    if (before[i].ignored && IsOn(after[i])) return true;
  }
  return false;
}

double LeftOffTogether(const std::vector<GatedEffect>& effects) {
  double kept = 1.0;
  for (const GatedEffect& effect : effects) {
    if (effect.ignored) kept *= 1.0 - effect.finding.bound;
  }
  return Compounded(kept);
}

double CostOf(const std::vector<GatedEffect>& effects) {
  double cost_ns = 0.0;
  for (const GatedEffect& effect : effects) cost_ns += IsOn(effect) ? effect.cost_ns : 0.0;
  return cost_ns;
}

}  // namespace lightcal
