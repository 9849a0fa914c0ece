// SPDX-License-Identifier: Apache-2.0
// How a light's amounts, sizes, cone and directions stand in a light file and in a preset.
// Internal to this room.
#pragma once

#include <string>
#include <utility>

#include "lightcal/records/field_reader.h"
#include "lightcal/records/field_writer.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/uncertain_fields.h"

namespace lightcal::records {

template <class Archive, class SomeLight>
void VisitMeasures(Archive& archive, SomeLight& light) {
  archive.Object("intensity_cd", light.intensity_cd, kVisitAmount);
  archive.Object("flux_lm", light.flux_lm, kVisitAmount);
  archive.Object("illuminance_lx", light.illuminance_lx, kVisitAmount);
  archive.Object("luminance_nits", light.luminance_nits, kVisitAmount);
  archive.Object("distance_offset_m", light.distance_offset_m, kVisitUncertain);
  archive.Object("ambient_lx", light.ambient_lx, kVisitUncertain);
}

template <class Archive, class SomeLight>
void VisitSizes(Archive& archive, SomeLight& light) {
  archive.Number("diameter_m", light.diameter_m, kNotNegative);
  archive.Number("width_m", light.width_m, kNotNegative);
  archive.Number("height_m", light.height_m, kNotNegative);
  archive.Number("length_m", light.length_m, kNotNegative);
  archive.Number("radius_m", light.radius_m, kNotNegative);
}

template <class SomeLight>
void CheckCone(FieldReader& reader, const SomeLight& light) {
  constexpr double kRounding_deg = 1e-9;
  if (!light.inner_deg || !light.outer_deg) return;
  if (*light.inner_deg <= *light.outer_deg + kRounding_deg) return;
  reader.Fail("inner_deg", "inner_deg exceeds outer_deg; both are half angles: swap them");
}
template <class SomeLight>
void CheckCone(FieldWriter& /*writer*/, const SomeLight& /*light*/) {}

template <class Archive, class SomeLight>
void VisitCone(Archive& archive, SomeLight& light) {
  archive.Group("cone", [&](auto& cone) {
    cone.Number("inner_deg", light.inner_deg, kHalfAngleRule);
    cone.Number("outer_deg", light.outer_deg, kHalfAngleRule);
    cone.Number("inner_u95_deg", light.inner_u95_deg, kNotNegative);
    cone.Number("outer_u95_deg", light.outer_u95_deg, kNotNegative);
    CheckCone(cone, light);
  });
}

// A number at a time is no rule for these.
inline void CheckDirections(FieldReader& reader, const FittedLight& light) {
  for (const auto& [key, way] : {std::pair("aim", light.aim), std::pair("axis", light.axis)}) {
    if (!way || Length(*way) > 0.0) continue;
    reader.Fail(key, std::string(key) + " = [0, 0, 0] is no direction");
  }
}
inline void CheckDirections(FieldWriter& /*writer*/, const FittedLight& /*light*/) {}

template <class Archive, class SomeLight>
void VisitGeometry(Archive& archive, SomeLight& light) {
  VisitCone(archive, light);
  VisitSizes(archive, light);
  archive.Number("angular_diameter_deg", light.angular_diameter_deg, kNotNegative);
  archive.Array("position_m", light.position_m);
  archive.Array("position_u95_m", light.position_u95_m, kNotNegative);
  archive.Array("aim", light.aim);
  archive.Array("axis", light.axis);
  archive.Number("aim_u95_deg", light.aim_u95_deg, kNotNegative);
  CheckDirections(archive, light);
}

}  // namespace lightcal::records
