// SPDX-License-Identifier: Apache-2.0
#include "inspect/glare_words.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "input_files.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "lightcal/imaging/scene/picture_luminance.h"
#include "picture_words.h"

namespace lightcal::app {
namespace {

// "2000", "2000cd/m2", "2000nits".
Result<double> ParseNits(const std::string& option, const std::string& text) {
  constexpr std::array<std::string_view, 5> kUnits = {"", "cd/m2", "cd/m²", "nits", "nit"};
  const auto parts = SplitNumberAndUnit(text);
  if (!parts || !(parts->number > 0.0) || std::ranges::find(kUnits, parts->unit) == kUnits.end()) {
    return WrongUsage(option, "\"" + text + "\" is no luminance such as 2000 or 2000cd/m2");
  }
  return parts->number;
}

// evalglare's -r is in radians, and so are bare numbers here.
Result<Radians> ParseSearchRadius(const std::string& text) {
  const auto bare = ParseNumber(text);
  const auto angle = bare ? Result<Radians>(Radians(*bare)) : ParseAngle(text);
  if (!angle || !(angle->value() > 0.0 && angle->value() < 3.0)) {
    return WrongUsage("--glare-radius",
                      "\"" + text + "\" is no angle such as 0.2 (radians) or 11deg");
  }
  return *angle;
}

bool EndsInAny(const std::string& path, std::initializer_list<std::string_view> endings) {
  const std::string low = LowerAscii(path);
  return std::any_of(endings.begin(), endings.end(),
                     [&](std::string_view ending) { return low.ends_with(ending); });
}

Result<void> CheckGlareWords(const GlareWords& words) {
  for (const std::string& path : words.outputs) {
    if (!EndsInAny(path, {".png", ".svg", ".csv"})) {
      return WrongUsage("-o", "\"" + path +
                                  "\" must end in .png, .svg (the picture with its "
                                  "sources) or .csv (the sources)");
    }
  }
  if (words.wanted) return {};
  const bool any = !words.threshold.empty() || !words.radius.empty() || !words.peak.empty() ||
                   words.no_peak || words.peaks_too || words.no_dim || !words.task.empty() ||
                   !words.vertical.empty() || !words.scale_u95.empty() || !words.sigma.empty() ||
                   !words.outputs.empty();
  if (any) {
    return WrongUsage("--glare",
                      "-b, -r, -y, -Y, -x, -i, --task, --sigma, --scale-u95 and -o belong to "
                      "--glare; add it");
  }
  return {};
}

Result<std::vector<float>> ReadSigma(const std::string& path, const InspectedPicture& inspected) {
  auto sigma = InspectPicture(path, InputSources(), {}, LuminanceConvention::kPhotometric);
  if (!sigma) return Propagate(std::move(sigma));
  if (sigma->luminance.width != inspected.luminance.width ||
      sigma->luminance.height != inspected.luminance.height) {
    return Refused("bad_view", "--sigma", path + " and the picture differ in size");
  }
  return std::move(sigma->luminance.nits);
}

}  // namespace

void AddGlareOptions(CLI::App& parser, GlareWords& words) {
  parser.add_flag("--glare", words.wanted,
                  "Glare at the eye: Ev, sources, DGP, UGR, DGI, CGI (evalglare 2.10's defaults)");
  parser.add_option("-b,--glare-threshold", words.threshold,
                    "sources are brighter: cd/m², or up to 100 times the mean (of the task) "
                    "[2000cd/m2; 5 with --task, and for UGR where nothing is above]");
  parser.add_option("-r,--glare-radius", words.radius,
                    "sources nearer than half of it are one: radians [0.2]");
  parser.add_flag("-y", words.peaks_too, "as of evalglare; what -Y does without it");
  parser.add_option("-Y,--glare-peak", words.peak,
                    "from here on pixels are sources of their own [50000cd/m2]");
  parser.add_flag("-x,--glare-no-peak", words.no_peak, "they are not");
  parser.add_option("-i,--glare-ev", words.vertical,
                    "Ev as a meter at the eye read it, instead of the picture's: 850lx");
  parser.add_flag("--glare-no-dim", words.no_dim, "DGP without its correction below 1000 lx");
  parser.add_option("--task", words.task, "where the eye works: x,y,width,height in pixels")
      ->delimiter(',')
      ->expected(4)
      ->allow_extra_args(false);
  parser.add_option(
      "--scale-u95", words.scale_u95,
      "how sure the picture's cd/m² are, all in common, 95 % [what it says, else 20%]");
  parser.add_option("--sigma", words.sigma, "each pixel's standard deviation, as merge writes it");
  parser
      .add_option("-o,--output", words.outputs,
                  "the picture with its sources: .png .svg; the sources: .csv")
      ->allow_extra_args(false);
  parser.add_flag("--force", words.force, "Replace files that lightcal did not write");
}

Result<GlareSettings> GlareSettingsOf(const GlareWords& words) {
  if (auto ok = CheckGlareWords(words); !ok) return Propagate(std::move(ok));
  GlareSettings settings;
  if (!words.threshold.empty()) {
    const auto threshold = ParseNits("--glare-threshold", words.threshold);
    if (!threshold) return tl::unexpected(threshold.error());
    settings.threshold = *threshold;
  }
  if (!words.radius.empty()) {
    const auto radius = ParseSearchRadius(words.radius);
    if (!radius) return tl::unexpected(radius.error());
    settings.search_radius = *radius;
  }
  if (!words.peak.empty()) {
    const auto peak = ParseNits("--glare-peak", words.peak);
    if (!peak) return tl::unexpected(peak.error());
    settings.peak = Nits(*peak);
  }
  if (words.no_peak) settings.peak.reset();
  if (!words.task.empty()) {
    settings.task = Region{words.task[0], words.task[1], words.task[2], words.task[3]};
  }
  if (!words.vertical.empty()) {
    const auto vertical = ParseIlluminance(words.vertical);
    if (!vertical || !(vertical->value() > 0.0)) {
      return WrongUsage("--glare-ev",
                        "\"" + words.vertical + "\" is no illuminance such as 850 or 850lx");
    }
    settings.vertical = *vertical;
  }
  settings.dim_correction = !words.no_dim;
  if (!words.scale_u95.empty()) {
    const auto share = ParseShare("--scale-u95", words.scale_u95);
    if (!share) return tl::unexpected(share.error());
    settings.scale_u95 = *share;
  }
  return settings;
}

Result<GlareAnswer> MeasureGlareOf(const GlareWords& words, GlareSettings settings,
                                   const InspectedPicture& inspected,
                                   const std::optional<PixelSolidAngles>& angles) {
  if (!angles) {
    return Refused("no_projection", inspected.info.file,
                   "glare needs the direction of each pixel, and the file does not say it; give "
                   "--projection equidistant --fov 180, latlong of a whole panorama, or as your "
                   "lens draws");
  }
  if (inspected.luminance.scale == "assumed_nits") {
    return Refused("no_absolute_scale", inspected.info.file,
                   "glare depends on cd/m², and the file does not say what 1.0 is; name it "
                   "(--luminance-convention), or merge its bracket (lightcal merge)");
  }
  GlareAnswer answer;
  answer.scale_source = "stated";
  if (words.scale_u95.empty()) {
    constexpr double kMost = 0.95;
    const bool unit_known = inspected.luminance.scale != "assumed_nits";
    answer.scale_source = inspected.scale_u95_relative ? "picture"
                          : unit_known                 ? "assumed"
                                                       : "unknown";
    settings.scale_u95 =
        unit_known ? std::min(kMost, inspected.scale_u95_relative.value_or(kUnstatedScaleU95))
                   : kMost;
  }
  answer.scale_u95 = settings.scale_u95;
  answer.ev_stated = settings.vertical.has_value();
  std::vector<float> sigma;
  if (!words.sigma.empty()) {
    auto read = ReadSigma(words.sigma, inspected);
    if (!read) return Propagate(std::move(read));
    sigma = std::move(*read);
  }
  const View2d<const float> sigma_view =
      sigma.empty() ? View2d<const float>()
                    : View2d<const float>(sigma.data(), inspected.luminance.width,
                                          inspected.luminance.height);
  auto glare = MeasureGlare(inspected.luminance.view(), *angles, settings, sigma_view);
  if (!glare) return Propagate(std::move(glare));
  answer.glare = std::move(*glare);
  return answer;
}

}  // namespace lightcal::app
