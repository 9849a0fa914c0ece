// SPDX-License-Identifier: Apache-2.0
// What an engine emits for the numbers that its file holds.
#pragma once

#include <optional>
#include <string_view>

#include "lightcal/light/axial_shape.h"
#include "lightcal/presets/check/engine_light.h"
#include "lightcal/presets/derived_light.h"
#include "lightcal/presets/falloff_refit.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal {

// A light as its engine has it: cd on the axis, or lux of one at infinity.
struct Emission {
  std::optional<double> candela{}, lux{};
  AxialShape shape{};
  std::optional<EngineFalloff> falloff{};  // absent: 1/d^2
  double range_m = 0.0;
  std::optional<ConeOfLaw> cone{};  // of a spot
  bool table = false;               // a photometric file: what was measured, in every direction
};

// `axial_part`: the lamp's intensity on its axis over that of its peak.
using EmissionLaw = Emission(const DerivedLight& light, LightKind kind, double axial_part);

// The first number of a field; 0 where there is none.
[[nodiscard]] double NumberIn(const DerivedLight& light, std::string_view field);

// Luminance of linear Rec. 709 in a field of three numbers.
[[nodiscard]] double LuminanceIn(const DerivedLight& light, std::string_view field);

// For renderers that take rgb of what is emitted, of these names for a light at infinity, a dome
// and an area; anything else is small. Sizes by the fields of PutSize.
struct PathTracerNames {
  std::string_view directional, dome, area;
};
[[nodiscard]] Emission EmittedByPathTracer(const DerivedLight& light, LightKind kind,
                                           double emitted, const PathTracerNames& names);

}  // namespace lightcal
