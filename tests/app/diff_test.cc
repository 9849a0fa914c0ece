// SPDX-License-Identifier: Apache-2.0
// lightcal diff, driven as a shell would.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "lightcal/records/light_codec.h"
#include "run_cli.h"
#include "run_cli_json.h"
#include "sample_lights.h"

namespace lightcal::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

std::string Write(const TempDir& folder, const std::string& name,
                  const std::vector<FittedLight>& lights) {
  return folder.Write(name, LightFileToJson(FileOf(lights)).value());
}

json QuantityOf(const json& light, const std::string& name) {
  for (const json& quantity : light["quantities"]) {
    if (quantity["quantity"] == name) return quantity;
  }
  ADD_FAILURE() << name << " is not compared";
  return {};
}

TEST(DiffCommand, CallsAChangeOfEachQuantityByItsUncertainty) {
  const TempDir folder;
  FittedLight later = WarmPoint();
  later.intensity_cd = Uncertain{1100.0, 45.0, std::nullopt, std::nullopt};
  later.color.cct_K = Uncertain{2730.0, 40.0, std::nullopt, std::nullopt};
  later.position_m = Vec3{1.0, 2.0, 3.1};
  const std::string a = Write(folder, "a.json", {WarmPoint()});
  const std::string b = Write(folder, "b.json", {later});
  const json document = LightcalJson("diff", {a, b});
  EXPECT_TRUE(document["changed"]);
  const json& light = document["lights"][0];
  const json intensity = QuantityOf(light, "intensity_cd");
  EXPECT_NEAR(double(intensity["difference"]), 100.0, 1e-9);
  // The old one's upper side, 41 cd, and the new one's 45 cd.
  EXPECT_NEAR(double(intensity["u95"]), std::sqrt(41.0 * 41.0 + 45.0 * 45.0), 1e-9);
  EXPECT_NEAR(double(intensity["relative"]), 0.1, 1e-12);
  EXPECT_EQ(intensity["verdict"], "changed");
  const json cct = QuantityOf(light, "color.cct_K");
  EXPECT_NEAR(double(cct["u95"]), std::sqrt(35.0 * 35.0 + 40.0 * 40.0), 1e-9);
  EXPECT_EQ(cct["verdict"], "within_u");
  EXPECT_EQ(QuantityOf(light, "flux_lm")["verdict"], "same");
  const json position = QuantityOf(light, "position_m");
  EXPECT_NEAR(double(position["difference"]), 0.1, 1e-12);
  EXPECT_EQ(position["verdict"], "changed_without_u") << "nobody measured the position";
}

TEST(DiffCommand, APositionIsJudgedByItsThreeCoordinatesTogether) {
  const TempDir folder;
  const auto verdict = [&](double away_m) {
    FittedLight before = SimpleLight("key", LightKind::kPoint, 100.0);
    before.position_m = Vec3{0.0, 0.0, 2.0};
    before.position_u95_m = Vec3{0.03, 0.03, 0.03};
    FittedLight after = before;
    after.position_m = Vec3{away_m, 0.0, 2.0};
    after.position_u95_m = Vec3{0.04, 0.04, 0.04};
    const json document =
        LightcalJson("diff", {Write(folder, "a.json", {before}), Write(folder, "b.json", {after})});
    return std::string(QuantityOf(document["lights"][0], "position_m")["verdict"]);
  };
  // u = 5 cm along each axis; of three axes together 5 cm x 2.795/1.960 = 7.13 cm.
  EXPECT_EQ(verdict(0.0712), "within_u");
  EXPECT_EQ(verdict(0.0714), "changed");
}

TEST(DiffCommand, CallsOneInTwentyWhereNothingChanged) {
  const TempDir folder;
  std::mt19937 random(20261122);
  std::normal_distribution<double> normal;
  constexpr int kLights = 2000;
  std::vector<FittedLight> before;
  std::vector<FittedLight> after;
  for (int i = 0; i < kLights; ++i) {
    const std::string name = "lamp " + std::to_string(i);
    for (const auto& [file, sd] : {std::pair(&before, 20.0), std::pair(&after, 35.0)}) {
      FittedLight light = SimpleLight(name, LightKind::kPoint, 1000.0);
      light.color.cct_K.reset();
      light.intensity_cd =
          Uncertain{1000.0 + sd * normal(random), 1.959964 * sd, std::nullopt, std::nullopt};
      file->push_back(light);
    }
  }
  const json document =
      LightcalJson("diff", {Write(folder, "a.json", before), Write(folder, "b.json", after)});
  int called = 0;
  for (const json& light : document["lights"]) called += light["changed"] ? 1 : 0;
  // Binomial: 100 +- 9.7; four standard deviations.
  EXPECT_NEAR(called, 0.05 * kLights, 4.0 * std::sqrt(0.05 * 0.95 * kLights));
}

TEST(DiffCommand, CorrelatedErrorsMakeSmallerChangesReal) {
  const TempDir folder;
  const std::string a = Write(folder, "a.json", {SimpleLight("x", LightKind::kPoint, 100.0)});
  const std::string b = Write(folder, "b.json", {SimpleLight("x", LightKind::kPoint, 108.0)});
  const auto intensity = [&](const std::string& r) {
    const json document = LightcalJson("diff", {a, b, "--correlation", r});
    return QuantityOf(document["lights"][0], "intensity_cd");
  };
  EXPECT_EQ(intensity("0")["verdict"], "within_u");
  EXPECT_EQ(intensity("0.9")["verdict"], "changed");
  EXPECT_NEAR(double(intensity("0.5")["u95"]), std::sqrt(100.0 + 116.64 - 108.0), 1e-9);
  EXPECT_EQ(RunLightcal({"diff", a, b, "--correlation", "1.5"}).exit_code, 2);
}

TEST(DiffCommand, ExitsZeroUnlessAskedToFail) {
  const TempDir folder;
  const std::string a = Write(folder, "a.json", {WarmPoint()});
  const std::string b = Write(folder, "b.json", {SimpleLight("key", LightKind::kPoint, 2000.0)});
  EXPECT_EQ(RunLightcal({"diff", a, b}).exit_code, 0);
  const CliResult failed = RunLightcal({"diff", a, b, "--fail-on-change", "--json"});
  EXPECT_EQ(failed.exit_code, 1);
  EXPECT_EQ(json::parse(failed.out)["error"]["code"], "changed");
  EXPECT_TRUE(json::parse(failed.out)["changed"]);
  EXPECT_EQ(RunLightcal({"diff", a, a, "--fail-on-change"}).exit_code, 0);
}

TEST(DiffCommand, NamesLampsThatCameAndWent) {
  const TempDir folder;
  const CliResult result = RunLightcal({"diff", Write(folder, "a.json", {WarmPoint(), Spot()}),
                                        Write(folder, "b.json", {WarmPoint(), Sun()})});
  EXPECT_THAT(result.out, HasSubstr("gone"));
  EXPECT_THAT(result.out, HasSubstr("new"));
  EXPECT_THAT(result.out, HasSubstr("sun"));
}

TEST(DiffCommand, ReadsPresetsAndSessions) {
  const TempDir folder;
  folder.Write("lamp/session.toml",
               "lightcal = 1\n[[light]]\nname = \"key\"\nkind = \"point\"\n[[reading]]\nlight = "
               "\"key\"\ndistance_m = 1\nilluminance_lx = 100\n");
  const std::string session = folder.path() + "/lamp";
  const CliResult unread = RunLightcal({"diff", session, session});
  EXPECT_EQ(unread.exit_code, 3);
  EXPECT_THAT(unread.err, HasSubstr("lightcal run"));
  ASSERT_EQ(RunLightcal({"run", session, "--to", "json"}).exit_code, 0);
  const json document = LightcalJson("diff", {session, session + "/out/lamp.preset.json"});
  EXPECT_FALSE(document["changed"]) << document;
  EXPECT_EQ(QuantityOf(document["lights"][0], "intensity_cd")["verdict"], "same");
  EXPECT_EQ(document["shared_inputs"][0], "session.toml");
  EXPECT_THAT(RunLightcal({"diff", session, session}).out, HasSubstr("not the lamp"));
}

TEST(DiffCommand, AnUnevenIntervalHasItsEnds) {
  const TempDir folder;
  FittedLight lamp = SimpleLight("spot", LightKind::kSpot, 2000.0);
  lamp.flux_lm = Uncertain{1260.0, 659.5, 11.0, 1330.0};
  const std::string a = Write(folder, "a.json", {lamp});
  lamp.flux_lm->value = 1250.0;
  const std::string b = Write(folder, "b.json", {lamp});
  const json flux = QuantityOf(LightcalJson("diff", {a, b})["lights"][0], "flux_lm");
  EXPECT_EQ(flux["old"]["low95"], 11.0);
  EXPECT_EQ(flux["old"]["high95"], 1330.0);
  EXPECT_THAT(RunLightcal({"diff", a, b}).out, HasSubstr("1260 lm, 11 … 1330"));
}

TEST(DiffCommand, WhatASolverLeavesIsNoChange) {
  const TempDir folder;
  FittedLight lamp = SimpleLight("key", LightKind::kPoint, 100.0);
  lamp.distance_offset_m = Uncertain{0.01, 0.0186, {}, {}};
  const std::string a = Write(folder, "a.json", {lamp});
  lamp.distance_offset_m = Uncertain{0.01 + 2e-6, 0.0186 + 4e-7, {}, {}};
  const json document =
      LightcalJson("diff", {a, Write(folder, "b.json", {lamp}), "--correlation", "1"});
  EXPECT_EQ(QuantityOf(document["lights"][0], "distance_offset_m")["verdict"], "within_u");
}

}  // namespace
}  // namespace lightcal::test
