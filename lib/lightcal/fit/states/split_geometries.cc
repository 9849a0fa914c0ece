// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/states/split_geometries.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lightcal/fit/model/fill_light.h"
#include "lightcal/fit/states/ln_of.h"
#include "lightcal/records/display_step.h"

namespace lightcal::fit {
namespace {

constexpr double kSamePlaces_m = 0.005;

constexpr double kSameAngles_rad = 1e-3;

bool OtherPlace(const Reading& a, const Reading& b) {
  if (std::abs(a.off_axis.value() - b.off_axis.value()) > kSameAngles_rad) return true;
  if (a.position_m && b.position_m) return Length(*a.position_m - *b.position_m) > kSamePlaces_m;
  if (a.distance && b.distance) {
    return std::abs(a.distance->value() - b.distance->value()) > kSamePlaces_m;
  }
  return false;
}

// Offset or beam.
bool TellsGeometry(const Session& part, const std::string& light) {
  const Reading* first = nullptr;
  for (const SessionReading& row : part.readings) {
    const Reading& reading = row.reading;
    const bool lit = reading.light == light && reading.lamp == LampState::kOn &&
                     reading.illuminance && !reading.shadow_card;
    if (!lit) continue;
    if (first == nullptr) first = &reading;
    if (OtherPlace(*first, reading)) return true;
  }
  return false;
}

Session WithoutReadings(const Session& session) {
  Session out = session;
  out.display_steps = DisplaySteps(session);
  out.readings.clear();
  out.state_readings.clear();
  return out;
}

// Size, cone and beam.
StateGeometry ShapeOf(const FittedLight& light) {
  StateGeometry out;
  out.state = light.state;
  out.kind = light.kind;
  out.flux_lm = light.flux_lm;
  out.luminance_nits = light.luminance_nits;
  out.inner_deg = light.inner_deg;
  out.outer_deg = light.outer_deg;
  out.inner_u95_deg = light.inner_u95_deg;
  out.outer_u95_deg = light.outer_u95_deg;
  out.diameter_m = light.diameter_m;
  out.width_m = light.width_m;
  out.height_m = light.height_m;
  out.length_m = light.length_m;
  out.radius_m = light.radius_m;
  out.distribution = light.distribution;
  out.beam = light.beam;
  return out;
}

double MeterSd(const FittedLight& a, const FittedLight& b) {
  if (!a.meter || !b.meter || a.meter->name != b.meter->name) return 0.0;
  return std::min(a.meter->calibration_relative, b.meter->calibration_relative);
}

}  // namespace

bool SameGeometry(const FixtureState& a, const FixtureState& b) {
  return std::ranges::all_of(a, [&](const ControlValue& control) {
    const ControlValue* other = FindControl(b, control.name);
    if (other == nullptr) return false;
    if (control.IsWord()) return control.word == other->word;
    return control.name != kZoomControl || control.number == other->number;
  });
}

GeometryParts SplitGeometries(const Session& session, const LightDescription& light) {
  GeometryParts parts;
  const FixtureState reference = ReferenceState(session, light.name);
  const auto own = [&](const SessionReading& row) {
    const Reading& reading = row.reading;
    return reading.light == light.name && reading.lamp == LampState::kOn && !reading.state.empty();
  };
  std::vector<FixtureState> geometries;
  for (const SessionReading& row : session.state_readings) {
    if (!own(row) || SameGeometry(row.reading.state, reference)) continue;
    const auto known = [&](const FixtureState& one) {
      return SameGeometry(one, row.reading.state);
    };
    if (std::ranges::none_of(geometries, known)) geometries.push_back(row.reading.state);
  }
  std::vector<FixtureState> told;
  for (const FixtureState& geometry : geometries) {
    Session part = WithoutReadings(session);
    for (const auto* const rows : {&session.readings, &session.state_readings}) {
      for (const SessionReading& row : *rows) {
        const bool lit = own(row);
        const bool here =
            lit ? SameGeometry(row.reading.state, geometry)
                : row.reading.light == light.name && row.reading.lamp == LampState::kOff;
        if (here) part.readings.push_back(row);
      }
    }
    if (!SplitStates(part) || !TellsGeometry(part, light.name)) continue;
    told.push_back(geometry);
    parts.others.push_back(std::move(part));
  }
  if (parts.others.empty()) return parts;
  parts.main = session;
  parts.main.display_steps = DisplaySteps(session);
  std::erase_if(parts.main.state_readings, [&](const SessionReading& row) {
    return own(row) && std::ranges::any_of(told, [&](const FixtureState& one) {
             return SameGeometry(one, row.reading.state);
           });
  });
  return parts;
}

LightDescription DescriptionFromReadings(const Session& part, const LightDescription& light,
                                         const FixtureState& state) {
  LightDescription out = DescriptionAt(light, state);
  // A data sheet's figures are of one zoom.
  out.flux.reset();
  out.beam.reset();
  out.field.reset();
  const bool stated = std::ranges::any_of(light.at, [&](const StateDescription& one) {
    return HoldsAt(one, state) && (one.inner || one.outer);
  });
  const bool across = std::ranges::any_of(part.readings, [&](const SessionReading& row) {
    return row.reading.light == light.name && row.reading.off_axis.value() != 0.0;
  });
  if (across && !stated) {
    out.inner.reset();
    out.outer.reset();
  }
  return out;
}

void DescribeOtherGeometries(const LightDescription& light, FittedLight& fitted) {
  for (const MeasuredState& read : fitted.states) {
    const auto alike = [&](const StateGeometry& one) {
      return SameGeometry(one.state, read.state);
    };
    const bool known =
        SameGeometry(fitted.state, read.state) || std::ranges::any_of(fitted.geometries, alike);
    const bool described = std::ranges::any_of(
        light.at, [&](const StateDescription& one) { return HoldsAt(one, read.state); });
    if (known || !described || !read.intensity_cd) continue;
    const LightDescription there = DescriptionAt(light, read.state);
    FittedLight shaped = Describe(there);
    shaped.state = read.state;
    shaped.intensity_cd = read.intensity_cd;
    AddDerivedQuantities(there, shaped);
    fitted.geometries.push_back(ShapeOf(shaped));
  }
}

void TakeGeometry(const FittedLight& own, FittedLight& light) {
  if (!own.intensity_cd || !light.intensity_cd || !(light.intensity_cd->value > 0.0)) return;
  const double ln = std::log(own.intensity_cd->value / light.intensity_cd->value);
  const double meter = MeterSd(own, light);
  const double between =
      std::max(0.0, std::pow(SdOfLn(*own.intensity_cd), 2.0) +
                        std::pow(SdOfLn(*light.intensity_cd), 2.0) - 2.0 * meter * meter);
  StateGeometry geometry = ShapeOf(own);
  geometry.distance_offset_m = own.distance_offset_m;
  light.geometries.push_back(std::move(geometry));
  for (const MeasuredState& one : own.states) {
    MeasuredState state = one;
    const double within = SdOfLn(one.relative);
    state.relative =
        UncertainFromLog(ln + std::log(one.relative.value), std::hypot(std::sqrt(between), within));
    light.states.push_back(std::move(state));
  }
}

}  // namespace lightcal::fit
