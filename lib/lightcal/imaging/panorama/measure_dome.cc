// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/panorama/measure_dome.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/imaging/panorama/cut_off_lights.h"
#include "lightcal/imaging/panorama/dome_holes.h"
#include "lightcal/imaging/panorama/turn_north.h"
#include "lightcal/imaging/scene/picture_luminance.h"
#include "lightcal/photometry/half_range.h"

namespace lightcal {
namespace {

constexpr double kConflict = 0.25;
constexpr double kMostHidden = 0.03;  // of a meter's view, in no picture
constexpr double kMostHiddenByBall = 0.1;

tl::unexpected<Error> AboutFile(const char* code, const DomeInput& input, const char* message) {
  return Refused(code, input.files.front(), message);
}

Result<void> CheckBrightness(const DomeInput& input, Warnings& warnings) {
  const auto& nits = input.dome.nits;
  const auto [least, most] = std::minmax_element(nits.begin(), nits.end());
  if (!(*most > 0.0F)) {
    return AboutFile("all_black", input, "no pixel is above 0; expose longer, or merge a bracket");
  }
  if (*least != *most) return {};
  if (std::abs(*most - kLargestHalf) < 1.0) {
    return AboutFile("all_saturated", input,
                     "every pixel is at the format's limit; expose shorter, or merge a bracket");
  }
  warnings.push_back({"all_saturated", input.files.front(),
                      "every pixel has the same value: the picture is saturated all over, or was "
                      "drawn"});
  return {};
}

std::string WholeDegrees(double degrees) {
  return std::to_string(static_cast<int>(std::lround(degrees)));
}

// Where a single ball's hole is, and what fills it.
std::string HoleBehindBall(const MeasuredDome& measured) {
  const auto& cap = measured.input.blind_cap;
  if (!cap) return "";
  const AzimuthElevation at = AnglesOf(TurnedNorth(cap->direction, measured.north));
  return ": the ball hides a cap of " + RoundedText(DegreesFromRadians(cap->half_angle), 2) +
         " degrees around azimuth " + WholeDegrees(at.azimuth_deg) + ", elevation " +
         WholeDegrees(at.elevation_deg) +
         ", and opposite of it the camera shows itself. A second picture of the ball from 90 "
         "degrees aside ({dome.aims} each) fills both";
}

// The largest holes of the dome, in the answer's directions.
std::string WhereHoles(const MeasuredDome& measured) {
  constexpr std::size_t kNamed = 3;
  const auto holes = HolesOf(measured.input.unseen, measured.input.dome.grid());
  std::string text;
  for (std::size_t i = 0; i < std::min(kNamed, holes.size()); ++i) {
    const AzimuthElevation at = AnglesOf(TurnedNorth(holes[i].direction, measured.north));
    text += (i == 0 ? ": " : ", ") + RoundedText(100.0 * holes[i].share, 2) + " % around azimuth " +
            RoundedText(at.azimuth_deg, 3) + ", elevation " + RoundedText(at.elevation_deg, 3);
  }
  if (holes.size() > kNamed) text += " and " + std::to_string(holes.size() - kNamed) + " more";
  return text;
}

// What no view shows is black: the meter must not have seen much of it. The share of a uniform
// sphere's light on it that is hidden.
Result<double> CheckSeen(const std::optional<DomeReading>& reading, MeasuredDome& measured) {
  const DomeInput& input = measured.input;
  if (input.unseen.empty()) return 0.0;
  measured.warnings.push_back({"partly_seen", input.files.front(),
                               "no view shows " + RoundedText(100.0 * (1.0 - input.seen_share), 2) +
                                   " % of the sphere" +
                                   (measured.input.blind_cap ? "" : WhereHoles(measured)) +
                                   "; it is black in the dome" + HoleBehindBall(measured)});
  if (!reading) return 0.0;
  std::vector<float> hidden(input.unseen.begin(), input.unseen.end());
  const double share = IlluminanceOn({hidden.data(), input.dome.width, input.dome.height},
                                     input.dome.grid(), reading->normal)
                           .value() /
                       std::numbers::pi;
  if (share <= (input.blind_cap ? kMostHiddenByBall : kMostHidden)) return share;
  return AboutFile("reading_beyond_view", input,
                   ("the meter saw what no view shows: " + RoundedText(100.0 * share, 2) +
                    " % of what lights it from a uniform sphere; turn it to where the pictures "
                    "look ({dome.normal}), or add views")
                       .c_str());
}

Result<void> SetScale(const std::optional<DomeReading>& reading, MeasuredDome& measured) {
  DomeInput& input = measured.input;
  measured.scale_source = input.scale;
  measured.unit_known = input.absolute;
  measured.scale_u95_relative = input.scale_u95_relative;
  if (input.absolute && !input.scale_u95_relative) measured.scale_u95_relative = kUnstatedScaleU95;
  if (!reading) return {};
  std::optional<double> stated_sd = input.scale_u95_relative;
  if (stated_sd) *stated_sd /= kZ95;
  auto scale = ScaleDome(*reading, input.absolute, stated_sd, input.dome, measured.lights);
  if (!scale) return Propagate(std::move(scale));
  measured.scale = *scale;
  const bool scaled = scale->sd_relative > 0.0;
  if (scaled) {
    measured.unit_known = true;
    if (scale->read_weight >= 0.5) measured.scale_source = reading->shaded ? "lux_shaded" : "lux";
    measured.scale_u95_relative =
        scale->range_ln + kZ95 * std::hypot(scale->sd_relative, measured.missing_sd);
    std::erase_if(input.warnings, [](const Warning& w) { return w.code == "relative_scale"; });
  }
  const double off = std::abs(std::log(scale->read_factor));
  const bool agree = stated_sd ? scale->read_weight < 1.0 : off <= kConflict;
  if (scaled && input.absolute && !agree) {
    measured.warnings.push_back(
        {"scale_conflict", input.files.front(),
         "the reading makes the picture " + RoundedText(scale->read_factor, 3) +
             " times as bright as the file says it is; the reading is believed"});
  }
  if (scale->shading_of_pixels < 1.0) {
    measured.warnings.push_back(
        {"shading_conflict", input.files.front(),
         "the card took away " + RoundedText(scale->shading_of_pixels, 2) +
             " times what the picture shows of the light; the readings are believed: check that "
             "it was this light that was shaded, and wholly"});
  }
  if (scale->inferred > 1) {
    measured.warnings.push_back(
        {"clipped_lights_share", input.files.front(),
         std::to_string(scale->inferred) +
             " lights are clipped; one reading cannot tell them apart, so they share one "
             "luminance"});
  }
  return {};
}

void WarnOfClippedLights(MeasuredDome& measured) {
  const bool white = std::ranges::any_of(
      measured.lights, [](const DomeLight& light) { return light.body.clipped && !light.xy; });
  if (white && measured.input.dome.channels == 3) {
    measured.warnings.push_back(
        {"clipped_color", measured.input.files.front(),
         "a light is clipped: what colour it has the picture does not tell, and none is given; "
         "read it with a colour meter, or take a shorter frame of it"});
  }
  const bool lost = std::ranges::any_of(measured.lights, [](const DomeLight& light) {
    return light.body.clipped && !light.inferred;
  });
  if (!lost) return;
  measured.warnings.push_back({"clipped", measured.input.files.front(),
                               "a light is clipped: its lux are a lower bound; read it with a lux "
                               "meter ({dome.illuminance}, and "
                               "{dome.shaded} where the picture is not in cd/m2)"});
}

// What lights that are clipped, or may be, and that no reading gave, are at most.
void BoundLights(const std::optional<DomeReading>& reading, MeasuredDome& measured) {
  if (!measured.unit_known) return;
  const Dome& dome = measured.input.dome;
  for (DomeLight& light : measured.lights) {
    if (light.inferred || !(light.maybe_clipped || light.body.clipped)) continue;
    const double shown = light.illuminance.value();
    const double rest =
        IlluminanceOn(dome.luminance(), dome.grid(), light.direction).value() - shown;
    const DomeLight* const one = &light;
    light.at_most = Lux(MostOfCutOff({&one, 1}, light.direction, std::max(0.0, rest)));
    // A reading in the picture's own unit holds it, as well as both are known.
    if (!reading || reading->shaded || !LightsMeter(light, reading->normal)) continue;
    const double seen = IlluminanceOn(dome.luminance(), dome.grid(), reading->normal).value();
    const double open = 2.0 * measured.scale_u95_relative.value_or(0.0) * seen;
    const double most = shown + open / Dot(light.direction, reading->normal);
    light.at_most = Lux(std::min(light.at_most->value(), most));
  }
}

// Outside the atmosphere the sun gives 133 klx at its mean distance, 138 at perihelion (Darula,
// Kittler, Gueymard 2005), and clouds beside it add little.
constexpr double kMoreThanSun_lx = 150e3;
constexpr double kLowestSun_deg = 1.0;  // below the horizon: a tripod's tilt

std::string WordsOfLight(const MeasuredDome& measured, const DomeLight& light) {
  const AzimuthElevation at = AnglesOf(TurnedNorth(light.direction, measured.north));
  return RoundedText(light.illuminance.value(), 3) + " lx at azimuth " +
         RoundedText(at.azimuth_deg, 3) + ", elevation " + RoundedText(at.elevation_deg, 3);
}

// Where the unit is known; lights brightest first. What mirrors a sun above the horizon is no sun.
void WarnOfImpossibleSuns(MeasuredDome& measured) {
  if (!measured.unit_known) return;
  const std::string& file = measured.input.files.front();
  constexpr const char* kCauses =
      ": is the panorama upside down or tilted, the reading that of another place, or the meter "
      "turned otherwise ({dome.normal})?";
  for (const DomeLight& light : measured.lights) {
    if (light.illuminance.value() <= kMoreThanSun_lx) break;
    measured.warnings.push_back(
        {"brighter_than_sun", file,
         WordsOfLight(measured, light) + ": no sun gives more than 138000" + kCauses});
  }
  const auto sun = std::ranges::find_if(measured.lights, IsBrightAsSun);
  const double lowest = -std::sin(RadiansFromDegrees(kLowestSun_deg).value());
  if (sun == measured.lights.end() || sun->direction[2] >= lowest) return;
  measured.warnings.push_back({"sun_below_horizon", file,
                               WordsOfLight(measured, *sun) +
                                   ": as bright as the sun alone, and below the horizon" +
                                   kCauses});
}

// What was inferred may outshine what was not.
void OrderLights(MeasuredDome& measured) {
  std::ranges::stable_sort(measured.lights, [](const DomeLight& a, const DomeLight& b) {
    return a.illuminance.value() > b.illuminance.value();
  });
  const double scale = measured.scale_u95_relative.value_or(0.0) / kZ95;
  for (const DomeLight& light : measured.lights) {
    measured.sd_relative.push_back(
        std::hypot(light.inferred ? measured.scale.inferred_sd_relative : scale,
                   light.background_sd_relative));
  }
}

}  // namespace

Uncertain LuxOfDome(const MeasuredDome& measured, double value_lx, double sd_relative) {
  const bool in_ln = measured.scale.range_ln > 0.0 || kZ95 * sd_relative >= 1.0;
  if (!(value_lx > 0.0) || (measured.unit_known && !in_ln)) {
    return UncertainFromNormal(value_lx, sd_relative * value_lx);
  }
  if (measured.unit_known) return UncertainFromLog(std::log(value_lx), sd_relative);
  return UncertainFromLog(std::log(value_lx), std::hypot(kUnstatedUnitSdLn, sd_relative));
}

Uncertain LuxOfLight(const MeasuredDome& measured, std::size_t index) {
  const DomeLight& light = measured.lights[index];
  const double value = light.illuminance.value();
  Uncertain lux = LuxOfDome(measured, value, measured.sd_relative[index]);
  if (!light.at_most) return lux;
  lux.low = light.at_least ? light.at_least->value() : LowEnd(lux);
  lux.high = std::max(HighEnd(lux), light.at_most->value());
  lux.u95 = 0.5 * (*lux.high - *lux.low);
  return lux;
}

Result<MeasuredDome> MeasureDome(DomeInput input, const DomeRequest& request) {
  MeasuredDome measured;
  measured.input = std::move(input);
  measured.north = request.north;
  if (auto ok = CheckBrightness(measured.input, measured.warnings); !ok) {
    return Propagate(std::move(ok));
  }
  std::optional<DomeReading> reading = request.reading;
  if (reading) reading->normal = TurnedNorth(reading->normal, -request.north);
  auto hidden = CheckSeen(reading, measured);
  if (!hidden) return Propagate(std::move(hidden));
  if (reading) {  // the hidden part may be as dark as it may be bright
    reading->sigma_relative = std::hypot(reading->sigma_relative, *hidden / 2.0);
  }
  measured.lights = FindLights(measured.input, !measured.input.clipped.empty());
  if (auto ok = JudgePlateaus(request, reading, measured); !ok) return Propagate(std::move(ok));
  if (auto ok = SetScale(reading, measured); !ok) return Propagate(std::move(ok));
  BoundLights(reading, measured);
  OrderLights(measured);
  WarnOfClippedLights(measured);
  WarnOfImpossibleSuns(measured);
  Warnings& warnings = measured.warnings;
  warnings.insert(warnings.begin(), measured.input.warnings.begin(), measured.input.warnings.end());
  return measured;
}

}  // namespace lightcal
