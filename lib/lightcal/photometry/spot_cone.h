// SPDX-License-Identifier: Apache-2.0
// Spot lights: the angular attenuation engines give them and the flux it really carries.
// Half angles everywhere (see solid_angle.h): i inner, o outer, ci = cos i, co = cos o.
#pragma once

#include "lightcal/core/units.h"
#include "lightcal/core/vec3.h"

namespace lightcal {

// Full intensity inside `inner`, none outside `outer`. Holds for 0 <= inner <= outer <= pi,
// outer > 0; an inner angle beyond outer counts as outer, equal angles make a hard edge.
struct SpotCone {
  Radians inner{0.0};
  Radians outer{0.0};
};

// How intensity falls between inner and outer, with t = clamp((cos theta - co)/(ci - co), 0, 1).
enum class SpotFalloff {
  kHard,           // 1 inside outer; inner is ignored
  kLinear,         // t
  kSquaredLinear,  // t^2: Frostbite, Filament, glTF
  kSmoothstep,     // t^2 (3 - 2t): three.js, pbrt
};

// Relative intensity at an angle from the axis, 0..1.   Sources: glTF KHR_lights_punctual; Lagarde
// & de Rousiers 2014, 4.7.
[[nodiscard]] double SpotAttenuation(Radians from_axis, const SpotCone& cone, SpotFalloff falloff);

// Angle between a lamp's aim and the direction from the lamp to a point; any lengths above 0.
// atan2 of cross and dot product: exact near 0 and pi, where acos loses half the digits.
[[nodiscard]] Radians AngleFromAim(const Vec3& aim, const Vec3& lamp_to_point);

// Flux per candela of axial intensity, the integral of the attenuation over the sphere [sr]:
//   hard             2 pi (1 - co)
//   squared linear   2 pi [(1 - ci) + (ci - co)/3]
//   linear           2 pi [(1 - ci) + (ci - co)/2]
//   smoothstep       2 pi [(1 - ci) + (ci - co)/2]
// 2 pi (1 - co) for a squared penumbra would be three times too much at inner = 0.
[[nodiscard]] Steradians SolidAngleOfSpot(const SpotCone& cone, SpotFalloff falloff);
[[nodiscard]] Lumens FluxOfSpot(Candela axial, const SpotCone& cone, SpotFalloff falloff);
[[nodiscard]] Candela AxialCandelaOfSpot(Lumens flux, const SpotCone& cone, SpotFalloff falloff);

// The convention of user interfaces in which turning a spot's angle leaves its brightness alone:
//   Phi = pi I, whatever the cone.   Source: Lagarde & de Rousiers 2014; Filament SPOT, Godot.
// As physics it is true only of a hard cone of 60 degrees half angle or of a Lambertian lobe.
[[nodiscard]] Lumens FluxOfSpotByPiConvention(Candela axial);

}  // namespace lightcal
