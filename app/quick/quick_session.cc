// SPDX-License-Identifier: Apache-2.0
#include "quick/quick_session.h"

#include <algorithm>
#include <utility>

#include "calibration_options.h"
#include "lightcal/core/file_stem.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/printable.h"
#include "lightcal/core/units_text.h"
#include "lightcal/light/beam_ensemble.h"
#include "typed_reading.h"

namespace lightcal::app {
namespace {

enum class Least { kAboveZero, kFromZero };
// Fills an optional quantity from an option's text; an empty text leaves it absent.
// Wrong usage, of that option: what is below its least value.
template <class Unit, class Parse>
Result<void> Fill(std::optional<Unit>& target, const char* option, const std::string& text,
                  Parse parse, Least least = Least::kAboveZero) {
  if (text.empty()) return {};
  const auto value = parse(text);
  if (!value) return tl::unexpected(value.error());
  const bool from_zero = least == Least::kFromZero;
  if (!(from_zero ? value->value() >= 0.0 : value->value() > 0.0)) {
    return WrongUsage(
        option, "\"" + text + "\" must " + (from_zero ? "not be below zero" : "be above zero"));
  }
  target = Unit(*value);
  return {};
}

template <class Unit>
Result<void> FillPlain(std::optional<Unit>& target, const char* option, const std::string& text,
                       std::string_view unit_word) {
  return Fill(target, option, text, [unit_word](const std::string& t) -> Result<Unit> {
    const auto split = SplitNumberAndUnit(t);
    if (!split) return tl::unexpected(split.error());
    if (!split->unit.empty() && LowerAscii(split->unit) != LowerAscii(unit_word)) {
      return WrongUsage(t, "the unit here is " + std::string(unit_word));
    }
    return Unit(split->number);
  });
}

// A surface has a size: a softbox taken for a bulb is a quarter wrong at half a metre.
Result<void> FillSides(LightDescription& light, const QuickOptions& options) {
  const std::string kind(LightKindName(light.kind));
  const auto asked = [&](const char* option, const char* example) {
    return WrongUsage(option, "a " + kind + " has a size: " + option + " " + example);
  };
  const bool rect = light.kind == LightKind::kRect;
  const bool tube = light.kind == LightKind::kTube;
  const bool round = light.kind == LightKind::kDisk || light.kind == LightKind::kSphere;
  if (rect && options.size.empty()) return asked("--size", "120x60cm");
  if (tube && !light.length) return asked("--length", "1.2m");
  if (light.kind == LightKind::kDisk && !light.diameter) return asked("--diameter", "40cm");
  for (const auto& [option, wrong] : {std::pair("--size", !rect && !options.size.empty()),
                                      std::pair("--length", !tube && light.length.has_value()),
                                      std::pair("--radius", !tube && light.radius.has_value()),
                                      std::pair("--diameter", !round && light.diameter)}) {
    if (wrong) return WrongUsage(option, "a " + kind + " has none; did you mean another --kind?");
  }
  if (!rect) return {};
  const auto sides = ParseSides(options.size, 2, "WIDTHxHEIGHT, for example 120x60cm");
  if (!sides) return tl::unexpected(sides.error());
  light.width = Metres(sides->at(0));
  light.height = Metres(sides->at(1));
  return {};
}

// As told, or what alone has the sizes or angles that are.
std::string KindOf(const QuickOptions& options) {
  if (!options.kind.empty()) return options.kind;
  if (!options.outer.empty() || !options.beam.empty()) return "spot";
  if (!options.size.empty()) return "rect";
  return options.length.empty() ? "point" : "tube";
}

// Angles that would be heard by nobody.
Result<void> CheckAngles(std::optional<Radians> inner, std::optional<Radians> outer,
                         const LightDescription& light) {
  if (inner && !outer) {
    return WrongUsage("--inner", "says how far a cone is even; add --outer, where it ends");
  }
  if (inner && *inner > *outer) {
    return WrongUsage("--inner", "exceeds --outer; both count from the axis: swap them");
  }
  if (light.beam && !(*light.beam < kWidestBeam)) {
    return WrongUsage(
        "--beam",
        "goes to below 170 degrees; a lamp that shines wider is no beam: leave it out, "
        "and of a bulb (its box says 200 to 360) say --fixture bulb");
  }
  if (light.field && !light.beam) {
    return WrongUsage("--field", "stands beside a beam angle: add --beam, at half of the middle");
  }
  return {};
}

Result<LightDescription> DescribeLight(const QuickOptions& options) {
  LightDescription light;
  light.name = options.name;
  const std::string kind = KindOf(options);
  const auto known = LightKindFromName(kind);
  if (!known)
    return WrongUsage(kind, "unknown --kind; point, spot, sphere, disk, rect, tube or directional");
  light.kind = *known;
  light.fixture = FixtureFromName(options.fixture);
  std::optional<Radians> inner = std::nullopt;
  std::optional<Radians> outer = std::nullopt;
  for (const Result<void>& filled :
       {Fill(light.diameter, "--diameter", options.diameter,
             [](const auto& t) { return ParseLength(t); }),
        Fill(light.length, "--length", options.length,
             [](const auto& t) { return ParseLength(t); }),
        Fill(light.radius, "--radius", options.radius,
             [](const auto& t) { return ParseLength(t); }),
        Fill(
            inner, "--inner", options.inner, [](const auto& t) { return ParseAngle(t); },
            Least::kFromZero),
        Fill(outer, "--outer", options.outer, [](const auto& t) { return ParseAngle(t); }),
        Fill(light.beam, "--beam", options.beam, [](const auto& t) { return ParseAngle(t); }),
        Fill(light.field, "--field", options.field, [](const auto& t) { return ParseAngle(t); }),
        FillPlain(light.flux, "--lumens", options.lumens, "lm"),
        FillPlain(light.electrical, "--watts", options.watts, "W")}) {
    if (!filled) return tl::unexpected(filled.error());
  }
  if (auto shaped = CheckAngles(inner, outer, light); !shaped) return Propagate(std::move(shaped));
  const double half = options.full_angles ? 0.5 : 1.0;
  if (inner) light.inner = *inner * half;
  if (outer) light.outer = *outer * half;
  if (auto sized = FillSides(light, options); !sized) return Propagate(std::move(sized));
  return light;
}

constexpr const char* kQuickMeter = "meter";

Result<void> AddReadings(Session& session, const QuickOptions& options) {
  std::optional<Kelvin> cct;
  std::optional<double> duv;
  if (auto filled = Fill(cct, "--cct", options.cct, ParseLampTemperature); !filled) {
    return filled;
  }
  if (!options.duv.empty()) {
    const auto parsed = ParseDuv(options.duv);
    if (!parsed) return tl::unexpected(parsed.error());
    duv = *parsed;
  }
  const auto sigma = SigmaAsked(options);
  if (!sigma) return tl::unexpected(sigma.error());
  for (const std::string& text : options.readings) {
    auto typed = ParseTypedReading(text, options.name);
    if (!typed) return Propagate(std::move(typed));
    for (Reading& reading : *typed) {
      if (IsLit(reading) && !reading.cct) reading.cct = cct;
      if (reading.cct) reading.duv = duv;
      if (options.meter.empty()) {
        reading.sigma_relative = *sigma;
      } else {
        reading.meter = kQuickMeter;
      }
      session.readings.push_back({std::move(reading), text});
    }
  }
  const bool colored = cct || std::ranges::any_of(session.readings, [](const auto& row) {
                         return row.reading.cct.has_value();
                       });
  if (duv && !colored) {
    return WrongUsage("--duv", "stands beside a colour temperature; add --cct 2900K");
  }
  if (options.readings.empty() && cct) {
    Reading color_only;
    color_only.light = options.name;
    color_only.cct = cct;
    color_only.duv = duv;
    session.readings.push_back({color_only, "--cct " + options.cct});
  }
  return {};
}

// What all readings are taken with, and the first will be, where none is there to tell.
Result<void> AddMeter(Session& session, const QuickOptions& options) {
  const auto sigma = SigmaAsked(options);
  if (!sigma) return tl::unexpected(sigma.error());
  if (!*sigma || (options.meter.empty() && !options.readings.empty())) return {};
  MeterDescription meter;
  meter.name = kQuickMeter;
  meter.sigma_relative = **sigma;
  session.meters.push_back(std::move(meter));
  return {};
}

}  // namespace

Result<std::optional<double>> SigmaAsked(const QuickOptions& options) {
  if (options.sigma.empty() && options.meter.empty()) return std::nullopt;
  const auto sigma =
      options.meter.empty() ? ParseTolerance(options.sigma) : SigmaOfMeter(options.meter);
  if (!sigma) return tl::unexpected(sigma.error());
  return *sigma;
}

Result<Session> SessionFromOptions(const QuickOptions& options) {
  if (options.readings.empty() && options.lumens.empty() && !options.plan) {
    return WrongUsage("quick", "give a reading such as 192lx@0.5m, or a data sheet's --lumens 806");
  }
  if (options.name.empty() || !IsPrintable(options.name)) {
    return WrongUsage("--name", "\"" + options.name + "\" is no name: letters that show, please");
  }
  auto light = DescribeLight(options);
  if (!light) return Propagate(std::move(light));
  Session session;
  session.name = options.name;
  session.stem = FileStem(options.name);
  session.directory = ".";
  session.lights.push_back(std::move(*light));
  if (!options.room.empty()) {
    if (auto set = SetRoom(options.room, session); !set) return Propagate(std::move(set));
  }
  if (auto added = AddReadings(session, options); !added) return Propagate(std::move(added));
  if (auto added = AddMeter(session, options); !added) return Propagate(std::move(added));
  return session;
}

}  // namespace lightcal::app
