// SPDX-License-Identifier: Apache-2.0
// lightcal merge: a bracket of frames -> luminance in cd/m^2, with a sigma for every pixel.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>

#include "color_words.h"
#include "commands.h"
#include "input_files.h"
#include "lightcal/calibrate/camera/read_camera_profile.h"
#include "lightcal/calibrate/merge_bracket.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "lightcal/imaging/bracket/shutter_check.h"
#include "lightcal_devices/captures/picture.h"
#include "lightcal_devices/disk_sources.h"
#include "one_of.h"
#include "output_files.h"
#include "picture_words.h"

namespace lightcal::app {
namespace {

struct MergeOptions {
  std::vector<std::string> frames;
  std::string output, sigma;
  std::vector<std::string> exposures;
  std::string f_number, t_stop, iso;
  std::string anchor, anchor_sigma = "5%";
  std::vector<double> noise;
  std::string space, white;
  std::string camera, nd, lamp_class, cos4;
  bool no_flat = false;
  std::string align = "off", mains, pwm;
  bool uncompressed = false, force = false;
};

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
  if (auto added = AddCamera(options, sources, request); !added) return Propagate(std::move(added));
  return request;
}

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

// Order of exposures, what was used, and where the scale is from: enough to repeat the merge.
std::vector<std::pair<std::string, std::string>> Attributes(const MergedBracket& merged,
                                                            const std::string& quantity) {
  std::string sources;
  for (const MergedFrame& frame : merged.frames) {
    sources += (sources.empty() ? "" : " ") + frame.info.file;
    if (frame.ratio_ev) sources += "@" + RoundedText(*frame.ratio_ev, 6) + "EV";
  }
  return {{"generator", GeneratorName()},
          {"quantity", quantity},
          {"frames", sources},
          {"scale_source", std::string(WordOf(merged.scale_source))},
          {"scale_u95_relative", RoundedText(merged.scale_u95_relative, 3)},
          {"nits_per_unit", ShortestText(merged.nits_per_unit)}};
}

OutputWriter PictureWriter(const MergeOptions& options, const BracketMergeRequest& request,
                           const MergedBracket& merged) {
  return {options.output, "exr", [&options, &request, &merged](const std::string& temporary) {
            devices::ExrPicture exr;
            exr.samples = View2d<const float>(merged.picture.data(), merged.width, merged.height,
                                              merged.channels);
            exr.channel_names = {"Y"};
            if (request.space) {
              exr.channel_names = {"R", "G", "B"};
              exr.chromaticities = PrimariesOf(*request.space);
            }
            exr.white_luminance = Nits(1.0);
            exr.attributes = Attributes(merged, "luminance, cd/m2");
            exr.compressed = !options.uncompressed;
            return devices::WriteExr(temporary, exr);
          }};
}

OutputWriter SigmaWriter(const MergeOptions& options, const MergedBracket& merged) {
  return {options.sigma, "exr", [&options, &merged](const std::string& temporary) {
            devices::ExrPicture exr;
            exr.samples = View2d<const float>(merged.sigma.data(), merged.width, merged.height);
            exr.channel_names = {"Y"};
            exr.white_luminance = Nits(1.0);
            exr.attributes = Attributes(merged, "standard deviation of luminance, cd/m2");
            exr.compressed = !options.uncompressed;
            return devices::WriteExr(temporary, exr);
          }};
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

Node ToJson(const MergedBracket& merged) {
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
            {"fixed_pattern", merged.plan.fixed_pattern}}},
          {"crop", crop ? Node{crop->x, crop->y, crop->width, crop->height} : Node()},
          {"masked_pixels", merged.masked_pixels > 0 ? Node(merged.masked_pixels) : Node()},
          {"camera", CorrectionsNode(merged)},
          {"width", merged.width},
          {"height", merged.height}};
}

std::string ScaleText(ScaleSource source) {
  if (source == ScaleSource::kAnchor) return "the spot reading";
  return source == ScaleSource::kCamera ? "the camera's profile" : "the ISO speed (prior)";
}

std::string Table(const MergedBracket& merged) {
  std::vector<std::vector<std::string>> rows;
  for (const MergedFrame& frame : merged.frames) {
    const FrameExposure& exposure = frame.info.exposure;
    rows.push_back(
        {frame.info.file, exposure.time ? RoundedText(exposure.time->value(), 4) + " s" : "",
         exposure.t_stop     ? "T" + RoundedText(*exposure.t_stop, 3)
         : exposure.f_number ? "f/" + RoundedText(*exposure.f_number, 3)
                             : "",
         exposure.iso ? RoundedText(*exposure.iso, 4) : "",
         frame.ratio_ev ? RoundedText(*frame.ratio_ev, 4) : "", frame.used ? "yes" : "no"});
  }
  std::string text = TextTable({"frame", "time", "aperture", "ISO", "measured EV", "used"}, rows);
  const auto [low, high] = std::minmax_element(merged.picture.begin(), merged.picture.end());
  text += "luminance up to " + RoundedText(*high, 4) + " cd/m2 (lowest " + RoundedText(*low, 2) +
          "), scale ± " + RoundedText(100.0 * merged.scale_u95_relative, 2) + " % from " +
          ScaleText(merged.scale_source) + "\n";
  return text;
}

Result<void> RunMerge(const MergeOptions& options, Console& console) {
  const Sources sources = InputSources();
  const auto request = RequestOf(options, sources);
  if (!request) return tl::unexpected(request.error());
  const auto overrides = OverridesOf(options);
  if (!overrides) return tl::unexpected(overrides.error());
  const auto lamps = ParseLamps(options.mains, options.pwm);
  if (!lamps) return tl::unexpected(lamps.error());
  const auto bracket = sources.open_bracket(options.frames, *overrides);
  if (!bracket) return tl::unexpected(bracket.error());
  if (auto safe = RefuseHopelessShutter(bracket->frames, *lamps); !safe) return safe;
  std::vector<PlannedOutput> planned = {{options.output, "exr"}};
  if (request->want_sigma) planned.push_back({options.sigma, "exr"});
  if (auto free = CheckOutputs(planned, options.force); !free) return free;
  const auto merged = MergeBracket(*bracket, sources, *request);
  if (!merged) return tl::unexpected(merged.error());
  console.Warn(merged->warnings);
  console.Warn(CheckShutters(bracket->frames, *lamps));
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  std::vector<OutputWriter> outputs = {PictureWriter(options, *request, *merged)};
  if (request->want_sigma) outputs.push_back(SigmaWriter(options, *merged));
  if (auto written = WriteOutputsWith(outputs, options.force); !written) return written;
  console.Print(Table(*merged));
  console.PrintDocument(ToJson(*merged));
  console.Note("wrote " + options.output +
               (request->want_sigma ? " and " + options.sigma : std::string()));
  if (merged->scale_source == ScaleSource::kIsoPrior) {
    console.Note(
        "next: read one spot with a luminance meter and pass --anchor x,y,w,h=NITS; the "
        "scale is a prior until then");
  }
  return {};
}

}  // namespace

Run BuildMerge(CLI::App& parser) {
  auto options = std::make_shared<MergeOptions>();
  MergeOptions& o = *options;
  parser.add_option("frames", o.frames, "RAW, DNG, EXR, HDR, TIFF, PNG or JPEG files of one scene")
      ->required();
  parser.add_option("-o,--output", o.output, "The merged picture, OpenEXR, cd/m2")->required();
  parser.add_option("--sigma", o.sigma, "Also write each pixel's standard deviation here");
  parser
      .add_option("--exposures", o.exposures,
                  "Exposure times in the order of the files, e.g. 1,1/4,1/15 [from the files]")
      ->delimiter(',')
      ->allow_extra_args(false);
  parser.add_option("--f-number", o.f_number, "Aperture of all frames [from the files]");
  parser.add_option("--t-stop", o.t_stop, "T-stop of all frames instead [from the files]");
  parser.add_option("--iso", o.iso, "ISO speed of all frames [from the files]");
  parser.add_option("--anchor", o.anchor,
                    "A luminance meter's reading of pixels: x,y,w,h=NITS [ISO speed, a prior]");
  parser.add_option("--anchor-sigma", o.anchor_sigma, "The meter's 1 sigma")->capture_default_str();
  parser
      .add_option("--noise", o.noise,
                  "SCALE,OFFSET of the sensor's noise [NoiseProfile of the files, else measured]")
      ->delimiter(',')
      ->allow_extra_args(false);
  parser.add_option("--camera", o.camera,
                    "Profile of the camera, by lightcal camera: its scale, noise, lens, black");
  parser.add_option("--nd", o.nd, "The filter of the profile that the frames were taken through");
  parser
      .add_option("--lamp-class", o.lamp_class,
                  "Whose light it is; corrects how the camera misreads it")
      ->check(OneOf(kLampClassWords));
  parser.add_flag("--no-flat", o.no_flat, "Leave the profile's flat fields out");
  parser.add_option("--cos4", o.cos4,
                    "Width of the sensor, e.g. 36mm: where no flat field is known, take out what "
                    "an ideal lens loses towards the corners (a prior) [off]");
  parser.add_option("--space", o.space, "RGB in this space instead of luminance alone")
      ->check(OneOf(kSpaceWords));
  parser.add_option("--white", o.white,
                    "What becomes white: 3200K, D65 or x,y (luminance stays) [no adaptation]");
  parser
      .add_option("--align", o.align,
                  "auto: take back what the camera moved, by whole pixels and only on evidence; "
                  "crops to what all frames show")
      ->check(CLI::IsMember({"auto", "off"}))
      ->capture_default_str();
  parser
      .add_option("--mains", o.mains, "Which lamps' flicker shutters are checked for, Hz [either]")
      ->check(OneOf(kMainsWords));
  parser.add_option("--pwm", o.pwm, "HZ[,DUTY] of a dimmed lamp, to check shutters for");
  parser.add_flag("--uncompressed", o.uncompressed, "Faster, larger files");
  parser.add_flag("--force", o.force, "Replace files that lightcal did not write");
  return [options](Console& console) { return RunMerge(*options, console); };
}

}  // namespace lightcal::app
