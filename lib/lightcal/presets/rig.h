// SPDX-License-Identifier: Apache-2.0
// The exposed rig that goes with a preset: a white and an 18 % card where a reading was taken, a
// camera that looks at them, and the exposure that shows them as they should look.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "lightcal/core/units.h"
#include "lightcal/core/vec3.h"
#include "lightcal/presets/preset_light.h"
#include "lightcal/presets/punctual_light.h"

namespace lightcal {

// A square matt card; Z up, metres. Its normal points to the lamp. illuminance is what all lights
// of the preset cast on its centre, by_light what each does; luminance = reflectance *
// illuminance/pi.
struct RigCard {
  std::string name;
  double reflectance = 0.0;
  Vec3 centre_m{};
  Lux illuminance{0.0};
  std::vector<Lux> by_light;
  Nits luminance{0.0};
};

struct RigCamera {
  Vec3 position_m{};
  Vec3 target_m{};
  Vec3 up{};  // unit, perpendicular to the view
  Radians vertical_fov{0.5};
  double aspect_ratio = 1.5;
};

// Pixel = luminance * scale, with a perfect white card (reflectance 1) at 1.0, so that the 90 %
// card reads 0.9 and the 18 % card 0.18 in linear light:
//   scale = pi/E       2^ev100 = 1/(scale L1),  L1 = 78/(q 100) = 1.2 (ISO 12232, q = 0.65)
struct RigExposure {
  double ev100 = 0.0;
  double scale = 1.0;
};

struct Rig {
  std::string light;           // whose reading the cards stand at
  Metres distance{1.0};        // of that reading from the lamp's reference point
  Metres separation{1.0};      // from the effective source: distance + EffectiveOffset_m
  bool from_reading = false;   // false: no reading had a distance; 1 m was taken
  Vec3 normal{0.0, 0.0, 1.0};  // of both cards
  Vec3 row{1.0, 0.0, 0.0};     // from the white card to the grey one
  Metres side{0.1};
  RigPlace place{};
  std::array<RigCard, 2> cards;  // white, grey
  RigCamera camera;
  RigExposure exposure;
};

inline constexpr double kWhiteCardReflectance = 0.9;
inline constexpr double kGreyCardReflectance = 0.18;

// The cards stand on the axis of the first light with a used reading at a distance (the median
// one), else of the first light at 1 m. Their sides are a tenth of that, at most 0.2 m, and within
// a quarter of the cone. `lights` are those of `file`, in order, at least one.
[[nodiscard]] Rig BuildRig(const LightFile& file, std::span<const PunctualLight> lights,
                           const RigPlace& place = {});
// The same place, or off the axis (of a spot then so small that its penumbra is even across them);
// illuminance and exposure are those of the forms the engine is given.
[[nodiscard]] Rig BuildRig(const LightFile& file, std::span<const PresetLight> lights,
                           const RigPlace& place = {});

// Refused: rig_place (a light from far away has no axis to stand off; the cards would be dark),
// unknown_light.
[[nodiscard]] Result<void> CheckRigPlace(const LightFile& file, const Rig& rig);

// A card's corners, counter-clockwise seen from the lamp, the first at minus row and lowest.
[[nodiscard]] std::array<Vec3, 4> CornersOf(const Rig& rig, const RigCard& card);

}  // namespace lightcal
