// SPDX-License-Identifier: Apache-2.0
// lightcal ratio: key to fill as a gaffer asks it, with the interval that the meter's common error
// leaves.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>

#include "calibration_options.h"
#include "commands.h"
#include "lamp_words.h"
#include "light_input.h"
#include "lightcal/calibrate/environments.h"
#include "lightcal/core/joined.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/stops.h"
#include "lightcal/core/units_text.h"
#include "lightcal/light/illuminance_map.h"
#include "lightcal/records/light_codec.h"
#include "lightcal/records/session.h"
#include "lightcal_devices/disk_sources.h"
#include "lightcal_devices/files/delimited_text.h"
#include "simulate/lamp_places.h"
#include "typed_reading.h"

namespace lightcal::app {
namespace {

struct RatioOptions {
  std::vector<std::string> what;
  std::string at, normal = "lamp", meter;
  bool normal_given = false;
  std::vector<std::string> key, fill;
  LampPlaceWords places;
};

// One lamp at the place asked about.
struct RatioPart {
  std::string name;
  double lux = 0.0;
  double sd_of_ln = 0.0;
  std::optional<MeterShare> meter;
};

struct RatioSide {
  std::vector<RatioPart> parts;
  [[nodiscard]] double Lux() const {
    double sum = 0.0;
    for (const RatioPart& part : parts) sum += part.lux;
    return sum;
  }
};

struct RatioAnswer {
  double ratio = 1.0;
  double sd_of_ln = 0.0;
  double apart_sd_of_ln = 0.0;  // as if nothing were in common
};

// ln(key/fill) = ln sum key - ln sum fill; a lamp's part in it is its share of its side. Errors of
// two lamps that one meter read have the square of its calibration in common.
RatioAnswer RatioOf(const RatioSide& key, const RatioSide& fill) {
  struct Term {
    double share;
    const RatioPart* part;
  };
  std::vector<Term> terms;
  const double key_lux = key.Lux();
  const double fill_lux = fill.Lux();
  for (const RatioPart& part : key.parts) terms.push_back({part.lux / key_lux, &part});
  for (const RatioPart& part : fill.parts) terms.push_back({-part.lux / fill_lux, &part});
  double variance = 0.0;
  double apart = 0.0;
  for (const Term& a : terms) {
    const double own = a.part->sd_of_ln * a.part->sd_of_ln;
    variance += a.share * a.share * own;
    apart += a.share * a.share * own;
    for (const Term& b : terms) {
      if (a.part == b.part || !a.part->meter || !b.part->meter) continue;
      if (a.part->meter->name != b.part->meter->name) continue;
      const double common =
          std::min({a.part->meter->calibration_relative, b.part->meter->calibration_relative,
                    a.part->sd_of_ln, b.part->sd_of_ln});
      variance += a.share * b.share * common * common;
    }
  }
  return {key_lux / fill_lux, std::sqrt(std::max(0.0, variance)), std::sqrt(apart)};
}

Result<RatioSide> SideOf(const RatioOptions& options, const LightFile& lights,
                         const std::string& folder, const std::vector<std::string>& names) {
  const auto position = ParsePoint("--at", options.at);
  if (!position) return tl::unexpected(position.error());
  const auto chosen = ChooseLights(lights, names);
  if (!chosen) return tl::unexpected(chosen.error());
  std::vector<const FittedLight*> all;  // places are given for both sides at once
  for (const FittedLight& light : lights.lights) all.push_back(&light);
  const auto places = ParseLampPlaces(options.places, all);
  if (!places) return tl::unexpected(places.error());
  Warnings warnings;
  const auto picture = [&](const FittedLight& light) {
    return LoadEnvironment(light, folder, devices::DiskSources());
  };
  const auto lamps = PlaceLamps(*chosen, *places, picture, warnings);
  if (!lamps) return tl::unexpected(lamps.error());
  const IlluminancePredictor predictor(*lamps, MapSettings{});
  const auto normal = ParseMeterNormal(options.normal);
  if (!normal) return tl::unexpected(normal.error());
  // Turned to this side's brightest lamp, as one reads key and fill.
  const auto luxes_at = [&](const Vec3& n) { return predictor.At({*position, n}); };
  std::vector<LampLux> luxes;
  if (*normal) {
    luxes = luxes_at(**normal);
  } else {
    double most = -1.0;
    for (const PlacedLamp& lamp : *lamps) {
      const auto way = DirectionToLamp(lamp, *position);
      if (!way) continue;
      std::vector<LampLux> turned = luxes_at(*way);
      double sum = 0.0;
      for (const LampLux& lux : turned) sum += lux.direct_lx;
      if (sum > most) {
        most = sum;
        luxes = std::move(turned);
      }
    }
    // Skies alone: as a meter lies on the floor.
    if (luxes.empty()) luxes = luxes_at({0.0, 0.0, 1.0});
  }
  RatioSide side;
  for (std::size_t i = 0; i < luxes.size(); ++i) {
    const double lux = luxes[i].direct_lx;
    if (!(lux > 0.0)) continue;
    side.parts.push_back(
        {(*chosen)[i]->name, lux, luxes[i].u95_lx / (kZ95 * lux), (*chosen)[i]->meter});
  }
  if (side.parts.empty()) {
    return Refused("no_light", Joined(names), "gives no light at " + options.at + "; check --at");
  }
  return side;
}

// What the digits shown leave open, 1 sigma: a rectangle of one last digit.
Result<RatioPart> TypedPart(const std::string& text, double calibration) {
  const auto lux = ParseIlluminance(text);
  if (!lux) return tl::unexpected(lux.error());
  if (!(lux->value() > 0.0)) return Refused("bad_reading", text, "must be above zero");
  const auto split = SplitNumberAndUnit(text);
  if (!split) return tl::unexpected(split.error());
  const std::string digits = text.substr(0, text.find_first_not_of("0123456789.eE+"));
  const double rounding = devices::files::LastDigit(digits) / (std::sqrt(12.0) * split->number);
  const double repeat = RepeatabilityBeside(calibration, calibration);
  RatioPart part{text, lux->value(), 0.0, MeterShare{"", calibration}};
  part.sd_of_ln = std::sqrt(calibration * calibration + repeat * repeat + rounding * rounding);
  return part;
}

bool IsReading(const std::string& text) {
  const auto split = SplitNumberAndUnit(text);
  return split && ParseIlluminance(text).has_value();
}

// A number with a comma in it, "1,000lx", is no file of lights.
Result<void> CheckCommas(const std::vector<std::string>& what) {
  for (const std::string& text : what) {
    const bool number = !text.empty() && text.find_first_of("0123456789") == 0;
    if (!number || text.find(',') == std::string::npos || text.ends_with(".json")) continue;
    if (const auto lux = ParseIlluminance(text); !lux) return tl::unexpected(lux.error());
  }
  return {};
}

Result<std::pair<RatioSide, RatioSide>> SidesOf(const RatioOptions& options) {
  const std::vector<std::string>& what = options.what;
  if (auto plain = CheckCommas(what); !plain) return Propagate(std::move(plain));
  if (what.size() == 2 && IsReading(what[0])) {
    const std::pair<const char*, bool> of_lights[] = {
        {"--at", !options.at.empty()},
        {"--key", !options.key.empty()},
        {"--fill", !options.fill.empty()},
        {"--normal", options.normal_given},
        {"--position", !options.places.position.empty()},
        {"--aim", !options.places.aim.empty()}};
    for (const auto& [option, given] : of_lights) {
      if (given) {
        return WrongUsage(option, "is of a light.json; two readings say themselves what is where");
      }
    }
    double calibration = kSigmaUnnamedMeter;
    if (!options.meter.empty()) {
      const auto sigma = SigmaOfMeter(options.meter);
      if (!sigma) return tl::unexpected(sigma.error());
      calibration = *sigma;
    }
    const auto key = TypedPart(what[0], calibration);
    if (!key) return tl::unexpected(key.error());
    const auto fill = TypedPart(what[1], calibration);
    if (!fill) return tl::unexpected(fill.error());
    return std::pair(RatioSide{{*key}}, RatioSide{{*fill}});
  }
  if (what.size() != 1) {
    return WrongUsage("ratio",
                      "give two readings, 800lx 200lx (key first), or a light.json with --at, "
                      "--key and --fill");
  }
  // The line first: a wrong one is told whatever the file holds.
  if (!options.meter.empty()) {
    return WrongUsage("--meter", "is of two readings; a light.json knows the meter of its own");
  }
  if (options.at.empty()) return WrongUsage("--at", "say where: --at x,y,z (metres)");
  for (const auto& [option, names] :
       {std::pair("--key", &options.key), std::pair("--fill", &options.fill)}) {
    if (names->empty()) {
      return WrongUsage(option, std::string("name the lights, e.g. ") + option + " window,lamp");
    }
  }
  const auto lights = LightsIn(what.front());
  if (!lights) return tl::unexpected(lights.error());
  for (const std::string& name : options.key) {
    if (std::ranges::find(options.fill, name) != options.fill.end()) {
      return WrongUsage("--fill", "\"" + name + "\" is the key already");
    }
  }
  const std::string folder =
      std::filesystem::path(LightFileAt(what.front()).value_or("")).parent_path().string();
  auto key = SideOf(options, *lights, folder, options.key);
  if (!key) return Propagate(std::move(key));
  auto fill = SideOf(options, *lights, folder, options.fill);
  if (!fill) return Propagate(std::move(fill));
  return std::pair(*std::move(key), *std::move(fill));
}

Node SideNode(const RatioSide& side) {
  return {{"illuminance_lx", side.Lux()},
          {"lights", Node::List(side.parts, [](const RatioPart& part) -> Node {
             return {{"name", part.name},
                     {"illuminance_lx", part.lux},
                     {"u95_relative", kZ95 * part.sd_of_ln}};
           })}};
}

std::string SideText(const RatioSide& side) {
  return Joined(side.parts, " + ", [](const RatioPart& part) {
    const std::string lux = RoundedText(part.lux, 3) + " lx";
    return IsReading(part.name) ? part.name : part.name + " " + lux;
  });
}

Result<void> RunRatio(const RatioOptions& options, Console& console) {
  const auto sides = SidesOf(options);
  if (!sides) return tl::unexpected(sides.error());
  const auto& [key, fill] = *sides;
  const RatioAnswer answer = RatioOf(key, fill);
  const Uncertain ratio = UncertainFromLog(std::log(answer.ratio), answer.sd_of_ln);
  const double stops = std::log2(answer.ratio);
  const double u95_stops = StopsOfSd(answer.sd_of_ln);
  const double apart = StopsOfSd(answer.apart_sd_of_ln);
  const bool surer = apart > 1.05 * u95_stops;
  double unit = u95_stops < 0.095 ? 100.0 : 10.0;
  // So many decimals that the two intervals, side by side, read as they are.
  while (surer && std::round(u95_stops * unit) >= std::round(apart * unit)) unit *= 10.0;
  const auto rounded = [&](double value) {
    std::string text = ShortestText(std::round(value * unit) / unit);
    if (text.find('.') == std::string::npos) text += ".0";
    return text;
  };
  console.Print(RoundedText(answer.ratio, 2) + " : 1 · " + rounded(stops) + " ± " +
                rounded(u95_stops) + " stops\n");
  console.Print(LabelledLine("key", SideText(key)) + LabelledLine("fill", SideText(fill)));
  if (surer) {
    console.Print(LabelledLine("why so sure",
                               "one meter read both: its own error cancels (two "
                               "meters would leave ± " +
                                   rounded(apart) + ")"));
  }
  console.PrintDocument({{"ratio", DocumentOf(ratio)},
                         {"stops", {{"value", stops}, {"u95", u95_stops}}},
                         {"stops_u95_if_independent", apart},
                         {"key", SideNode(key)},
                         {"fill", SideNode(fill)}});
  return {};
}

}  // namespace

Run BuildRatio(CLI::App& parser) {
  auto options = std::make_shared<RatioOptions>();
  parser
      .add_option("input", options->what,
                  "Two readings of one meter, key first: 800lx 200lx; or a light.json or session")
      ->required();
  parser.add_option("--at", options->at, "Where: x,y,z in metres, Z up");
  parser.add_option("--key", options->key, "Lights of the key, e.g. window,lamp")
      ->delimiter(',')
      ->allow_extra_args(false);
  parser.add_option("--fill", options->fill, "Lights of the fill")
      ->delimiter(',')
      ->allow_extra_args(false);
  const CLI::Option* const normal =
      parser
          .add_option("--normal", options->normal,
                      "How the meter is turned: lamp (to each side's brightest), up, or x,y,z")
          ->capture_default_str();
  parser
      .add_option("--position", options->places.position,
                  "Where a light stands: [NAME=]x,y,z; may be repeated")
      ->allow_extra_args(false);
  parser.add_option("--aim", options->places.aim, "Where it shines: [NAME=]x,y,z")
      ->allow_extra_args(false);
  parser.add_option("--meter", options->meter,
                    "Of two readings: phone, hobby or lab, or its maker's figure, e.g. 3%");
  return [options, normal](Console& console) {
    options->normal_given = normal->count() > 0;
    return RunRatio(*options, console);
  };
}

}  // namespace lightcal::app
