// SPDX-License-Identifier: Apache-2.0
// lightcal convert: one photometric value of a lamp -> all the others.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands.h"
#include "light_value.h"
#include "lightcal/core/joined.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "lightcal/photometry/lambert.h"
#include "lightcal/photometry/luminous_efficacy.h"
#include "lightcal/photometry/solid_angle.h"
#include "lightcal/photometry/source_photometry.h"
#include "one_of.h"

namespace lightcal::app {
namespace {

constexpr int kConvertDigits = 6;

struct ConvertOptions {
  std::string value, kind, distance, radius, diameter, size, width, height, length;
  std::string inner, outer, angular_diameter, efficacy, reflectance;
  std::string spot_falloff = "squared";
  bool full_angles = false;
};

// All that convert prints. luminance and exitance are the lit surface's where there is one.
struct ConvertAnswer {
  SourcePhotometry source;
  std::optional<LumensPerSquareMetre> lit_exitance;
  std::optional<Nits> lit_luminance;
  std::optional<ElectricalWatts> electrical;
};

Result<LightKind> ParseKind(const std::string& text) {
  if (const auto kind = LightKindFromName(text)) return *kind;
  return WrongUsage("--kind",
                    "say what shines: --kind point, spot, sphere, disk, rect, tube, "
                    "directional or dome");
}

// An option's length; absent when it was not given.
Result<void> FillLength(std::optional<Metres>& target, const std::string& text) {
  if (text.empty()) return {};
  const auto length = ParseLength(text);
  if (!length) return tl::unexpected(length.error());
  target = *length;
  return {};
}

// "1.2mx60cm" "120x60cm" "1.2x0.6": one unit at the end serves both sides.
Result<void> FillSize(SourceGeometry& g, const std::string& text) {
  if (text.empty()) return {};
  const auto cross = text.find('x');
  if (cross == std::string::npos || text.find('x', cross + 1) != std::string::npos) {
    return WrongUsage("--size", "\"" + text + "\" is not WIDTHxHEIGHT, for example 120x60cm");
  }
  std::string width = text.substr(0, cross);
  const std::string height = text.substr(cross + 1);
  const auto width_parts = SplitNumberAndUnit(width);
  const auto height_parts = SplitNumberAndUnit(height);
  if (width_parts && height_parts && width_parts->unit.empty()) {
    if (height_parts->unit.find_first_of("0123456789") != std::string_view::npos) {
      return WrongUsage("--size", "\"" + text + "\": write the unit of " + width + " too");
    }
    width += height_parts->unit;
  }
  if (auto done = FillLength(g.width, width); !done) return done;
  return FillLength(g.height, height);
}

Result<void> FillRadius(SourceGeometry& g, const ConvertOptions& o) {
  if (!o.radius.empty() && !o.diameter.empty()) {
    return WrongUsage("--radius", "give --radius or --diameter, not both");
  }
  if (auto done = FillLength(g.radius, o.radius.empty() ? o.diameter : o.radius); !done)
    return done;
  if (g.radius && !o.diameter.empty()) g.radius = *g.radius / 2.0;
  return {};
}

Result<void> FillSizes(SourceGeometry& g, const ConvertOptions& o) {
  if (!o.size.empty() && (!o.width.empty() || !o.height.empty())) {
    return WrongUsage("--size", "give --size or --width and --height, not both");
  }
  if (auto done = FillRadius(g, o); !done) return done;
  if (auto done = FillLength(g.distance, o.distance); !done) return done;
  if (auto done = FillLength(g.width, o.width); !done) return done;
  if (auto done = FillLength(g.height, o.height); !done) return done;
  if (auto done = FillLength(g.length, o.length); !done) return done;
  return FillSize(g, o.size);
}

struct FalloffRow {
  std::string_view name;
  SpotFalloff falloff;
  SpotFlux flux;
};
constexpr FalloffRow kFalloffs[] = {{"squared", SpotFalloff::kSquaredLinear, SpotFlux::kIntegral},
                                    {"linear", SpotFalloff::kLinear, SpotFlux::kIntegral},
                                    {"smoothstep", SpotFalloff::kSmoothstep, SpotFlux::kIntegral},
                                    {"hard", SpotFalloff::kHard, SpotFlux::kIntegral},
                                    {"pi", SpotFalloff::kSquaredLinear, SpotFlux::kPiConvention}};

Result<void> FillFalloff(SourceGeometry& g, const std::string& text) {
  for (const FalloffRow& row : kFalloffs) {
    if (row.name != text) continue;
    g.falloff = row.falloff;
    g.spot_flux = row.flux;
    return {};
  }
  return WrongUsage("--spot-falloff", "unknown falloff \"" + text +
                                          "\"; use squared, linear, smoothstep, hard or pi");
}

Result<Radians> HalfAngle(const std::string& text, bool full) {
  const auto angle = ParseAngle(text);
  if (!angle) return tl::unexpected(angle.error());
  return full ? HalfAngleFromFull(*angle) : *angle;
}

Result<void> FillAngles(SourceGeometry& g, const ConvertOptions& o, Console& console) {
  if (auto done = FillFalloff(g, o.spot_falloff); !done) return done;
  if (!o.angular_diameter.empty()) {
    const auto radius = HalfAngle(o.angular_diameter, true);
    if (!radius) return tl::unexpected(radius.error());
    g.angular_radius = *radius;
  }
  if (o.outer.empty()) {
    if (g.kind != LightKind::kSpot) return {};
    return WrongUsage("--outer",
                      "a spot needs --outer, its half angle (or --full-angles), for "
                      "example --outer 35");
  }
  const auto outer = HalfAngle(o.outer, o.full_angles);
  if (!outer) return tl::unexpected(outer.error());
  const auto inner = HalfAngle(o.inner.empty() ? "0" : o.inner, o.full_angles);
  if (!inner) return tl::unexpected(inner.error());
  g.cone = SpotCone{*inner, *outer};
  if (*inner > *outer) {
    console.Warn({"inner_beyond_outer", "--inner",
                  "the inner angle is wider than the outer one; the outer one is used for both"});
  }
  return {};
}

Result<LumensPerWatt> ParseEfficacy(const std::string& text) {
  const auto number = ParseInUnit(text, "lm/w");
  if (!number) return tl::unexpected(number.error());
  if (!(*number > 0.0)) return Refused("not_positive", "--efficacy", "must be above zero");
  if (*number > kMaximumEfficacy.value()) {
    return Refused("above_efficacy", "--efficacy",
                   "no light gives more than 683 lm/W, and that is green of 555 nm; white light "
                   "ends near 350 lm/W");
  }
  return LumensPerWatt(*number);
}

struct Given {
  SourceQuantity quantity = SourceQuantity::kFlux;
  double value = 0.0;
};

// Watts become lumens here; every other unit is a quantity of the source already.
Result<Given> GivenQuantity(const LightValue& typed, const std::optional<LumensPerWatt>& efficacy) {
  constexpr std::array<SourceQuantity, 5> kQuantities = {
      SourceQuantity::kFlux, SourceQuantity::kIntensity, SourceQuantity::kIlluminance,
      SourceQuantity::kLuminance, SourceQuantity::kExitance};
  if (typed.unit != LightUnit::kWatts) {
    return Given{kQuantities[static_cast<std::size_t>(typed.unit)], typed.value};
  }
  if (!efficacy) {
    return WrongUsage("--efficacy",
                      "watts are electrical power; say how many lumens the lamp makes "
                      "of one, for example --efficacy 10lm/W (typical values: "
                      "lightcal reference efficacy)");
  }
  if (!(typed.value > 0.0)) return Refused("not_positive", "power", "must be above zero");
  return Given{SourceQuantity::kFlux,
               LumensFromElectrical(ElectricalWatts(typed.value), *efficacy).value()};
}

Result<void> LightSurface(ConvertAnswer& answer, const std::string& text) {
  if (text.empty()) return {};
  const auto reflectance = ParsePlainNumber("--reflectance", text);
  if (!reflectance) return tl::unexpected(reflectance.error());
  if (!(*reflectance > 0.0 && *reflectance <= 1.0)) {
    return Refused("bad_reflectance", "--reflectance",
                   "a surface reflects more than nothing and at most all: above 0, up to 1");
  }
  if (!answer.source.illuminance) {
    return WrongUsage("--reflectance", "a lit surface needs its --distance from the lamp");
  }
  answer.lit_exitance = ExitanceOfLitSurface(*answer.source.illuminance, *reflectance);
  answer.lit_luminance = LuminanceOfLitSurface(*answer.source.illuminance, *reflectance);
  return {};
}

// Options of other kinds of lamps, which change nothing.
void WarnOfUnused(const ConvertOptions& o, LightKind kind, Console& console) {
  using enum LightKind;
  struct Row {
    const char* option;
    bool given;
    std::vector<LightKind> of;
  };
  const Row rows[] = {{"--inner", !o.inner.empty(), {kSpot}},
                      {"--outer", !o.outer.empty(), {kSpot}},
                      {"--radius", !o.radius.empty(), {kSphere, kDisk, kTube}},
                      {"--diameter", !o.diameter.empty(), {kSphere, kDisk, kTube}},
                      {"--size", !o.size.empty(), {kRect}},
                      {"--width", !o.width.empty(), {kRect}},
                      {"--height", !o.height.empty(), {kRect}},
                      {"--length", !o.length.empty(), {kTube}},
                      {"--angular-diameter", !o.angular_diameter.empty(), {kDirectional}}};
  for (const Row& row : rows) {
    if (!row.given || std::ranges::find(row.of, kind) != row.of.end()) continue;
    console.Warn({"unused_option", row.option,
                  "says nothing of a " + std::string(LightKindName(kind)) +
                      " light and is left aside: it is of a " +
                      Joined(row.of, " or ",
                             [](LightKind one) { return std::string(LightKindName(one)); })});
  }
}

Result<ConvertAnswer> Convert(const ConvertOptions& o, Console& console) {
  const auto typed = ParseLightValue(o.value);
  if (!typed) return tl::unexpected(typed.error());
  const auto kind = ParseKind(o.kind);
  if (!kind) return tl::unexpected(kind.error());
  std::optional<LumensPerWatt> efficacy;
  if (!o.efficacy.empty()) {
    const auto parsed = ParseEfficacy(o.efficacy);
    if (!parsed) return tl::unexpected(parsed.error());
    efficacy = *parsed;
  }
  const auto given = GivenQuantity(*typed, efficacy);
  if (!given) return tl::unexpected(given.error());
  WarnOfUnused(o, *kind, console);
  SourceGeometry geometry;
  geometry.kind = *kind;
  if (auto done = FillSizes(geometry, o); !done) return tl::unexpected(done.error());
  if (auto done = FillAngles(geometry, o, console); !done) return tl::unexpected(done.error());
  auto source = ConvertSource(geometry, given->quantity, given->value);
  if (!source) return tl::unexpected(source.error());
  ConvertAnswer answer{*source, {}, {}, {}};
  const std::optional<Lumens> flux = answer.source.flux;
  if (efficacy && flux) answer.electrical = ElectricalFromLumens(*flux, *efficacy);
  if (auto done = LightSurface(answer, o.reflectance); !done) return tl::unexpected(done.error());
  return answer;
}

// Calls add(json key, name, unit, what it belongs to, value) for every quantity there is, in the
// order both outputs use.
template <class Add>
void ForEachQuantity(const ConvertAnswer& a, Add add) {
  const auto give = [&add](const char* key, const char* name, const char* unit, const char* of,
                           const auto& quantity) {
    if (quantity.has_value()) add(key, name, unit, of, quantity->value());
  };
  give("flux_lm", "luminous flux", "lm", "lamp", a.source.flux);
  give("intensity_cd", "axial intensity", "cd", "lamp", a.source.intensity);
  give("illuminance_lx", "illuminance", "lx", "receiver", a.source.illuminance);
  const bool lit = a.lit_luminance.has_value();
  if (lit) {
    give("luminance_nits", "luminance", "cd/m²", "lit surface", a.lit_luminance);
    give("exitance_lm_m2", "luminous exitance", "lm/m²", "lit surface", a.lit_exitance);
  }
  give(lit ? "source_luminance_nits" : "luminance_nits", "luminance", "cd/m²", "lamp",
       a.source.luminance);
  give(lit ? "source_exitance_lm_m2" : "exitance_lm_m2", "luminous exitance", "lm/m²", "lamp",
       a.source.exitance);
  give("electrical_W", "electrical power", "W", "lamp", a.electrical);
}

Result<void> RunConvert(const ConvertOptions& o, Console& console) {
  const auto answer = Convert(o, console);
  if (!answer) return tl::unexpected(answer.error());
  if (auto refused = console.RefuseIfStrict(); !refused) return refused;
  Node document = Node::Table();
  std::vector<std::vector<std::string>> rows;
  ForEachQuantity(*answer, [&](const char* key, const char* name, const char* unit, const char* of,
                               double value) {
    document.Put(key, value);
    rows.push_back({name, RoundedText(value, kConvertDigits), unit, of});
  });
  console.Print(TextTable({"quantity", "value", "unit", "of"}, rows));
  console.PrintDocument(document);
  return {};
}

}  // namespace

Run BuildConvert(CLI::App& parser) {
  auto o = std::make_shared<ConvertOptions>();
  parser
      .add_option("value", o->value,
                  "806lm flux, 64cd intensity, 190lx or 17.8fc illuminance, 1500nits or 14fL "
                  "luminance, 60W electrical power drawn (never radiant; needs --efficacy)")
      ->required();
  parser.add_option("--kind", o->kind, "What shines")->check(OneOfAnyCase(kLightKindNames));
  parser.add_option("--distance", o->distance,
                    "From the lamp (a sphere's or tube's middle) to a receiver that faces it on "
                    "its axis");
  parser.add_option("--radius", o->radius, "Of a sphere, disk or tube");
  parser.add_option("--diameter", o->diameter, "Instead of --radius");
  parser.add_option("--size", o->size, "Of a rect, WIDTHxHEIGHT: 120x60cm");
  parser.add_option("--width", o->width, "Of a rect");
  parser.add_option("--height", o->height, "Of a rect");
  parser.add_option("--length", o->length, "Of a tube");
  parser.add_option("--inner", o->inner,
                    "Spot: half angle of full brightness, degrees; 0 when not given, as in glTF");
  parser.add_option("--outer", o->outer, "Spot: half angle where the light ends, degrees");
  parser.add_flag("--full-angles", o->full_angles, "--inner and --outer are full apex angles");
  parser
      .add_option("--spot-falloff", o->spot_falloff,
                  "How a spot fades: squared as in Filament and glTF, smoothstep as in three.js; "
                  "pi: the convention that lumens are pi x candela whatever the cone")
      ->check(OneOf(NamesOf(kFalloffs)))
      ->capture_default_str();
  parser.add_option("--angular-diameter", o->angular_diameter,
                    "Directional: angle the disk spans, degrees (sun 0.53); gives its luminance");
  parser.add_option("--efficacy", o->efficacy,
                    "Lumens per electrical watt, 10lm/W; with another value, the watts drawn");
  parser.add_option("--reflectance", o->reflectance,
                    "Of a matt surface at --distance: its exitance M = rho E and luminance M/pi");
  return [o](Console& console) { return RunConvert(*o, console); };
}

}  // namespace lightcal::app
