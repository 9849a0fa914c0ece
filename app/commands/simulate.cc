// SPDX-License-Identifier: Apache-2.0
// lightcal simulate: the illuminance that fitted lights will give, at points or over a plane.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>

#include "calibration_options.h"
#include "commands.h"
#include "input_files.h"
#include "lightcal/calibrate/environments.h"
#include "lightcal/calibrate/lux_in_room.h"
#include "lightcal/core/nearest_word.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "lightcal/records/light_codec.h"
#include "lightcal_devices/disk_sources.h"
#include "output_files.h"
#include "simulate/lamp_places.h"
#include "simulate/map_files.h"
#include "simulate/map_plane.h"
#include "simulate/simulate_answer.h"
#include "typed_reading.h"

namespace lightcal::app {
namespace {

namespace fs = std::filesystem;

struct SimulateOptions {
  std::string input;
  std::vector<std::string> at, lights, outputs;
  std::string normal = "up";
  MapPlaneWords plane{"", "512", "", ""};
  LampPlaceWords places;
  std::string room, tolerance = "1%", effects = "auto", title, scale, border, target;
  double reflectance = 0.5;
  bool timing = false, force = false;
};

struct Input {
  LightFile lights;
  std::string folder;  // of the light.json
  std::optional<Session> session;
  std::string title;
};

Result<Input> ReadInput(const SimulateOptions& options, double tolerance, Console& console) {
  if (fs::path(options.input).extension() == ".json") {
    const auto text = ReadInputFile(options.input);
    if (!text) return tl::unexpected(text.error());
    auto lights = LightFileFromJson(*text, options.input);
    if (!lights) return Propagate(std::move(lights));
    return Input{std::move(*lights), fs::path(options.input).parent_path().string(), std::nullopt,
                 fs::path(options.input).stem().string()};
  }
  // The fit has its own gate; --effects is about the prediction.
  CalibrationSettings settings;
  settings.profile.tolerance_relative = tolerance;
  auto calibrated = CalibrateAloud(options.input, settings, console);
  if (!calibrated) return Propagate(std::move(calibrated));
  const std::string title =
      calibrated->session.name.empty() ? calibrated->session.stem : calibrated->session.name;
  return Input{std::move(calibrated->lights), "", std::move(calibrated->session), title};
}

// Which effects a prediction has, and what the person said of them.
struct Effects {
  EffectChoice finite_source = EffectChoice::kGate, room_bounce = EffectChoice::kGate;
  bool ambient = false;
};

Result<Effects> ParseEffects(const std::string& text) {
  Effects out;
  if (text == "auto" || text.empty()) return out;
  if (text == "all" || text == "none") {
    out.finite_source = out.room_bounce =
        text == "all" ? EffectChoice::kAlways : EffectChoice::kNever;
    return out;
  }
  std::string_view rest = text;
  while (!rest.empty()) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    std::string_view word = TrimBlanks(rest.substr(0, comma));
    rest.remove_prefix(std::min(rest.size(), comma + 1));
    if (word.empty()) continue;
    const bool off = word.front() == '-';
    if (off || word.front() == '+') word.remove_prefix(1);
    const EffectChoice choice = off ? EffectChoice::kNever : EffectChoice::kAlways;
    if (word == "finite_source") {
      out.finite_source = choice;
    } else if (word == "room_bounce") {
      out.room_bounce = choice;
    } else if (word == "ambient") {
      out.ambient = !off;
    } else {
      const std::vector<std::string_view> names = {"finite_source", "room_bounce", "ambient"};
      const std::string nearest = NearestWord(word, names);
      return WrongUsage("--effects",
                        "a prediction has no effect \"" + std::string(word) + "\"" +
                            (nearest.empty() ? "; it has finite_source, room_bounce and ambient"
                                             : "; did you mean \"" + nearest + "\"?"));
    }
  }
  return out;
}

Result<std::optional<RoomBox>> RoomOf(const SimulateOptions& options, const Input& input) {
  if (!options.room.empty()) {
    const auto size = ParseLengths("--room", options.room, ',');
    if (!size) return tl::unexpected(size.error());
    const bool positive = std::ranges::all_of(*size, [](double v) { return v > 0.0; });
    if (size->size() != 3 || !positive) {
      return WrongUsage("--room", "\"" + options.room + "\" must be width,depth,height: 5,4,2.6");
    }
    if (!(options.reflectance >= 0.0) || options.reflectance > 0.95) {
      return WrongUsage("--reflectance", "must lie within 0 and 0.95");
    }
    return std::optional<RoomBox>(
        RoomBox{{(*size)[0], (*size)[1], (*size)[2]}, options.reflectance});
  }
  if (!input.session || !input.session->room) return std::optional<RoomBox>();
  return std::optional<RoomBox>(
      RoomBox{input.session->room->size_m, input.session->room->reflectance});
}

Result<void> CheckSimulate(const SimulateOptions& options) {
  if (options.at.empty() && options.plane.plane.empty()) {
    return WrongUsage("simulate", "say where: --at x,y,z (metres), or --plane floor");
  }
  if (!options.outputs.empty() && options.plane.plane.empty()) {
    return WrongUsage("-o", "writes a map; say of which plane: --plane floor");
  }
  return CheckMapNames(options.outputs);
}

// "lamp": turned to the lamp that gives most there; behind all of them, to the one of the most
// candela over the square of its distance.
Vec3 TowardBrightest(const std::vector<PlacedLamp>& lamps, const Vec3& position) {
  Vec3 best{0.0, 0.0, 1.0};
  double most = 0.0;
  double most_behind = 0.0;
  for (const PlacedLamp& lamp : lamps) {
    const auto normal = DirectionToLamp(lamp, position);
    if (!normal) continue;
    const double lux = LuxOf(lamp, {position, *normal});
    if (lux > most) {
      most = lux;
      best = *normal;
    }
    const Vec3 way = lamp.pose.position_m - position;
    const double behind = IsEverywhere(lamp.source) ? 0.0 : lamp.strength / Dot(way, way);
    if (most == 0.0 && behind > most_behind) {
      most_behind = behind;
      best = *normal;
    }
  }
  return best;
}

Result<std::vector<PredictedPoint>> Points(const SimulateOptions& options,
                                           const std::vector<PlacedLamp>& lamps) {
  std::vector<PredictedPoint> out;
  const auto normal = ParseMeterNormal(options.normal);
  if (!normal) return tl::unexpected(normal.error());
  for (const std::string& text : options.at) {
    const auto position = ParsePoint("--at", text);
    if (!position) return tl::unexpected(position.error());
    out.push_back({{*position, normal->value_or(TowardBrightest(lamps, *position))}, {}});
  }
  return out;
}

// A room throws nothing back to where it does not reach.
Result<void> CheckInRoom(const Simulated& simulated) {
  if (!simulated.settings.room) return {};
  const Vec3& size = simulated.settings.room->size_m;
  const auto check = [&](const std::string& what, const Vec3& p) -> Result<void> {
    if (IsInRoom(p, size)) return {};
    return Refused("outside_room", what,
                   "lies outside the room, which reaches from -" + RoundedText(0.5 * size[0], 3) +
                       " to " + RoundedText(0.5 * size[0], 3) + " m in x, -" +
                       RoundedText(0.5 * size[1], 3) + " to " + RoundedText(0.5 * size[1], 3) +
                       " m in y, 0 to " + RoundedText(size[2], 3) + " m in z");
  };
  for (const PlacedLamp& lamp : simulated.lamps) {
    if (IsEverywhere(lamp.source)) continue;
    if (auto in = check(lamp.name, lamp.pose.position_m); !in) return in;
  }
  for (const PredictedPoint& point : simulated.points) {
    const Vec3& p = point.at.position_m;
    const std::string at = ShortestText(p[0]) + "," + ShortestText(p[1]) + "," + ShortestText(p[2]);
    if (auto in = check(at, p); !in) return in;
  }
  return {};
}

// Of the room the lamps were measured in, the session's own or one nobody stated; of another
// (--room) no meter said anything.
void PredictRooms(const SimulateOptions& options, const Input& input, Simulated& simulated) {
  const auto chosen = ChooseLights(input.lights, options.lights);
  if (!chosen || !options.room.empty() || chosen->size() != simulated.lamps.size()) return;
  MapSettings lamps_alone = simulated.settings;
  lamps_alone.room.reset();
  const IlluminancePredictor predictor(simulated.lamps, lamps_alone);
  for (PredictedPoint& point : simulated.points) {
    const std::vector<LampLux> alone =
        simulated.settings.room ? predictor.At(point.at) : point.parts;
    for (std::size_t k = 0; k < simulated.lamps.size(); ++k) {
      point.in_room.push_back(LuxInRoom(*(*chosen)[k], simulated.lamps[k], alone[k], point.at));
    }
  }
}

void Predict(Simulated& simulated) {
  const auto start = std::chrono::steady_clock::now();
  const IlluminancePredictor predictor(simulated.lamps, simulated.settings);
  simulated.accounts.assign(simulated.lamps.size(), {});
  for (PredictedPoint& point : simulated.points) {
    std::vector<LampAccount> accounts;
    point.parts = predictor.At(point.at, &accounts);
    for (std::size_t k = 0; k < accounts.size(); ++k) simulated.accounts[k] += accounts[k];
  }
  if (simulated.plane) {
    simulated.map = predictor.Over(simulated.plane->grid);
    for (std::size_t k = 0; k < simulated.lamps.size(); ++k) {
      simulated.accounts[k] += simulated.map.accounts[k];
    }
    const auto ambient = static_cast<float>(simulated.ambient_lx);
    if (ambient > 0.0F) {
      for (float& lux : simulated.map.lux) lux += ambient;
    }
  }
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
  simulated.elapsed_ms = took.count();
}

Result<std::vector<PlacedLamp>> LampsAsked(const SimulateOptions& options, const Input& input,
                                           Console& console) {
  const auto chosen = ChooseLights(input.lights, options.lights);
  if (!chosen) return tl::unexpected(chosen.error());
  const auto places = ParseLampPlaces(options.places, *chosen);
  if (!places) return tl::unexpected(places.error());
  Warnings warnings;
  const auto picture = [&](const FittedLight& light) {
    return LoadEnvironment(light, input.folder, devices::DiskSources());
  };
  auto lamps = PlaceLamps(*chosen, *places, picture, warnings);
  if (lamps) console.Warn(warnings);
  return lamps;
}

Result<Simulated> Prepare(const SimulateOptions& options, const Input& input, double tolerance,
                          Console& console) {
  const auto effects = ParseEffects(options.effects);
  if (!effects) return tl::unexpected(effects.error());
  const auto room = RoomOf(options, input);
  if (!room) return tl::unexpected(room.error());
  Simulated out;
  auto lamps = LampsAsked(options, input, console);
  if (!lamps) return Propagate(std::move(lamps));
  out.lamps = *std::move(lamps);
  out.settings.tolerance = tolerance;
  out.settings.finite_source = effects->finite_source;
  out.settings.room_bounce = effects->room_bounce;
  out.settings.room = *room;
  if (input.session) out.surroundings = input.session->surroundings;
  for (const FittedLight& light : input.lights.lights) {
    if (effects->ambient && light.ambient_lx) {
      out.ambient_lx = std::max(out.ambient_lx, light.ambient_lx->value);
    }
  }
  auto points = Points(options, out.lamps);
  if (!points) return Propagate(std::move(points));
  out.points = *std::move(points);
  if (!options.border.empty()) {
    const auto border = ParseLength(options.border);
    if (!border) return tl::unexpected(border.error());
    if (border->value() < 0.0) return WrongUsage("--border", "must not be negative");
    out.border_m = border->value();
  }
  if (!options.target.empty()) {
    const auto target = ParseGridTarget(options.target);
    if (!target) return tl::unexpected(target.error());
    out.target = *target;
  }
  if (options.plane.plane.empty()) return out;
  auto plane = ReadMapPlane(options.plane, out.lamps, *room);
  if (!plane) return Propagate(std::move(plane));
  out.plane = *std::move(plane);
  return out;
}

Result<void> RunSimulate(const SimulateOptions& options, Console& console) {
  if (auto ok = CheckSimulate(options); !ok) return ok;
  const auto tolerance = ParseTolerance(options.tolerance);
  if (!tolerance) return tl::unexpected(tolerance.error());
  const auto input = ReadInput(options, *tolerance, console);
  if (!input) return tl::unexpected(input.error());
  auto simulated = Prepare(options, *input, *tolerance, console);
  if (!simulated) return Propagate(std::move(simulated));
  if (auto in = CheckInRoom(*simulated); !in) return in;
  Predict(*simulated);
  PredictRooms(options, *input, *simulated);
  if (!options.timing) simulated->elapsed_ms.reset();
  const std::string title = options.title.empty() ? input->title : options.title;
  auto writers = MapWriters(*simulated, options.outputs, {title, options.scale});
  if (!writers) return Propagate(std::move(writers));
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  if (auto written = WriteOutputsWith(*writers, options.force); !written) return written;
  simulated->files = options.outputs;
  console.Print(AnswerText(*simulated));
  console.PrintDocument(AnswerNode(*simulated));
  for (const std::string& file : options.outputs) console.Note("wrote " + file);
  return {};
}

}  // namespace

Run BuildSimulate(CLI::App& parser) {
  auto options = std::make_shared<SimulateOptions>();
  parser.add_option("input", options->input, "light.json, session directory or .toml file")
      ->required();
  parser.add_option("--at", options->at, "Points x,y,z in metres, Z up: --at 0,0,0 1,0,0");
  parser
      .add_option("--normal", options->normal,
                  "How a surface at --at is turned: up, lamp (faces the brightest), or x,y,z")
      ->capture_default_str();
  parser.add_option("--plane", options->plane.plane, "A map of: floor, z=0.8, x=-2 or y=1.5");
  parser.add_option("--grid", options->plane.grid, "Points of its longer side, or 512x256")
      ->capture_default_str();
  parser.add_option("--size", options->plane.size,
                    "Of the map, e.g. 6m or 6x4m [the room's, or around the lamps]");
  parser.add_option("--center", options->plane.center, "Of the map, in its two coordinates: 1,2");
  CLI::Option* const plane = parser.get_option("--plane");
  parser
      .add_option("--border", options->border,
                  "Of the map, left out of least, mean and uniformity: .5m")
      ->needs(plane);
  parser
      .add_option("--target", options->target,
                  "What the map's mean, least and uniformity are held to: 500lx,min=300lx,U0=0.6")
      ->needs(plane);
  parser.add_option("--lights", options->lights, "Only these of the lights, e.g. key,fill")
      ->delimiter(',')
      ->allow_extra_args(false);
  parser
      .add_option("--position", options->places.position,
                  "Where a light stands: [NAME=]x,y,z; may be repeated")
      ->allow_extra_args(false);
  parser.add_option("--aim", options->places.aim, "Where it shines: [NAME=]x,y,z")
      ->allow_extra_args(false);
  parser
      .add_option("--axis", options->places.axis,
                  "Of a tube's length or a rect's width: [NAME=]x,y,z")
      ->allow_extra_args(false);
  parser.add_option("--room", options->room,
                    "Walls that throw light back: width,depth,height, origin under its middle "
                    "[the session's]");
  parser.add_option("--reflectance", options->reflectance, "Of the walls of --room")
      ->capture_default_str();
  parser.add_option("--tol", options->tolerance, "Tolerance of the effect gate")
      ->capture_default_str();
  parser
      .add_option("--effects", options->effects,
                  "auto, all, none, or +name,-name: finite_source, room_bounce, ambient")
      ->capture_default_str();
  parser.add_option("-o,--output", options->outputs, "The map: .png .svg .exr .csv")
      ->allow_extra_args(false);
  parser.add_option("--scale", options->scale, "Of the picture's colours [by the map]")
      ->check(CLI::IsMember({"log", "linear"}));
  parser.add_option("--title", options->title, "Of the picture");
  parser.add_flag("--timing", options->timing, "Say how long it took");
  parser.add_flag("--force", options->force, "Replace files that lightcal did not write");
  return [options](Console& console) { return RunSimulate(*options, console); };
}

}  // namespace lightcal::app
