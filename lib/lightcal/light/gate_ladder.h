// SPDX-License-Identifier: Apache-2.0
// What the gate saves, from a bare bulb in a dark hall to a panel in a white room.
#pragma once

#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/light/scene.h"

namespace lightcal {

// One reading of one lamp, by three models: every effect, those the gate calls for, none. An error
// is |E/truth - 1|, the truth no model of ours.
struct GateStep {
  std::string name;
  double cost_all_ns = 0.0, cost_gate_ns = 0.0, cost_none_ns = 0.0;
  double error_all = 0.0, error_gate = 0.0, error_none = 0.0;
  double bound = 0.0;  // LeftOffTogether: what the gate's answer can differ from every effect's by
};

// The lamps of the ladder, each with its room, in the order of how much they call for. `truth`:
// E d^2/I of its reading [lx m^2/cd] by brute force: lamp, head and walls in small pieces
// (tests/tools/gate_truth/ladder_truth.py, which uses nothing of ours).
struct NamedScene {
  std::string name;
  Scene scene;
  double truth = 0.0;
};
[[nodiscard]] std::vector<NamedScene> LadderScenes();

// Illuminance per candela at the scene's first reading with what is on: the direct light with
// finite source, tilt, head, haze and narrow beam, the room's bounce, the ambient light.
[[nodiscard]] double GatedIlluminance(const Scene& scene, const std::vector<std::string>& on);

[[nodiscard]] GateStep StepOf(const NamedScene& named, double tolerance);

}  // namespace lightcal
