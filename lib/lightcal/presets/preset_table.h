// SPDX-License-Identifier: Apache-2.0
// Every target lightcal can export to, and all that the house knows of an engine: a new one is one
// file in this room and one row here.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/colorimetry/rgb_spaces.h"
#include "lightcal/core/units.h"
#include "lightcal/presets/check/engine_light.h"
#include "lightcal/presets/emission.h"
#include "lightcal/presets/engine_cone.h"
#include "lightcal/presets/preset.h"

namespace lightcal {

// The field of an exported light that is its brightness: of the first row whose type ("" = any) and
// field fit.
struct TypedNumber {
  std::string_view type, field, label, unit;
};
// What must be set with it: a field of the exported light, `factor` times as large where people see
// another unit than files have.
enum class TypedPart : std::uint8_t {
  kOther,
  kColor,
  kTemperature,
  kSize,
  kCone,
  kWith,
  kFile,
  kEarlierVersions
};
struct TypedNote {
  std::string_view field, before, after;
  bool shows_number = true;
  TypedPart part = TypedPart::kOther;
  double factor = 1.0;
};

// What a sample of a linear picture (EXR) stands for.
enum class PixelUnit { kExposed, kNits, kWatts };

// A program that renders the files, by the word people call it.
struct Renderer {
  std::string_view word;
  PixelUnit linear_pixels = PixelUnit::kExposed;
};

// What a program makes of a Kelvin setting.
struct KelvinSetting {
  std::string_view key;    // "unreal_rgb", of documents
  std::string_view label;  // "Unreal's linear RGB at this CCT"
  Rgb (*color)(Kelvin) = nullptr;
  std::string_view krystek{};  // its name where the setting is on Krystek's locus
};

// How an engine lights a matt surface with a panorama.
enum class PanoramaLaw : std::uint8_t {
  kNotKnown,
  kTraced,        // the integral of the picture itself
  kNineHarmonics  // of its harmonics to the second order: a sun left inside is up to a quarter off
};

struct PresetTarget {
  std::string_view name;  // the word it is asked for by
  Exporter* exporter;
  std::string_view verified;   // how the output was checked, for people
  bool into_scene = false;     // sets lights that are there (PresetOptions::into)
  bool only_if_named = false;  // left out where all targets are meant

  // The file that is read back: "" = none is.
  std::string_view ending{};
  PresetReader* reader = nullptr;

  // In reports, from 1 on in the order people look for engines; 0 = not there.
  int place_in_report = 0;
  std::string_view title{};  // "Unreal Engine"
  PanoramaLaw panorama = PanoramaLaw::kNotKnown;
  EmissionLaw* emission = nullptr;  // absent: what the file says that is read back
  // The law that the two angles of its spots are written for, where they can be written for
  // another, too (learnt_engine.h); absent: spots have no such angles, or several.
  std::optional<EngineConeLaw> cone{};
  std::span<const TypedNumber> numbers{};
  std::span<const TypedNote> notes{};

  std::span<const Renderer> renderers{};
  std::optional<KelvinSetting> kelvin{};
};

[[nodiscard]] std::span<const PresetTarget> PresetTargets();

// The row of that name. Wrong usage when there is none; the message names the nearest.
[[nodiscard]] Result<PresetTarget> FindPresetTarget(std::string_view name);

// The row whose files end like this and are read back; null = none.
[[nodiscard]] const PresetTarget* TargetOfFile(std::string_view path);

// ".gltf, .tscn, ...": the endings of files that are read back.
[[nodiscard]] std::string ReadableEndings(std::string_view between = ", ");

// What a linear picture of that renderer holds.
[[nodiscard]] PixelUnit LinearPixelsOf(std::string_view renderer);

// Those of reports, in their order.
[[nodiscard]] std::vector<const PresetTarget*> ReportTargets();

}  // namespace lightcal
