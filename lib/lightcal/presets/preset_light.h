// SPDX-License-Identifier: Apache-2.0
// A fitted lamp in every quantity an engine may ask for, in the form that engine has for it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/core/units.h"
#include "lightcal/light/intensity_table.h"
#include "lightcal/light/lamp_axes.h"
#include "lightcal/presets/engine_cone.h"
#include "lightcal/presets/preset.h"
#include "lightcal/presets/projected_spot.h"
#include "lightcal/presets/punctual_light.h"

namespace lightcal {

// What an engine is given. The first three every engine has.
enum class LightForm : std::uint8_t {
  kPoint,
  kSpot,
  kDirectional,
  kSphere,
  kDisk,
  kRect,
  kTube,
  kTable,  // a photometric file
  kDome,   // one luminance from every direction, or a picture
};

// The forms an engine has beside point, spot and directional light, and how its spots fall off.
struct EngineForms {
  bool sphere = false, disk = false, rect = false, tube = false, table = false, dome = false;
  bool pictured_dome = false;  // a dome that has a picture; an even one is a light from above
  EngineConeLaw cone = EngineConeLaw::kSquared;
  bool round_tables = false;    // of a table it shows the mean round the aim (RoundAboutAim)
  bool projects_spots = false;  // SpotForm::kAuto may put a picture before a spot
  bool spots_by_table = false;  // its tables are absolute wherever it runs: SpotForm::kAuto may
};

// The lamp itself, whatever engines make of it.
inline constexpr EngineForms kEveryForm{
    .sphere = true, .disk = true, .rect = true, .tube = true, .table = true, .dome = true};

// All photometric values are those the engine must emit, before the division by color.luminance
// that a max-normalised colour needs:
//   candela  axial intensity [cd]; of a table its peak, wherever that is
//   lux      on a plane that faces a directional light, or under a dome
//   nits     of an area form, L = I/A with A its area seen along the axis (sphere, disk pi r^2,
//            rect w h, tube 2 r l); of a dome; of the disc a directional light shines from,
//            E/(pi sin^2(a/2)), where its angular diameter a is known
//   lumens   flux of that form: point and sphere 4 pi I, flat pi I, tube pi^2 I, spot by the
//            squared-linear profile, tables by their own integral
// 0 where there is no such quantity.
struct PresetLight {
  PunctualLight punctual;  // the same lamp as a point, spot or directional light; position, colour
  LightForm form = LightForm::kPoint;
  std::string substitution;  // what this form does otherwise than the lamp; "" = nothing
  double strays = 0.0;       // as `substitution` has it, of the axial intensity; 0: not said
  LampAxes axes;             // c0: width and a tube's length run along it; c90: height
  double candela = 0.0, lux = 0.0, nits = 0.0, lumens = 0.0;
  std::optional<double> relative_u95;  // of all of these
  double width_m = 0.0, height_m = 0.0, radius_m = 0.0, length_m = 0.0;
  std::optional<double> angular_diameter_deg;  // directional
  std::optional<IntensityTable> table;         // form kTable; absolute candela; as it is shown
  // Of a spot or a measured beam: what is to be shown, and the engine's own cone nearest to it.
  std::optional<BeamProfile> beam;
  EngineCone cone;
  std::optional<ProjectedSpot> projected{};  // shown instead of that cone, of a squared beam
  std::shared_ptr<const EnvironmentPicture> environment{};  // form kDome; null = an even one
  // Of a renderer that turns pictures: what it shows of `environment`; null = that itself.
  std::shared_ptr<const EnvironmentPicture> shown{};
  // What the renderer multiplies with: all values above are divided by it already.
  double engine_factor = 1.0;

  [[nodiscard]] const std::string& name() const { return punctual.name; }
  [[nodiscard]] const EmittedColor& color() const { return punctual.color; }
  [[nodiscard]] const Vec3& position_m() const { return punctual.position_m; }
  [[nodiscard]] const Vec3& aim() const { return axes.aim; }
};

// The lamps of a file, in order. A kind the engine has no form for, or whose size nobody stated,
// becomes a disk -> square of its area, else what PunctualLightsFrom makes of it; either way with
// the warning `substituted`. Of a spot whose engine has another cone law the angles are refitted
// (engine_cone.h) and the rest is warned (cone_profile).   Refuses and fails as PunctualLightsFrom.
[[nodiscard]] Result<std::vector<PresetLight>> PresetLightsFrom(const LightFile& file,
                                                                const EngineForms& forms,
                                                                const PresetOptions& options,
                                                                Warnings& warnings);

// Illuminance at a point on a surface of unit normal `normal`, by the law of the light's form (near
// field of area forms included) and the renderer's factor.
[[nodiscard]] Lux IlluminanceAt(const PresetLight& light, const Vec3& point, const Vec3& normal);

}  // namespace lightcal
