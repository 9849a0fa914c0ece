// SPDX-License-Identifier: Apache-2.0
// The numbers a light has in KHR_lights_punctual: what gltf.cc writes and what json.cc lists under
// derived.gltf.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "lightcal/core/vec3.h"
#include "lightcal/presets/derived_light.h"
#include "lightcal/presets/engine_axes.h"
#include "lightcal/presets/falloff_refit.h"
#include "lightcal/presets/punctual_light.h"

namespace lightcal {

// glTF is right-handed, Y up; ours is right-handed, Z up: (x, y, z) -> (x, z, -y), a rotation by
// -90 degrees about X. Metres in both.
[[nodiscard]] constexpr Vec3 GltfFromZUp(const Vec3& v) { return DirectionIn(EngineAxes::kYUp, v); }

// Unit quaternion x, y, z, w.
using Quaternion = std::array<double, 4>;

// The shortest rotation that turns glTF's light axis -Z to the unit direction `forward` (already in
// glTF axes); half a turn about Y when forward is +Z.
[[nodiscard]] Quaternion RotationFromMinusZ(const Vec3& forward);
// The rotation whose columns are the unit, right-handed axes x, y, z (glTF axes).
[[nodiscard]] Quaternion RotationFromAxes(const Vec3& x, const Vec3& y, const Vec3& z);

// Far enough to be no window: (d/range)^4 is 1e-12 at 10 m. Left out, Filament would use 10 m.
inline constexpr double kGltfRange_m = 10000.0;

struct GltfLight {
  std::string_view type;   // "point", "spot", "directional"
  double intensity = 0.0;  // cd, lx for directional: divided by the colour's luminance
  std::optional<double> intensity_u95;
  std::array<double, 3> color{};                         // linear Rec. 709, max-normalised
  std::optional<double> range_m;                         // not for directional
  std::optional<double> inner_cone_rad, outer_cone_rad;  // half angles
  Vec3 translation{};
  Quaternion rotation{};
};
[[nodiscard]] GltfLight GltfLightFrom(const PunctualLight& light, const FalloffRefit& refit);

// The same for audit.
[[nodiscard]] DerivedLight DerivedGltf(const PunctualLight& light, const FalloffRefit& refit);

// Ranges and intensities in glTF's plain window; kGltfRange_m where nobody fixed a range.
[[nodiscard]] std::vector<FalloffRefit> RefitInGltf(const LightFile& file,
                                                    std::span<const PunctualLight> lights,
                                                    const PresetOptions& options,
                                                    Warnings& warnings);

}  // namespace lightcal
