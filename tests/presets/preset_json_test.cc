// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "lightcal/presets/exporters.h"
#include "run_cli.h"
#include "sample_lights.h"

namespace lightcal::test {
namespace {

using nlohmann::json;

json Exported(const LightFile& file, bool rig = false) {
  const auto preset = ExportJson(file, "stem", {.rig = rig});
  EXPECT_TRUE(preset.has_value());
  EXPECT_EQ(preset->files.front().name, rig ? "stem.rig.preset.json" : "stem.preset.json");
  return json::parse(preset->files.front().contents);
}

// Exit code of python3-jsonschema's validator, 1 = the document breaks the schema.
CliResult ValidateAgainstSchema(const std::string& document) {
  const TempDir folder;
  const std::string path = folder.Write("preset.json", document);
  const std::string program =
      "import json, sys, jsonschema\n"
      "schema = json.load(open(sys.argv[1]))\n"
      "jsonschema.Draft202012Validator.check_schema(schema)\n"
      "errors = "
      "list(jsonschema.Draft202012Validator(schema).iter_errors(json.load(open(sys.argv[2]))))\n"
      "print(*errors, sep='\\n')\n"
      "sys.exit(1 if errors else 0)\n";
  return RunProgram({"/usr/bin/python3", "-c", program,
                     LIGHTCAL_SOURCE_DIR "/lib/lightcal/presets/schemas/preset.schema.json", path});
}

std::vector<FittedLight> ManyKinds() {
  FittedLight sky = Sun();
  sky.kind = LightKind::kDome;
  FittedLight white = SimpleLight("white", LightKind::kTube, 3.0);
  white.color = {};
  return {WarmPoint(), Spot(), Sun(), sky, white, SimpleLight("disk", LightKind::kDisk, 5.0)};
}

TEST(PresetJson, KeepsItsSchemaForEveryKindAloneAndInARig) {
  for (const bool rig : {false, true}) {
    const CliResult result = ValidateAgainstSchema(Exported(FileOf(ManyKinds()), rig).dump());
    EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  }
}

TEST(PresetJson, TheSchemaRejectsUnknownKeysAndMissingNumbers) {
  json document = Exported(FileOf({WarmPoint()}));
  document["lights"][0]["brightness"] = 3;
  EXPECT_EQ(ValidateAgainstSchema(document.dump()).exit_code, 1);
  document["lights"][0].erase("brightness");
  EXPECT_EQ(ValidateAgainstSchema(document.dump()).exit_code, 0);
  document["lights"][0]["derived"]["gltf"].erase("intensity");
  EXPECT_EQ(ValidateAgainstSchema(document.dump()).exit_code, 1);
}

TEST(PresetJson, DerivedHoldsEveryNumberTheGltfFileHas) {
  const LightFile file = FileOf(ManyKinds());
  const json document = Exported(file);
  const auto preset = ExportGltf(file, "stem", {.rig = true});
  ASSERT_TRUE(preset.has_value());
  const json gltf = json::parse(preset->files.front().contents);
  for (std::size_t i = 0; i < file.lights.size(); ++i) {
    const json& derived = document["lights"][i]["derived"]["gltf"];
    json light = gltf["extensions"]["KHR_lights_punctual"]["lights"][i];
    light.erase("name");
    if (light.contains("spot")) {
      light.update(light["spot"]);
      light.erase("spot");
    }
    light["translation"] = gltf["nodes"][i]["translation"];
    light["rotation"] = gltf["nodes"][i]["rotation"];
    for (const auto& [key, value] : light.items()) EXPECT_EQ(derived[key], value) << key;
  }
  for (int card = 0; card < 2; ++card) {
    EXPECT_EQ(document["rig"]["cards"][card]["illuminance_lx"],
              gltf["nodes"][file.lights.size() + card]["extras"]["lightcal"]["illuminance_lx"]);
  }
}

TEST(PresetJson, EveryEngineIsAuditedAndTheSpaceIsSaid) {
  PresetOptions options;
  options.color = {.space = RgbSpace::kAcescg, .white = Xy{0.4, 0.39}};
  options.range = Metres(30.0);
  const auto preset = ExportJson(FileOf(ManyKinds()), "stem", options);
  ASSERT_TRUE(preset.has_value());
  const CliResult result = ValidateAgainstSchema(preset->files.front().contents);
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  const json document = json::parse(preset->files.front().contents);
  for (const json& light : document["lights"]) {
    for (const char* engine : {"gltf", "godot", "usd", "unreal", "unity", "mitsuba", "pbrt"}) {
      EXPECT_TRUE(light["derived"].contains(engine)) << engine;
    }
    EXPECT_EQ(light["color"]["pipeline_linear"]["space"], "acescg");
    if (!light["color"]["known"]) continue;
    EXPECT_NE(light["color"]["pipeline_linear"]["max_normalised"],
              light["color"]["rec709_linear"]["max_normalised"]);
  }
  EXPECT_EQ(document["lights"][0]["derived"]["godot"]["omni_range"], 30.0);
}

// A disc of .53 degrees and 98 klx is 1.458e9 nits (engines.md): at the exposure of its own white
// card, pi/98000 a nit, that is 46 739, below the largest half float of 65 504; of .44 degrees not.
TEST(PresetJson, ASunDiscBeyondHalfFloatsIsWarned) {
  FittedLight sun = Sun();
  for (const auto& [degrees, safe] : {std::pair{0.53, true}, {0.44, false}}) {
    sun.angular_diameter_deg = degrees;
    const auto preset = ExportJson(FileOf({sun}), "stem", {});
    ASSERT_TRUE(preset.has_value());
    const json light = json::parse(preset->files.front().contents)["lights"][0];
    EXPECT_EQ(light["pre_exposed"]["fits_fp16"], safe);
    const bool warned = std::ranges::any_of(
        preset->warnings, [](const Warning& w) { return w.code == "exceeds_fp16"; });
    EXPECT_EQ(warned, !safe);
  }
}

TEST(PresetJson, PhotometryIsTheFitsWithItsIntervals) {
  const json light = Exported(FileOf({WarmPoint()}))["lights"][0];
  EXPECT_EQ(light["photometry"]["intensity_cd"]["value"], 1000.0);
  EXPECT_EQ(light["photometry"]["intensity_cd"]["low95"], 961.0);
  EXPECT_EQ(light["photometry"]["distance_offset_m"]["u95"], 0.02);
  EXPECT_EQ(light["fit"]["rejected"], json::parse("[2]"));
  EXPECT_EQ(light["color"]["cct_K"]["value"], 2700.0);
}

TEST(PresetJson, AlwaysDescribesTheRigForPicturesOfIt) {
  for (const bool rig : {false, true}) {
    const json document = Exported(FileOf({WarmPoint()}), rig);
    EXPECT_TRUE(document.contains("rig"));
    EXPECT_TRUE(document["exposure"].contains("ev100"));
    EXPECT_EQ(document["name"], rig ? "stem.rig" : "stem");
  }
}

// 60 cd of a globe of .4 m, read from its glass: where the gate left it to the offset, that holds
// the radius already. At 2 m from the glass: 60/2.2^2 = 12.4 lx.
TEST(PresetJson, TheRigCountsTheRadiusOfAGlobeOnce) {
  FittedLight globe = SimpleLight("globe", LightKind::kSphere, 60.0);
  globe.color = {};
  globe.diameter_m = 0.4;
  globe.distance_offset_m = Uncertain{0.2, 0.02, {}, {}};
  ResidualRow row;
  row.distance_m = 2.0;
  globe.residuals = {row};
  for (const auto& [state, offset] :
       {std::pair(EffectState::kFitted, 0.2), std::pair(EffectState::kOn, 0.0)}) {
    globe.effects = {{"sphere_surface", state, 0.21, std::nullopt, 0.5, ""}};
    globe.distance_offset_m->value = offset;
    const json rig = Exported(FileOf({globe}), true)["rig"];
    EXPECT_NEAR(rig["separation_m"].get<double>(), 2.2, 1e-12);
    EXPECT_NEAR(rig["cards"][0]["illuminance_lx"].get<double>(), 60.0 / (2.2 * 2.2), 0.1);
  }
}

}  // namespace
}  // namespace lightcal::test
