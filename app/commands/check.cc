// SPDX-License-Identifier: Apache-2.0
// lightcal check: a preset file against the readings, or a rendered picture against the meter.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "check/card_picture.h"
#include "check/engine_light.h"
#include "check/render_cause.h"
#include "check/rig_file.h"
#include "commands.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/captures/picture.h"
#include "output_files.h"
#include "session_input.h"

namespace lightcal::app {
namespace {

struct Options {
  std::string preset, session, render, rig, engine;
};

// ---- a picture ----

Result<PixelUnit> UnitOf(const Options& options, const FrameInfo& info) {
  const bool linear = info.meaning == SampleMeaning::kLinear;
  if (options.engine.empty()) return PixelUnit::kExposed;
  if (options.engine == "blender") return linear ? PixelUnit::kWatts : PixelUnit::kExposed;
  if (options.engine == "three") return linear ? PixelUnit::kNits : PixelUnit::kExposed;
  return PixelUnit::kExposed;
}

Node CauseNode(const RenderCause& cause) {
  return {{"code", cause.code}, {"message", cause.message}, {"factor", cause.factor}};
}

void PrintVerdict(const CheckedRig& rig, const RenderVerdict& verdict, Console& console) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < 2; ++i) {
    const double expected = rig.cards[i].expected_lx;
    rows.push_back({rig.cards[i].name, RoundedText(expected, 4) + " lx",
                    RoundedText(verdict.card_lx[i], 4) + " lx",
                    RoundedText(std::log2(verdict.card_lx[i] / expected), 2)});
  }
  console.Print(TextTable({"card", "meter", "picture", "stops"}, rows));
  console.Print("\n" + RoundedText(verdict.lux, 4) + " lx, " +
                RoundedText(std::log2(verdict.lux / verdict.expected_lx), 2) +
                " stops off: " + verdict.cause.code + "\n  " + verdict.cause.message + "\n");
  for (const RenderCause& other : verdict.alternatives) {
    console.Print("or " + other.code + ": " + other.message + "\n");
  }
}

Result<void> CheckRender(const Options& options, Console& console) {
  if (options.rig.empty()) {
    return WrongUsage("--rig", "is missing: the STEM.preset.json that was exported with the rig");
  }
  const auto text = ReadWholeFile(options.rig);
  if (!text) return tl::unexpected(text.error());
  const auto rig = RigFromPreset(*text, options.rig);
  if (!rig) return tl::unexpected(rig.error());
  const auto picture = ReadPicture(options.render);
  if (!picture) return tl::unexpected(picture.error());
  const auto unit = UnitOf(options, picture->info);
  if (!unit) return tl::unexpected(unit.error());
  const auto cards = MeasureCards(*picture, *rig);
  if (!cards) return tl::unexpected(cards.error());
  const auto verdict = JudgeRender(*rig, *cards, *unit, options.render);
  if (!verdict) return tl::unexpected(verdict.error());
  for (std::size_t i = 0; i < 2; ++i) {
    const CardPixels& card = (*cards)[i];
    if (card.clipped[0] || card.clipped[1] || card.clipped[2]) {
      console.Warn(
          {"clipped", rig->cards[i].name, "is clipped in this picture and left out there"});
    }
    if (card.spread > 0.15) {
      console.Warn({"uneven_card", rig->cards[i].name,
                    "is uneven where the rig says it is: another camera, or too few samples"});
    }
  }
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  PrintVerdict(*rig, *verdict, console);
  Node measured = Node::Array();
  for (std::size_t i = 0; i < 2; ++i) {
    measured.items.push_back({{"name", rig->cards[i].name},
                              {"expected_lx", rig->cards[i].expected_lx},
                              {"illuminance_lx", verdict->card_lx[i]},
                              {"pixel", (*cards)[i].rgb}});
  }
  console.PrintDocument({{"illuminance_lx", verdict->lux},
                         {"expected_lx", verdict->expected_lx},
                         {"stops_off", std::log2(verdict->lux / verdict->expected_lx)},
                         {"cause", CauseNode(verdict->cause)},
                         {"alternatives", Node::List(verdict->alternatives, CauseNode)},
                         {"cards", measured}});
  return {};
}

// ---- a preset ----

struct Compared {
  std::string light;
  int index = 0;
  std::optional<double> distance_m;
  double measured_lx = 0.0, predicted_lx = 0.0;
  bool used = true;
};

std::vector<const Reading*> ReadingsOf(const Session& session, const std::string& light) {
  std::vector<const Reading*> out;
  for (const SessionReading& row : session.readings) {
    if (row.reading.light == light) out.push_back(&row.reading);
  }
  return out;
}

// A lamp as the session has it. A lamp that is turned somewhere has its effective source behind the
// place its distances count from, by its offset; of any other that is a radius.
struct MeteredLamp {
  const LightDescription& description;
  const FittedLight& fitted;
  Vec3 place_m{}, aim{0.0, 0.0, -1.0};
  bool turned = false;
  double offset_m = 0.0, surface_m = 0.0;  // surface: of a sphere that distances count from
};

MeteredLamp MeteredLampOf(const LightDescription& description, const FittedLight& fitted) {
  MeteredLamp lamp{description, fitted};
  lamp.place_m = description.position_m.value_or(Vec3{});
  const LightKind kind = description.kind;
  if (description.aim && kind != LightKind::kDome) lamp.aim = *description.aim;
  lamp.turned = description.aim || kind == LightKind::kSpot || kind == LightKind::kDisk ||
                kind == LightKind::kRect || kind == LightKind::kPhotometric;
  if (fitted.distance_offset_m) lamp.offset_m = fitted.distance_offset_m->value;
  for (const EffectReport& effect : fitted.effects) {
    if (effect.name == "sphere_surface" && effect.state != EffectState::kOff) {
      lamp.surface_m = fitted.diameter_m.value_or(0.0) / 2.0;
    }
  }
  return lamp;
}

// A photometric file hangs where the lamp does, C0 to the right as seen from behind it.
EngineLight PlacedAt(EngineLight light, const MeteredLamp& lamp) {
  light.position_m = lamp.place_m - lamp.aim * (lamp.turned ? lamp.offset_m : 0.0);
  light.offset_m = lamp.turned ? 0.0 : lamp.offset_m;
  light.aim = lamp.aim;
  const Vec3 level = {lamp.aim[1], -lamp.aim[0], 0.0};
  const double length = Length(level);
  light.x = length > 1e-9 ? level * (1.0 / length) : Vec3{1.0, 0.0, 0.0};
  light.y = Cross(light.x, lamp.aim);
  return light;
}

// What the file's lights give where the meter stood.
double Predicted(const std::vector<EngineLight>& lights, const MeteredLamp& lamp,
                 const Reading& reading) {
  double sum = 0.0;
  for (const EngineLight& light : lights) {
    if (!light.name.empty() && light.name != lamp.fitted.name) continue;
    const bool dome = lamp.description.kind == LightKind::kDome;
    if (light.name.empty() && light.placed && !dome) continue;  // surroundings
    const EngineLight placed = light.placed ? light : PlacedAt(light, lamp);
    if (reading.position_m && reading.normal) {
      const Vec3 normal = *reading.normal * (1.0 / Length(*reading.normal));
      sum += LuxAt(placed, *reading.position_m, normal);
      continue;
    }
    const double d = (reading.distance ? reading.distance->value() : 1.0) + lamp.surface_m +
                     (lamp.turned ? 0.0 : placed.offset_m);
    sum += LuxAt(placed, lamp.place_m + lamp.aim * d, lamp.aim * -1.0) *
           std::cos(reading.tilt.value());
  }
  return sum;
}

std::vector<Compared> Compare(const CalibratedSession& calibrated,
                              std::vector<EngineLight> lights) {
  for (EngineLight& light : lights) {
    // A photometric file may be of any make: it stands for every lamp, unless it names one.
    if (!light.placed && FindLight(calibrated.session, light.name) == nullptr) light.name.clear();
  }
  std::vector<Compared> rows;
  for (const FittedLight& lamp : calibrated.lights.lights) {
    const auto readings = ReadingsOf(calibrated.session, lamp.name);
    const LightDescription* description = FindLight(calibrated.session, lamp.name);
    for (const ResidualRow& row : lamp.residuals) {
      if (description == nullptr || row.index < 0 ||
          static_cast<std::size_t>(row.index) >= readings.size()) {
        continue;
      }
      const Reading& reading = *readings[static_cast<std::size_t>(row.index)];
      rows.push_back({lamp.name, row.index, row.distance_m,
                      row.measured_lx - (lamp.ambient_lx ? lamp.ambient_lx->value : 0.0),
                      Predicted(lights, MeteredLampOf(*description, lamp), reading), row.used});
    }
  }
  return rows;
}

double RmsOf(const std::vector<Compared>& rows) {
  double sum = 0.0;
  int count = 0;
  for (const Compared& row : rows) {
    if (!row.used || !(row.predicted_lx > 0.0)) continue;
    sum += std::pow(row.measured_lx / row.predicted_lx - 1.0, 2);
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : 0.0;
}

Result<void> CheckPreset(const Options& options, Console& console) {
  const auto text = ReadWholeFile(options.preset);
  if (!text) return tl::unexpected(text.error());
  const auto lights = LightsOfPreset(options.preset, *text);
  if (!lights) return tl::unexpected(lights.error());
  const auto calibrated = CalibrateSession(options.session, {}, console);
  if (!calibrated) return tl::unexpected(calibrated.error());
  const std::vector<Compared> rows = Compare(*calibrated, *lights);
  if (rows.empty()) {
    return Refused("no_readings", options.session, "has no reading to check against");
  }
  if (std::ranges::any_of(rows,
                          [](const Compared& row) { return !std::isfinite(row.predicted_lx); })) {
    return Refused("bad_preset", options.preset,
                   "gives no finite illuminance at a reading; look at its numbers");
  }
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  std::vector<Node> readings;
  std::vector<std::vector<std::string>> table;
  for (const Compared& row : rows) {
    readings.push_back({{"light", row.light},
                        {"index", row.index},
                        {"measured_lx", row.measured_lx},
                        {"predicted_lx", row.predicted_lx},
                        {"used", row.used},
                        {"distance_m", row.distance_m}});
    std::string error = "-";
    if (row.measured_lx > 0.0) {
      readings.back().Put("error", row.predicted_lx / row.measured_lx - 1.0);
      error = RoundedText(100.0 * (row.predicted_lx / row.measured_lx - 1.0), 2) + " %";
    }
    table.push_back({row.light, row.distance_m ? RoundedText(*row.distance_m, 3) + " m" : "-",
                     RoundedText(row.measured_lx, 4) + " lx",
                     RoundedText(row.predicted_lx, 4) + " lx",
                     error + (row.used ? "" : " (rejected)")});
  }
  console.Print(TextTable({"light", "distance", "meter", "preset", "error"}, table));
  console.Print("\nrms " + RoundedText(100.0 * RmsOf(rows), 2) + " %\n");
  console.PrintDocument({{"readings", readings}, {"rms_relative", RmsOf(rows)}});
  return {};
}

Result<void> RunCheck(const Options& options, Console& console) {
  if (!options.render.empty()) return CheckRender(options, console);
  if (options.preset.empty() || options.session.empty()) {
    return WrongUsage("check",
                      "needs PRESET --session SESSION, or --render PICTURE --rig PRESET.json");
  }
  return CheckPreset(options, console);
}

}  // namespace

Run BuildCheck(CLI::App& parser) {
  auto options = std::make_shared<Options>();
  parser.add_option(
      "preset", options->preset,
      "An exported file: .gltf .blender.py .three.js .filament.json .preset.json .tscn .usda .ies "
      ".ldt");
  parser.add_option("--session", options->session, "The readings it is checked against");
  parser.add_option("--render", options->render, "A picture an engine rendered of the rig");
  parser.add_option("--rig", options->rig, "The STEM.preset.json of that rig");
  parser
      .add_option("--engine", options->engine,
                  "Who rendered it: an EXR of blender holds watts, one of three cd/m2; any other "
                  "picture is exposed")
      ->check(CLI::IsMember(
          {"blender", "three", "babylon", "filament", "unreal", "unity", "godot", "other"}));
  return [options](Console& console) { return RunCheck(*options, console); };
}

}  // namespace lightcal::app
