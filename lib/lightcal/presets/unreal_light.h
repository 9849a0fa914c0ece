// SPDX-License-Identifier: Apache-2.0
// The numbers a light has in Unreal Engine 5: what unreal.cc writes to both of its files.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "lightcal/core/vec3.h"
#include "lightcal/presets/derived_light.h"
#include "lightcal/presets/falloff_refit.h"
#include "lightcal/presets/preset_light.h"

namespace lightcal {

inline constexpr EngineForms kUnrealForms = {
    .sphere = true, .rect = true, .table = true, .pictured_dome = true};

// Engine lights without a range get this; the editor's slider ends here.
inline constexpr Metres kUnrealFarRange{163.84};

inline constexpr EngineFalloff kUnrealFalloff{&UnrealFalloff};

struct UnrealLight {
  DerivedLight
      derived;  // type "PointLight", "SpotLight", "RectLight", "DirectionalLight", "SkyLight"
  bool use_temperature = false;  // else the colour is baked into 8 bits, whose luminance is known
  int color_srgb8[3] = {255, 255, 255};
};

// Intensity is cd, lx of a directional light; lengths cm. A source on the Planckian locus (|Duv|
// below .001, 1000 to 15000 K) in Rec. 709 takes the engine's temperature, whose colour has
// luminance 1; any other takes LightColor, an 8-bit sRGB colour, and intensity/Y of what those 8
// bits hold.   Source: Unreal 5.6 LightComponent, MakeFromColorTemperature.
[[nodiscard]] UnrealLight UnrealLightFrom(const PresetLight& light, const FalloffRefit& refit,
                                          Warnings& warnings);

// Inner and outer angle [degrees] of that cone, the engine's own law (kSquared), as far as it goes.
[[nodiscard]] std::array<double, 2> UnrealAnglesOf(const SpotCone& cone);
// Inner and outer angle [degrees] of a spot that shows this lamp: its cone; of a face the nearest
// one; else the widest, for a cone cuts what shines all round or has a photometric file.
[[nodiscard]] std::array<double, 2> UnrealSpotOf(const PresetLight& light);

// Unreal's FRotator [degrees] of the object whose forward (+X), right (+Y) and up (+Z) axes point
// along these unit vectors of Unreal's world:
//   forward = (cos p cos y, cos p sin y, sin p),  right_z = -sin r cos p,  up_z = cos r cos p
// Straight up or down (cos p = 0) takes yaw 0.   Source: FRotationMatrix of the engine's API.
struct UnrealRotator {
  double pitch_deg = 0.0, yaw_deg = 0.0, roll_deg = 0.0;
};
[[nodiscard]] UnrealRotator UnrealRotatorFromAxes(const Vec3& forward, const Vec3& right,
                                                  const Vec3& up);

}  // namespace lightcal
