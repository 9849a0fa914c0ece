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

// Of each light and engine the number that is its brightness (TypedNumber), where it is off by more
// than `max_error`; in the space and for the white that the file says. A light that was derived as
// something else (another form of spots) is left alone.
[[nodiscard]] std::vector<DerivedOff> CompareDerived(const std::string& preset_json,
                                                     const LightFile& lamps, double max_error);

}  // namespace lightcal
