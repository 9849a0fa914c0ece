// SPDX-License-Identifier: Apache-2.0
// lightcal exposure: camera settings -> EV, the luminance that saturates, and what lights become
// when a renderer pre-exposes them.
#include "lightcal/photometry/exposure.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands.h"
#include "light_value.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "lightcal/photometry/half_range.h"

namespace lightcal::app {
namespace {

constexpr int kExposureDigits = 6;
constexpr double kFullTurnDegrees = 360.0;

struct ExposureOptions {
  std::vector<std::string> settings;  // as a camera shows them
  std::string aperture, t_stop, shutter, angle, fps, iso;
  std::string transmittance, vignetting, field_angle;
  std::vector<std::string> lights;
};

struct PreExposedLight {
  std::string typed;
  LightValue light;
  double pre_exposed = 0.0;
  HalfRange range = HalfRange::kFits;
  [[nodiscard]] bool Fits() const {
    return range == HalfRange::kFits || range == HalfRange::kSubnormal;
  }
};

Result<double> Positive(const std::string& option, const std::string& text) {
  auto number = ParsePlainNumber(option, text);
  if (!number) return number;
  if (!(*number > 0.0)) return Refused("not_positive", option, "must be above zero");
  return number;
}

// "f/2.8" "T2.8" "t/2.8" "2.8"
std::string WithoutStopLetter(std::string text) {
  if (!text.empty() && (text[0] == 'f' || text[0] == 'F' || text[0] == 't' || text[0] == 'T')) {
    text.erase(0, 1);
    if (text.starts_with('/')) text.erase(0, 1);
  }
  return text;
}

Result<double> RelativeAperture(const ExposureOptions& o) {
  if (o.aperture.empty() == o.t_stop.empty()) {
    return WrongUsage("--aperture",
                      "give the lens opening once: --aperture f/2.8, or --t-stop "
                      "T2.9 of a cine lens");
  }
  return o.aperture.empty() ? Positive("--t-stop", WithoutStopLetter(o.t_stop))
                            : Positive("--aperture", WithoutStopLetter(o.aperture));
}

Result<Seconds> TypedShutter(const std::string& text, Console& console) {
  auto time = ParseDuration(text);
  if (!time) return time;
  if (!(*time > Seconds(0.0))) {
    return Refused("not_positive", "--shutter", "an exposure takes time: above zero");
  }
  if (ParseNumber(text) && *time >= Seconds(2.0)) {
    console.Note("--shutter " + text + " is read as " + text + " seconds; write 1/" + text +
                 " for the fraction");
  }
  return time;
}

Result<Seconds> RotaryShutter(const ExposureOptions& o) {
  const auto angle = ParseAngle(o.angle);
  if (!angle) return tl::unexpected(angle.error());
  const double degrees = DegreesFromRadians(*angle);
  if (!(degrees > 0.0 && degrees <= kFullTurnDegrees * (1.0 + 1e-12))) {
    return Refused("bad_angle", "--angle", "a shutter opens more than 0 and at most 360 degrees");
  }
  const auto fps = Positive("--fps", o.fps);
  if (!fps) return tl::unexpected(fps.error());
  return ShutterFromAngle(*angle, *fps);
}

Result<Seconds> ExposureTime(const ExposureOptions& o, Console& console) {
  const bool rotary = !o.angle.empty() || !o.fps.empty();
  if (rotary == !o.shutter.empty()) {
    return WrongUsage("--shutter",
                      "give the exposure time once: --shutter 1/60, or --angle 180 "
                      "--fps 24");
  }
  if (!rotary) return TypedShutter(o.shutter, console);
  if (o.angle.empty() || o.fps.empty()) {
    return WrongUsage(o.angle.empty() ? "--angle" : "--fps",
                      "--angle and --fps go together, for example --angle 180 --fps 24");
  }
  return RotaryShutter(o);
}

// A factor of light, above 0 up to 1; the default where it was not given.
Result<double> Fraction(const std::string& option, const std::string& text, double otherwise) {
  if (text.empty()) return otherwise;
  auto number = ParsePlainNumber(option, text);
  if (number && !(*number > 0.0 && *number <= 1.0)) {
    return Refused("bad_fraction", option,
                   "a lens passes more than nothing and at most all: "
                   "above 0, up to 1");
  }
  return number;
}

Result<Radians> FieldAngle(const std::string& text) {
  if (text.empty()) return LensTransmission{}.field_angle;
  auto angle = ParseAngle(text);
  if (!angle) return angle;
  const double degrees = DegreesFromRadians(*angle);
  if (!(degrees >= 0.0 && degrees < 90.0)) {
    return Refused("bad_angle", "--field-angle",
                   "must lie from 0 to below 90 degrees off the axis");
  }
  return angle;
}

// A T-stop has the transmittance in it already, so it is taken out of q.
Result<double> ChosenLensConstant(const ExposureOptions& o) {
  const bool t_stop = !o.t_stop.empty();
  if (t_stop && !o.transmittance.empty()) {
    return WrongUsage("--transmittance",
                      "a T-stop includes the transmittance; give it with "
                      "--aperture only");
  }
  const LensTransmission usual;
  if (o.transmittance.empty() && o.vignetting.empty() && o.field_angle.empty()) {
    return t_stop ? kIsoLensConstant / usual.transmittance : kIsoLensConstant;
  }
  auto transmittance =
      Fraction("--transmittance", o.transmittance, t_stop ? 1.0 : usual.transmittance);
  if (!transmittance) return transmittance;
  auto vignetting = Fraction("--vignetting", o.vignetting, usual.vignetting);
  if (!vignetting) return vignetting;
  const auto field_angle = FieldAngle(o.field_angle);
  if (!field_angle) return tl::unexpected(field_angle.error());
  return LensConstant({*transmittance, *vignetting, *field_angle});
}

Result<CameraSettings> ParseCamera(const ExposureOptions& o, Console& console) {
  const auto opening = RelativeAperture(o);
  if (!opening) return tl::unexpected(opening.error());
  const auto time = ExposureTime(o, console);
  if (!time) return tl::unexpected(time.error());
  if (o.iso.empty()) return WrongUsage("--iso", "give the speed, for example --iso 100");
  const auto iso = Positive("--iso", o.iso);
  if (!iso) return tl::unexpected(iso.error());
  return CameraSettings{*opening, *time, *iso};
}

void WarnOfHalf(const PreExposedLight& light, Console& console) {
  if (light.range == HalfRange::kOverflow) {
    const double stops = std::log2(light.pre_exposed / kLargestHalf);
    console.Warn({"fp16_overflow", light.typed,
                  "pre-exposed to " + RoundedText(light.pre_exposed, kExposureDigits) +
                      ", above the 65504 a half float holds; close down " + RoundedText(stops, 3) +
                      " EV more, or keep it in 32-bit float"});
  } else if (light.range != HalfRange::kFits) {
    console.Warn({"fp16_subnormal", light.typed,
                  "pre-exposed to " + RoundedText(light.pre_exposed, kExposureDigits) +
                      ", below the 6.1e-5 from which a half float keeps all its digits"});
  }
}

Result<std::vector<PreExposedLight>> PreExpose(const std::vector<std::string>& texts,
                                               double exposure, Console& console) {
  std::vector<PreExposedLight> lights;
  for (const std::string& text : texts) {
    const auto light = ParseLightValue(text);
    if (!light) return tl::unexpected(light.error());
    if (light->unit == LightUnit::kWatts) {
      return WrongUsage(text, "watts are not light; convert them first: lightcal convert " + text +
                                  " --efficacy 100lm/W --kind point");
    }
    if (light->value < 0.0) return Refused("negative", text, "no lamp emits less than nothing");
    const double value = PreExposed(light->value, exposure);
    if (!std::isfinite(value)) return Refused("out_of_range", text, "beyond the range of numbers");
    lights.push_back({text, *light, value, ClassifyHalf(value)});
    WarnOfHalf(lights.back(), console);
  }
  return lights;
}

Node PreExposedNode(const PreExposedLight& light) {
  return {{"value", light.light.value},
          {"unit", LightUnitText(light.light.unit)},
          {"pre_exposed", light.pre_exposed},
          {"fits_fp16", light.Fits()},
          {"fp16", HalfRangeName(light.range)}};
}

std::string LightsTable(const std::vector<PreExposedLight>& lights) {
  std::vector<std::vector<std::string>> rows;
  rows.reserve(lights.size());
  for (const PreExposedLight& light : lights) {
    rows.push_back({light.typed, RoundedText(light.pre_exposed, kExposureDigits),
                    std::string(HalfRangeName(light.range))});
  }
  return TextTable({"light", "pre-exposed", "fp16"}, rows);
}

// "f/2.8" "T2.9" "ISO400" "180deg" "24fps" "1/60": each says by its letters what it is.
Result<void> TakeSettings(ExposureOptions& o) {
  for (const std::string& word : o.settings) {
    const std::string lower = LowerAscii(word);
    std::string* meant = &o.shutter;
    std::string value = word;
    if (lower.starts_with("iso")) {
      meant = &o.iso;
      value = word.substr(3);
    } else if (lower.starts_with("f") || lower.starts_with("t")) {
      meant = lower.starts_with("f") ? &o.aperture : &o.t_stop;
    } else if (lower.ends_with("deg") || lower.ends_with("°")) {
      meant = &o.angle;
    } else if (lower.ends_with("fps")) {
      meant = &o.fps;
      value = word.substr(0, word.size() - 3);
    } else if (ParseNumber(word)) {
      return WrongUsage(word, "is it the opening, the time or the speed? write f/" + word + ", 1/" +
                                  word + " or ISO" + word);
    }
    if (meant == &o.shutter && !ParseDuration(word)) {
      return WrongUsage(word, "is no setting: f/2.8, T2.9, 1/60, 180deg, 24fps or ISO400");
    }
    if (!meant->empty()) return WrongUsage(word, "stands beside " + *meant + ": give it once");
    *meant = value;
  }
  return {};
}

Result<void> RunExposure(const ExposureOptions& typed, Console& console) {
  ExposureOptions o = typed;
  if (auto taken = TakeSettings(o); !taken) return taken;
  const auto camera = ParseCamera(o, console);
  if (!camera) return tl::unexpected(camera.error());
  const auto q = ChosenLensConstant(o);
  if (!q) return tl::unexpected(q.error());
  const Nits maximum = MaximumLuminance(*camera, *q);
  const double exposure = ExposureScale(*camera, *q);
  if (!std::isnormal(maximum.value()) || !std::isnormal(exposure)) {
    return Refused("out_of_range", "exposure",
                   "the answer lies beyond the range of numbers; check opening, time and speed");
  }
  const auto lights = PreExpose(o.lights, exposure, console);
  if (!lights) return tl::unexpected(lights.error());
  if (auto refused = console.RefuseIfStrict(); !refused) return refused;

  console.Print(
      TextTable({"quantity", "value", "unit"},
                {{"EV", RoundedText(Ev(*camera), kExposureDigits), ""},
                 {"EV100", RoundedText(Ev100(*camera), kExposureDigits), ""},
                 {"exposure time", RoundedText(camera->shutter.value(), kExposureDigits), "s"},
                 {"lens constant q", RoundedText(*q, kExposureDigits), ""},
                 {"saturating luminance", RoundedText(maximum.value(), kExposureDigits), "cd/m²"},
                 {"exposure", RoundedText(exposure, kExposureDigits), "m²/cd"}}));
  if (!lights->empty()) console.Print("\n" + LightsTable(*lights));
  console.PrintDocument({{"ev", Ev(*camera)},
                         {"ev100", Ev100(*camera)},
                         {"l_max_nits", maximum},
                         {"exposure", exposure},
                         {"q", *q},
                         {"shutter_s", camera->shutter},
                         {"lights", Node::UnlessEmpty(Node::List(*lights, PreExposedNode))}});
  return {};
}

}  // namespace

Run BuildExposure(CLI::App& parser) {
  auto o = std::make_shared<ExposureOptions>();
  parser.add_option("settings", o->settings, "As the camera shows them: f/2.8 1/60 ISO400");
  parser.add_option("--aperture", o->aperture, "Relative aperture N, f/2.8 or 2.8");
  parser.add_option("--t-stop", o->t_stop,
                    "T-stop of a cine lens instead, T2.9 or 2.9; EV then counts in T");
  parser.add_option("--shutter", o->shutter,
                    "Exposure time, 1/60 or 20ms; a bare 2 is two seconds");
  parser.add_option("--angle", o->angle, "Shutter angle in degrees instead, with --fps");
  parser.add_option("--fps", o->fps, "Frames per second");
  parser.add_option("--iso", o->iso, "ISO speed");
  parser.add_option("--transmittance", o->transmittance,
                    "Lens transmittance T, 0.9 when another lens factor is given");
  parser.add_option("--vignetting", o->vignetting, "Vignetting factor v, 0.98");
  parser.add_option(
      "--field-angle", o->field_angle,
      "Degrees off the axis, 10: q = pi/4 T v cos^4. With none of the three, q = 0.65");
  parser
      .add_option("--light", o->lights,
                  "Values to pre-expose, 2e9nits 100klx 806lm: do they fit a half float?")
      ->delimiter(',');
  return [o](Console& console) { return RunExposure(*o, console); };
}

}  // namespace lightcal::app
