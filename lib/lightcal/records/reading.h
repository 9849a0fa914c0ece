// SPDX-License-Identifier: Apache-2.0
// One reading of one meter: the noun every driver, importer and person fills.
#pragma once

#include <optional>
#include <string>

#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal/core/units.h"
#include "lightcal/core/vec3.h"
#include "lightcal/records/fixture_state.h"

namespace lightcal {

enum class LampState { kOn, kOff };

// Where a reading's colour came from; decides the default sigma of its chromaticity.
enum class ColorSource { kUnknown, kSpectrometer, kColorimeter, kCamera };

// What kind of instrument a reading came from: how far its number may be believed to be lux.
enum class MeterQuality {
  kUnknown,
  kPhotometer,   // V(lambda) filter and cosine corrector
  kColorimeter,  // three filters
  kSpectral,     // integrated from a spectrum
  kBareSensor,   // a photodiode chip: no cosine, the maker's scale
  kDerived,      // computed from something else, as from a picture
};

// What all that one instrument says is off by together: 1 sigma of ln of its factor.
struct SharedScale {
  std::string instrument;  // "" = the meter that nobody names
  double sigma = 0.0;
};

// A reading as the journal and session.toml hold it. Absent = not measured.
struct Reading {
  std::string light;                     // name of the [[light]]
  std::string meter;                     // name of the [[meter]], "" = none named
  std::optional<Metres> distance;        // from the session's reference point of the lamp, > 0
  std::optional<Metres> distance_sigma;  // 1 sigma of it alone; overrides the light's
  std::optional<Vec3> position_m;        // of the meter; with normal, instead of distance
  std::optional<Vec3> normal;            // any length above 0
  std::optional<Lux> illuminance;        // as read: ambient and bounce included
  Radians tilt{0.0};                     // between the meter's normal and the lamp's direction
  // Between the lamp's axis and the direction of the meter, seen from the lamp; the sign tells the
  // two sides of the axis apart. 0: on the axis.
  Radians off_axis{0.0};
  LampState lamp = LampState::kOn;
  bool shadow_card = false;  // only the direct beam was blocked: everything but the lamp
  std::optional<Kelvin> cct;
  std::optional<double> duv;
  std::optional<Xy> xy;
  std::string spectrum_file;             // relative to the session directory, "" = none
  std::optional<double> sigma_relative;  // 1 sigma, overrides the meter's
  std::optional<Mireds> sigma_mired;     // 1 sigma of the colour along the locus, a camera's
  std::string time;                      // ISO 8601 as recorded, "" = unknown
  bool over_range = false;               // the true value is at least illuminance
  bool under_range = false;              // the true value is at most illuminance
  ColorSource color_source = ColorSource::kUnknown;
  std::string device;  // driver and serial, "sekonic:..." , "" = by hand
  MeterQuality quality = MeterQuality::kUnknown;
  std::optional<double> calibration_factor;  // already in illuminance: shown value times this
  FixtureState state{};                      // what the lamp's controls said, empty = it has none
  std::optional<SharedScale> scale{};        // of a picture; absent: what its meter says
  bool of_luminance = false;                 // of a picture of the lamp itself
};

// Whether a picture tells it by the camera's scale, not by a meter's.
[[nodiscard]] inline bool ByOwnScale(const Reading& reading) {
  return reading.scale && reading.scale->instrument == reading.device;
}

// Whether it is of the lamp's own light.
[[nodiscard]] inline bool IsLit(const Reading& reading) {
  return reading.illuminance && reading.lamp == LampState::kOn && !reading.shadow_card;
}

// What is wrong with a reading: the key it is wrong at, and what to do.
struct ReadingFault {
  std::string key, message;
};
// The first fault of a reading, absent where it is one: numbers finite and in their ranges, a place
// given one way, something measured, marks that agree. A journal takes no other.
[[nodiscard]] std::optional<ReadingFault> FaultOf(const Reading& reading);

}  // namespace lightcal
