// SPDX-License-Identifier: Apache-2.0
#include "check_preset.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calibration_options.h"
#include "check_cause.h"
#include "color_words.h"
#include "input_files.h"
#include "lamp_state.h"
#include "lightcal/calibrate/wall_part.h"
#include "lightcal/core/joined.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/presets/check/compare_colors.h"
#include "lightcal/presets/check/compare_derived.h"
#include "lightcal/presets/check/compare_emission.h"
#include "lightcal/presets/check/compare_readings.h"
#include "lightcal/presets/check/fresh_preset.h"
#include "lightcal/presets/check/read_preset.h"
#include "lightcal/presets/preset_table.h"
#include "preset_input.h"

namespace lightcal::app {
namespace {

// Nothing but rounding is left: a table shows 0.
double BeyondRounding(double value, double of) { return std::abs(value) < 1e-7 * of ? 0.0 : value; }

// What of a session a preset is held against: its lights, at states of their controls where some
// are asked for.
Result<void> ToStates(const PresetCheck& options, CalibratedSession& calibrated, Console& console) {
  const std::vector<FittedLight> references = calibrated.lights.lights;
  const auto warnings = SetStates(options.states, calibrated.lights);
  if (!warnings) return tl::unexpected(warnings.error());
  console.Warn(*warnings);
  for (std::size_t i = 0; i < references.size(); ++i) {
    FittedLight& there = calibrated.lights.lights[i];
    const bool asked = !references[i].states.empty() && there.states.empty();
    if (!asked || TakeReadingsOfState(references[i], there, calibrated.session) > 0) continue;
    return Refused("no_readings", there.name,
                   "was not read at " + StateText(there.state) +
                       "; check it at a state that was: " +
                       Joined(references[i].states, ", or ",
                              [](const MeasuredState& one) { return StateText(one.state); }));
  }
  return {};
}

// "" where no lamp has states that the preset may be of.
std::string PerhapsOfAState(const PresetCheck& options, const LightFile& lights) {
  const auto several = [](const FittedLight& light) { return light.states.size() > 1; };
  const auto one = std::ranges::find_if(lights.lights, several);
  if (!options.states.empty() || one == lights.lights.end()) return {};
  return ". A preset of another state than " + StateText(one->state) +
         " is checked with --state, as it was exported";
}

// Of a beam that was read at angles, where the engine has but a cone for it, and the lamp is right
// on its axis.
std::string PerhapsACone(const PresetCheck& options, const std::vector<ComparedReading>& rows,
                         const ComparedReading& worst, double max_error) {
  if (worst.off_axis_deg == 0.0) return {};
  const PresetTarget* target = TargetOfFile(options.file);
  if (target == nullptr || target->place_in_report == 0) return {};  // holds the beam itself
  const bool wrong_on_axis = std::ranges::any_of(rows, [&](const ComparedReading& row) {
    return row.used && row.light == worst.light && row.off_axis_deg == 0.0 &&
           std::abs(row.Judged().value_or(0.0)) > max_error;
  });
  if (wrong_on_axis) return {};
  return "That is " + RoundedText(std::abs(worst.off_axis_deg), 3) +
         " degrees off the axis, where an engine's own cone may stray; .ies and .ldt hold the beam "
         "itself. ";
}

// "1.00 m, 15°"
std::string PlaceOf(const ComparedReading& row) {
  std::string place = row.distance_m ? RoundedText(*row.distance_m, 3) + " m" : kNone;
  if (row.off_axis_deg != 0.0) place += ", " + RoundedText(row.off_axis_deg, 3) + "°";
  return place;
}

// The largest first.
std::vector<LampRms> LampsOff(std::vector<LampRms> lamps, double max_error) {
  std::erase_if(lamps, [&](const LampRms& lamp) { return lamp.rms <= max_error; });
  std::ranges::stable_sort(lamps, std::greater<>{}, &LampRms::rms);
  return lamps;
}

// "4.6 % (rms) off what the meter showed, of 30 lamps l07 25 %"; `off`: those lamps.
std::string OffText(double rms, std::size_t lamps, std::vector<LampRms> off) {
  constexpr std::size_t kNamed = 5;
  std::string text = PercentText(rms) + " (rms) off what the meter showed";
  if (lamps < 2) return text;
  const std::size_t more = off.size() - std::min(off.size(), kNamed);
  off.resize(off.size() - more);
  text += ", of " + std::to_string(lamps) + " lamps " +
          Joined(off, ", ", [](const LampRms& l) { return l.light + " " + PercentText(l.rms); });
  return more == 0 ? text : text + " and " + std::to_string(more) + " more";
}

Node ColorNode(const ComparedColor& color) {
  return {{"light", color.light},
          {"apart_uv", color.apart_uv},
          {"allowed_uv", color.allowed_uv},
          {"off", color.Off()}};
}

Node DerivedNode(const DerivedOff& one) {
  return {{"light", one.light},
          {"engine", one.engine},
          {"field", one.field},
          {"listed", one.listed},
          {"derived", one.derived}};
}

Node EmissionNode(const EmissionOff& one) {
  return {{"light", one.light},
          {"off_axis_deg", one.off_axis_deg},
          {"round_deg", one.round_deg},
          {"given", one.given},
          {"exported", one.exported}};
}

// Lamps that share out their light otherwise than in what export makes of them here, in any form of
// its spots. Absent: this engine's file is not made of these lamps, or holds no place of a light.
std::optional<std::vector<EmissionOff>> BeamsOff(const PresetTarget& target,
                                                 const CalibratedSession& calibrated,
                                                 const std::vector<EngineLight>& lights,
                                                 double max_error) {
  std::optional<std::vector<EmissionOff>> fewest;
  for (const SpotForm form : {SpotForm::kAuto, SpotForm::kIes, SpotForm::kCone}) {
    auto fresh = FreshPresetOf(target, calibrated.lights, form);
    if (!fresh) continue;
    // A preset.json whose distribution was not copied with it holds the cone beside it.
    std::erase_if(fresh->lights, [&](const EngineLight& one) {
      return target.name == "json" && one.kind == EngineLightKind::kTable &&
             std::ranges::any_of(lights, [&](const EngineLight& light) {
               return light.name == one.name && light.kind != EngineLightKind::kTable;
             });
    });
    if (std::ranges::none_of(fresh->lights, &EngineLight::placed)) continue;
    auto off = CompareEmission(calibrated.session, lights, fresh->lights, max_error);
    if (!fewest || off.size() < fewest->size()) fewest = std::move(off);
    if (fewest->empty()) break;
  }
  return fewest;
}

std::string BeamText(const EmissionOff& one) {
  std::string place = RoundedText(one.off_axis_deg, 3) + "° off its axis";
  if (one.round_deg != 0.0) place += ", " + RoundedText(one.round_deg, 3) + "° round it,";
  return one.light + " gives " + PercentText(one.given) + " of its brightest " + place +
         " instead of " + PercentText(one.exported);
}

// How a file is not the session's, whatever its readings say.
struct OtherFaults {
  std::vector<std::string> missing, extra;  // lights, by name
  std::vector<ComparedColor> colors;
  std::vector<DerivedOff> derived;                // of a preset.json
  std::optional<std::vector<EmissionOff>> beams;  // absent: not compared
};

std::optional<Error> OtherFault(const PresetCheck& options, const OtherFaults& faults) {
  const auto fault = [&](const char* code, std::string message) {
    return Error{ErrorKind::kFailed, code, options.file, std::move(message)};
  };
  if (!faults.missing.empty()) {
    return fault("missing_lights", "shows no light for " + Joined(faults.missing) +
                                       ": none is there, or it is hidden; export it from this "
                                       "session");
  }
  if (!faults.extra.empty()) {
    return fault("extra_lights", "shows " + std::to_string(faults.extra.size()) +
                                     " that the session has not: " + Joined(faults.extra) +
                                     ". What they shine comes on top of the lamps");
  }
  if (faults.beams && !faults.beams->empty()) {
    return fault("beam_off", "has another cone, size or turn than an export of these lamps: " +
                                 Joined(*faults.beams, "; ", BeamText) +
                                 ". Export it again; what was exported with --engine for another "
                                 "renderer is checked by a picture");
  }
  std::vector<ComparedColor> off = faults.colors;
  std::erase_if(off, [](const ComparedColor& color) { return !color.Off(); });
  if (off.empty() && faults.derived.empty()) return std::nullopt;
  if (off.empty()) {
    return fault("derived_off", "lists for engines what its lamps do not derive to: " +
                                    Joined(faults.derived, ", ",
                                           [](const DerivedOff& one) {
                                             return one.light + "'s " + one.engine + " " +
                                                    one.field + " " + RoundedText(one.listed, 5) +
                                                    " instead of " + RoundedText(one.derived, 5);
                                           }) +
                                    ". Export it again, or undo what was edited in it");
  }
  return fault(
      "color_off",
      "has another colour than was read: " + Joined(off, ", ", [](const ComparedColor& color) {
        return color.light + " by " + RoundedText(color.apart_uv, 2) + " in u'v' (" +
               RoundedText(color.allowed_uv, 2) + " allowed)";
      }) + ". Export it again; one that was exported with --white is checked with it");
}

// What the preset lacks, where that is more than it may.
std::optional<Error> Judged(const PresetCheck& options, const CalibratedSession& calibrated,
                            const std::vector<ComparedReading>& rows, double rms,
                            const std::vector<LampRms>& lamps, const OtherFaults& faults,
                            double max_error) {
  std::vector<LampRms> off = LampsOff(lamps, max_error);
  if (!faults.missing.empty() || off.empty()) return OtherFault(options, faults);
  const auto worst = std::ranges::max_element(rows, {}, [](const ComparedReading& row) {
    return row.used ? std::abs(row.Judged().value_or(0.0)) : 0.0;
  });
  return Error{ErrorKind::kFailed, "preset_off", options.file,
               "is " + OffText(rms, lamps.size(), std::move(off)) + ", more than " +
                   PercentText(max_error) + "; most at a reading of " + worst->light + ": " +
                   RoundedText(worst->predicted_lx, 4) + " lx instead of " +
                   RoundedText(worst->measured_lx, 4) + " lx. " +
                   PerhapsACone(options, rows, *worst, max_error) +
                   CauseOfStraying(options.file, calibrated, rows, max_error) +
                   "; --max-error allows more" + PerhapsOfAState(options, calibrated.lights)};
}

}  // namespace

Result<void> CheckPreset(const PresetCheck& options, Console& console) {
  const auto max_error = ParseTolerance(options.max_error);
  if (!max_error) return tl::unexpected(max_error.error());
  const auto words = ParseColorWords("", options.white);
  if (!words) return tl::unexpected(words.error());
  const auto text = ReadInputFile(options.file);
  if (!text) return tl::unexpected(text.error());
  const auto lights = LightsOfPreset(options.file, *text, FilesBeside(options.file));
  if (!lights) return tl::unexpected(lights.error());
  auto calibrated = CalibrateAloud(options.session, {}, console);
  if (!calibrated) return tl::unexpected(calibrated.error());
  if (auto there = ToStates(options, *calibrated, console); !there) return there;
  const auto rows = ComparedWith(*calibrated, *lights);
  const PresetTarget* target = TargetOfFile(options.file);
  const OtherFaults faults = {
      LampsMissing(calibrated->session, calibrated->lights, *lights),
      LightsBeyond(calibrated->session, *lights),
      CompareColors(calibrated->lights, *lights, words->white),
      target != nullptr && target->name == "json"
          ? CompareDerived(*text, calibrated->lights, *max_error)
          : std::vector<DerivedOff>{},
      target != nullptr ? BeamsOff(*target, *calibrated, *lights, *max_error) : std::nullopt};
  const std::vector<LampRms> lamps = RmsByLamp(rows);
  const auto rms = RmsOf(rows);
  if (!rms) {
    return Refused("no_readings", options.session, "has no reading to check against");
  }
  if (std::ranges::any_of(
          rows, [](const ComparedReading& row) { return !std::isfinite(row.predicted_lx); })) {
    return Refused("bad_preset", options.file,
                   "gives no finite illuminance at a reading; look at its numbers");
  }
  if (target != nullptr && target->name == "blender") {
    console.Warn(OldBlenderSpheres(calibrated->session, calibrated->lights));
  }
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  std::vector<Node> readings;
  std::vector<std::vector<std::string>> table;
  for (const ComparedReading& row : rows) {
    readings.push_back(
        {{"light", row.light},
         {"index", row.index},
         {"measured_lx", row.measured_lx},
         {"walls_lx", row.walls_lx},
         {"predicted_lx", row.predicted_lx},
         {"used", row.used},
         {"distance_m", row.distance_m},
         {"off_axis_deg", row.off_axis_deg == 0.0 ? Node() : Node(row.off_axis_deg)}});
    std::string error = kNone;
    if (const auto relative = row.Error()) {
      readings.back().Put("error", *relative);
      error = PercentText(BeyondRounding(*relative, 1.0));
    }
    table.push_back(
        {row.light, PlaceOf(row), RoundedText(row.measured_lx + row.walls_lx, 4) + " lx",
         RoundedText(BeyondRounding(row.walls_lx, row.measured_lx), 3) + " lx",
         RoundedText(row.predicted_lx, 4) + " lx", error + (row.used ? "" : " (rejected)")});
  }
  console.Print(TextTable({"light", "distance", "meter", "of it walls", "preset", "error"}, table));
  console.Print("\nrms " + PercentText(BeyondRounding(*rms, 1.0)) + " of what the meter showed\n");
  if (std::ranges::none_of(*lights,
                           [](const EngineLight& light) { return light.rgb.has_value(); })) {
    console.Print("colours not compared: the file holds none\n");
  }
  if (!faults.beams && std::ranges::any_of(*lights, &EngineLight::placed)) {
    console.Print("cones, sizes and turns not compared: these lamps make no such file here\n");
  }
  Node document = {
      {"readings", readings},
      {"rms_relative", *rms},
      {"max_error", *max_error},
      {"lights", Node::List(lamps,
                            [&](const LampRms& lamp) {
                              return Node{{"name", lamp.light},
                                          {"rms_relative", lamp.rms},
                                          {"off", lamp.rms > *max_error}};
                            })},
      {"missing", Node::UnlessEmpty(Node(faults.missing))},
      {"extra", Node::UnlessEmpty(Node(faults.extra))},
      {"derived_off", Node::UnlessEmpty(Node::List(faults.derived, DerivedNode))},
      {"beams_off",
       faults.beams ? Node::UnlessEmpty(Node::List(*faults.beams, EmissionNode)) : Node()},
      {"colors", Node::UnlessEmpty(Node::List(faults.colors, ColorNode))}};
  if (const auto fault = Judged(options, *calibrated, rows, *rms, lamps, faults, *max_error)) {
    return EndWithError(console, std::move(document), *fault);
  }
  console.PrintDocument(std::move(document));
  return {};
}

}  // namespace lightcal::app
