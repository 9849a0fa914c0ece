// SPDX-License-Identifier: Apache-2.0
// Simulate only the effects a scene calls for.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/light/effects/effect.h"

namespace lightcal {

enum class GateState : std::uint8_t { kOff, kOn, kFitted };

struct GatedEffect {
  std::string_view name;
  double cost_ns = 0.0;
  EffectFinding finding;
  GateState state = GateState::kOff;
  bool forced = false;   // the person named it
  bool ignored = false;  // off because its bound fits the tolerance
  std::string_view key;  // of the session: what states it
  std::string reason;    // a sentence for people
};

// An effect that is on stays on until its bound has fallen below this part of what would switch it
// on.
inline constexpr double kHysteresis = 0.7;

// Finds every effect's bound for the scene, sorts by it, and leaves effects off while what is left
// off together stays within `tolerance`: the worst case, compounded as 1/((1 - b1)(1 - b2)...) - 1,
// which the bounds' sum never exceeds and which bounds |model/truth - 1| whatever their signs. The
// others are on when modelled or when they widen the interval, fitted when a parameter takes them
// up. `overrides`: "auto", "all", "none", or "+a,-b" on top of auto. In the
// order of the table.
// Fails: usage (an unknown name; the nearest known one is given).
[[nodiscard]] Result<std::vector<GatedEffect>> GateEffects(const Scene& scene, double tolerance,
                                                           std::string_view overrides);

// The same with the scene as the fit found it. Effects that were on in `before` go off only where
// 1/kHysteresis times their bound would fit.   Fails: as GateEffects.
[[nodiscard]] Result<std::vector<GatedEffect>> RegateEffects(const std::vector<GatedEffect>& before,
                                                             const Scene& fitted, double tolerance,
                                                             std::string_view overrides);

// Whether an effect left off in `before` outgrew its share: it is on or fitted in `after`.
[[nodiscard]] bool OutgrewShare(const std::vector<GatedEffect>& before,
                                const std::vector<GatedEffect>& after);

// What the effects left off for being small can do together: 1/((1 - b1)(1 - b2)...) - 1.
[[nodiscard]] double LeftOffTogether(const std::vector<GatedEffect>& effects);

// Declared price of those that are on or fitted, in ns of one evaluation.
[[nodiscard]] double CostOf(const std::vector<GatedEffect>& effects);

}  // namespace lightcal
