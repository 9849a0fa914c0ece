// SPDX-License-Identifier: Apache-2.0
// lightcal merge: a bracket of frames -> luminance in cd/m^2, with a sigma for every pixel.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>

#include "color_words.h"
#include "commands.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/captures/picture.h"
#include "merge_request.h"
#include "one_of.h"
#include "output_files.h"
#include "picture_words.h"

namespace lightcal::app {
namespace {

// Order of exposures, what was used, and where the scale is from: enough to repeat the merge.
std::vector<std::pair<std::string, std::string>> Attributes(const MergedBracket& merged,
                                                            const std::string& quantity) {
  std::string sources;
  for (const MergedFrame& frame : merged.frames) {
    sources += (sources.empty() ? "" : " ") + frame.info.file;
    if (frame.ratio_ev) sources += "@" + RoundedText(*frame.ratio_ev, 6) + "EV";
  }
  std::vector<std::pair<std::string, std::string>> attributes = {
      {"generator", GeneratorName()},
      {"quantity", quantity},
      {"frames", sources},
      {"scale_source", std::string(WordOf(merged.scale_source))},
      {"scale_u95_relative", RoundedText(merged.scale_u95_relative, 3)},
      {"nits_per_unit", ShortestText(merged.nits_per_unit)}};
  if (merged.clipped_fraction > 0.0) {
    attributes.emplace_back("clipped_fraction", ShortestText(merged.clipped_fraction));
  }
  if (!merged.response_source.empty()) attributes.emplace_back("response", merged.response_source);
  return attributes;
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

std::string ScaleText(ScaleSource source) {
  if (source == ScaleSource::kAnchor) return "the spot reading";
  return source == ScaleSource::kCamera ? "the camera's profile" : "the ISO speed (prior)";
}

// How the camera turned and what is left of the picture; nothing of one on a tripod.
std::string MovesText(const MergedBracket& merged) {
  std::string text;
  for (const MergedFrame& frame : merged.frames) {
    if (!frame.moved || !frame.moved->from_reference || frame.info.file == merged.aligned_to)
      continue;
    text += frame.info.file + ": turned " + RoundedText(std::abs(frame.moved->turned_deg), 2) +
            " deg, shifted " + RoundedText(std::hypot(frame.moved->x, frame.moved->y), 3) +
            " px (± " + RoundedText(2.0 * frame.moved->sd, 1) + " px)\n";
  }
  if (text.empty()) return text;
  const Region& crop = *merged.crop;
  return text + "aligned to " + merged.aligned_to +
         ", of which x,y,w,h = " + std::to_string(crop.x) + "," + std::to_string(crop.y) + "," +
         std::to_string(crop.width) + "," + std::to_string(crop.height) + " is left\n";
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
  text += MovesText(merged);
  text += "luminance up to " + RoundedText(*high, 4) + " cd/m2 (lowest " + RoundedText(*low, 2) +
          "), scale ± " + RoundedText(100.0 * merged.scale_u95_relative, 2) + " % from " +
          ScaleText(merged.scale_source) + "\n";
  return text;
}

Result<void> RunMerge(const MergeOptions& options, Console& console) {
  const auto opened = OpenMerge(options);
  if (!opened) return tl::unexpected(opened.error());
  const BracketMergeRequest* const request = &opened->request;
  std::vector<PlannedOutput> planned = {{options.output, "exr"}};
  if (request->want_sigma) planned.push_back({options.sigma, "exr"});
  if (!options.response_output.empty()) planned.push_back({options.response_output, "csv"});
  if (auto free = CheckOutputs(planned, options.force); !free) return free;
  const auto merged = MergeOpened(*opened, console);
  if (!merged) return tl::unexpected(merged.error());
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  std::vector<OutputWriter> outputs = {PictureWriter(options, *request, *merged)};
  if (request->want_sigma) outputs.push_back(SigmaWriter(options, *merged));
  if (!options.response_output.empty()) {
    if (merged->response.signal_of_code[0].empty()) {
      return Refused("no_codes", "--save-response", "these frames are no codes: nothing bent them");
    }
    outputs.push_back(WriterOf({options.response_output, ResponseToText(merged->response)}));
  }
  if (auto written = WriteOutputsWith(outputs, options.force); !written) return written;
  console.Print(Table(*merged));
  console.PrintDocument(DocumentOf(*merged));
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
  parser.add_option(
      "--response", o.response,
      "Of PNG or JPEG codes: srgb (what programs write, no camera's own JPEG), linear, "
      "or a table of code,red,green,blue [recovered from two frames and more]");
  parser.add_option("--save-response", o.response_output,
                    "Also write that table here (.csv), for pictures of the same camera and style");
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
                  "auto: take back how a camera in the hand moved and turned, only on evidence; "
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
