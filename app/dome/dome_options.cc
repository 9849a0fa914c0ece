// SPDX-License-Identifier: Apache-2.0
#include "dome/dome_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "one_of.h"
#include "picture_words.h"

namespace lightcal::app {
namespace {

Result<Lux> ParseReading(const char* option, const std::string& text) {
  const auto lux = ParseIlluminance(text);
  if (!lux) return tl::unexpected(lux.error());
  if (!(lux->value() > 0.0)) return Refused("not_positive", option, "a lux reading is above 0");
  return *lux;
}

// "up", "down", or "AZIMUTH,ELEVATION" in degrees: right of +Y, above the horizon.
Result<Vec3> ParseDirection(const std::string& option, const std::string& text) {
  if (text == "up") return Vec3{0.0, 0.0, 1.0};
  if (text == "down") return Vec3{0.0, 0.0, -1.0};
  const std::size_t comma = text.find(',');
  const auto wrong = [&] {
    return WrongUsage(option, "\"" + text +
                                  "\" is neither up, down nor AZIMUTH,ELEVATION in degrees (right "
                                  "of the picture's centre, above the horizon)");
  };
  if (comma == std::string::npos) return wrong();
  const auto azimuth = ParseNumber(TrimBlanks(std::string_view(text).substr(0, comma)));
  const auto elevation = ParseNumber(TrimBlanks(std::string_view(text).substr(comma + 1)));
  if (!azimuth || !elevation || std::abs(*elevation) > 90.0) return wrong();
  const double a = RadiansFromDegrees(*azimuth).value(), e = RadiansFromDegrees(*elevation).value();
  return Vec3{std::sin(a) * std::cos(e), std::cos(a) * std::cos(e), std::sin(e)};
}

Result<std::optional<DomeReading>> ReadingOf(const DomeOptions& options) {
  if (options.lux.empty()) {
    if (!options.lux_shaded.empty()) return WrongUsage("--lux-shaded", "belongs to a --lux");
    return std::nullopt;
  }
  DomeReading reading;
  const auto lux = ParseReading("--lux", options.lux);
  if (!lux) return tl::unexpected(lux.error());
  reading.illuminance = *lux;
  const auto sigma = ParseShare("--lux-sigma", options.lux_sigma);
  if (!sigma) return tl::unexpected(sigma.error());
  reading.sigma_relative = *sigma;
  const auto normal = ParseDirection("--lux-direction", options.lux_direction);
  if (!normal) return tl::unexpected(normal.error());
  reading.normal = *normal;
  if (!options.lux_shaded.empty()) {
    const auto shaded = ParseReading("--lux-shaded", options.lux_shaded);
    if (!shaded) return tl::unexpected(shaded.error());
    reading.shaded = *shaded;
  }
  return std::optional(reading);
}

Result<ViewAim> ParseAim(const std::string& text) {
  std::array<double, 3> degrees{};
  std::string_view rest = text;
  std::size_t count = 0;
  bool whole = true;
  for (; whole && !rest.empty() && count < degrees.size(); ++count) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    const auto number = ParseNumber(TrimBlanks(rest.substr(0, comma)));
    whole = number.has_value();
    degrees[count] = number.value_or(0.0);
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  if (!whole || !rest.empty() || count < 2 || std::abs(degrees[1]) > 90.0) {
    return WrongUsage("--aim", "\"" + text +
                                   "\" is not YAW,PITCH[,ROLL] in degrees (right of +Y, above the "
                                   "horizon, leaning right), such as 45,0 or 0,90");
  }
  return ViewAim{RadiansFromDegrees(degrees[0]), RadiansFromDegrees(degrees[1]),
                 RadiansFromDegrees(degrees[2])};
}

Result<void> TakeViews(const DomeOptions& options, DomeInputRequest& request) {
  const auto projection = ParseProjection("--projection", options.projection);
  if (!projection) return tl::unexpected(projection.error());
  request.projection = *projection;
  if (!options.fov.empty()) {
    const auto fov = ParseAngle(options.fov);
    if (!fov) return tl::unexpected(fov.error());
    request.field_of_view = *fov;
  }
  for (const std::string& text : options.aims) {
    const auto aim = ParseAim(text);
    if (!aim) return tl::unexpected(aim.error());
    request.aims.push_back(*aim);
  }
  const bool one = options.files.size() == 1 && request.projection != Projection::kRectilinear;
  if (request.aims.size() != options.files.size() && !(one && request.aims.empty())) {
    return WrongUsage("--aim", std::to_string(options.files.size()) +
                                   " pictures are views and need --aim YAW,PITCH[,ROLL] once each, "
                                   "in their order; " +
                                   std::to_string(request.aims.size()) + " given");
  }
  if (options.width.empty()) return {};
  const auto width = ParseNumber(options.width);
  constexpr double kLeast = 16.0, kMost = 16384.0;
  if (!width || !(*width >= kLeast && *width <= kMost) || std::fmod(*width, 2.0) != 0.0) {
    return WrongUsage("--width",
                      "\"" + options.width + "\" is not an even count of pixels, 16 to 16384");
  }
  request.width = static_cast<int>(*width);
  return {};
}

}  // namespace

void AddDomeOptions(CLI::App& parser, DomeOptions& w) {
  parser
      .add_option("panoramas", w.files,
                  "Lat-long panorama: EXR, Radiance HDR or float TIFF. Its centre looks along +Y, "
                  "its right side is +X, its upper edge +Z. Or views of other projections, several "
                  "with their --aim each: overlaps give them one scale")
      ->required();
  parser.add_option("--lux", w.lux,
                    "A lux meter's reading where the panorama was taken: sets the scale, or what "
                    "clipped [the picture's own scale]");
  parser
      .add_option("--lux-direction", w.lux_direction,
                  "Where the meter faced: up, down or AZIMUTH,ELEVATION in degrees, right of the "
                  "centre and above the horizon")
      ->capture_default_str();
  parser.add_option("--lux-shaded", w.lux_shaded,
                    "The same reading with a card shading the brightest light: then a clipped "
                    "light needs no absolute picture");
  parser.add_option("--lux-sigma", w.lux_sigma, "The meter's 1 sigma")->capture_default_str();
  parser.add_option("--clip", w.clip,
                    "Samples from this value on are clipped, in the picture's own unit [found]");
  parser.add_option("--luminance-convention", w.convention, kConventionHelp)
      ->check(OneOf(kConventionWords));
  parser.add_option("--north", w.north,
                    "Azimuth in degrees, right of the picture's centre, that becomes +Y [0]");
  parser
      .add_option("--projection", w.projection,
                  "Of the pictures: a panorama, fisheyes (looking up unless aimed) or an ordinary "
                  "lens (rect)")
      ->check(OneOf(kProjectionWords))
      ->capture_default_str();
  parser.add_option("--fov", w.fov,
                    "Full angle in degrees: across a fisheye's circle, across a rect's width");
  parser
      .add_option("--aim", w.aims,
                  "Where a view looks, once for each picture in their order: YAW,PITCH[,ROLL] in "
                  "degrees, right of +Y, above the horizon, leaning right")
      ->allow_extra_args(false);
  parser.add_option("--width", w.width,
                    "Pixels across the dome made of views [the finest view's detail]");
}

Result<DomeRequest> DomeRequestOf(const DomeOptions& options) {
  DomeRequest request;
  request.input.files = options.files;
  if (auto views = TakeViews(options, request.input); !views) return Propagate(std::move(views));
  if (!options.convention.empty()) {
    const auto convention = ParseConvention("--luminance-convention", options.convention);
    if (!convention) return tl::unexpected(convention.error());
    request.input.convention = *convention;
  }
  if (!options.clip.empty()) {
    const auto clip = ParseNumber(options.clip);
    if (!clip || !(*clip > 0.0)) {
      return WrongUsage("--clip", "\"" + options.clip + "\" is not a value above 0");
    }
    request.input.clip = *clip;
  }
  if (!options.north.empty()) {
    const auto north = ParseAngle(options.north);
    if (!north) return tl::unexpected(north.error());
    request.north = *north;
  }
  auto reading = ReadingOf(options);
  if (!reading) return Propagate(std::move(reading));
  request.reading = *reading;
  return request;
}

Result<CameraSettings> ParsePlateExposure(const std::string& option, const std::string& text) {
  std::array<std::string_view, 3> parts;
  std::string_view rest = text;
  std::size_t count = 0;
  while (count < parts.size()) {
    const std::size_t comma = rest.find(',');
    parts[count++] = TrimBlanks(rest.substr(0, comma));
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  const bool whole = count == 3 && rest.find(',') == std::string_view::npos;
  const auto f_number = ParseFNumber(parts[0]);
  const auto time = ParseDuration(parts[1]);
  const auto iso = ParseNumber(parts[2]);
  if (!whole || !f_number || !time || !iso) {
    return WrongUsage(option, "\"" + text + "\" is not f-number,time,ISO such as f/8,1/60,100");
  }
  if (!(*f_number > 0.0 && time->value() > 0.0 && *iso > 0.0)) {
    return Refused("not_positive", option, "f-number, time and ISO speed are above 0");
  }
  return CameraSettings{*f_number, *time, *iso};
}

}  // namespace lightcal::app
