// SPDX-License-Identifier: Apache-2.0
#include "dome/dome_words.h"

#include <CLI/CLI.hpp>
#include <array>
#include <string_view>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "picture_words.h"

namespace lightcal::app {
namespace {

Result<Lux> ParseReading(const char* option, const std::string& text) {
  const auto lux = ParseIlluminance(text);
  if (!lux) return tl::unexpected(lux.error());
  if (!(lux->value() > 0.0)) return Refused("not_positive", option, "a lux reading is above 0");
  return *lux;
}

Result<std::optional<DomeReading>> ReadingOf(const DomeWords& words) {
  if (words.lux.empty()) {
    if (!words.lux_shaded.empty()) return WrongUsage("--lux-shaded", "belongs to a --lux");
    return std::nullopt;
  }
  DomeReading reading;
  const auto lux = ParseReading("--lux", words.lux);
  if (!lux) return tl::unexpected(lux.error());
  reading.illuminance = *lux;
  const auto sigma = ParseShare("--lux-sigma", words.lux_sigma);
  if (!sigma) return tl::unexpected(sigma.error());
  reading.sigma_relative = *sigma;
  const auto normal = ParseDirection("--lux-direction", words.lux_direction);
  if (!normal) return tl::unexpected(normal.error());
  reading.normal = *normal;
  if (!words.lux_shaded.empty()) {
    const auto shaded = ParseReading("--lux-shaded", words.lux_shaded);
    if (!shaded) return tl::unexpected(shaded.error());
    reading.shaded = *shaded;
  }
  return std::optional(reading);
}

}  // namespace

void AddDomeWords(CLI::App& parser, DomeWords& w) {
  parser
      .add_option("panoramas", w.files,
                  "Lat-long panorama: EXR, Radiance HDR or float TIFF. Its centre looks along +Y, "
                  "its right side is +X, its upper edge +Z")
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
  parser.add_option("--luminance-convention", w.convention, kConventionHelp);
  parser.add_option("--north", w.north,
                    "Azimuth in degrees, right of the picture's centre, that becomes +Y [0]");
}

Result<DomeRequest> DomeRequestOf(const DomeWords& words) {
  if (words.files.size() != 1) {
    return WrongUsage(words.files[1], "dome reads one panorama at a time");
  }
  DomeRequest request;
  request.input.files = words.files;
  if (!words.convention.empty()) {
    const auto convention = ParseConvention("--luminance-convention", words.convention);
    if (!convention) return tl::unexpected(convention.error());
    request.input.convention = *convention;
  }
  if (!words.clip.empty()) {
    const auto clip = ParseNumber(words.clip);
    if (!clip || !(*clip > 0.0)) {
      return WrongUsage("--clip", "\"" + words.clip + "\" is not a value above 0");
    }
    request.input.clip = *clip;
  }
  if (!words.north.empty()) {
    const auto north = ParseAngle(words.north);
    if (!north) return tl::unexpected(north.error());
    request.north = *north;
  }
  auto reading = ReadingOf(words);
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
