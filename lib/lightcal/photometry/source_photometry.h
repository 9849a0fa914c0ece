// SPDX-License-Identifier: Apache-2.0
// One lamp, every photometric quantity of it: flux <-> axial intensity <-> luminance <-> exitance
// <-> illuminance at a distance, for each kind of light.
#pragma once

#include <optional>

#include "lightcal/core/result.h"
#include "lightcal/core/units.h"
#include "lightcal/photometry/light_kind.h"
#include "lightcal/photometry/spot_cone.h"

namespace lightcal {

// How a spot's lumens are meant: the integral of its attenuation, or pi I (spot_cone.h).
enum class SpotFlux { kIntegral, kPiConvention };

// Size and distance; what a kind does not need is ignored.
struct SourceGeometry {
  LightKind kind = LightKind::kPoint;
  std::optional<Metres> radius;         // sphere, disk, tube
  std::optional<Metres> width, height;  // rect
  std::optional<Metres> length;         // tube
  std::optional<SpotCone> cone;         // spot; half angles
  SpotFalloff falloff = SpotFalloff::kSquaredLinear;
  SpotFlux spot_flux = SpotFlux::kIntegral;
  std::optional<Radians> angular_radius;  // directional: half the angle the sun disk spans
  std::optional<Metres> distance;         // source (sphere: its centre) to a receiver facing it
};

enum class SourceQuantity { kFlux, kIntensity, kLuminance, kExitance, kIlluminance };

// The quantities this kind and geometry define; the others are absent. Intensity is axial and of
// the far field; luminance and exitance are the source's own.
//   kind         Phi/I            L/I              E/I at d
//   point        4 pi             -                1/d^2
//   spot         SolidAngleOfSpot -                1/d^2
//   sphere       4 pi             1/(pi R^2)       1/d^2 exactly
//   disk         pi               1/(pi R^2)       1/(d^2 + R^2)
//   rect         pi               1/(w h)          LuxPerNitOfRect/(w h)
//    of one side 0  pi            -                LuxPerCandelaOfLine
//   tube         pi^2             1/(2 R l)        LuxPerNitOfTube/(2 R l)     mantle only, square
//   on directional  -                L = E/(pi sin^2 a), a the angular radius     E at any distance
//   dome         -                L = E/pi                                     E at any distance
// M = pi L throughout.
struct SourcePhotometry {
  std::optional<Lumens> flux;
  std::optional<Candela> intensity;
  std::optional<Nits> luminance;
  std::optional<LumensPerSquareMetre> exitance;
  std::optional<Lux> illuminance;
};

// All of them from one. Fails:
//   usage: a size or distance this conversion needs is missing, or the kind has no such quantity (a
//     directional light has no lumens; a photometric light has a file instead);
//   refused: "not_positive" (the value is not above 0, a size or distance is not), "inside_source"
//     (distance <= radius of a sphere or tube), "bad_cone" (outer not in 0..180 degrees, inner
//     negative), "bad_angle", "out_of_range" (an answer no double holds).
[[nodiscard]] Result<SourcePhotometry> ConvertSource(const SourceGeometry& geometry,
                                                     SourceQuantity given, double value);

}  // namespace lightcal
