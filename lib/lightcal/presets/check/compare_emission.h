// SPDX-License-Identifier: Apache-2.0
// How a file's lights share out their light by direction, against those that this engine's export
// of the same lamps makes.
#pragma once

#include <string>
#include <vector>

#include "lightcal/presets/check/engine_light.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"

namespace lightcal {

// Where a light strays furthest, in parts of its brightest light.
struct EmissionOff {
  std::string light;
  double off_axis_deg = 0.0, round_deg = 0.0;  // from its aim; about it, from its C0
  double given = 0.0, exported = 0.0;
};

// One row a light that strays by more than `max_error` of its brightest, on a ball about it: of a
// surface so near that its sides show, of any other of 1 m. `exported`: what its engine's reader
// makes of a fresh export. A light of which the session states no aim may hang any way, and is
// compared in its own axes; how bright it is on its axis is the readings' to judge. Suns, domes,
// photometric files (of any make) and lamps of several lights are left alone.
[[nodiscard]] std::vector<EmissionOff> CompareEmission(const Session& session,
                                                       const std::vector<EngineLight>& lights,
                                                       const std::vector<EngineLight>& exported,
                                                       double max_error);

}  // namespace lightcal
