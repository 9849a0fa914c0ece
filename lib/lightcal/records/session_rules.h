// SPDX-License-Identifier: Apache-2.0
// The keys of a session's rooms, lights and meters with what each must obey, for whoever reads them
// from a file and for whoever is handed them. Internal to the records room.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lightcal/records/field_checker.h"
#include "lightcal/records/field_reader.h"
#include "lightcal/records/field_rules.h"
#include "lightcal/records/session.h"

namespace lightcal::records {

template <class Archive, class SomeRoom>
void VisitRoom(Archive& archive, SomeRoom& room) {
  archive.Array("size_m", room.size_m, kPositive);
  archive.Number("reflectance", room.reflectance, kReflectanceRule);
  archive.Number("reflectance_u95", room.reflectance_u95, kPositive);
}

template <class Archive, class SomeLamp>
void VisitInTime(Archive& archive, SomeLamp& lamp) {
  archive.Number("minutes_on", lamp.minutes_on, kNotNegative);
  archive.Number("flicker_hz", lamp.flicker_hz, kPositive);
  archive.Number("flicker_depth", lamp.flicker_depth, kDepthRule);
  archive.Number("pwm_duty", lamp.pwm_duty, kDutyRule);
}

// A rect's sides, which a file gives together.
template <class Described>
void VisitSides(FieldReader& reader, Described& light) {
  std::optional<std::array<double, 2>> size;
  reader.Array("size_m", size, kNotNegative);
  if (!size) return;
  light.width = Metres((*size)[0]);
  light.height = Metres((*size)[1]);
}
template <class Described>
void VisitSides(FieldChecker& checker, const Described& light) {
  checker.Number("size_m", light.width, kNotNegative);
  checker.Number("size_m", light.height, kNotNegative);
}

// Sizes and cone, of a light or of what it is at some of its states.
template <class Archive, class Described>
void VisitShape(Archive& archive, Described& light) {
  archive.Number("diameter_m", light.diameter, kPositive);
  VisitSides(archive, light);
  archive.Number("length_m", light.length, kPositive);
  archive.Number("radius_m", light.radius, kPositive);
  archive.Degrees("inner_deg", light.inner, kHalfAngleRule);
  archive.Degrees("outer_deg", light.outer, kHalfAngleRule);
}

template <class Archive, class SomeState>
void VisitAtState(Archive& archive, SomeState& one) {
  archive.Controls("state", one.state);
  archive.Word("kind", one.kind, kLightKindNames);
  archive.Word("fixture", one.fixture, kFixtureNames);
  VisitShape(archive, one);
}

// All but `at`.
template <class Archive, class SomeLight>
void VisitLight(Archive& archive, SomeLight& light) {
  archive.Text("name", light.name);
  archive.Word("kind", light.kind, kLightKindNames);
  archive.Word("fixture", light.fixture, kFixtureNames);
  archive.Word("lamp_class", light.lamp_class, kLampClassWords);
  VisitInTime(archive, light.in_time);
  archive.Array("position_m", light.position_m);
  archive.Array("aim", light.aim);
  archive.Array("axis", light.axis);
  VisitShape(archive, light);
  archive.Number("electrical_W", light.electrical, kPositive);
  archive.Number("flux_lm", light.flux, kPositive);
  archive.Degrees("beam_deg", light.beam, kFullAngleRule);
  archive.Degrees("field_deg", light.field, kFullAngleRule);
  archive.Degrees("off_axis_sigma_deg", light.angle_sigma, kHalfAngleRule);
  archive.Number("distance_sigma_m", light.distance_sigma, kNotNegative);
  archive.Text("distribution", light.distribution_file);
}

template <class Archive, class SomeMeter>
void VisitMeter(Archive& archive, SomeMeter& meter) {
  archive.Text("name", meter.name);
  archive.Number("sigma_relative", meter.sigma_relative, kSigmaRule);
  archive.Number("calibration_relative", meter.calibration_relative, kErrorFractionRule);
  archive.Number("repeatability_relative", meter.repeatability_relative, kSigmaRule);
  archive.Number("cosine_f2", meter.cosine_f2, kErrorFractionRule);
  archive.Number("spectral_f1", meter.spectral_f1, kErrorFractionRule);
  archive.Number("head_radius_m", meter.head_radius, kPositive);
  archive.Number("window_s", meter.window_s, kPositive);
  archive.Number("step_lx", meter.step, kPositive);
}

// Of fields that are right each by itself. Of a light without its `at`.
[[nodiscard]] std::optional<ReadingFault> DisagreementIn(const LightDescription& light);
[[nodiscard]] std::optional<ReadingFault> DisagreementIn(const StateDescription& one);
[[nodiscard]] std::optional<ReadingFault> DisagreementIn(const MeterDescription& meter);

// Of the name of all[i]: empty, or borne by one before it.
struct NameFault {
  std::string code;  // bad_session, duplicate_name
  std::string message;
};
[[nodiscard]] std::optional<NameFault> FaultOfName(const std::vector<LightDescription>& all,
                                                   std::size_t i);
[[nodiscard]] std::optional<NameFault> FaultOfName(const std::vector<MeterDescription>& all,
                                                   std::size_t i);

}  // namespace lightcal::records
