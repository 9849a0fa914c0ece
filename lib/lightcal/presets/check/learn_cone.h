// SPDX-License-Identifier: Apache-2.0
// Which cone a renderer shows of the two angles it was given: its law and what it makes of each.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "lightcal/presets/check/render_shape.h"
#include "lightcal/presets/learnt_engine.h"

namespace lightcal {

struct ConeFound {
  LearntCone cone;
  std::string cause;    // render_cause.h's word; "none" = as written
  double shared = 1.0;  // factor on the axis itself, which cards near it show in part
};

// Pictures of one spot off its axis, and one of its cards about the axis, seen `on_axis` times as
// bright as they should be. `written`: the law that the rendered file's angles are for. The
// simplest reading that explains all pictures within .4 % of the axial intensity and 1 % of their
// own, else the nearest within four times that; absent: none does.
[[nodiscard]] std::optional<ConeFound> FindCone(const CheckedRig& axis, double on_axis,
                                                std::span<const SeenRig> off_axis,
                                                EngineConeLaw written);

}  // namespace lightcal
