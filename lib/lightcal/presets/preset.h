// SPDX-License-Identifier: Apache-2.0
// What an exporter gets and what it gives: a pure function from fitted lights to the text of files.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/progress.h"
#include "lightcal/core/result.h"
#include "lightcal/core/units.h"
#include "lightcal/presets/derived_light.h"
#include "lightcal/presets/environment_picture.h"
#include "lightcal/presets/learnt_engine.h"
#include "lightcal/presets/light_color.h"
#include "lightcal/presets/usd_readings.h"
#include "lightcal/records/control_sweep.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal {

// How spots and measured beams are written where the engine has more than a cone.
enum class SpotForm : std::uint8_t {
  kAuto,  // its IES light or a projected profile where its own cone strays over kConeGoodEnough
  kIes,   // always that, where the engine has it
  kCone,  // never
};
inline constexpr double kConeGoodEnough = 0.03;  // of the axial intensity

// The figures of a lamp go onto the lights of this name in a person's scene: * any letters, ? one;
// for USD the path of one prim.
struct IntoRow {
  std::string lamp;
  std::string object;
};

// Where a rig's cards stand, at the distance of the reading and facing the lamp: so far off its
// axis, and round it from its width (C0) to its height (C90). Of a dome: the way they face, from
// above and then from the picture's middle to its right. light: before which lamp; "" = the first
// that was read at a distance.
struct RigPlace {
  double off_axis_deg = 0.0, round_deg = 0.0;
  std::string light{};

  [[nodiscard]] bool OnAxis() const { return off_axis_deg == 0.0; }
};

// What of a preset is written out; files of the rest are named and stay empty.
enum class Written : std::uint8_t {
  kAll,
  kNoPictures,
  kFigures,  // no file at all: what is derived, for whoever asks for no more
};

struct PresetOptions {
  // false: the lights alone, which touch nothing else in the scene they come into. true: the rig,
  // <stem>.rig.<ending>: the lights with cards, camera and exposure in a scene of its own.
  bool rig = false;
  RigPlace rig_place{};               // of that rig
  std::vector<RigPlace> more_rigs{};  // ExportPresets: rigs beside it, <stem>.rig[_<light>][_<angle>].<ending>
  // Not empty: nothing is made; what is written sets lights that are there.
  std::vector<IntoRow> into{};
  ColorTarget color{};  // the space the engine works in, and what its pipeline calls white
  // The range the person wants (their engine culls lights by it); absent = so far that it is none.
  std::optional<Metres> range{};
  SpotForm spots = SpotForm::kAuto;
  // The pictures that domes name, one a light (null = none), or none at all: then domes are even.
  std::vector<std::shared_ptr<const EnvironmentPicture>> environments{};
  UsdReading usd_reading = UsdReading::kSpec;  // the variant a .usda opens with
  // What the renderer makes of each kind: undone in every number that engines are given.
  std::shared_ptr<const LearntEngine> engine{};
  // What the lights' controls do, for engines that can turn them; empty: they are as they stand.
  // ExportPresets finds them out where there are none.
  std::vector<ControlSweep> sweeps{};
  Written written = Written::kAll;
  Progress progress{};  // of all that is written, target by target
};

struct PresetFile {
  std::string name;  // "<stem>.gltf", relative to the output directory
  std::string contents;
};

struct Preset {
  std::vector<PresetFile> files;
  Warnings warnings;  // color_unknown, out_of_gamut, substituted, position_unknown, ...
  std::vector<DerivedLight> derived{};  // one a light, for audit
  // One line to paste that opens the files in their program, with kPasteDirectory where the output
  // directory belongs; "" = nothing to say.
  std::string paste{};
};

inline constexpr std::string_view kPasteDirectory = "%DIR%";

// Same input, same bytes. Refused: no_intensity, no_illuminance (a light without the figure its
// kind is exported by), no_lights. Fails: not_finite.
using Exporter = Result<Preset>(const LightFile& lights, const std::string& stem,
                                const PresetOptions& options);

}  // namespace lightcal
