// SPDX-License-Identifier: Apache-2.0
// What an effect is: a name, a price, and a finding for a scene.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "lightcal/light/scene.h"

namespace lightcal {

// What is done about an effect that the tolerance cannot ignore.
enum class Treatment : std::uint8_t {
  kModelled,     // its parameters are known: the forward model holds it
  kFitted,       // a fitted parameter takes it up
  kWidens,       // a nuisance of known or usual size: the interval carries it
  kInsideSigma,  // the meter's stated sigma already holds it
};

struct EffectFinding {
  double bound = 0.0;  // |relative contribution to E| it cannot exceed, or its class default
  Treatment treatment = Treatment::kModelled;
  double distance_power = 0.0;      // how it grows with distance: 0 common gain, 1, 2
  std::string reason;               // a sentence on where the bound comes from
  bool applies = true;              // false: this scene has no such thing, and the bound is 0
  std::optional<double> sd{};       // 1 sigma of one that widens; absent: half the bound
  bool own_lamp = false;            // widens a person's readings; a data sheet's lamp is warm, ...
  std::optional<double> cost_ns{};  // of what is done here, where that is not the declared price
  bool of_pictures = false;         // widens what a camera read, not what a meter did
  std::string_view part{};          // of the interval, where what widens it goes by another name
};

[[nodiscard]] inline EffectFinding NotApplicable(std::string why) {
  return {.reason = std::move(why), .applies = false};
}

struct Effect {
  std::string_view name;
  double cost_ns = 0.0;  // declared price of its own code for one reading; tests/bench/effect_costs
  std::string_view key;  // of the session: what states it, or what makes it smaller
  EffectFinding (*find)(const Scene& scene);
};

}  // namespace lightcal
