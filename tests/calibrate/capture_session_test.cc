// SPDX-License-Identifier: Apache-2.0
// Sessions that hold a bracket, driven as a shell would. The brackets are synthetic: a lamp of 300
// cd and 3000 K, 0.8 m from a card of 18 %, seen by a camera 15 % less sensitive than its ISO says;
// no walls, and the light starts where the lamp is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "lightcal/imaging/camera/spectral_mismatch.h"
#include "lightcal/records/camera_sensitivities.h"
#include "lightcal_devices/files/import_file.h"
#include "run_cli.h"
#include "run_cli_json.h"
#include "synthetic_dng.h"

namespace lightcal::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

constexpr double kIntensityCd = 300.0, kKelvin = 3000.0, kLux = 300.0 / (0.8 * 0.8);
constexpr double kCameraSensitivity = 0.85;
const std::string kHead =
    "lightcal = 1\n[room]\ndark = true\n"
    "[[light]]\nname = \"lamp\"\nkind = \"point\"\nfixture = \"bulb\"\n";

std::string Frames(const std::string& session) {
  return SampleData("sessions/" + session + "/captures/");
}

// A capture of the shipped DNG frames, wherever the session lies.
std::string Capture(const std::string& more = "") {
  return "[[capture]]\nlight = \"lamp\"\nframes = \"" + Frames("grey_card_dng") +
         "*.dng\"\nuse = \"card\"\nreflectance = 0.18\ndistance_m = 0.8\n"
         "rect = [220, 120, 200, 160]\n" +
         more;
}

std::string LuxReading(double lux, double distance) {
  return "[[reading]]\nlight = \"lamp\"\ndistance_m = " + std::to_string(distance) +
         "\nilluminance_lx = " + std::to_string(lux) + "\n";
}

class CaptureSession : public testing::Test {
 protected:
  // The first light of the fit of this session.toml.
  json Light(const std::string& toml) {
    document_ = LightcalJson("fit", {folder_.Write("session.toml", toml), "--allow-outside", "-o",
                                     folder_.path() + "/light.json", "--force"});
    return document_["lights"].at(0);
  }
  CliResult Fit(const std::string& toml) {
    return RunLightcal({"fit", folder_.Write("session.toml", toml), "--allow-outside", "-o",
                        folder_.path() + "/light.json", "--force"});
  }
  [[nodiscard]] bool Warned(const std::string& code) const {
    const json warnings = document_.value("warnings", json::array());
    return std::ranges::any_of(warnings,
                               [&](const json& warning) { return warning["code"] == code; });
  }

  TempDir folder_;
  json document_;
};

double RelativeU95(const json& light) {
  return double(light["intensity_cd"]["u95"]) / double(light["intensity_cd"]["value"]);
}

void ExpectTheLamp(const json& light) {
  const json& intensity = light["intensity_cd"];
  EXPECT_LE(double(intensity["low95"]), kIntensityCd);
  EXPECT_GE(double(intensity["high95"]), kIntensityCd);
  const json& cct = light["color"]["cct_K"];
  EXPECT_NEAR(double(cct["value"]), kKelvin, double(cct["u95"]));
}

class ShippedBracket : public testing::TestWithParam<const char*> {};

TEST_P(ShippedBracket, BecomesPresetsAndAReport) {
  const TempDir out;
  const json document =
      LightcalJson("run", {SampleData(std::string("sessions/") + GetParam()), "-o", out.path()});
  const json& light = document["lights"].at(0);
  ExpectTheLamp(light);
  // What is wrong is the camera's sensitivity, and nothing else.
  EXPECT_NEAR(double(light["intensity_cd"]["value"]) / kIntensityCd, kCameraSensitivity, 0.01);
  EXPECT_NEAR(double(light["color"]["cct_K"]["value"]), kKelvin, 10.0);
  const json& prior = light["fit"]["prior"];
  EXPECT_NE(std::ranges::find(prior, "camera_scale"), prior.end());
  const std::string stem = GetParam();
  for (const std::string& name : {stem + ".gltf", stem + ".preset.json", std::string("light.json"),
                                  std::string("report.html")}) {
    EXPECT_TRUE(fs::exists(fs::path(out.path()) / name)) << name;
  }
  EXPECT_THAT(ReadFile(out.path() + "/report.html"), HasSubstr("lamp"));
}

INSTANTIATE_TEST_SUITE_P(Sessions, ShippedBracket,
                         testing::Values("grey_card_dng", "grey_card_exr"),
                         [](const auto& param) { return std::string(param.param); });

TEST_F(CaptureSession, LuxAndABracketAreSurerThanEitherAlone) {
  const json bracket = Light(kHead + Capture());
  EXPECT_TRUE(Warned("scale_prior"));
  // One reading with the sigma of a camera: the meter is an old one.
  const std::string meter = "[[meter]]\nname = \"old\"\nsigma_relative = 0.2\n";
  std::string reading = LuxReading(kLux * 1.05, 0.8) + "meter = \"old\"\n";
  const json lux = Light(kHead + meter + reading);
  const json both = Light(kHead + meter + reading + Capture());
  EXPECT_EQ(both["fit"]["readings"], 2);
  EXPECT_FALSE(Warned("scale_prior")) << "asks for the lux reading that is there";
  EXPECT_LT(RelativeU95(both), RelativeU95(bracket));
  EXPECT_LT(RelativeU95(both), RelativeU95(lux));
  ExpectTheLamp(both);
  const json& prior = both["fit"]["prior"];
  EXPECT_EQ(std::ranges::find(prior, "camera_scale"), prior.end()) << "the lux reading tells too";
}

TEST_F(CaptureSession, ASecondBracketByOneCameraDoesNotMakeItsScaleSurer) {
  const json one = Light(kHead + Capture());
  const json three = Light(kHead + Capture() + Capture() + Capture());
  EXPECT_EQ(three["fit"]["readings"], 3);
  EXPECT_NEAR(RelativeU95(three), RelativeU95(one), 0.01 * RelativeU95(one));
}

TEST_F(CaptureSession, OneMeterHeldToManyCardsIsNoSurerThanItsCalibration) {
  const std::string meter =
      "[[meter]]\nname = \"old\"\nsigma_relative = 0.05\ncalibration_relative = 0.05\n";
  const std::string card = Capture("anchor_illuminance_lx = 468.75\nmeter = \"old\"\n");
  const json one = Light(kHead + meter + card);
  const json three = Light(kHead + meter + card + card + card);
  EXPECT_EQ(three["fit"]["readings"], 3);
  EXPECT_GT(RelativeU95(three), 1.96 * 0.05);
  EXPECT_GT(RelativeU95(three), 0.97 * RelativeU95(one));
  const std::string by_hand = LuxReading(468.75, 0.8) + "meter = \"old\"\n";
  const json all = Light(kHead + meter + card + card + by_hand);
  EXPECT_NEAR(RelativeU95(all), RelativeU95(three), 2e-3) << "one meter at each";
  EXPECT_EQ(all["meter"]["name"], "old");
}

// An ordinary lens sees .6 rad in its corner; 1 - cos^4 of where the card stands in the picture.
TEST_F(CaptureSession, VignettingIsThatOfTheCardsPlace) {
  const auto bound_at = [&](const std::string& rect) {
    std::string capture = Capture();
    const std::string middle = "rect = [220, 120, 200, 160]";
    capture.replace(capture.find(middle), middle.size(), "rect = " + rect);
    const json light = Light(kHead + capture);
    for (const json& one : light["effects"]) {
      if (one["name"] == "vignetting") return double(one["bound"]);
    }
    return -1.0;
  };
  EXPECT_NEAR(bound_at("[220, 120, 160, 160]"), 0.0, 1e-9);
  const double tangent = std::hypot(30.0, 40.0) / std::hypot(300.0, 200.0) * std::tan(0.6);
  EXPECT_NEAR(bound_at("[220, 120, 100, 80]"), 1.0 - std::pow(1.0 + tangent * tangent, -2.0), 1e-6);
}

TEST_F(CaptureSession, TheCamerasScaleIsWhatTheIntervalOfCardsNames) {
  const json cards = Light(kHead + Capture() + Capture());
  const auto& warnings = document_["warnings"];
  EXPECT_EQ(std::ranges::count(warnings, "scale_prior", [](const json& w) { return w["code"]; }), 1)
      << "one warning a cause";
  ASSERT_FALSE(cards["budget"].empty());
  EXPECT_EQ(cards["budget"].at(0)["name"], "camera_scale");
  EXPECT_FALSE(cards.contains("meter")) << "no meter read it";
  const auto& effects = cards["effects"];
  const auto scale =
      std::ranges::find(effects, "camera_scale", [](const json& e) { return e["name"]; });
  ASSERT_NE(scale, effects.end());
  EXPECT_EQ((*scale)["key"], "capture.anchor_illuminance_lx");
}

// The same frames as of a darker or a lighter card, nearer or farther away.
std::string CardAt(double distance) {
  const double reflectance = 0.18 * std::pow(distance / 0.8, 2.0);
  return "[[capture]]\nlight = \"lamp\"\nframes = \"" + Frames("grey_card_dng") +
         "*.dng\"\nuse = \"card\"\nrect = [220, 120, 200, 160]\nreflectance = " +
         std::to_string(reflectance) + "\ndistance_m = " + std::to_string(distance) + "\n";
}

TEST_F(CaptureSession, WhatCardsSayOfOneAnotherCountsBesideALuxReading) {
  const std::string room = "lightcal = 1\n" + kHead.substr(kHead.find("[[light]]"));
  const std::string cards = CardAt(0.4) + CardAt(0.8) + CardAt(1.6);
  const json lux = Light(room + LuxReading(kLux, 0.8));
  const json by_cards = Light(room + cards);
  const json both = Light(room + LuxReading(kLux, 0.8) + cards);
  EXPECT_LT(RelativeU95(both), 0.8 * RelativeU95(lux)) << "they tell the room and the offset";
  EXPECT_LT(RelativeU95(both), 0.5 * RelativeU95(by_cards));
  ExpectTheLamp(both);
  EXPECT_THAT(both["fit"]["learned"].dump(), HasSubstr("instrument_scale"));
  const json again = Light(room + LuxReading(kLux, 0.8) + cards + CardAt(0.8));
  EXPECT_LT(RelativeU95(again), 1.02 * RelativeU95(both)) << "more never widens";
}

TEST_F(CaptureSession, ALuxReadingAtTheCardTakesTheCamerasScaleOut) {
  const json light = Light(kHead + Capture("anchor_illuminance_lx = 468.75\n"));
  EXPECT_FALSE(Warned("scale_prior"));
  EXPECT_NEAR(double(light["intensity_cd"]["value"]), kIntensityCd, 1e-6 * kIntensityCd);
  const json meter = Light(kHead + LuxReading(kLux, 0.8));
  EXPECT_NEAR(RelativeU95(light), RelativeU95(meter), 1e-3);
  EXPECT_TRUE(light["color"].contains("cct_K")) << "the picture adds the colour";
}

TEST_F(CaptureSession, TheKindOfLampChangesTheLuminanceByItsFactorAndTheInterval) {
  const json unknown = Light(kHead + Capture());
  const json tungsten = Light(kHead + Capture("lamp_class = \"tungsten\"\n"));
  EXPECT_NEAR(double(tungsten["intensity_cd"]["value"]) / double(unknown["intensity_cd"]["value"]),
              0.974, 0.001);
  EXPECT_LT(RelativeU95(tungsten), RelativeU95(unknown));
}

TEST_F(CaptureSession, WhatTheLightOrAnotherCaptureSaysOfTheLampIsHeard) {
  const std::string said = "lamp_class = \"tungsten\"\n";
  const json unknown = Light(kHead + Capture());
  const json of_capture = Light(kHead + Capture(said));
  const json of_light = Light(kHead + said + Capture());
  EXPECT_LT(double(of_capture["color"]["cct_K"]["u95"]), double(unknown["color"]["cct_K"]["u95"]));
  EXPECT_EQ(of_light["intensity_cd"], of_capture["intensity_cd"]);
  EXPECT_EQ(of_light["color"], of_capture["color"]);
  EXPECT_EQ(Light(kHead + Capture() + Capture(said))["intensity_cd"],
            Light(kHead + Capture(said) + Capture(said))["intensity_cd"]);
}

TEST_F(CaptureSession, MeasuredSensitivitiesAndASpectrumAreUsed) {
  const std::string camera =
      "camera = \"" + SampleData("camera_sensitivities/Canon_EOS_5D_380_780_5.json") + "\"\n";
  const std::string spectrum =
      "spectrum = \"" + SampleData("spectra/uprtek_cv600/Osram Osconiq 3000K.xls") + "\"\n";
  const json by_class = Light(kHead + Capture(camera + "lamp_class = \"white_led\"\n"));
  const json by_spectrum = Light(kHead + Capture(camera + spectrum));
  EXPECT_LT(RelativeU95(by_spectrum), RelativeU95(by_class));
  const json& inputs = document_["provenance"]["inputs"];
  EXPECT_EQ(inputs.size(), 8U) << "session.toml, five frames, camera, spectrum";
}

using Rows = std::array<std::array<double, 3>, 3>;

// Adjugate over determinant.
Rows Inverse(const Rows& m) {
  Rows out{};
  double determinant = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
    determinant += m[0][i] * (m[1][a] * m[2][b] - m[1][b] * m[2][a]);
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t c = (j + 1) % 3, d = (j + 2) % 3;
      out[i][j] = m[c][a] * m[d][b] - m[c][b] * m[d][a];
    }
  }
  for (auto& row : out) {
    for (double& value : row) value /= determinant;
  }
  return out;
}

// A matrix that answers this lamp as the measured camera does: its D65 matrix, bent by one rank.
Rows CameraSeeing(const SpectralCamera& camera, const Spectrum& lamp, Xy xy) {
  Rows out = Inverse(camera.xyz_from_raw());
  const auto raw = camera.ChannelsOf(lamp);
  EXPECT_TRUE(raw);
  const Xyz color = XyzFromXyAtUnitY(xy);
  const std::array<double, 3> v = {color.X, color.Y, color.Z};
  const double length2 = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  for (std::size_t i = 0; i < 3; ++i) {
    const double seen = out[i][0] * v[0] + out[i][1] * v[1] + out[i][2] * v[2];
    for (std::size_t j = 0; j < 3; ++j) out[i][j] += ((*raw)[i] - seen) * v[j] / length2;
  }
  return out;
}

TEST_F(CaptureSession, AMeasuredCameraReadsAMeasuredLampWithinHalfAPercentOnceBothAreKnown) {
  const std::string camera_file = SampleData("camera_sensitivities/Canon_EOS_5D_380_780_5.json");
  const std::string lamp_file = SampleData("spectra/uprtek_cv600/Nichia 80 CRI.xls");
  const auto sensitivities = CameraSensitivitiesFromJson(ReadFile(camera_file), "camera");
  const auto imported = devices::ImportFile(lamp_file);
  ASSERT_TRUE(sensitivities && imported);
  const Spectrum& lamp = imported->spectra.front().spectrum;
  const auto measured = SpectralCamera::Make(*sensitivities);
  const auto xyz = XyzFromSpectrum(lamp);
  ASSERT_TRUE(measured && xyz);
  const Xy xy = XyFromXyz(*xyz);

  SyntheticCamera camera;
  camera.width = 300;
  camera.height = 200;
  camera.camera_from_xyz = CameraSeeing(*measured, lamp, xy);
  SyntheticDngOptions options;
  options.white_x = xy.x;
  options.white_y = xy.y;
  const auto series = ExposureSeries(1.0 / 64.0, 4, 1.0, 4.0, 0.0, 5);
  const SyntheticScene scene = [&](int x, int /*y*/) {
    return XyzOf((x < 200 ? 0.18 : 0.5) * kLux / std::numbers::pi, xy.x, xy.y);
  };
  WriteDngBracket(folder_.path(), "card", camera, series, scene, options);
  const std::string card = kHead +
                           "[[capture]]\nlight = \"lamp\"\nframes = \"card*.dng\"\nuse = \"card\"\n"
                           "reflectance = 0.18\ndistance_m = 0.8\nrect = [20, 20, 160, 160]\n";
  const std::string by_camera = card + "camera = \"" + camera_file + "\"\n";
  const auto off = [&](const std::string& toml) {
    return double(Light(toml)["intensity_cd"]["value"]) / kIntensityCd - 1.0;
  };
  // The lamp reads 3.5 % low by its D65 matrix.
  const double uncorrected = off(by_camera);
  EXPECT_LT(uncorrected, -0.02);
  EXPECT_LT(std::abs(off(by_camera + "lamp_class = \"white_led\"\n")), 0.02);
  EXPECT_LT(std::abs(off(by_camera + "spectrum = \"" + lamp_file + "\"\n")), 0.005);
}

TEST_F(CaptureSession, WhatCannotBeReadIsRefusedByName) {
  struct Case {
    const char* code;
    std::string toml;
  };
  const std::string exr = "[[capture]]\nlight = \"lamp\"\nframes = \"" + Frames("grey_card_exr") +
                          "*.exr\"\nuse = \"card\"\nreflectance = 0.18\ndistance_m = 0.8\n";
  const std::string dng = "[[capture]]\nlight = \"lamp\"\nframes = \"" + Frames("grey_card_dng") +
                          "*.dng\"\nuse = \"card\"\nreflectance = 0.18\ndistance_m = 0.8\n";
  const std::string camera =
      "camera = \"" + SampleData("camera_sensitivities/Canon_EOS_5D_380_780_5.json") + "\"\n";
  const std::vector<Case> cases = {
      {"no_exposure_metadata", exr},
      {"exposure_count", exr + "exposure_s = [0.1, 0.2]\nf_number = 4\niso = 100\n"},
      {"camera_needs_raw", exr + camera +
                               "exposure_s = [0.015625, 0.03125, 0.0625, 0.125, 0.25]\n"
                               "f_number = 4\niso = 100\nrect = [55, 30, 50, 40]\n"},
      {"card_uneven", dng + "rect = [100, 120, 200, 160]\n"},
      {"bad_region", dng + "rect = [500, 120, 200, 160]\n"},

      {"bad_sensitivities", Capture("camera = \"session.toml\"\n")}};
  for (const Case& one : cases) {
    const CliResult result =
        RunLightcal({"fit", folder_.Write("session.toml", kHead + one.toml), "--allow-outside",
                     "-o", folder_.path() + "/light.json", "--json"});
    EXPECT_EQ(result.exit_code, 3) << one.code << result.err;
    const json answer = json::parse(result.out, nullptr, false);
    ASSERT_TRUE(answer.contains("error")) << one.code << result.out;
    EXPECT_EQ(answer["error"]["code"], one.code) << answer.dump();
    EXPECT_FALSE(fs::exists(folder_.path() + "/light.json"));
  }
  const CliResult missing = Fit(kHead +
                                "[[capture]]\nlight = \"lamp\"\nframes = \"no*.dng\"\n"
                                "use = \"card\"\nreflectance = 0.18\ndistance_m = 1\n");
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_THAT(missing.err, HasSubstr("[[capture]] 1"));
}

TEST_F(CaptureSession, TheRemedyForMissingExposureNamesTheSessionsKeys) {
  const CliResult result =
      Fit(kHead + "[[capture]]\nlight = \"lamp\"\nframes = \"" + Frames("grey_card_exr") +
          "*.exr\"\nuse = \"card\"\nreflectance = 0.18\ndistance_m = 0.8\n");
  EXPECT_THAT(result.err, HasSubstr("exposure_s = [..]"));
}

}  // namespace
}  // namespace lightcal::test
