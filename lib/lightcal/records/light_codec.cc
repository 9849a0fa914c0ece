// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/light_codec.h"

#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "lightcal/records/distribution_codec.h"
#include "lightcal/records/field_reader.h"
#include "lightcal/records/field_writer.h"
#include "lightcal/records/json_codec.h"
#include "lightcal/records/light_fields.h"
#include "lightcal/records/preset_lights.h"
#include "lightcal/records/provenance_fields.h"
#include "lightcal/records/spectral_fields.h"
#include "lightcal/records/uncertain_fields.h"

namespace lightcal {
namespace records {
namespace {

constexpr std::array<std::string_view, 3> kEffectStateWords = {"off", "on", "fitted"};

// Duv is a number with its interval beside it: "duv", "duv_u95".
void VisitDuv(FieldReader& reader, std::optional<Uncertain>& duv) {
  if (reader.Has("duv")) duv.emplace();
  Uncertain read;
  reader.Number("duv", read.value);
  reader.Number("duv_u95", read.u95, kNotNegative);
  reader.Number("duv_low95", read.low);
  reader.Number("duv_high95", read.high);
  if (duv) {
    duv = read;
    reader.Require({"duv_u95"});
    CheckInterval(reader, "duv", read);
  } else if (reader.Has("duv_u95")) {
    reader.Require({"duv"});
  }
}
void VisitDuv(FieldWriter& writer, const std::optional<Uncertain>& duv) {
  if (!duv) return;
  writer.Number("duv", duv->value);
  writer.Number("duv_u95", duv->u95);
  writer.Number("duv_low95", duv->low);
  writer.Number("duv_high95", duv->high);
}

constexpr auto kVisitFamily = [](auto& archive, auto& family) {
  archive.Text("name", family.name);
  archive.Number("share", family.share, kNotNegative);
  archive.Number("leave_one_out", family.leave_one_out, kNotNegative);
  archive.Require({"name", "share"});
};

constexpr auto kVisitBeam = [](auto& archive, auto& beam) {
  archive.Object("axial_cd", beam.axial, kVisitAmount);
  archive.Object("beam_deg", beam.beam_deg, kVisitAmount);
  archive.Object("field_deg", beam.field_deg, kVisitAmount);
  archive.List("families", beam.families, kVisitFamily);
  archive.Number("falling_share", beam.falling_share, kNotNegative);
};

constexpr auto kVisitColorMeter = [](auto& archive, auto& meter) {
  archive.Text("name", meter.name);
  archive.Number("sigma_xy", meter.sigma_xy, kNotNegative);
  archive.Require({"name", "sigma_xy"});
};

template <class Archive, class SomeColor>
void VisitColor(Archive& archive, SomeColor& color) {
  archive.Object("cct_K", color.cct_K, kVisitKelvin);
  VisitDuv(archive, color.duv);
  archive.Chromaticity("xy", color.xy);
  archive.Object("meter", color.meter, kVisitColorMeter);
}

template <class Archive, class SomeFit>
void VisitFit(Archive& archive, SomeFit& fit) {
  archive.Count("readings", fit.readings);
  archive.Count("used", fit.used);
  archive.Counts("rejected", fit.rejected);
  archive.Number("rms_relative", fit.rms_relative, kNotNegative);
  archive.Number("chi2_dof", fit.chi2_dof, kNotNegative);
  archive.Count("degrees_of_freedom", fit.degrees_of_freedom);
  archive.Number("leave_one_out", fit.leave_one_out, kNotNegative);
  archive.Number("condition", fit.condition, kNotNegative);
  archive.Texts("learned", fit.learned);
  archive.Texts("prior", fit.prior);
  archive.Require({"readings", "used", "rejected", "learned", "prior"});
}

constexpr auto kVisitEnvironment = [](auto& archive, auto& environment) {
  archive.Text("file", environment.file);
  archive.Text("projection", environment.projection);
  archive.Number("nits_per_unit", environment.nits_per_unit, kNotNegative);
  archive.Require({"file", "projection", "nits_per_unit"});
};

constexpr auto kVisitEffect = [](auto& archive, auto& effect) {
  archive.Text("name", effect.name);
  archive.Word("state", effect.state, kEffectStateWords);
  archive.Number("bound", effect.bound, kNotNegative);
  archive.Number("contribution", effect.contribution);
  archive.Number("cost_ns", effect.cost_ns, kNotNegative);
  archive.Text("reason", effect.reason);
  archive.Text("key", effect.key);
  archive.Require({"name", "state", "bound", "cost_ns"});
  CheckNamed(archive, effect.name);
};

constexpr auto kVisitBudgetPart = [](auto& archive, auto& part) {
  archive.Text("name", part.name);
  archive.Number("sd_relative", part.sd_relative, kNotNegative);
  archive.Number("share", part.share, kNotNegative);
  archive.Text("halve", part.halve);
  archive.Require({"name", "sd_relative", "share"});
  CheckNamed(archive, part.name);
};

constexpr auto kVisitResidual = [](auto& archive, auto& row) {
  archive.Count("index", row.index);
  archive.Number("distance_m", row.distance_m);
  archive.Number("measured_lx", row.measured_lx);
  archive.Number("predicted_lx", row.predicted_lx);
  archive.Number("relative", row.relative);
  archive.Number("sigma_relative", row.sigma_relative, kNotNegative);
  archive.Truth("used", row.used);
  archive.Number("walls_lx", row.walls_lx, kNotNegative);
  archive.Number("facing_lx", row.facing_lx, kNotNegative);
  archive.Require({"index", "measured_lx", "predicted_lx", "relative", "sigma_relative", "used"});
};

constexpr auto kVisitInRoom = [](auto& archive, auto& one) {
  archive.Number("weight", one.weight, kNotNegative);
  archive.Number("ln_intensity_cd", one.ln_intensity);
  archive.Number("distance_offset_m", one.distance_offset_m);
  archive.Number("ambient_lx", one.ambient_lx, kNotNegative);
  archive.Number("ln_b", one.ln_b);
  archive.Number("slope", one.slope);
  archive.Number("bend", one.bend);
  archive.Number("scatter", one.scatter, kNotNegative);
  archive.Number("width_m", one.width_m, kNotNegative);
  archive.Number("height_m", one.height_m, kNotNegative);
  archive.Array("covariance", one.covariance);
  archive.Require({"weight", "ln_intensity_cd", "distance_offset_m", "ambient_lx", "slope", "bend",
                   "scatter", "covariance"});
};

constexpr auto kVisitLocatedWalls = [](auto& archive, auto& walls) {
  archive.Number("ln_b", walls.ln_b);
  archive.Number("slope", walls.slope);
  archive.Number("bend", walls.bend);
  archive.Number("scatter", walls.scatter, kNotNegative);
  archive.Require({"ln_b", "slope", "bend", "scatter"});
};

constexpr auto kVisitLocated = [](auto& archive, auto& one) {
  archive.Number("ln_intensity_cd", one.ln_intensity);
  archive.Array("position_m", one.position_m);
  archive.Number("ambient_lx", one.ambient_lx, kNotNegative);
  archive.Object("walls", one.walls, kVisitLocatedWalls);
  archive.Array("gradient", one.gradient);
  archive.Array("middle", one.middle);
  archive.Array("covariance", one.covariance);
  archive.Require({"ln_intensity_cd", "position_m", "ambient_lx", "covariance"});
};

constexpr auto kVisitUneven = [](auto& archive, auto& one) {
  archive.Array("gradient_sd", one.gradient_sd, kNotNegative);
  archive.Array("middle", one.middle);
  archive.Require({"gradient_sd", "middle"});
};

constexpr auto kVisitMeter = [](auto& archive, auto& meter) {
  archive.Text("name", meter.name);
  archive.Number("calibration_relative", meter.calibration_relative, kNotNegative);
  archive.Require({"calibration_relative"});
};

constexpr auto kVisitState = [](auto& archive, auto& one) {
  archive.Controls("state", one.state);
  archive.Object("intensity_cd", one.intensity_cd, kVisitAmount);
  archive.Object("illuminance_lx", one.illuminance_lx, kVisitAmount);
  archive.Group("relative", [&](auto& relative) { kVisitAmount(relative, one.relative); });
  archive.Number("repeatability", one.repeatability, kNotNegative);
  archive.Number("predicted_reference", one.predicted_reference, kNotNegative);
  archive.Group("color", [&](auto& color) { VisitColor(color, one.color); });
  archive.Count("readings", one.readings);
  VisitSpectrumOf(archive, one.spectrum);
  VisitAmounts(archive, one.emitter_amounts);
  archive.Require({"state", "relative", "repeatability"});
};

// Absent of a lamp without controls.
void VisitStates(FieldReader& reader, std::vector<MeasuredState>& states) {
  reader.List("states", states, kVisitState);
}
void VisitStates(FieldWriter& writer, const std::vector<MeasuredState>& states) {
  if (!states.empty()) writer.List("states", states, kVisitState);
}

// Absent where one normal says all.
void VisitRoom(FieldReader& reader, std::vector<LampInRoom>& in_room) {
  reader.List("in_room", in_room, kVisitInRoom);
}
void VisitRoom(FieldWriter& writer, const std::vector<LampInRoom>& in_room) {
  if (!in_room.empty()) writer.List("in_room", in_room, kVisitInRoom);
}

constexpr auto kVisitStateGeometry = [](auto& archive, auto& one) {
  archive.Controls("state", one.state);
  archive.Word("kind", one.kind, kLightKindNames);
  archive.Object("distance_offset_m", one.distance_offset_m, kVisitUncertain);
  archive.Object("flux_lm", one.flux_lm, kVisitAmount);
  archive.Object("luminance_nits", one.luminance_nits, kVisitAmount);
  VisitCone(archive, one);
  VisitSizes(archive, one);
  VisitDistribution(archive, one.distribution);
  archive.Object("beam", one.beam, kVisitBeam);
  archive.Require({"state", "kind"});
};

// Absent where the light's own holds of every state, or is all that is known.
void VisitGeometries(FieldReader& reader, std::vector<StateGeometry>& geometries) {
  reader.List("geometries", geometries, kVisitStateGeometry);
}
void VisitGeometries(FieldWriter& writer, const std::vector<StateGeometry>& geometries) {
  if (!geometries.empty()) writer.List("geometries", geometries, kVisitStateGeometry);
}

template <class Archive, class SomeLight>
void VisitCauses(Archive& archive, SomeLight& light) {
  archive.List("effects", light.effects, kVisitEffect);
  archive.List("budget", light.budget, kVisitBudgetPart);
}

constexpr auto kVisitLight = [](auto& archive, auto& light) {
  archive.Text("name", light.name);
  archive.Word("kind", light.kind, kLightKindNames);
  VisitMeasures(archive, light);
  VisitGeometry(archive, light);
  VisitDistribution(archive, light.distribution);
  archive.Object("environment", light.environment, kVisitEnvironment);
  archive.Object("beam", light.beam, kVisitBeam);
  archive.Group("color", [&](auto& color) { VisitColor(color, light.color); });
  archive.Group("fit", [&](auto& fit) { VisitFit(fit, light.fit); });
  VisitCauses(archive, light);
  archive.List("residuals", light.residuals, kVisitResidual);
  archive.Array("covariance_lnI_d0_E0", light.covariance_lnI_d0_E0);
  archive.Object("meter", light.meter, kVisitMeter);
  archive.Object("of_file", light.of_file, kVisitAmount);
  VisitRoom(archive, light.in_room);
  archive.Object("located", light.located, kVisitLocated);
  archive.Object("uneven", light.uneven, kVisitUneven);
  archive.Controls("state", light.state);
  VisitStates(archive, light.states);
  VisitGeometries(archive, light.geometries);
  VisitSpectrumOf(archive, light.spectrum);
  VisitEmittersOf(archive, light);
  archive.Require({"name", "kind"});
  CheckNamed(archive, light.name);
};

template <class Archive, class SomeFile>
void VisitFile(Archive& archive, SomeFile& file) {
  archive.List("lights", file.lights, kVisitLight);
  VisitProvenance(archive, file.provenance);
  archive.Require({"lights"});
}

}  // namespace
}  // namespace records

records::Node DocumentOf(const LightFile& file) {
  records::FieldWriter writer;
  writer.Put("schema", kLightSchema);
  records::VisitFile(writer, file);
  return writer.TakeTable();
}

records::Node ExplanationOf(const FittedLight& light) {
  records::FieldWriter writer;
  writer.Text("name", light.name);
  records::VisitCauses(writer, light);
  return writer.TakeTable();
}

records::Node DocumentOf(const Uncertain& value) {
  return records::FieldWriter::Visited(value, records::kVisitUncertain);
}

Result<std::string> LightFileToJson(const LightFile& file) {
  return records::FiniteJson(DocumentOf(file));
}

// What an answer adds to the same document, of which nothing is read back.
constexpr std::array<std::string_view, 8> kBesideLights = {
    "warnings", "next_step", "next_steps", "files", "type_in", "through", "predictions", "minutes"};

static Result<LightFile> LightsOfDocument(std::string_view text, std::string_view where,
                                          std::string_view preset_schema) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  const auto node = records::ParseJson(text);
  if (!node) return Refused("bad_light", std::string(where), node.error().message);
  if (node->kind != records::Node::Kind::kTable) {
    return Refused("bad_light", std::string(where), "a light.json must be one JSON object");
  }
  if (!preset_schema.empty() && node->TextAt("schema") == preset_schema) {
    return records::LightsOfPreset(*node, where);
  }
  if (node->TextAt("schema").starts_with("lightcal.preset/")) {
    return Refused("bad_light", std::string(where),
                   "is a preset, made of a light.json for engines; give that light.json");
  }
  records::ReadingOfFile reading{std::string(where), "bad_light", records::PlaceStyle::kJson,
                                 std::nullopt};
  records::FieldReader reader(*node, "", reading);
  LightFile file;
  reader.RequireSchema(kLightSchema, "light.json",
                       "fit the session again with this program, or update it");
  records::VisitFile(reader, file);
  for (const std::string_view key : kBesideLights) reader.Ignore(key);
  reader.Finish();
  if (reading.error) return tl::unexpected(*std::move(reading.error));
  return file;
}

Result<LightFile> LightFileFromJson(std::string_view text, std::string_view where) {
  return LightsOfDocument(text, where, "");
}

Result<LightFile> LightFileOrPresetFromJson(std::string_view text, std::string_view where) {
  return LightsOfDocument(text, where, "lightcal.preset/1");
}

}  // namespace lightcal
