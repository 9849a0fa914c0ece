// SPDX-License-Identifier: Apache-2.0
// lightcal shoot: a bracket from a tethered camera into a session.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "commands.h"
#include "guide/shell_word.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "one_of.h"
#include "picture_words.h"
#include "shooting/bracket_shoot.h"

namespace lightcal::app {
namespace {

struct ShootOptions {
  ShootRequest request;
  std::string bracket;
  std::string mains, pwm;  // both empty: nothing flickers
  std::string use, distance, tilt, fov, lamp_class;
  double reflectance = 0.0;
  std::vector<int> rect;
};

template <class Words>
std::size_t IndexOf(const std::string& word, const Words& words) {
  return static_cast<std::size_t>(std::ranges::find(words, std::string_view(word)) - words.begin());
}

// What the options make of the frames; absent where they say nothing of it.
Result<std::optional<CaptureDescription>> CaptureOf(const ShootOptions& options) {
  const bool described = !options.use.empty() || !options.distance.empty() ||
                         options.reflectance > 0.0 || !options.rect.empty() ||
                         !options.tilt.empty() || !options.fov.empty() ||
                         !options.lamp_class.empty();
  if (!described) return std::nullopt;
  CaptureDescription capture;
  if (!options.use.empty()) {
    capture.use = static_cast<CaptureUse>(IndexOf(options.use, kCaptureUseWords));
  }
  capture.reflectance = options.reflectance;
  if (!options.distance.empty()) {
    const auto distance = ParseLength(options.distance);
    if (!distance) return tl::unexpected(distance.error());
    capture.distance = *distance;
  }
  if (!options.tilt.empty()) {
    const auto tilt = ParseAngle(options.tilt);
    if (!tilt) return tl::unexpected(tilt.error());
    capture.tilt = *tilt;
  }
  if (!options.fov.empty()) {
    const auto fov = ParseAngle(options.fov);
    if (!fov) return tl::unexpected(fov.error());
    capture.field_of_view = *fov;
  }
  if (!options.rect.empty()) {
    capture.rect = {options.rect[0], options.rect[1], options.rect[2], options.rect[3]};
  }
  if (!options.lamp_class.empty()) {
    capture.lamp_class = static_cast<LampClass>(IndexOf(options.lamp_class, kLampClassWords));
  }
  const bool card = capture.use == CaptureUse::kCard;
  if (card && !(capture.reflectance > 0.0)) {
    return WrongUsage("--reflectance", "say what the card reflects, for example 0.18");
  }
  const bool source = capture.use == CaptureUse::kSource;
  if (!card && !source) {
    return WrongUsage("--use",
                      "shoot without --use, then describe the frames in a [[capture]] of "
                      "session.toml: a wall, a dome and a ball need more than fits here");
  }
  if (!capture.distance) {
    return WrongUsage("--distance",
                      "say how far the card (or the camera, for a source) stood from "
                      "the lamp, for example 0.8m");
  }
  if (source && !capture.field_of_view) {
    return WrongUsage("--fov", "say what the lens sees across the picture's width, for example 40");
  }
  return capture;
}

Result<ShootRequest> RequestOf(const ShootOptions& options) {
  ShootRequest request = options.request;
  if (request.resume) return request;
  if (options.bracket.empty()) {
    return WrongUsage("--bracket", "give half the range and the step, for example ±4EV/1EV");
  }
  auto bracket = devices::ParseBracket(options.bracket);
  if (!bracket) return Propagate(std::move(bracket));
  request.bracket = *std::move(bracket);
  if (!options.mains.empty() || !options.pwm.empty()) {
    const auto lamps = ParseLamps(options.mains.empty() ? "none" : options.mains, options.pwm);
    if (!lamps) return tl::unexpected(lamps.error());
    request.bracket.lamps = lamps->mains;
    if (lamps->pwm) request.bracket.lamps.push_back(*lamps->pwm);
  }
  auto capture = CaptureOf(options);
  if (!capture) return Propagate(std::move(capture));
  request.capture = *std::move(capture);
  return request;
}

std::string SecondsCell(double seconds) {
  return (seconds < 0.3 ? "1/" + ShortestText(std::round(1.0 / seconds))
                        : RoundedText(seconds, 3)) +
         " s";
}

std::string FramesTable(const TetheredShoot& shoot) {
  std::vector<std::vector<std::string>> rows;
  for (const ShotFrame& frame : shoot.frames) {
    rows.push_back({frame.shutter, SecondsCell(frame.planned_s), frame.file,
                    frame.exposure ? SecondsCell(frame.exposure->value()) : ""});
  }
  return TextTable({"shutter", "true time", "file", "file says"}, rows);
}

// What a person completes and puts into session.toml.
std::string BlockToPaste(const ShootOutcome& outcome) {
  return "\nTell session.toml what the pictures show, then lightcal run uses them:\n\n[[capture]]\n"
         "light = \"" +
         outcome.shoot.light + "\"\nframes = \"" + outcome.folder +
         "/frame_*\"\nuse = \"card\"          # or source, wall, dome\n"
         "# reflectance = 0.18  of the card\n# distance_m = 0.8    from the lamp to the card\n";
}

Node ToJson(const ShootOutcome& outcome, bool dry_run) {
  const TetheredShoot& shoot = outcome.shoot;
  Node settings = Node::Table();
  for (const NamedSetting& setting : shoot.settings) settings.Put(setting.name, setting.value);
  const auto frame_node = [&](const ShotFrame& frame) -> Node {
    return {{"shutter", frame.shutter},
            {"planned_s", frame.planned_s},
            {"file", frame.file.empty() ? Node() : Node(outcome.folder + "/" + frame.file)},
            {"exposure_s", frame.exposure},
            {"f_number", frame.f_number},
            {"iso", frame.iso}};
  };
  return {{"camera", shoot.camera},
          {"device", shoot.device},
          {"light", shoot.light},
          {"dry_run", dry_run ? Node(true) : Node()},
          {"folder", dry_run ? Node() : Node(outcome.folder)},
          {"in_session", dry_run ? Node() : Node(shoot.capture.has_value())},
          {"settings", Node::UnlessEmpty(settings)},
          {"frames", Node::List(shoot.frames, frame_node)}};
}

Result<void> RunShoot(const ShootOptions& options, Console& console) {
  const auto request = RequestOf(options);
  if (!request) return tl::unexpected(request.error());
  const auto outcome = ShootBracket(*request, console);
  if (!outcome) return tl::unexpected(outcome.error());
  console.Print(FramesTable(outcome->shoot));
  if (!request->dry_run) {
    if (!outcome->shoot.capture) console.Print(BlockToPaste(*outcome));
    console.Note(outcome->shoot.capture
                     ? "The session holds it: lightcal run " + ShellWord(request->session)
                     : "The frames are in " + outcome->folder);
  }
  console.PrintDocument(ToJson(*outcome, request->dry_run));
  return {};
}

}  // namespace

Run BuildShoot(CLI::App& parser) {
  auto options = std::make_shared<ShootOptions>();
  ShootRequest& request = options->request;
  parser.add_option("-s,--session", request.session, "Session the bracket is shot into")
      ->required();
  parser.add_option("-l,--light", request.light,
                    "Name of the lamp, as in session.toml [the only one]");
  parser.add_option("--bracket", options->bracket,
                    "Half the range and the step: ±4EV/1EV, 4EV/1EV");
  parser.add_option("--center", request.exposure.center,
                    "The middle shutter time (1/60), unless the camera stands at it");
  parser.add_option("--aperture", request.exposure.aperture, "f/8, unless as the camera stands");
  parser.add_option("--iso", request.exposure.iso, "100, unless as the camera stands");
  parser
      .add_option("--mains", options->mains,
                  "The lamp flickers with these mains, Hz; prefer whole periods")
      ->check(OneOf(kMainsWords));
  parser.add_option("--pwm", options->pwm, "HZ[,DUTY] of a dimmed lamp, likewise");
  parser.add_option(
      "--device", request.device,
      "gphoto2:ptpip:HOST, or an id of lightcal devices, where several are plugged in");
  parser.add_option("-o,--use", options->use, "What the frames are for: card, source")
      ->check(OneOf(kCaptureUseWords));
  parser.add_option("-d,--distance", options->distance, "From the lamp to the card: 0.8m");
  parser.add_option("--reflectance", options->reflectance, "Of the card: 0.18")
      ->check(CLI::Range(0.0, 1.0));
  parser.add_option("--fov", options->fov,
                    "Of a source: what the lens sees across the picture's width, degrees");
  parser.add_option("--tilt", options->tilt, "Between the card's normal and the lamp, degrees");
  parser.add_option("--rect", options->rect, "The card in the picture: X,Y,WIDTH,HEIGHT")
      ->delimiter(',')
      ->expected(4);
  parser.add_option("--lamp-class", options->lamp_class, "How the lamp makes its light")
      ->check(OneOf(kLampClassWords));
  parser.add_flag("--delete", request.delete_from_card,
                  "Take each frame off the camera's card once it is here");
  auto* dry =
      parser.add_flag("--dry-run", request.dry_run, "Show the frames; set and shoot nothing");
  parser.add_flag("--resume", request.resume, "Go on with the bracket that was broken off")
      ->excludes(dry);
  return [options](Console& console) { return RunShoot(*options, console); };
}

}  // namespace lightcal::app
