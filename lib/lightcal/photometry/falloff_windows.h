// SPDX-License-Identifier: Apache-2.0
// How engines let a punctual light fall off: illuminance per candela [1/m^2] at distance d with the
// engine's range r. Nature's is 1/d^2; the rest is what a preset has to be refitted in.
//
// Window: w = clamp(1 - (d/r)^4, 0, 1), 0 from d = r on. Every law here is finite and defined for
// every d (|d| is used) and every r: r <= 0 or infinite means no range, w = 1, as Filament and
// three.js treat 0. A tiny range makes the light vanish.
#pragma once

#include <limits>

#include "lightcal/core/units.h"

namespace lightcal {

inline constexpr Metres kNoRange{std::numeric_limits<double>::infinity()};

// w itself, not squared.
[[nodiscard]] double RangeWindow(Metres d, Metres r);

// w^2 / max(d^2, 1 cm^2).             Source: Filament surface_light_punctual.fs.
[[nodiscard]] double FilamentFalloff(Metres d, Metres r);
// w^2 min(1/d, 100)^2; with range attenuation off a step to 0 at d = r.
// Source: Unity render-pipelines core, SmoothWindowedDistanceAttenuation.
[[nodiscard]] double UnityHdrpFalloff(Metres d, Metres r, bool range_attenuation = true);
// w^2 / max(d^decay, 0.01): for decay 2 the light is clamped below 10 cm.
// Source: three.js lights_pars_begin, getDistanceAttenuation.
[[nodiscard]] double ThreeJsFalloff(Metres d, Metres r, double decay = 2.0);
// w^2 max(d, 0.1 mm)^-decay. The engine's default decay is 1; a preset must say 2.
// Source: Godot scene_forward_lights_inc.glsl, get_omni_attenuation.
[[nodiscard]] double GodotFalloff(Metres d, Metres r, double decay = 2.0);
// w / d^2, the window not squared; d below 0.1 mm counts as 0.1 mm so that it stays finite.
// Source: KHR_lights_punctual, "range property".
[[nodiscard]] double GltfFalloff(Metres d, Metres r);
// w^2 / (d^2 + 1 cm^2). In metres the 1 would be 1 m^2: half the light at 1 m.   Source: Karis,
// Real Shading in Unreal Engine 4 (2013), eq. 9, in centimetres.
[[nodiscard]] double UnrealFalloff(Metres d, Metres r);

// Smallest range r that takes at most `loss` (0 < loss < 1) from a light at d_max:
//   squared window  r = d_max (1 - sqrt(1 - loss))^(-1/4)     3.76 d_max for 1 %
//   plain window    r = d_max loss^(-1/4)                     3.16 d_max for 1 %
enum class WindowPower { kPlain, kSquared };
[[nodiscard]] Metres RangeForLoss(Metres d_max, double loss, WindowPower power);

}  // namespace lightcal
