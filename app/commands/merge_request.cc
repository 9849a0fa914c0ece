// SPDX-License-Identifier: Apache-2.0
#include "merge_request.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "color_words.h"
#include "input_files.h"
#include "lightcal/calibrate/camera/read_camera_profile.h"
#include "lightcal/calibrate/merge_bracket.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "lightcal/imaging/bracket/encoded_errors.h"
#include "lightcal/records/stored_pixels.h"
#include "picture_words.h"
#include "progress_line.h"

namespace lightcal::app {
namespace {

// "x,y,w,h=NITS"
Result<SpotReading> ParseAnchor(const std::string& text, const std::string& sigma) {
  const auto wrong = [&] {
    return WrongUsage("--anchor", "\"" + text +
                                      "\" is not x,y,w,h=NITS, e.g. 1200,800,40,40=312 for a meter "
                                      "that read 312 cd/m2 there");
  };
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) return wrong();
  std::vector<int> numbers;
  std::string_view rest = std::string_view(text).substr(0, equals);
  while (!rest.empty()) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    const auto number = ParseNumber(rest.substr(0, comma));
    if (!number || *number != std::floor(*number) || std::abs(*number) > 1e6) return wrong();
    numbers.push_back(static_cast<int>(*number));
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  const auto reading = SplitNumberAndUnit(std::string_view(text).substr(equals + 1));
  const bool known_unit =
      reading && (reading->unit.empty() || reading->unit == "nits" || reading->unit == "cd/m2");
  if (numbers.size() != 4 || !known_unit) return wrong();
  if (!(reading->number > 0.0)) {
    return Refused("bad_anchor", "--anchor", "a luminance reading is above 0");
  }
  const auto share = ParseShare("--anchor-sigma", sigma);
  if (!share) return tl::unexpected(share.error());
  return SpotReading{numbers[0], numbers[1], numbers[2], numbers[3], Nits(reading->number), *share};
}

Result<BracketOverrides> OverridesOf(const MergeOptions& options) {
  BracketOverrides overrides;
  for (const std::string& text : options.exposures) {
    const auto time = ParseDuration(text);
    if (!time) return tl::unexpected(time.error());
    if (!(time->value() > 0.0)) {
      return Refused("not_positive", "--exposures", "an exposure takes time: above zero");
    }
    overrides.exposure.push_back(*time);
  }
  if (!options.f_number.empty()) {
    const auto f_number = ParseFNumber(options.f_number);
    if (!f_number) return tl::unexpected(f_number.error());
    overrides.f_number = *f_number;
  }
  if (!options.t_stop.empty()) {
    if (overrides.f_number) return WrongUsage("--t-stop", "stands instead of --f-number");
    const bool letter = options.t_stop.starts_with('T') || options.t_stop.starts_with('t');
    const auto t_stop = ParseNumber(std::string_view(options.t_stop).substr(letter ? 1 : 0));
    if (!t_stop) return WrongUsage("--t-stop", "\"" + options.t_stop + "\" is not T2.9 or 2.9");
    overrides.t_stop = *t_stop;
  }
  if (!options.iso.empty()) {
    const auto iso = ParseNumber(options.iso);
    if (!iso) return WrongUsage("--iso", "\"" + options.iso + "\" is not an ISO speed");
    overrides.iso = *iso;
  }
  if (overrides.f_number.value_or(1.0) <= 0.0 || overrides.t_stop.value_or(1.0) <= 0.0 ||
      overrides.iso.value_or(1.0) <= 0.0) {
    return Refused("not_positive", "--f-number, --t-stop, --iso", "are above zero");
  }
  return overrides;
}

// --camera with what belongs to it.
Result<void> AddCamera(const MergeOptions& options, const Sources& sources,
                       BracketMergeRequest& request) {
  if (!options.cos4.empty()) {
    const auto width = ParseLength(options.cos4);
    if (!width) return tl::unexpected(width.error());
    if (!(width->value() > 1e-4 && width->value() < 1.0)) {
      return WrongUsage("--cos4", "takes the width of the sensor, e.g. 36mm");
    }
    request.cosine_fourth = *width;
  }
  if (options.camera.empty()) {
    if (options.nd.empty() && options.lamp_class.empty() && !options.no_flat) return {};
    return WrongUsage("--nd, --lamp-class, --no-flat", "belong to a profile: add --camera");
  }
  auto profile = ReadCameraProfile(options.camera, sources);
  if (!profile) return Propagate(std::move(profile));
  LampClass lamp = LampClass::kUnknown;
  if (!options.lamp_class.empty()) {
    const auto word = std::ranges::find(kLampClassWords, options.lamp_class);
    lamp = static_cast<LampClass>(word - kLampClassWords.begin());
  }
  const auto factor = CameraMismatch(*profile, lamp);
  if (!factor) return tl::unexpected(factor.error());
  request.lamp = *factor;
  request.camera = KnownCamera{std::make_shared<const CameraProfile>(std::move(*profile)),
                               options.nd, !options.no_flat};
  return {};
}

Result<BracketMergeRequest> RequestOf(const MergeOptions& options, const Sources& sources) {
  BracketMergeRequest request;
  request.want_sigma = !options.sigma.empty();
  request.align = options.align == "auto";
  if (!options.anchor.empty()) {
    const auto anchor = ParseAnchor(options.anchor, options.anchor_sigma);
    if (!anchor) return tl::unexpected(anchor.error());
    request.anchor = *anchor;
  }
  if (!options.noise.empty()) {
    if (options.noise.size() != 2 || !(options.noise[0] >= 0.0) || !(options.noise[1] > 0.0)) {
      return WrongUsage("--noise",
                        "takes SCALE,OFFSET of Var(x) = SCALE x + OFFSET, x = 1 at full "
                        "scale, as DNG's NoiseProfile has them");
    }
    request.noise = NoiseProfile{options.noise[0], options.noise[1]};
  }
  if (!options.white.empty() && options.space.empty()) {
    return WrongUsage("--white", "belongs to a colour picture: add --space");
  }
  const auto colors = ParseColorWords(options.space, options.white);
  if (!colors) return tl::unexpected(colors.error());
  request.space = colors->space;
  request.white = colors->white;
  if (!options.response.empty()) {
    auto response = ReadResponse(options.response, options.response, sources);
    if (!response) return Propagate(std::move(response));
    request.response = *std::move(response);
  }
  if (auto added = AddCamera(options, sources, request); !added) return Propagate(std::move(added));
  return request;
}

}  // namespace

Result<OpenedMerge> OpenMerge(const MergeOptions& options) {
  OpenedMerge opened;
  opened.sources = InputSources();
  auto request = RequestOf(options, opened.sources);
  if (!request) return Propagate(std::move(request));
  opened.request = *std::move(request);
  const auto overrides = OverridesOf(options);
  if (!overrides) return tl::unexpected(overrides.error());
  const auto lamps = ParseLamps(options.mains, options.pwm);
  if (!lamps) return tl::unexpected(lamps.error());
  opened.lamps = *lamps;
  auto bracket = opened.sources.open_bracket(options.frames, *overrides);
  if (!bracket) return Propagate(std::move(bracket));
  opened.bracket = *std::move(bracket);
  if (const auto& anchor = opened.request.anchor) {
    const FrameInfo& info = opened.bracket.frames.front();
    auto fits = CheckTurned(info.file, info, {anchor->x, anchor->y, anchor->width, anchor->height},
                            opened.bracket.warnings);
    if (!fits) return Propagate(std::move(fits));
  }
  if (auto safe = RefuseHopelessShutter(opened.bracket.frames, *lamps); !safe) {
    return Propagate(std::move(safe));
  }
  return opened;
}

Result<MergedBracket> MergeOpened(const OpenedMerge& opened, Console& console) {
  ProgressLine progress("merging", !console.quiet());
  BracketMergeRequest request = opened.request;
  request.progress = progress.Watcher();
  auto merged = MergeBracket(opened.bracket, opened.sources, request);
  progress.Wipe();
  if (!merged) return merged;
  console.Warn(merged->warnings);
  console.Warn(CheckShutters(opened.bracket.frames, opened.lamps));
  return merged;
}

namespace {

const char* NoiseWord(NoiseSource source) {
  switch (source) {
    case NoiseSource::kCamera:
      return "camera";
    case NoiseSource::kGiven:
      return "given";
    case NoiseSource::kFile:
      return "noise_profile";
    case NoiseSource::kEstimated:
      return "estimated";
    case NoiseSource::kAssumed:
      return "assumed";
  }
  return "assumed";
}

Node FrameNode(const MergedFrame& frame) {
  const FrameExposure& exposure = frame.info.exposure;
  Node node = {{"file", frame.info.file},
               {"exposure_s", exposure.time},
               {"f_number", exposure.f_number},
               {"t_stop", exposure.t_stop},
               {"iso", exposure.iso},
               {"shutter_angle_deg", exposure.written.shutter_angle_deg},
               {"frames_per_second", exposure.written.frames_per_second},
               {"image_counter", frame.info.image_counter},
               {"ratio_ev", frame.ratio_ev},
               {"used", frame.used}};
  if (const auto& moved = frame.moved) {
    node.Put({{"shift_px", {moved->x, moved->y}},
              {"shift_sd_px", moved->sd},
              {"taken_back_px", {moved->taken_back_x, moved->taken_back_y}}});
    if (const auto& h = moved->from_reference) {
      node.Put({{"turned_deg", moved->turned_deg}, {"homography", Node::List(h->m)}});
    }
  }
  return node;
}

// What the camera's profile took out; absent where it did nothing.
Node CorrectionsNode(const MergedBracket& merged) {
  const SampleCorrections& corrections = merged.corrections;
  const auto& flat = corrections.flat();
  if (!flat && !(corrections.black_sd() > 0.0) &&
      corrections.hot_pixels() <= merged.masked_pixels) {
    return {};
  }
  Node node = {{"hot_pixels", corrections.hot_pixels()},
               {"black_sigma_nits", corrections.black_sd() * merged.nits_per_unit}};
  if (flat) {
    const bool prior = corrections.flat_source() == SampleCorrections::FlatSource::kCosineFourth;
    node.Put("flat", {{"source", prior ? "cos4_prior" : "measured"},
                      {"f_number", flat->f_number},
                      {"sigma_relative", flat->sigma_relative}});
  }
  return node;
}

}  // namespace

Node DocumentOf(const MergedBracket& merged) {
  const auto& crop = merged.crop;
  return {{"frames", Node::List(merged.frames, FrameNode)},
          {"scale",
           {{"nits_per_unit", merged.nits_per_unit},
            {"source", WordOf(merged.scale_source)},
            {"u95_relative", merged.scale_u95_relative}}},
          {"clipped_fraction", merged.clipped_fraction},
          {"noise",
           {{"source", NoiseWord(merged.noise_source)},
            {"scale", merged.plan.noise.front().scale},
            {"offset", merged.plan.noise.front().offset},
            {"fixed_pattern", merged.plan.fixed_pattern},
            {"curve_misfit", merged.plan.encoded ? Node(merged.plan.encoded->misfit) : Node()}}},
          {"response", Node::UnlessEmpty(merged.response_source)},
          {"aligned_to", Node::UnlessEmpty(merged.aligned_to)},
          {"crop", crop ? Node{crop->x, crop->y, crop->width, crop->height} : Node()},
          {"masked_pixels", merged.masked_pixels > 0 ? Node(merged.masked_pixels) : Node()},
          {"camera", CorrectionsNode(merged)},
          {"width", merged.width},
          {"height", merged.height}};
}

}  // namespace lightcal::app
