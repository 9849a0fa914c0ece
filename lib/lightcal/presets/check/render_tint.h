// SPDX-License-Identifier: Apache-2.0
// What the tint of rendered cards says of the lamps' colours.
#pragma once

#include <array>
#include <optional>

#include "lightcal/presets/check/render_cause.h"
#include "lightcal/presets/check/rig_file.h"

namespace lightcal {

// The mistake by which a lamp's light has the tint of `rgb`, linear Rec. 709 of any length; `seen`:
// the factor by which it is brighter than measured. Absent: the tint is the lamp's.
[[nodiscard]] std::optional<RenderCause> TintIn(const CheckedLamp& lamp,
                                                const std::array<double, 3>& rgb, double seen);

// Of cards that are off in u'v' (verdict.color): the lamp that has another known colour, else the
// one that gives them most of their light.
[[nodiscard]] RenderCause TintAmong(const CheckedRig& rig, const RenderVerdict& verdict);

}  // namespace lightcal
