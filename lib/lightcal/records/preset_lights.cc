// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/preset_lights.h"

#include <optional>
#include <string>
#include <utility>

#include "lightcal/records/light_fields.h"
#include "lightcal/records/provenance_fields.h"

namespace lightcal::records {
namespace {

// A light of a lightcal.preset/1, which holds much besides.
constexpr auto kReadPresetLight = [](FieldReader& reader, FittedLight& light) {
  reader.Text("name", light.name);
  reader.Word("kind", light.kind, kLightKindNames);
  reader.Group("photometry", [&](FieldReader& group) {
    VisitMeasures(group, light);
    group.IgnoreRest();
  });
  reader.Group("color", [&](FieldReader& group) {
    group.Object("cct_K", light.color.cct_K, kVisitKelvin);
    group.Object("duv", light.color.duv, kVisitUncertain);
    group.Chromaticity("xy", light.color.xy);
    group.IgnoreRest();
  });
  reader.Group("geometry", [&](FieldReader& group) {
    group.Array("position_m", light.position_m);
    group.Array("aim", light.aim);
    group.Array("axis", light.axis);
    group.Number("inner_deg", light.inner_deg, kHalfAngleRule);
    group.Number("outer_deg", light.outer_deg, kHalfAngleRule);
    VisitSizes(group, light);
    CheckDirections(group, light);
    CheckCone(group, light);
    group.IgnoreRest();
  });
  reader.Require({"name", "kind", "photometry", "color", "geometry"});
  reader.IgnoreRest();
};

}  // namespace

Result<LightFile> LightsOfPreset(const Node& root, std::string_view where) {
  ReadingOfFile reading{std::string(where), "bad_preset", PlaceStyle::kJson, std::nullopt};
  FieldReader reader(root, "", reading);
  LightFile file;
  reader.List("lights", file.lights, kReadPresetLight);
  VisitProvenance(reader, file.provenance);
  reader.Require({"lights"});
  reader.IgnoreRest();
  reader.Finish();
  if (!reading.error) return file;
  reading.error->message = "is not as lightcal writes it: " + reading.error->message +
                           "; export it again with {preset.target} json";
  return tl::unexpected(*std::move(reading.error));
}

}  // namespace lightcal::records
