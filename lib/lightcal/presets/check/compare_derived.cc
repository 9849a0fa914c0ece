// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/check/compare_derived.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "lightcal/presets/preset_table.h"
#include "lightcal/records/json_codec.h"

namespace lightcal {
namespace {

using records::Node;

constexpr std::string_view kRefit = "falloff_intensity_factor";  // what a range of its own costs

// The pipeline's space and white, as any light of the file says them.
ColorTarget TargetIn(const Node& light) {
  ColorTarget target;
  const Node* color = light.Find("color");
  const Node* pipeline = color == nullptr ? nullptr : color->Find("pipeline_linear");
  if (pipeline == nullptr) return target;
  if (const Node* space = pipeline->Find("space")) {
    for (const RgbSpace known : kRgbSpaces) {
      if (RgbSpaceWord(known) == space->text) target.space = known;
    }
  }
  const Node* white = pipeline->Find("white_xy");
  if (white != nullptr && white->items.size() == 2) {
    target.white = Xy{white->items[0].number, white->items[1].number};
  }
  return target;
}

double ListedIn(const Node& light, std::string_view field) {
  const Node* number = light.Find(field);
  return number != nullptr && number->IsNumber() ? number->number : 0.0;
}

double RefitOf(const DerivedLight& light) {
  const auto note = std::ranges::find(light.notes, kRefit, &DerivedField::name);
  return note != light.notes.end() && !note->values.empty() ? note->values.front() : 1.0;
}

std::optional<DerivedOff> OffIn(const PresetTarget& target, const Node& listed,
                                const DerivedLight& derived, double max_error) {
  const Node* type = listed.Find("type");
  if (type == nullptr || type->text != derived.type) return std::nullopt;
  for (const TypedNumber& row : target.numbers) {
    const DerivedField* field = derived.Find(row.field);
    if (field == nullptr || !(row.type.empty() || row.type == derived.type)) continue;
    if (field->values.size() != 1 || !(field->values.front() > 0.0)) return std::nullopt;
    if (listed.Find(row.field) == nullptr) return std::nullopt;
    const double refit = ListedIn(listed, kRefit);
    const double here = ListedIn(listed, row.field) / (refit > 0.0 ? refit : 1.0);
    const double there = field->values.front() / RefitOf(derived);
    if (std::abs(here / there - 1.0) <= max_error) return std::nullopt;
    return DerivedOff{{}, std::string(target.name), std::string(row.field), here, there};
  }
  return std::nullopt;
}

}  // namespace

std::vector<DerivedOff> CompareDerived(const std::string& preset_json, const LightFile& lamps,
                                       double max_error) {
  std::vector<DerivedOff> off;
  const auto root = records::ParseJson(preset_json);
  const Node* lights = root && root->kind == Node::Kind::kTable ? root->Find("lights") : nullptr;
  if (lights == nullptr || lights->items.empty()) return off;
  PresetOptions options;
  options.written = Written::kFigures;
  options.color = TargetIn(lights->items.front());
  for (const PresetTarget& target : PresetTargets()) {
    if (target.numbers.empty()) continue;
    const auto preset = target.exporter(lamps, "fresh", options);
    if (!preset || preset->derived.size() != lamps.lights.size()) continue;
    for (const Node& light : lights->items) {
      const Node* name = light.Find("name");
      const Node* derived = light.Find("derived");
      const Node* listed = derived == nullptr ? nullptr : derived->Find(target.name);
      const auto lamp = name == nullptr
                            ? lamps.lights.end()
                            : std::ranges::find(lamps.lights, name->text, &FittedLight::name);
      if (listed == nullptr || lamp == lamps.lights.end() || lamp->environment) continue;
      const auto index = static_cast<std::size_t>(lamp - lamps.lights.begin());
      if (auto one = OffIn(target, *listed, preset->derived[index], max_error)) {
        one->light = lamp->name;
        off.push_back(*std::move(one));
      }
    }
  }
  return off;
}

}  // namespace lightcal
