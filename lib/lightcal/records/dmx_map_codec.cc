// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "lightcal/core/joined.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/records/dmx_map.h"
#include "lightcal/records/field_reader.h"
#include "lightcal/records/toml_codec.h"

namespace lightcal {
namespace records {
namespace {

constexpr int kMapVersion = 1;

int LargestOf(const DmxControl& control) { return control.slots.size() == 2 ? 65535 : 255; }

// Two ways to say where labels stand become one.
void ReadLabels(FieldReader& reader, DmxControl& control) {
  std::optional<std::array<double, 2>> range;
  reader.Array("range", range);
  reader.Numbers("labels", control.labels, kAnyNumber);
  reader.Numbers("values", control.values, kNotNegative);
  std::vector<std::pair<std::string, double>> words;
  reader.NumbersByName("words", words, kNotNegative);
  const int ways = (range ? 1 : 0) + (reader.Has("labels") ? 1 : 0) + (words.empty() ? 0 : 1);
  if (reader.Failed()) return;
  if (ways != 1) {
    return reader.Fail("",
                       "say in one way what the slots mean: range = [0, 100], or labels and values "
                       "of one length, or words = { white = 0 }");
  }
  const int largest = LargestOf(control);
  const std::string held = " must be a whole number from 0 to " + std::to_string(largest) +
                           ": what " + std::to_string(control.slots.size()) + " slot" +
                           (control.slots.size() == 1 ? " holds" : "s hold");
  const auto fits = [&](double value) { return value <= largest && value == std::round(value); };
  for (const auto& [word, value] : words) {
    if (!fits(value)) return reader.Fail("words", word + held);
    control.words.emplace_back(word, static_cast<int>(value));
  }
  if (range) {
    control.labels = {range->front(), range->back()};
    control.values = {0.0, static_cast<double>(largest)};
  }
  if (!words.empty()) return;
  if (control.labels.size() < 2 || control.labels.size() != control.values.size()) {
    return reader.Fail("labels", "labels and values are lists of one length, two or more");
  }
  for (const double value : control.values) {
    if (!fits(value)) return reader.Fail("values", ShortestText(value) + held);
  }
  const bool rising = control.labels[1] > control.labels[0];
  for (std::size_t i = 1; i < control.labels.size(); ++i) {
    const double step = control.labels[i] - control.labels[i - 1];
    if (rising ? !(step > 0.0) : !(step < 0.0)) {
      return reader.Fail(range ? "range" : "labels", "must rise, or fall, all the way");
    }
  }
}

void ReadControl(FieldReader& reader, DmxControl& control) {
  reader.Text("name", control.name);
  reader.Integers("slots", control.slots);
  reader.Require({"name", "slots"});
  if (reader.Failed()) return;
  if (const std::string fault = FaultOfState({{control.name, 1.0}}); !fault.empty()) {
    return reader.Fail("name", fault);
  }
  if (control.slots.empty() || control.slots.size() > 2) {
    return reader.Fail("slots", "one slot (8 bits), or two, coarse and fine (16 bits)");
  }
  ReadLabels(reader, control);
}

// Counts slots from the fixture's address, and refuses what no universe has or two would move.
class Addressing {
 public:
  explicit Addressing(int address) : address_(address) {}
  // What is wrong with this slot; empty where nothing is.
  std::string Take(int& slot, const std::string& by) {
    const int there = slot + address_ - 1;
    const std::string name = "slot " + std::to_string(slot);
    if (slot < 1 || there > kDmxSlots) {
      return name + " of a fixture at address " + std::to_string(address_) +
             " lies outside of the universe's 512";
    }
    slot = there;
    std::string& owner = owners_[static_cast<std::size_t>(there - 1)];
    if (!owner.empty()) return name + " is moved by " + owner + " too; one slot, one control";
    owner = by;
    return {};
  }

 private:
  int address_;
  std::array<std::string, kDmxSlots> owners_;
};

void ReadMap(FieldReader& reader, DmxMap& map) {
  int version = 0;
  int address = 1;
  int universe = 0;
  reader.Integer("lightcal", version);
  reader.Integer("universe", universe);
  reader.Integer("address", address);
  reader.Integer("priority", map.priority);
  reader.Require({"lightcal", "control"});
  if (reader.Has("lightcal") && version != kMapVersion) {
    reader.Fail("lightcal", "lightcal = 1 is the only version of this file there is");
  }
  if (reader.Has("universe") && (universe < 1 || universe > kMostUniverse)) {
    reader.Fail("universe", "must lie between 1 and 63999");
  }
  if (reader.Has("universe")) map.universe = universe;
  if (address < 1 || address > kDmxSlots) reader.Fail("address", "must lie between 1 and 512");
  if (map.priority < 0 || map.priority > kMostSacnPriority) {
    reader.Fail("priority", "must lie between 0 and 200; consoles send 100");
  }
  if (reader.Failed()) return;
  Addressing addressing(address);
  reader.List("control", map.controls, [&](FieldReader& inner, DmxControl& control) {
    ReadControl(inner, control);
    if (inner.Failed()) return;
    if (std::ranges::count(map.controls, control.name, &DmxControl::name) > 1) {
      inner.Fail("name", Quoted(control.name) + " is there twice");
    }
    for (int& slot : control.slots) {
      const std::string fault = addressing.Take(slot, control.name);
      if (!fault.empty()) inner.Fail("slots", fault);
    }
  });
  reader.List("hold", map.holds, [&](FieldReader& inner, DmxHold& hold) {
    inner.Integer("slot", hold.slot);
    inner.Integer("value", hold.value);
    inner.Require({"slot", "value"});
    if (inner.Failed()) return;
    if (hold.value < 0 || hold.value > 255) inner.Fail("value", "must lie between 0 and 255");
    const std::string fault = addressing.Take(hold.slot, "a [[hold]]");
    if (!fault.empty()) inner.Fail("slot", fault);
  });
}

}  // namespace
}  // namespace records

namespace {

std::string ControlNames(const DmxMap& map) {
  return Joined(map.controls, ", ", [](const DmxControl& one) { return one.name; });
}

// The number that the slots hold at a label.
Result<int> ValueAt(const DmxControl& control, const ControlValue& said) {
  if (control.words.empty() == said.IsWord()) {
    return Refused("map_word", said.name,
                   said.IsWord() ? "is a number in the map, not " + records::Quoted(said.word)
                                 : "is a word in the map, not a number");
  }
  if (said.IsWord()) {
    for (const auto& [word, value] : control.words) {
      if (word == said.word) return value;
    }
    return Refused("map_word", said.name + "=" + said.word,
                   "the map has no such word; it has " +
                       Joined(control.words, ", ", [](const auto& one) { return one.first; }));
  }
  for (std::size_t i = 1; i < control.labels.size(); ++i) {
    const double a = control.labels[i - 1];
    const double b = control.labels[i];
    const double share = (said.number - a) / (b - a);
    if (!(share >= -1e-12 && share <= 1.0 + 1e-12)) continue;
    const double value =
        control.values[i - 1] + share * (control.values[i] - control.values[i - 1]);
    return static_cast<int>(std::lround(value));
  }
  const auto [least, most] = std::ranges::minmax(control.labels);
  return Refused("map_range", said.name + "=" + ShortestText(said.number),
                 "the map covers " + ShortestText(least) + " to " + ShortestText(most) +
                     "; sweep within that, or widen its labels to what the fixture does");
}

}  // namespace

Result<DmxMap> DmxMapFromToml(std::string_view text, std::string_view where) {
  const auto document = records::ParseToml(text);
  if (!document) {
    return Refused("bad_map", std::string(where) + ":" + std::to_string(document.error().line),
                   "not valid TOML: " + document.error().message);
  }
  records::ReadingOfFile file{std::string(where), "bad_map", records::PlaceStyle::kToml,
                              std::nullopt};
  DmxMap map;
  records::FieldReader reader(*document, "", file);
  records::ReadMap(reader, map);
  reader.Finish();
  if (file.error) return tl::unexpected(*std::move(file.error));
  return map;
}

Result<std::vector<std::uint8_t>> SlotsAt(const DmxMap& map, const FixtureState& state) {
  for (const ControlValue& said : state) {
    if (std::ranges::find(map.controls, said.name, &DmxControl::name) == map.controls.end()) {
      return Refused("map_controls", said.name,
                     "the map moves " + ControlNames(map) + " and no such control; add a " +
                         "[[control]] of that name with its slots");
    }
  }
  std::vector<std::uint8_t> slots(kDmxSlots, 0);
  for (const DmxControl& control : map.controls) {
    const ControlValue* said = FindControl(state, control.name);
    if (said == nullptr) {
      return Refused("map_controls", control.name,
                     "the map moves it, and the states do not say where it stands; name one value "
                     "of it beside the others, or hold its slots by a [[hold]]");
    }
    const auto value = ValueAt(control, *said);
    if (!value) return tl::unexpected(value.error());
    const bool wide = control.slots.size() == 2;
    const auto at = [&](std::size_t i) -> std::uint8_t& {
      return slots[static_cast<std::size_t>(control.slots[i] - 1)];
    };
    at(0) = static_cast<std::uint8_t>(wide ? *value >> 8 : *value);
    if (wide) at(1) = static_cast<std::uint8_t>(*value & 0xff);
  }
  for (const DmxHold& hold : map.holds) {
    slots[static_cast<std::size_t>(hold.slot - 1)] = static_cast<std::uint8_t>(hold.value);
  }
  return slots;
}

}  // namespace lightcal
