// SPDX-License-Identifier: Apache-2.0
// A fitted lamp as the point, spot or directional light that engines share.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/core/units.h"
#include "lightcal/core/vec3.h"
#include "lightcal/photometry/spot_cone.h"
#include "lightcal/presets/light_color.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal {

enum class PunctualType : std::uint8_t { kPoint, kSpot, kDirectional };

// Right-handed, Z up, metres. `photometric` is the axial luminous intensity [cd] of a point or spot
// and the illuminance [lx] of a directional light on a plane that faces it.
//   intensity = photometric / color.luminance       what an engine with a max-normalised colour
//   gets
// position_m is the effective source: d0 behind the point distances were measured from, along the
// aim, so that the engine's plain 1/d^2 is the fitted I/(d + d0)^2. A lamp without an aim shines
// all round; it stays where it is (its d0 is a radius), and aim is straight down by convention.
struct PunctualLight {
  std::string name;
  LightKind kind = LightKind::kPoint;
  PunctualType type = PunctualType::kPoint;
  double photometric = 0.0;
  std::optional<double> photometric_u95;
  double intensity = 0.0;
  std::optional<double> intensity_u95;  // with the colour's share, in quadrature
  SpotCone cone;                        // spot: 0 <= inner < outer <= pi/2
  Vec3 position_m{};
  Vec3 aim{0.0, 0.0, -1.0};
  EmittedColor color;
  std::string substitution;  // what the engine's light does otherwise than the lamp; "" = nothing
  double strays = 0.0;       // as `substitution` has it, of the axial intensity; 0: not said
};

// Cosine of the inner angle of a 90-degree spot whose squared-linear falloff strays least from a
// Lambertian lobe: with t = cos/ci clamped, max|t^2 - cos| is 1 - ci at the inner angle and ci^2/4
// beyond; equal at ci = 2 sqrt(2) - 2, where both are 17.2 % of the axial intensity. Flux -10.5 %.
inline constexpr double kLambertianInnerCosine = 0.8284271247461903;

// A spot whose cone nobody told: engines get a point of its axial intensity (cone_unknown).
[[nodiscard]] bool IsSpotWithoutCone(const FittedLight& lamp);

// Kinds without a punctual counterpart become the nearest one with the warning `substituted`:
//   sphere       point            same beyond its surface; hard shadows
//   tube         point            along its axis too bright, flux +27 %
//   disk, rect   90-degree spot   axial intensity kept, see kLambertianInnerCosine
//   photometric  the nearest spot or point (table_cone.h): axial intensity kept
//   dome         directional, straight down: right on upward surfaces only
// A spot without a measured cone becomes a point (cone_unknown). A missing position is the origin
// (position_unknown, said once a file with several lights).
[[nodiscard]] Result<std::vector<PunctualLight>> PunctualLightsFrom(const LightFile& file,
                                                                    Warnings& warnings,
                                                                    const ColorTarget& color = {});

// From the point distances were measured from to the effective source: d0, and the radius that the
// fit added before it (SurfaceRadius_m). 0 for lights at infinity.
[[nodiscard]] double EffectiveOffset_m(const FittedLight& lamp);
// The least distance of its readings that count; absent where none says one.
[[nodiscard]] std::optional<double> NearestRead_m(const FittedLight& lamp);

// Illuminance of one light at a point on a surface of unit normal `normal`, by the glTF law:
//   E = photometric * attenuation(angle) * max(0, cos incidence) / d^2,  or photometric * cos.
[[nodiscard]] Lux IlluminanceAt(const PunctualLight& light, const Vec3& point, const Vec3& normal);

}  // namespace lightcal
