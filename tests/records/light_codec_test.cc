// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/light_codec.h"

#include <gmock/gmock.h>

#include <limits>
#include <string>

#include "sample_lights.h"

namespace lightcal {
namespace {

using test::FullLightFile;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

std::string JsonOf(const LightFile& file) {
  auto text = LightFileToJson(file);
  if (!text) ADD_FAILURE() << text.error().subject << " " << text.error().message;
  return text.value_or("");
}

LightFile Back(const std::string& text) {
  auto file = LightFileFromJson(text, "light.json");
  if (!file) ADD_FAILURE() << file.error().message;
  return file.value_or(LightFile{});
}

void ExpectSame(const std::optional<Uncertain>& a, const std::optional<Uncertain>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (!a) return;
  EXPECT_EQ(a->value, b->value);
  EXPECT_EQ(a->u95, b->u95);
  EXPECT_EQ(a->low, b->low);
  EXPECT_EQ(a->high, b->high);
}

TEST(LightJson, QuantitiesComeBackBitForBit) {
  const FittedLight light = FullLightFile().lights[0];
  const FittedLight back = Back(JsonOf(FullLightFile())).lights.at(0);
  EXPECT_EQ(back.name, light.name);
  EXPECT_EQ(back.kind, light.kind);
  ExpectSame(back.intensity_cd, light.intensity_cd);
  ExpectSame(back.flux_lm, light.flux_lm);
  ExpectSame(back.illuminance_lx, light.illuminance_lx);
  ExpectSame(back.luminance_nits, light.luminance_nits);
  ExpectSame(back.distance_offset_m, light.distance_offset_m);
  ExpectSame(back.ambient_lx, light.ambient_lx);
  ExpectSame(back.color.cct_K, light.color.cct_K);
  ExpectSame(back.color.duv, light.color.duv);
  EXPECT_EQ(back.color.xy.value().x, light.color.xy->x);
  EXPECT_EQ(back.color.xy.value().y, light.color.xy->y);
}

TEST(LightJson, GeometryComesBackBitForBit) {
  const FittedLight light = FullLightFile().lights[0];
  const FittedLight back = Back(JsonOf(FullLightFile())).lights.at(0);
  EXPECT_EQ(back.inner_deg, light.inner_deg);
  EXPECT_EQ(back.outer_deg, light.outer_deg);
  EXPECT_EQ(back.inner_u95_deg, light.inner_u95_deg);
  EXPECT_EQ(back.outer_u95_deg, light.outer_u95_deg);
  EXPECT_EQ(back.aim_u95_deg, light.aim_u95_deg);
  EXPECT_EQ(back.diameter_m, light.diameter_m);
  EXPECT_EQ(back.width_m, light.width_m);
  EXPECT_EQ(back.height_m, light.height_m);
  EXPECT_EQ(back.length_m, light.length_m);
  EXPECT_EQ(back.radius_m, light.radius_m);
  EXPECT_EQ(back.angular_diameter_deg, light.angular_diameter_deg);
  EXPECT_EQ(back.position_m, light.position_m);
  EXPECT_EQ(back.position_u95_m, light.position_u95_m);
  EXPECT_EQ(back.aim, light.aim);
  EXPECT_EQ(back.covariance_lnI_d0_E0, light.covariance_lnI_d0_E0);
}

TEST(LightJson, ALocatedLampComesBackBitForBit) {
  LightFile file = FullLightFile();
  LocatedLamp& located = *file.lights[0].located;
  for (std::size_t i = 0; i < located.covariance.size(); ++i) {
    located.covariance[i] = 1.0 / (3.0 + static_cast<double>(i));
  }
  const LocatedLamp back = Back(JsonOf(file)).lights.at(0).located.value();
  EXPECT_EQ(back.ln_intensity, located.ln_intensity);
  EXPECT_EQ(back.position_m, located.position_m);
  EXPECT_EQ(back.ambient_lx, located.ambient_lx);
  EXPECT_EQ(back.walls.value().ln_b, -2.1);
  EXPECT_EQ(back.walls->slope, -1.0);
  EXPECT_EQ(back.walls->bend, -0.27);
  EXPECT_EQ(back.walls->scatter, 0.07);
  EXPECT_EQ(back.gradient, located.gradient);
  EXPECT_EQ(back.middle, located.middle);
  EXPECT_EQ(back.covariance, located.covariance);
  const UnevenLight uneven = Back(JsonOf(file)).lights.at(0).uneven.value();
  EXPECT_EQ(uneven.gradient_sd, file.lights[0].uneven->gradient_sd);
  EXPECT_EQ(uneven.middle, file.lights[0].uneven->middle);
  located.walls.reset();
  EXPECT_FALSE(Back(JsonOf(file)).lights.at(0).located.value().walls.has_value());
}

TEST(LightJson, WhatLampAndRoomMayBeComesBackBitForBit) {
  LightFile file = FullLightFile();
  FittedLight& light = file.lights[0];
  LampInRoom one{0.7, 3.87, -0.01, 0.1, -2.1, -1.0, -0.27, 0.07, 0.12, 0.09, {}};
  for (std::size_t i = 0; i < one.covariance.size(); ++i) {
    one.covariance[i] = 1.0 / (3.0 + static_cast<double>(i));
  }
  light.in_room = {one, {0.3, 3.5, 0.0, 0.0, -5.7, 0.6, 0.0, 0.25, 0.0, 0.0, {}}};
  light.meter = MeterShare{"c800", 0.031};
  light.color.meter = ColorMeter{"c7000", 0.0015};
  light.of_file = Uncertain{0.78, 0.04, {}, {}};
  light.residuals.at(0).walls_lx = 8.25;
  light.residuals.at(0).facing_lx = 230.5;
  const FittedLight back = Back(JsonOf(file)).lights.at(0);
  ASSERT_EQ(back.in_room.size(), 2U);
  EXPECT_EQ(back.in_room[0].weight, one.weight);
  EXPECT_EQ(back.in_room[0].ln_intensity, one.ln_intensity);
  EXPECT_EQ(back.in_room[0].distance_offset_m, one.distance_offset_m);
  EXPECT_EQ(back.in_room[0].bend, one.bend);
  EXPECT_EQ(back.in_room[0].scatter, one.scatter);
  EXPECT_EQ(back.in_room[0].height_m, one.height_m);
  EXPECT_EQ(back.in_room[0].covariance, one.covariance);
  EXPECT_EQ(back.in_room[1].ln_b, -5.7);
  EXPECT_EQ(back.meter->name, "c800");
  EXPECT_EQ(back.meter->calibration_relative, 0.031);
  EXPECT_EQ(back.color.meter, light.color.meter);
  EXPECT_EQ(back.of_file->value, 0.78);
  EXPECT_EQ(back.residuals.at(0).walls_lx, 8.25);
  EXPECT_EQ(back.residuals.at(0).facing_lx, 230.5);
  for (LampInRoom& part : light.in_room) part.ln_b.reset();
  EXPECT_FALSE(Back(JsonOf(file)).lights.at(0).in_room.at(1).ln_b.has_value());
}

TEST(LightJson, DiagnosticsComeBack) {
  const FitDiagnostics back = Back(JsonOf(FullLightFile())).lights.at(0).fit;
  EXPECT_EQ(back.readings, 7);
  EXPECT_EQ(back.used, 5);
  EXPECT_THAT(back.rejected, ElementsAre(1, 6));
  EXPECT_EQ(back.rms_relative, 0.012);
  EXPECT_EQ(back.chi2_dof, 0.9);
  EXPECT_EQ(back.degrees_of_freedom, 2);
  EXPECT_EQ(back.leave_one_out, 0.02);
  EXPECT_EQ(back.condition, 314.5);
  EXPECT_THAT(back.learned, ElementsAre("intensity"));
  EXPECT_THAT(back.prior, ElementsAre("ambient", "offset"));
}

TEST(LightJson, EffectsResidualsAndProvenanceComeBack) {
  const LightFile back = Back(JsonOf(FullLightFile()));
  const FittedLight& light = back.lights.at(0);
  ASSERT_EQ(light.effects.size(), 3U);
  EXPECT_EQ(light.effects[0].contribution, 0.011);
  EXPECT_EQ(light.effects[1].state, EffectState::kOff);
  EXPECT_FALSE(light.effects[1].contribution);
  EXPECT_EQ(light.effects[2].state, EffectState::kFitted);
  EXPECT_EQ(light.effects[2].reason, "near readings");
  ASSERT_EQ(light.budget.size(), 1U);
  EXPECT_EQ(light.budget[0].name, "readings");
  EXPECT_EQ(light.budget[0].sd_relative, 1.0 / 30.0);
  EXPECT_EQ(light.budget[0].share, 0.9);
  EXPECT_EQ(light.budget[0].halve, "four times as many readings");
  ASSERT_EQ(light.residuals.size(), 2U);
  EXPECT_EQ(light.residuals[0].distance_m, 0.5);
  EXPECT_TRUE(light.residuals[0].used);
  EXPECT_FALSE(light.residuals[1].used);
  EXPECT_FALSE(light.residuals[1].distance_m);
  EXPECT_EQ(back.provenance.generator, "lightcal 0.1.0");
  EXPECT_EQ(back.provenance.inputs.at(0).path, "session.toml");
  EXPECT_EQ(back.provenance.time, "2026-01-02T03:04:05Z");
}

TEST(LightJson, WritingWhatWasReadGivesTheSameBytes) {
  const std::string text = JsonOf(FullLightFile());
  EXPECT_EQ(JsonOf(Back(text)), text);
}

TEST(LightJson, KeysThatDoNotApplyAreAbsent) {
  const std::string text = JsonOf({{FullLightFile().lights[1]}, {}});
  for (const char* key : {"intensity_cd", "color", "cone", "aim", "covariance", "rms_relative"}) {
    EXPECT_THAT(text, Not(HasSubstr(std::string("\"") + key)));
  }
  EXPECT_THAT(text, Not(HasSubstr("null")));
  EXPECT_FALSE(Back(text).lights.at(0).intensity_cd);
}

TEST(LightJson, ConeAndColourAreTablesAndDuvIsANumberBesideItsInterval) {
  const std::string text = JsonOf(FullLightFile());
  EXPECT_THAT(text, HasSubstr("\"cone\": {\n        \"inner_deg\": 20.1,"));
  EXPECT_THAT(text, HasSubstr("\"duv\": -0.0012,\n        \"duv_u95\": 0.0004,"));
  EXPECT_THAT(text, testing::EndsWith("}\n"));
}

TEST(LightJson, NumberThatIsNotFiniteIsNeverWritten) {
  LightFile file = FullLightFile();
  file.lights[0].fit.condition = std::numeric_limits<double>::infinity();
  const auto text = LightFileToJson(file);
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().code, "not_finite");
  EXPECT_EQ(text.error().subject, "lights[0].fit.condition");
  file = FullLightFile();
  file.lights[0].aim = Vec3{0.0, std::numeric_limits<double>::quiet_NaN(), 0.0};
  EXPECT_EQ(LightFileToJson(file).error().subject, "lights[0].aim[1]");
}

TEST(LightJson, WarningsOfTheFitCommandAreAccepted) {
  std::string text = JsonOf(FullLightFile());
  text.replace(0, 1, R"({"warnings": [{"code":"a","subject":"b","message":"c"}],)");
  EXPECT_EQ(Back(text).lights.size(), 2U);
}

struct BadLight {
  const char* name;
  const char* text;
  const char* code;
  const char* says;
};

void PrintTo(const BadLight& bad, std::ostream* out) { *out << bad.name; }

constexpr BadLight kBadLights[] = {
    {"Empty", "", "bad_light", "not JSON"},
    {"Array", "[]", "bad_light", "one JSON object"},
    {"NoSchema", R"({"lights":[]})", "bad_light", "schema is missing"},
    {"NewerSchema", R"({"schema":"lightcal.light/2","lights":[]})", "bad_light",
     "reads lightcal.light/1"},
    {"NoLights", R"({"schema":"lightcal.light/1"})", "bad_light", "lights is missing"},
    {"LightsAsTable", R"({"schema":"lightcal.light/1","lights":{}})", "bad_light", "an array"},
    {"UnknownKey", R"({"schema":"lightcal.light/1","lights":[],"provenence":{}})", "unknown_key",
     "\"provenance\""},
    {"UnknownKeyInLight",
     R"({"schema":"lightcal.light/1","lights":[{"name":"a","kind":"point","flux":1}]})",
     "unknown_key", "lights[0]: unknown key \"flux\""},
    {"UnknownKind", R"({"schema":"lightcal.light/1","lights":[{"name":"a","kind":"pont"}]})",
     "bad_light", "\"point\""},
    {"UncertainWithoutValue",
     R"({"schema":"lightcal.light/1","lights":[{"name":"a","kind":"point","flux_lm":{"u95":1}}]})",
     "bad_light", "lights[0].flux_lm: value is missing"},
    {"TextForNumber",
     R"({"schema":"lightcal.light/1","lights":[{"name":"a","kind":"point","diameter_m":"6cm"}]})",
     "bad_light", "diameter_m must be a number"},
    {"AimOfNoLength",
     R"({"schema":"lightcal.light/1","lights":[{"name":"a","kind":"spot","aim":[0,0,0]}]})",
     "bad_light", "lights[0]: aim = [0, 0, 0] is no direction"},
    {"InnerBeyondOuter",
     R"({"schema":"lightcal.light/1","lights":[{"name":"a","kind":"spot",
         "cone":{"inner_deg":30,"outer_deg":20}}]})",
     "bad_light", "inner_deg exceeds outer_deg"},
    {"NoName", R"({"schema":"lightcal.light/1","lights":[{"name":"","kind":"point"}]})",
     "bad_light", "lights[0]: name must not be empty"},
    {"DarkerThanDark",
     R"({"schema":"lightcal.light/1","lights":[{"name":"a","kind":"point",
         "intensity_cd":{"value":-3,"u95":1}}]})",
     "bad_light", "lights[0].intensity_cd: value = -3: must not be negative"},
    {"ColderThanCold",
     R"({"schema":"lightcal.light/1","lights":[{"name":"a","kind":"point",
         "color":{"cct_K":{"value":-1,"u95":1}}}]})",
     "bad_light", "lights[0].color.cct_K: value = -1: must be above 0"},
    {"IntervalTurnedRound",
     R"({"schema":"lightcal.light/1","lights":[{"name":"a","kind":"point",
         "intensity_cd":{"value":40,"u95":20,"low95":60,"high95":20}}]})",
     "bad_light", "low95 lies above value"},
    {"DuvOutsideItsInterval",
     R"({"schema":"lightcal.light/1","lights":[{"name":"a","kind":"point",
         "color":{"duv":0.001,"duv_u95":0.01,"duv_low95":-0.01,"duv_high95":-0.001}}]})",
     "bad_light", "duv_high95 lies below duv"},
    {"DuvOfNothing",
     R"({"schema":"lightcal.light/1","lights":[{"name":"a","kind":"point",
         "color":{"duv_u95":0.01}}]})",
     "bad_light", "duv is missing"},
    {"FewerReadingsThanNone",
     R"({"schema":"lightcal.light/1","lights":[{"name":"a","kind":"point",
         "fit":{"readings":-1,"used":1,"rejected":[],"learned":[],"prior":[]}}]})",
     "bad_light", "readings = -1: must not be negative"},
    {"NoHash",
     R"({"schema":"lightcal.light/1","lights":[],
         "provenance":{"inputs":[{"path":"a","sha256":"zzz"}]}})",
     "bad_light", "sha256 = \"zzz\" is no SHA-256"},
};

class LightJsonRefusals : public testing::TestWithParam<BadLight> {};

TEST_P(LightJsonRefusals, NameCodeAndPlace) {
  const auto file = LightFileFromJson(GetParam().text, "light.json");
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().kind, ErrorKind::kRefused);
  EXPECT_EQ(file.error().code, GetParam().code);
  EXPECT_EQ(file.error().subject, "light.json");
  EXPECT_THAT(file.error().message, HasSubstr(GetParam().says));
}

INSTANTIATE_TEST_SUITE_P(Json, LightJsonRefusals, testing::ValuesIn(kBadLights),
                         [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace lightcal
