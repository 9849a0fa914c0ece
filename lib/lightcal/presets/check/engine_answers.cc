// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/check/engine_answers.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/presets/check/parity.h"
#include "lightcal/presets/check/read_preset.h"
#include "lightcal/presets/preset_table.h"

namespace lightcal {
namespace {

constexpr int kDigits = 5, kColorDigits = 4;

// ---- the number to type in ----

// Zeros behind the point say nothing.
std::string WithoutZeros(std::string text) {
  if (text.find('.') == std::string::npos || text.find('e') != std::string::npos) return text;
  while (text.ends_with('0')) text.pop_back();
  if (text.ends_with('.')) text.pop_back();
  return text;
}

std::string TextOf(const DerivedField& field, int digits, double factor = 1.0) {
  constexpr std::size_t kChannels = 3;  // a fourth is an opaque alpha
  std::string text;
  for (std::size_t i = 0; i < std::min(field.values.size(), kChannels); ++i) {
    text += (i == 0 ? "" : ", ") + WithoutZeros(RoundedText(factor * field.values[i], digits));
  }
  return text;
}

void Append(std::string_view text, std::string_view by, std::string& to) {
  to.append(to.empty() || text.empty() ? "" : by).append(text);
}

void PutNotes(const PresetTarget& engine, const DerivedLight& light, EngineFigure& figure) {
  for (const TypedNote& row : engine.notes) {
    const DerivedField* field = light.Find(row.field);
    if (field == nullptr) continue;
    const std::string value =
        row.shows_number ? TextOf(*field, kColorDigits, row.factor) + std::string(row.after)
                         : std::string(row.after);
    const std::string text = std::string(row.before) + value;
    if (row.part == TypedPart::kColor) figure.color = value;
    if (row.part == TypedPart::kTemperature) figure.kelvin = value;
    if (row.part == TypedPart::kSize) figure.size = text;
    if (row.part == TypedPart::kFile) figure.file = ".ies";
    if (row.part == TypedPart::kEarlierVersions) figure.before = text;
    if (row.part == TypedPart::kWith) figure.with = text;
    if (row.part == TypedPart::kCone) Append(text, ", ", figure.cone);
    Append(text, "; ", figure.note);
  }
  Append(light.substitution, "; ", figure.note);
}

// Where its light starts, if that shows in the nearest reading.
std::string PlaceText(const FittedLight& lamp) {
  constexpr double kShows = 0.05;
  const double nearest_m = std::min(1.0, NearestRead_m(lamp).value_or(1.0));
  const double offset_m = EffectiveOffset_m(lamp);
  if (2.0 * std::abs(offset_m) < kShows * nearest_m) return "";
  return "stands " + RoundedText(100.0 * std::abs(offset_m), 2) + " cm " +
         (offset_m > 0.0 ? "behind" : "before") + " the point its distances were measured from";
}

void AddFigure(const std::string& lamp, const PresetTarget& engine, const DerivedLight& light,
               std::vector<EngineFigure>& figures) {
  for (const TypedNumber& row : engine.numbers) {
    const DerivedField* field = light.Find(row.field);
    if (field == nullptr || !(row.type.empty() || row.type == light.type)) continue;
    EngineFigure figure;
    figure.light = lamp;
    figure.engine = engine.title;
    figure.field = light.type + " · " + std::string(row.label);
    figure.value = TextOf(*field, kDigits);
    figure.unit = row.unit;
    PutNotes(engine, light, figure);
    figures.push_back(std::move(figure));
    return;
  }
}

// What any engine that takes candela or lux gets while its colour stays white.
void AddWhite(const FittedLight& lamp, std::vector<EngineFigure>& figures) {
  LightFile alone;
  alone.lights = {lamp};
  Warnings said_by_export;
  const auto punctual = PunctualLightsFrom(alone, said_by_export);
  if (!punctual) return;
  const PunctualLight& light = punctual->front();
  const std::string unit = light.type == PunctualType::kDirectional ? "lx" : "cd";
  EngineFigure figure;
  figure.light = lamp.name;
  figure.engine = "Any engine";
  figure.field = "colour left white";
  figure.value = RoundedText(light.photometric, kDigits);
  figure.unit = unit;
  figure.note = light.substitution;
  figures.push_back(std::move(figure));
}

// ---- all engines ----

std::vector<EngineLight> ReadBack(const PresetTarget& engine, const Preset& preset) {
  const auto beside = [&](const std::string& name) -> Result<std::string> {
    const auto file = std::ranges::find(preset.files, name, &PresetFile::name);
    if (file == preset.files.end()) return Failed("not_found", name, "is not in the preset");
    return file->contents;
  };
  for (const PresetFile& file : preset.files) {
    if (!file.name.ends_with(engine.ending)) continue;
    auto lights = LightsOfPreset(file.name, file.contents, beside);
    if (lights) return *std::move(lights);
  }
  return {};
}

using Pictures = std::vector<std::shared_ptr<const EnvironmentPicture>>;

std::vector<EngineExport> ExportsOf(const LightFile& lights, const Pictures& environments) {
  std::vector<EngineExport> all;
  const bool any_picture =
      std::ranges::any_of(environments, [](const auto& picture) { return picture != nullptr; });
  for (const PresetTarget* engine : ReportTargets()) {
    PresetOptions options;
    if (engine->emission != nullptr) options.written = Written::kFigures;
    auto preset = engine->exporter(lights, "report", options);
    if (!preset || preset->derived.size() != lights.lights.size()) continue;
    EngineExport one{engine, std::move(preset->derived), {}};
    if (engine->emission == nullptr) one.read_back = ReadBack(*engine, *preset);
    if (any_picture) {  // what is typed in is that of the pictures
      PresetOptions with_pictures;
      with_pictures.environments = environments;
      with_pictures.written = Written::kFigures;
      auto pictured = engine->exporter(lights, "report", with_pictures);
      if (pictured && pictured->derived.size() == one.derived.size()) {
        one.derived = std::move(pictured->derived);
      }
    }
    all.push_back(std::move(one));
  }
  return all;
}

}  // namespace

EngineAnswers EngineAnswersOf(const LightFile& lights, const Pictures& environments) {
  const std::vector<EngineExport> exports = ExportsOf(lights, environments);
  EngineAnswers answers;
  for (std::size_t i = 0; i < lights.lights.size(); ++i) {
    const FittedLight& lamp = lights.lights[i];
    const std::size_t first = answers.figures.size();
    AddWhite(lamp, answers.figures);
    for (const EngineExport& exported : exports) {
      AddFigure(lamp.name, *exported.engine, exported.derived[i], answers.figures);
    }
    const std::string place = PlaceText(lamp);
    for (std::size_t own = first; own < answers.figures.size(); ++own) {
      answers.figures[own].place = place;
      Append(place, "; ", answers.figures[own].note);
    }
  }
  answers.parity = ParityOf(lights, exports, environments);
  return answers;
}

}  // namespace lightcal
