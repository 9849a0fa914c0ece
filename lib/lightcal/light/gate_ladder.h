// SPDX-License-Identifier: Apache-2.0
// What the gate saves, from a bare bulb in a dark hall to a panel in a white room.
#pragma once

#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/light/scene.h"

namespace lightcal {

// One reading of one lamp, by three models: every effect, those the gate calls for, none. An error
// is |E/E_all - 1|, of the effects whose size the scene tells.
struct GateStep {
  std::string name;
  double cost_all_ns = 0.0, cost_gate_ns = 0.0, cost_none_ns = 0.0;
  double error_gate = 0.0, error_none = 0.0;
  double bound = 0.0;  // LeftOffTogether: what error_gate cannot exceed
};

// The lamps of the ladder, each with its room, in the order of how much they call for.
struct NamedScene {
  std::string name;
  Scene scene;
};
[[nodiscard]] std::vector<NamedScene> LadderScenes();

// Illuminance per candela at the scene's first reading with what is on: the direct light with
// finite source, tilt, head, haze and narrow beam, the room's bounce, the ambient light.
[[nodiscard]] double GatedIlluminance(const Scene& scene, const std::vector<std::string>& on);

[[nodiscard]] GateStep StepOf(const NamedScene& named, double tolerance);

}  // namespace lightcal
