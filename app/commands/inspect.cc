// SPDX-License-Identifier: Apache-2.0
// lightcal inspect: what a picture says of luminance, and of the light that reaches where it was
// taken.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "commands.h"
#include "input_files.h"
#include "inspect/glare_words.h"
#include "lightcal/calibrate/inspect_picture.h"
#include "lightcal/colorimetry/camera_neutral.h"
#include "lightcal/colorimetry/cct.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "lightcal/imaging/panorama/panorama.h"
#include "lightcal/imaging/scene/patches.h"
#include "lightcal/imaging/scene/picture_luminance.h"
#include "lightcal_devices/disk_sources.h"
#include "one_of.h"
#include "picture_words.h"

namespace lightcal::app {
namespace {

constexpr int kInspectDigits = 5;
struct InspectOptions {
  std::string image, projection, fov, convention;
  std::vector<int> rect;
  std::string exposure, f_number, iso;
  GlareWords glare;
};

struct InspectAnswer {
  LuminanceStatistics statistics;
  std::optional<RegionIlluminance> illuminance;
  std::optional<Vec3> peak_direction;
  std::optional<GlareAnswer> glare;
};

Result<double> Above0(const char* option, Result<double> number) {
  if (number && !(*number > 0.0)) return Refused("not_positive", option, "must be above zero");
  return number;
}

Result<BracketOverrides> OverridesOf(const InspectOptions& options) {
  BracketOverrides overrides;
  if (!options.exposure.empty()) {
    const auto time = ParseDuration(options.exposure);
    if (!time) return tl::unexpected(time.error());
    if (!(time->value() > 0.0)) return Refused("not_positive", "--exposure", "must be above zero");
    overrides.exposure = {*time};
  }
  if (!options.f_number.empty()) {
    const auto f_number = Above0("--f-number", ParseFNumber(options.f_number));
    if (!f_number) return tl::unexpected(f_number.error());
    overrides.f_number = *f_number;
  }
  if (!options.iso.empty()) {
    const auto typed = ParseNumber(options.iso);
    if (!typed) return WrongUsage("--iso", "\"" + options.iso + "\" is not an ISO speed");
    const auto iso = Above0("--iso", *typed);
    if (!iso) return tl::unexpected(iso.error());
    overrides.iso = *iso;
  }
  return overrides;
}

Result<InspectedPicture> Inspect(const InspectOptions& options, Console& console) {
  std::string word = options.convention.empty() ? "photometric" : options.convention;
  if (options.convention.empty() && options.glare.wanted) {
    const auto info = InputSources().read_frame_info(options.image);
    if (!info) return tl::unexpected(info.error());
    // Those who make pictures for glare mean Radiance's own unit.
    if (info->format == "hdr") word = "radiance";
  }
  const auto convention = ParseConvention("--luminance-convention", word);
  if (!convention) return tl::unexpected(convention.error());
  const auto overrides = OverridesOf(options);
  if (!overrides) return tl::unexpected(overrides.error());
  auto inspected = InspectPicture(options.image, InputSources(), *overrides, *convention);
  if (inspected) console.Warn(inspected->warnings);
  return inspected;
}

Result<Region> RegionOf(const InspectOptions& options, const PictureLuminance& picture) {
  if (options.rect.empty()) return Region{0, 0, picture.width, picture.height};
  const Region region{options.rect[0], options.rect[1], options.rect[2], options.rect[3]};
  if (auto ok = CheckRegion(region, picture.width, picture.height); !ok) {
    return Propagate(std::move(ok));
  }
  return region;
}

bool Holds(const Region& region, std::size_t pixel, int width) {
  const int at = static_cast<int>(pixel);
  return region.Holds(at % width, at / width);
}

// A sun that is cut off lights nothing.
void WarnOfCutOff(const InspectedPicture& inspected, const Region& region, Console& console) {
  const int width = inspected.luminance.width;
  std::vector<std::size_t> inside = inspected.cut_off;
  std::erase_if(inside, [&](std::size_t pixel) { return !Holds(region, pixel, width); });
  if (inside.empty()) return;
  const int first = static_cast<int>(inside.front());
  console.Warn({"maybe_clipped", inspected.info.file,
                std::to_string(inside.size()) +
                    (inside.size() == 1 ? " pixel ends" : " pixels end") +
                    " at the picture's largest value, far above the rest, the first at " +
                    std::to_string(first % width) + "," + std::to_string(first / width) +
                    "; if they are clipped, the illuminance is a lower bound: merge a bracket "
                    "with a darker frame, or read it with a lux meter"});
}

// Those of the region that hold no number, counted and named.
std::size_t WarnOfMasked(const InspectedPicture& inspected, const Region& region,
                         Console& console) {
  std::size_t count = 0;
  std::string first;
  for (const std::size_t pixel : inspected.masked) {
    const int width = inspected.luminance.width;
    if (!Holds(region, pixel, width) || count++ > 0) continue;
    const int at = static_cast<int>(pixel);
    first = std::to_string(at % width) + "," + std::to_string(at / width);
  }
  if (count > 0) {
    console.Warn(
        {"bad_samples", inspected.info.file,
         "left out: " + std::to_string(count) +
             (count == 1 ? " pixel of the region that holds" : " pixels of the region that hold") +
             " no number (not finite, or beyond 1e30); the first at " + first});
  }
  return count;
}

// Absent: nobody says how the picture was projected.
Result<std::optional<PixelSolidAngles>> AnglesOf(const InspectOptions& options,
                                                 const InspectedPicture& inspected) {
  PictureView view;
  view.width = inspected.luminance.width;
  view.height = inspected.luminance.height;
  const bool own_view = options.projection.empty() && inspected.info.view.has_value();
  if (own_view && options.fov.empty()) {
    view.projection = inspected.info.view->projection;
    view.field_of_view = inspected.info.view->field_of_view;
    auto written = PixelSolidAngles::Create(view);
    if (!written) return Propagate(std::move(written));
    return std::optional(std::move(*written));
  }
  if (options.projection.empty() && !inspected.info.environment_latlong) {
    if (!options.fov.empty()) return WrongUsage("--fov", "belongs to a --projection");
    return std::nullopt;
  }
  const auto projection =
      ParseProjection("--projection", options.projection.empty() ? "latlong" : options.projection);
  if (!projection) return tl::unexpected(projection.error());
  view.projection = *projection;
  if (view.projection != Projection::kLatLong) {
    if (options.fov.empty()) {
      return WrongUsage("--fov",
                        "give the full angle the lens sees: across the width of a rect picture, "
                        "across the image circle of a fisheye (180)");
    }
    const auto fov = ParseAngle(options.fov);
    if (!fov) return tl::unexpected(fov.error());
    view.field_of_view = *fov;
  }
  auto angles = PixelSolidAngles::Create(view);
  if (!angles) return Propagate(std::move(angles));
  return std::optional(std::move(*angles));
}

Result<InspectAnswer> MeasureInspected(const PictureLuminance& picture, const Region& region,
                                       const std::optional<PixelSolidAngles>& angles) {
  auto statistics = MeasureRegion(picture.view(), region);
  if (!statistics) return Propagate(std::move(statistics));
  InspectAnswer answer{*statistics, std::nullopt, std::nullopt, std::nullopt};
  if (!angles) return answer;
  const auto illuminance = MeasureIlluminance(picture.view(), *angles, region);
  if (!illuminance) return tl::unexpected(illuminance.error());
  answer.illuminance = *illuminance;
  answer.peak_direction = angles->Direction(statistics->peak_x + 0.5, statistics->peak_y + 0.5);
  return answer;
}

// Right of the picture's centre, and above its horizon.
std::pair<double, double> AzimuthAndElevation(const Vec3& direction) {
  const Radians azimuth(std::atan2(direction[0], direction[1]));
  const Radians elevation(std::asin(std::clamp(direction[2], -1.0, 1.0)));
  return {DegreesFromRadians(azimuth), DegreesFromRadians(elevation)};
}

// What the camera took for white. It moves nothing here.
std::optional<Xy> AsShotWhite(const FrameInfo& info) {
  if (!info.matrices || !info.as_shot_neutral) return std::nullopt;
  const auto white = XyFromCameraNeutral(*info.matrices, *info.as_shot_neutral);
  return white ? std::optional(*white) : std::nullopt;
}

Node ToJson(const InspectedPicture& inspected, const Region& region, const InspectAnswer& answer,
            std::size_t masked) {
  const LuminanceStatistics& s = answer.statistics;
  Node peak = {{"x", s.peak_x}, {"y", s.peak_y}, {"nits", s.max}};
  if (answer.peak_direction) {
    const auto [azimuth, elevation] = AzimuthAndElevation(*answer.peak_direction);
    peak.Put({{"azimuth_deg", azimuth}, {"elevation_deg", elevation}});
  }
  Node as_shot;
  if (const auto white = AsShotWhite(inspected.info)) {
    const CctResult cct = CctFromXy(*white);
    as_shot = {{"xy", {white->x, white->y}},
               {"cct_K", cct.valid() ? Node(cct.temperature) : Node()}};
  }
  const auto& lux = answer.illuminance;
  return {
      {"picture",
       {{"file", inspected.info.file},
        {"format", inspected.info.format},
        {"width", inspected.luminance.width},
        {"height", inspected.luminance.height}}},
      {"rect", {region.x, region.y, region.width, region.height}},
      {"luminance_nits", {{"min", s.min}, {"mean", s.mean}, {"median", s.median}, {"max", s.max}}},
      {"sigma_relative", s.sd_relative},
      {"masked_pixels", masked > 0 ? Node(masked) : Node()},
      {"illuminance_lx", lux ? Node(lux->illuminance) : Node()},
      {"solid_angle_sr", lux ? Node(lux->solid_angle) : Node()},
      {"peak", peak},
      {"as_shot", as_shot},
      {"glare", answer.glare ? GlareNode(*answer.glare) : Node()},
      {"scale",
       {{"source", inspected.luminance.scale}, {"u95_relative", inspected.scale_u95_relative}}}};
}

std::string Table(const InspectedPicture& inspected, const Region& region,
                  const InspectAnswer& answer, bool is_latlong) {
  const LuminanceStatistics& s = answer.statistics;
  const auto text = [](double v) { return RoundedText(v, kInspectDigits); };
  std::vector<std::vector<std::string>> rows = {
      {"luminance, mean", text(s.mean.value()), "cd/m²"},
      {"luminance, median", text(s.median.value()), "cd/m²"},
      {"luminance, min", text(s.min.value()), "cd/m²"},
      {"luminance, max", text(s.max.value()),
       "cd/m² at " + std::to_string(s.peak_x) + "," + std::to_string(s.peak_y)},
      {"spread of pixels, 1 σ", RoundedText(100.0 * s.sd_relative, 3), "% of mean"}};
  if (answer.peak_direction) {
    const auto [azimuth, elevation] = AzimuthAndElevation(*answer.peak_direction);
    rows.push_back({"brightest at", RoundedText(azimuth, 4),
                    "° right of centre, " + RoundedText(elevation, 4) + "° above it"});
  }
  if (answer.illuminance) {
    rows.push_back({is_latlong ? "illuminance, upper hemisphere" : "illuminance, picture's plane",
                    text(answer.illuminance->illuminance.value()), "lx"});
    rows.push_back({"solid angle", text(answer.illuminance->solid_angle.value()), "sr"});
  }
  std::string scale = inspected.luminance.scale;
  if (inspected.scale_u95_relative) {
    scale += " ± " + PercentText(*inspected.scale_u95_relative);
  }
  return inspected.info.file + ": " + std::to_string(inspected.luminance.width) + " x " +
         std::to_string(inspected.luminance.height) + ", region " + std::to_string(region.x) + "," +
         std::to_string(region.y) + "," + std::to_string(region.width) + "," +
         std::to_string(region.height) + ", scale: " + scale + "\n" +
         TextTable({"quantity", "value", "unit"}, rows);
}

Result<void> RunInspect(const InspectOptions& options, Console& console) {
  const auto glare_settings = GlareSettingsOf(options.glare);
  if (!glare_settings) return tl::unexpected(glare_settings.error());
  const auto inspected = Inspect(options, console);
  if (!inspected) return tl::unexpected(inspected.error());
  const auto region = RegionOf(options, inspected->luminance);
  if (!region) return tl::unexpected(region.error());
  const auto angles = AnglesOf(options, *inspected);
  if (!angles) return tl::unexpected(angles.error());
  auto answer = MeasureInspected(inspected->luminance, *region, *angles);
  if (!answer) return tl::unexpected(answer.error());
  if (options.glare.wanted) {
    auto glare = MeasureGlareOf(options.glare, *glare_settings, *inspected, *angles);
    if (!glare) return Propagate(std::move(glare));
    answer->glare = std::move(*glare);
  }
  const std::size_t masked = WarnOfMasked(*inspected, *region, console);
  if (answer->illuminance) WarnOfCutOff(*inspected, *region, console);
  if (auto ok = console.RefuseIfStrict(); !ok) return ok;
  const bool is_latlong =
      angles->has_value() && (*angles)->view().projection == Projection::kLatLong;
  if (answer->glare) {
    if (auto ok = WriteGlare(options.glare, *inspected, *answer->glare); !ok) return ok;
    for (const std::string& path : options.glare.outputs) console.Note("wrote " + path);
  }
  console.Print(Table(*inspected, *region, *answer, is_latlong));
  if (answer->glare) console.Print(GlareTable(*answer->glare));
  console.PrintDocument(ToJson(*inspected, *region, *answer, masked));
  return {};
}

}  // namespace

Run BuildInspect(CLI::App& parser) {
  auto options = std::make_shared<InspectOptions>();
  parser.add_option("image", options->image, "EXR, Radiance HDR, float TIFF, camera RAW or DNG")
      ->required();
  parser.add_option("--rect", options->rect, "only this region: x,y,width,height in pixels")
      ->delimiter(',')
      ->expected(4)
      ->allow_extra_args(false);
  parser
      .add_option("--projection", options->projection,
                  "How the picture was projected: gives illuminance and solid angle")
      ->check(OneOf(kProjectionWords));
  parser.add_option("--fov", options->fov,
                    "full angle, across the width (rect) or the image circle (fisheyes)");
  parser
      .add_option("--luminance-convention", options->convention,
                  std::string(kConventionHelp) +
                      " [photometric; with --glare of a Radiance picture radiance]")
      ->check(OneOf(kConventionWords));
  parser.add_option("--exposure,--exposures", options->exposure,
                    "of a RAW that does not say it: 1/60");
  parser.add_option("--f-number", options->f_number, "likewise");
  parser.add_option("--iso", options->iso, "likewise");
  AddGlareOptions(parser, options->glare);
  return [options](Console& console) { return RunInspect(*options, console); };
}

}  // namespace lightcal::app
