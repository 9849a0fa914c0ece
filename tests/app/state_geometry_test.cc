// SPDX-License-Identifier: Apache-2.0
// Lamps whose zoom or modifier changes where their light starts and how wide it shines: what is
// exported at a state is that state's own. Sessions worked out by hand, read back from the engines'
// files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "run_cli.h"
#include "run_cli_json.h"
#include "session_of_states.h"

namespace lightcal::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180.0;

std::string OffAxis(double off_deg) { return "off_axis_deg = " + std::to_string(off_deg) + "\n"; }

// A bell of so many degrees at half its peak, from so far behind the mark.
std::string Zoom(double zoom, double candela, double beam_deg, double offset_m) {
  const std::string at = "dimmer = 100, zoom_deg = " + std::to_string(zoom);
  std::string text;
  for (const double d : {1.0, 2.0, 4.0})
    text += StateRow(d, candela / std::pow(d + offset_m, 2.0), at);
  for (const double part : {0.5, 0.8, 1.1, 1.5, 2.1}) {
    // The angle is said as seen from the mark; the light comes from behind it.
    const double off = part * beam_deg / 2.0 * kDegree;
    const double across = 2.0 * std::sin(off);
    const double along = 2.0 * std::cos(off) + offset_m;
    const double seen = std::atan2(across, along) / kDegree / (beam_deg / 2.0);
    const double lux = candela * std::exp2(-seen * seen) / (across * across + along * along);
    text += StateRow(2.0, lux, at, OffAxis(off / kDegree));
  }
  text += StateRow(2.0, 0.5 * candela / std::pow(2.0 + offset_m, 2.0),
                   "dimmer = 40, zoom_deg = " + std::to_string(zoom));
  return text;
}

// 2 pi integral of the bell over the half sphere, by midpoints.
double BellFlux(double candela, double beam_deg) {
  constexpr int kSteps = 9000;
  const double step = 90.0 * kDegree / kSteps;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double off = (i + 0.5) * step;
    const double part = off / kDegree / (beam_deg / 2.0);
    sum += std::exp2(-part * part) * std::sin(off) * step;
  }
  return 2.0 * std::numbers::pi * candela * sum;
}

// Of the beam in a .gdtf.
double Attribute(const std::string& archive, const std::string& name) {
  const std::size_t at = archive.find(" " + name + "=\"");
  return at == std::string::npos ? -1.0 : std::stod(archive.substr(at + name.size() + 3));
}

TEST(StateGeometry, EachZoomExportsTheBeamThatItsOwnReadingsTold) {
  const TempDir folder;
  folder.Write("lamp/session.toml", DarkSession("kind = \"spot\"\noff_axis_sigma_deg = 0\n") +
                                        Zoom(15.0, 40000.0, 16.0, 0.15) +
                                        Zoom(40.0, 8000.0, 38.0, 0.03));
  LightcalJson("fit", {folder.path() + "/lamp", "-o", folder.path() + "/key.json"});
  struct Truth {
    const char* state;
    double candela, beam_deg, offset_m;
  };
  for (const Truth& truth : {Truth{"dimmer=100,zoom_deg=15", 40000.0, 16.0, 0.15},
                             Truth{"dimmer=100,zoom_deg=40", 8000.0, 38.0, 0.03},
                             Truth{"dimmer=40,zoom_deg=40", 4000.0, 38.0, 0.03}}) {
    const std::string out = folder.path() + "/" + truth.state;
    const json told = LightcalJson("export", {folder.path() + "/key.json", "--to", "gdtf,json",
                                              "--state", truth.state, "-o", out});
    EXPECT_EQ(told.dump().find("state_geometry"), std::string::npos) << truth.state;
    const json lamp = json::parse(ReadFile(out + "/key.preset.json"))["lights"][0];
    EXPECT_NEAR(double(lamp["photometry"]["intensity_cd"]["value"]) / truth.candela, 1.0, 0.03);
    EXPECT_NEAR(double(lamp["photometry"]["distance_offset_m"]["value"]), truth.offset_m, 0.03);
    const std::string gdtf = ReadFile(out + "/key-key.gdtf");
    EXPECT_NEAR(Attribute(gdtf, "BeamAngle") / truth.beam_deg, 1.0, 0.015) << truth.state;
    EXPECT_NEAR(Attribute(gdtf, "LuminousFlux") / BellFlux(truth.candela, truth.beam_deg), 1.0,
                0.02)
        << truth.state;
  }
}

// On its axis alone: what the session describes is all that is known of its cone.
std::string OnAxis(double zoom, double candela) {
  const std::string at = "dimmer = 100, zoom_deg = " + std::to_string(zoom);
  return StateRow(1.0, candela, at) + StateRow(2.0, candela / 4.0, at) +
         StateRow(4.0, candela / 16.0, at);
}

constexpr const char* kSpot = "kind = \"spot\"\ninner_deg = 6\nouter_deg = 8\n";
constexpr const char* kWide =
    "[[light.at]]\nstate = { zoom_deg = 40 }\ninner_deg = 15\nouter_deg = 21\n";

json Spot(const TempDir& folder, const std::string& state, json& told) {
  const std::string out = folder.path() + "/" + state;
  told = LightcalJson("export",
                      {folder.path() + "/key.json", "--to", "gltf", "--state", state, "-o", out});
  return json::parse(ReadFile(out + "/key.gltf"))["extensions"]["KHR_lights_punctual"]["lights"][0];
}

TEST(StateGeometry, AStatedConeOfAnotherZoomReachesTheEngine) {
  const TempDir folder;
  folder.Write("lamp/session.toml", DarkSession(kSpot + std::string(kWide)) +
                                        OnAxis(15.0, 40000.0) + OnAxis(40.0, 8000.0));
  LightcalJson("fit", {folder.path() + "/lamp", "-o", folder.path() + "/key.json"});
  json told;
  EXPECT_NEAR(double(Spot(folder, "dimmer=100,zoom_deg=15", told)["spot"]["outerConeAngle"]),
              8.0 * kDegree, 1e-6);
  const json wide = Spot(folder, "dimmer=100,zoom_deg=40", told);
  EXPECT_NEAR(double(wide["spot"]["outerConeAngle"]), 21.0 * kDegree, 1e-6);
  EXPECT_NEAR(double(wide["spot"]["innerConeAngle"]), 15.0 * kDegree, 1e-6);
  EXPECT_EQ(told.dump().find("state_geometry"), std::string::npos);
  // Between them, by the logarithms, and that is said.
  const json between = Spot(folder, "dimmer=100,zoom_deg=24.494897", told);
  EXPECT_NEAR(double(between["spot"]["outerConeAngle"]), std::sqrt(8.0 * 21.0) * kDegree, 1e-4);
  EXPECT_THAT(told.dump(), HasSubstr("state_geometry_between"));
}

TEST(StateGeometry, AZoomThatNobodyDescribesIsSaidToBorrow) {
  const TempDir folder;
  folder.Write("lamp/session.toml", DarkSession(kSpot) + OnAxis(15.0, 40000.0) +
                                        StateRow(2.0, 2000.0, "dimmer = 100, zoom_deg = 40"));
  LightcalJson("fit", {folder.path() + "/lamp", "-o", folder.path() + "/key.json"});
  json told;
  EXPECT_NEAR(double(Spot(folder, "dimmer=100,zoom_deg=40", told)["spot"]["outerConeAngle"]),
              8.0 * kDegree, 1e-6);
  EXPECT_THAT(told.dump(), HasSubstr("light.at"));
}

TEST(StateGeometry, AModifierGivesTheLampAnotherSizeAndKind) {
  const TempDir folder;
  const std::string at =
      "[[light.at]]\nstate = { modifier = \"softbox\" }\nkind = \"rect\"\nfixture = \"softbox\"\n"
      "size_m = [0.9, 0.6]\n";
  std::string text = DarkSession("kind = \"spot\"\nouter_deg = 30\n" + at);
  for (const double d : {1.0, 2.0, 4.0}) {
    text += StateRow(d, 9000.0 / (d * d), "dimmer = 100, modifier = \"bare\"");
    // A rect's axis: E = 4 L/2 (...) goes to I/(d + d0)^2 from afar; a metre off it is 10 % less.
    const double a = 0.45;
    const double b = 0.3;
    const double ra = std::hypot(a, d);
    const double rb = std::hypot(b, d);
    const double luminance = 1000.0 / (0.9 * 0.6);
    const double lux = 2.0 * luminance * (a / ra * std::atan(b / ra) + b / rb * std::atan(a / rb));
    text += StateRow(d, lux, "dimmer = 100, modifier = \"softbox\"");
  }
  folder.Write("lamp/session.toml", text);
  LightcalJson("fit", {folder.path() + "/lamp", "-o", folder.path() + "/key.json"});
  const auto preset = [&](const std::string& state) {
    const std::string out = folder.path() + "/" + state;
    LightcalJson("export",
                 {folder.path() + "/key.json", "--to", "json", "--state", state, "-o", out});
    return json::parse(ReadFile(out + "/key.preset.json"))["lights"][0];
  };
  EXPECT_EQ(preset("dimmer=100,modifier=bare")["kind"], "spot");
  const json soft = preset("dimmer=100,modifier=softbox");
  EXPECT_EQ(soft["kind"], "rect");
  EXPECT_NEAR(double(soft["geometry"]["width_m"]), 0.9, 1e-9);
  EXPECT_NEAR(double(soft["photometry"]["luminance_nits"]["value"]), 1000.0 / 0.54, 0.04 * 1852.0);
}

TEST(StateGeometry, WhatIsWrongInADescriptionOfAStateIsSaid) {
  const auto fault = [](const std::string& at) {
    const TempDir folder;
    folder.Write("lamp/session.toml", DarkSession(kSpot + at) + OnAxis(15.0, 40000.0));
    const CliResult run = RunLightcal({"fit", folder.path() + "/lamp", "--json"});
    EXPECT_EQ(run.exit_code, 3) << at;
    return json::parse(run.out)["error"]["message"].get<std::string>();
  };
  EXPECT_THAT(fault("[[light.at]]\nouter_deg = 20\n"), HasSubstr("state"));
  EXPECT_THAT(fault("[[light.at]]\nstate = { zoom_deg = 40 }\nkind = \"dome\"\n"),
              HasSubstr("light.at"));
  EXPECT_THAT(fault("[[light.at]]\nstate = { zoom_deg = 40 }\ninner_deg = 30\nouter_deg = 20\n"),
              HasSubstr("swap"));
  EXPECT_THAT(fault("[[light.at]]\nstate = { zoom_deg = 40 }\ncolor = 3\n"), HasSubstr("color"));
}

}  // namespace
}  // namespace lightcal::test
