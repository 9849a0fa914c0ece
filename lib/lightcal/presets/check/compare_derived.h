// SPDX-License-Identifier: Apache-2.0
// The numbers that a preset.json lists for each engine against what its lamps derive to.
#pragma once

#include <string>
#include <vector>

#include "lightcal/records/fitted_light.h"

namespace lightcal {

struct DerivedOff {
  std::string light, engine, field;
  double listed = 0.0, derived = 0.0;
};

// Every number of a light's "derived", "color", "pre_exposed" and, but for where it stands,
// "geometry" that is off by more than `max_error` (in a list, of its largest) of what the same
// lamps give in a preset.json written now: in the space and for the white that the file says, for
// the range and the form of spots that leave the fewest. `engine`: the part's name where it is no
// engine's. A light that an engine has as something else there is left alone, as are panoramas.
[[nodiscard]] std::vector<DerivedOff> CompareDerived(const std::string& preset_json,
                                                     const LightFile& lamps, double max_error);

}  // namespace lightcal
