// SPDX-License-Identifier: Apache-2.0
// gltf-validator 2.0.0-dev.3.10 on every kind of light, bare and with the rig.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "lightcal/presets/exporters.h"
#include "run_cli.h"
#include "sample_lights.h"

namespace lightcal::test {
namespace {

using nlohmann::json;

CliResult Validate(const std::string& gltf) {
  const TempDir folder;
  const std::string path = folder.Write("file.gltf", gltf);
  return RunProgram({"node", LIGHTCAL_VALIDATE, LIGHTCAL_VALIDATOR_MODULES, path});
}

LightFile EveryKind() {
  std::vector<FittedLight> lights = {WarmPoint(), Spot(), Sun()};
  for (const LightKind kind : {LightKind::kSphere, LightKind::kDisk, LightKind::kRect,
                               LightKind::kTube, LightKind::kPhotometric}) {
    lights.push_back(SimpleLight(std::string(LightKindName(kind)), kind, 300.0));
  }
  FittedLight dome = Sun();
  dome.name = "sky";
  dome.kind = LightKind::kDome;
  lights.push_back(dome);
  FittedLight hard = Spot();
  hard.name = "hard edge, wide, \"quoted\" <name> é";
  hard.inner_deg = hard.outer_deg = 90.0;
  lights.push_back(hard);
  FittedLight candle = SimpleLight("candle", LightKind::kPoint, 1.0);
  candle.color.cct_K = Uncertain{1500.0, 20.0, std::nullopt, std::nullopt};  // outside Rec. 709
  lights.push_back(candle);
  return FileOf(lights);
}

class GltfValidator : public ::testing::TestWithParam<bool> {};

TEST_P(GltfValidator, FindsNoErrorAndNoWarningInAnyKindOfLight) {
  const auto preset = ExportGltf(EveryKind(), "every_kind", {.rig = GetParam()});
  ASSERT_TRUE(preset.has_value()) << preset.error().message;
  const CliResult result = Validate(preset->files.front().contents);
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  const json report = json::parse(result.out);
  EXPECT_EQ(report["version"], "2.0.0-dev.3.10");
  EXPECT_EQ(report["numErrors"], 0) << report;
  EXPECT_EQ(report["numWarnings"], 0) << report;
  // It knows no EXT_lights_image_based, and so not that the dome's picture is used.
  EXPECT_EQ(report["numInfos"], 2) << report;
  EXPECT_EQ(report["messages"][0]["code"], "UNSUPPORTED_EXTENSION") << report;
  EXPECT_EQ(report["messages"][1]["pointer"], "/images/0") << report;
}
INSTANTIATE_TEST_SUITE_P(LightsAndRig, GltfValidator, ::testing::Bool(),
                         [](const auto& tested) { return tested.param ? "Rig" : "LightsAlone"; });

TEST(GltfValidatorGate, RejectsAColorAboveOneAndAConeOutOfOrder) {
  const auto preset = ExportGltf(FileOf({Spot()}), "spot", {});
  ASSERT_TRUE(preset.has_value());
  json file = json::parse(preset->files.front().contents);
  json& light = file["extensions"]["KHR_lights_punctual"]["lights"][0];
  light["color"] = {1.9, 0.8, 0.2};
  EXPECT_EQ(Validate(file.dump()).exit_code, 1);
  light["color"] = {1.0, 0.8, 0.2};
  EXPECT_EQ(Validate(file.dump()).exit_code, 0);
  light["spot"]["innerConeAngle"] = 0.9;
  EXPECT_EQ(Validate(file.dump()).exit_code, 1);
}

}  // namespace
}  // namespace lightcal::test
