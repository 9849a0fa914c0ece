// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/check/compare_derived.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include "lightcal/presets/check/rig_file.h"
#include "lightcal/presets/preset_table.h"
#include "lightcal/records/json_codec.h"

namespace lightcal {
namespace {

using records::Node;

// ---- leaves ----

// Beside a part's largest number the others may round.
double LargestOf(const Node& list) {
  double largest = 0.0;
  for (const Node& item : list.items) {
    if (item.IsNumber()) largest = std::max(largest, std::abs(item.number));
  }
  return largest;
}

class LeafComparison {
 public:
  LeafComparison(std::string light, std::string engine, double max_error)
      : light_(std::move(light)), engine_(std::move(engine)), max_error_(max_error) {}

  // Every number that both have; what one lacks is another version's.
  void Compare(const Node& listed, const Node& derived, const std::string& field, double of) {
    if (listed.IsNumber() && derived.IsNumber()) {
      constexpr double kNothing = 1e-6;
      const double allowed = max_error_ * std::max(std::abs(derived.number), of) + kNothing;
      if (std::abs(listed.number - derived.number) <= allowed) return;
      off_.push_back({light_, engine_, field, listed.number, derived.number});
      return;
    }
    for (const auto& [key, value] : derived.members) {
      const Node* there = listed.Find(key);
      if (there != nullptr) Compare(*there, value, field.empty() ? key : field + "." + key, 0.0);
    }
    const double largest = LargestOf(derived);
    for (std::size_t i = 0; i < std::min(listed.items.size(), derived.items.size()); ++i) {
      Compare(listed.items[i], derived.items[i], field + "[" + std::to_string(i) + "]", largest);
    }
  }
  [[nodiscard]] std::vector<DerivedOff> Take() { return std::move(off_); }

 private:
  std::string light_, engine_;
  double max_error_;
  std::vector<DerivedOff> off_;
};

void Append(std::vector<DerivedOff> more, std::vector<DerivedOff>& off) {
  off.insert(off.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

// A light in an engine, as something else in another form of spots.
bool IsOtherType(const Node& listed, const Node& derived) {
  const Node* one = listed.Find("type");
  const Node* other = derived.Find("type");
  return one != nullptr && other != nullptr && one->text != other->text;
}

std::vector<DerivedOff> OffOfLight(const Node& listed, const Node& derived, const std::string& name,
                                   double max_error) {
  std::vector<DerivedOff> off;
  for (const char* part : {"geometry", "color", "pre_exposed"}) {
    const Node* there = listed.Find(part);
    const Node* here = derived.Find(part);
    if (there == nullptr || here == nullptr) continue;
    Node own = *here;
    // A lamp is moved and turned where it is used; its readings say what that does.
    std::erase_if(own.members, [](const auto& member) {
      return member.key == "position_m" || member.key == "aim" || member.key == "axis";
    });
    LeafComparison leaves(name, part, max_error);
    leaves.Compare(*there, own, "", 0.0);
    Append(leaves.Take(), off);
  }
  const Node* there = listed.Find("derived");
  const Node* here = derived.Find("derived");
  if (there == nullptr || here == nullptr) return off;
  for (const auto& [engine, numbers] : here->members) {
    const Node* of_engine = there->Find(engine);
    if (of_engine == nullptr || IsOtherType(*of_engine, numbers)) continue;
    LeafComparison leaves(name, engine, max_error);
    leaves.Compare(*of_engine, numbers, "", 0.0);
    Append(leaves.Take(), off);
  }
  return off;
}

// ---- the same file, written now ----

const Node* LightsIn(const std::optional<Node>& root) {
  return root && root->kind == Node::Kind::kTable ? root->Find("lights") : nullptr;
}

const Node* LightOf(const Node& lights, const std::string& name) {
  const auto found = std::ranges::find_if(
      lights.items, [&](const Node& light) { return light.TextAt("name") == name; });
  return found == lights.items.end() ? nullptr : &*found;
}

// Absent: it cannot be written of these lamps.
std::optional<std::vector<DerivedOff>> OffAgainst(const Node& lights, const LightFile& lamps,
                                                  const PresetOptions& options, double max_error) {
  const auto target = FindPresetTarget("json");
  if (!target) return std::nullopt;
  const auto preset = target->exporter(lamps, "fresh", options);
  if (!preset || preset->files.empty()) return std::nullopt;
  const auto root = records::ParseJson(preset->files.front().contents);
  const std::optional<Node> whole = root ? std::optional(*root) : std::nullopt;
  const Node* fresh = LightsIn(whole);
  if (fresh == nullptr) return std::nullopt;
  std::vector<DerivedOff> off;
  for (const FittedLight& lamp : lamps.lights) {
    const Node* listed = LightOf(lights, lamp.name);
    const Node* derived = LightOf(*fresh, lamp.name);
    if (lamp.environment || listed == nullptr || derived == nullptr) continue;
    Append(OffOfLight(*listed, *derived, lamp.name, max_error), off);
  }
  return off;
}

// Ranges that the file may have been exported for: what its engines have, and none.
std::vector<std::optional<Metres>> RangesIn(const Node& lights) {
  std::vector<std::optional<Metres>> ranges = {std::nullopt};
  for (const Node& light : lights.items) {
    const Node* derived = light.Find("derived");
    for (const char* engine : {"gltf", "unity"}) {
      const Node* of_engine = derived == nullptr ? nullptr : derived->Find(engine);
      const Node* range = of_engine == nullptr ? nullptr : of_engine->Find("range");
      if (range == nullptr || !range->IsNumber() || !(range->number > 0.0)) continue;
      if (std::ranges::find(ranges, std::optional(Metres(range->number))) == ranges.end()) {
        ranges.emplace_back(Metres(range->number));
      }
    }
    if (ranges.size() > 2) break;
  }
  return ranges;
}

}  // namespace

std::vector<DerivedOff> CompareDerived(const std::string& preset_json, const LightFile& lamps,
                                       double max_error) {
  const auto root = records::ParseJson(preset_json);
  const std::optional<Node> whole = root ? std::optional(*root) : std::nullopt;
  const Node* lights = LightsIn(whole);
  if (lights == nullptr || lights->items.empty()) return {};
  PresetOptions options;
  options.written = Written::kNoPictures;
  options.color = PipelineIn(lights->items.front());
  std::optional<std::vector<DerivedOff>> fewest;
  for (const std::optional<Metres>& range : RangesIn(*lights)) {
    for (const SpotForm form : {SpotForm::kAuto, SpotForm::kIes, SpotForm::kCone}) {
      options.range = range;
      options.spots = form;
      auto off = OffAgainst(*lights, lamps, options, max_error);
      if (off && (!fewest || off->size() < fewest->size())) fewest = std::move(off);
      if (fewest && fewest->empty()) return {};
    }
  }
  return fewest.value_or(std::vector<DerivedOff>{});
}

}  // namespace lightcal
