// SPDX-License-Identifier: Apache-2.0
// Sessions that hold the lamp's own picture or a panorama, driven as a shell would. Truth is a
// plane of known luminance, sampled ray by ray, and tests/tools/synthetic_sky.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "dome_pictures.h"
#include "plain_exr.h"
#include "run_cli.h"
#include "run_cli_json.h"

namespace lightcal::test {
namespace {

using nlohmann::json;
using std::numbers::pi;

std::string Text(double v) { return std::to_string(v); }

// A flat lamp that faces a camera with an ordinary lens; its middle lies off the axis.
struct FlatLamp {
  double nits = 5000.0, room_nits = 3.0;
  double distance_m = 1.0;
  std::function<bool(double right_m, double up_m)> shines;
};

constexpr int kFrameWidth = 320, kFrameHeight = 240, kRaysAcross = 6;
constexpr double kLensFovDeg = 40.0;

std::vector<double> LookAt(const FlatLamp& lamp) {
  const double focal = kFrameWidth / 2.0 / std::tan(kLensFovDeg / 2.0 * pi / 180.0);
  // The direction to the lamp's middle and the plane's axes: right, forward, up.
  const double length = std::hypot(0.06, 1.0, 0.04);
  const Ray middle = {0.06 / length, 1.0 / length, 0.04 / length};
  const double flat = std::hypot(middle[0], middle[1]);
  const Ray right = {middle[1] / flat, -middle[0] / flat, 0.0};
  const Ray up = {-middle[2] * middle[0] / flat, -middle[2] * middle[1] / flat, flat};
  const auto dot = [](const Ray& a, const Ray& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  };
  std::vector<double> nits;
  for (int y = 0; y < kFrameHeight; ++y) {
    for (int x = 0; x < kFrameWidth; ++x) {
      int hits = 0;
      for (int i = 0; i < kRaysAcross * kRaysAcross; ++i) {
        const Ray ray = {x + (i % kRaysAcross + 0.5) / kRaysAcross - kFrameWidth / 2.0, focal,
                         kFrameHeight / 2.0 - y - (i / kRaysAcross + 0.5) / kRaysAcross};
        const double far = lamp.distance_m / dot(ray, middle);
        if (lamp.shines(far * dot(ray, right), far * dot(ray, up))) ++hits;
      }
      const double share = double(hits) / (kRaysAcross * kRaysAcross);
      nits.push_back(share * lamp.nits + (1.0 - share) * lamp.room_nits);
    }
  }
  return nits;
}

class SourceSession : public testing::Test {
 protected:
  // Frames at f/8 and ISO 100: 1 is 120 N^2/(t S), and the end of the scale.
  void Shoot(const FlatLamp& lamp, const std::vector<double>& times) { Shoot(LookAt(lamp), times); }
  void Shoot(const std::vector<double>& nits, const std::vector<double>& times) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    int frame = 0;
    for (const double time : times) {
      const double full = 120.0 * 64.0 / (time * 100.0);
      std::vector<float> samples;
      samples.reserve(nits.size());
      for (const double v : nits) {
        const double noisy = v / full * (1.0 + 0.003 * normal(random)) + 1e-5 * normal(random);
        samples.push_back(static_cast<float>(std::min(1.0, noisy)));
      }
      std::string name = "captures/lamp_" + std::to_string(frame++) + ".exr";
      folder_.Write(name, EncodeExr(kFrameWidth, kFrameHeight, samples));
      times_ += (times_.empty() ? "" : ", ") + Text(time);
    }
  }
  [[nodiscard]] std::string Toml(const std::string& light, const std::string& more = "") const {
    return "lightcal = 1\n[[light]]\nname = \"lamp\"\n" + light +
           "[[capture]]\nlight = \"lamp\"\nframes = \"captures/lamp_*.exr\"\nuse = \"source\"\n"
           "distance_m = 1.0\nfov_deg = 40\nf_number = 8\niso = 100\nexposure_s = [" +
           times_ + "]\n" + more;
  }
  static std::string InTheDark(const std::string& toml) {
    constexpr std::string_view kFirst = "lightcal = 1\n";
    return std::string(kFirst) + "[room]\ndark = true\n" + toml.substr(kFirst.size());
  }
  json Run(const std::string& toml) {
    document_ = LightcalJson(
        "run", {folder_.Write("session.toml", toml), "-o", folder_.path() + "/out", "--force"});
    return document_["lights"].at(0);
  }
  std::string Refusal(const std::string& toml) {
    const CliResult result = RunLightcal(
        {"run", folder_.Write("session.toml", toml), "-o", folder_.path() + "/out", "--json"});
    EXPECT_EQ(result.exit_code, 3) << result.out << result.err;
    return json::parse(result.out)["error"]["code"];
  }

  TempDir folder_;
  std::string times_;
  json document_;
};

double Value(const json& uncertain) { return uncertain["value"].get<double>(); }

TEST_F(SourceSession, ADiskGetsItsIntensityLuminanceAndDiameter) {
  FlatLamp lamp;
  lamp.shines = [](double r, double u) { return std::hypot(r, u) < 0.1; };
  Shoot(lamp, {1.0 / 400.0, 1.0 / 200.0, 1.0 / 100.0, 1.0 / 25.0});
  const json light = Run(Toml("kind = \"disk\"\n"));
  EXPECT_NEAR(Value(light["luminance_nits"]) / 4997.0, 1.0, 0.01);
  EXPECT_NEAR(Value(light["intensity_cd"]) / (4997.0 * pi * 0.01), 1.0, 0.01);
  EXPECT_NEAR(light["diameter_m"].get<double>() / 0.2, 1.0, 0.005);
  EXPECT_TRUE(dome::Warns(document_, "scale_prior"));
  const json& prior = light["fit"]["prior"];
  EXPECT_NE(std::ranges::find(prior, "camera_scale"), prior.end());
}

TEST_F(SourceSession, ARectGetsItsSides) {
  FlatLamp lamp;
  lamp.nits = 3000.0;
  lamp.shines = [](double r, double u) { return std::abs(r) < 0.15 && std::abs(u) < 0.05; };
  Shoot(lamp, {1.0 / 400.0, 1.0 / 100.0});
  const json light = Run(Toml("kind = \"rect\"\n"));
  EXPECT_NEAR(light["width_m"].get<double>() / 0.3, 1.0, 0.01);
  EXPECT_NEAR(light["height_m"].get<double>() / 0.1, 1.0, 0.01);
  EXPECT_NEAR(Value(light["luminance_nits"]) / 2997.0, 1.0, 0.01);
  EXPECT_NEAR(Value(light["intensity_cd"]) / (2997.0 * 0.03), 1.0, 0.01);
}

// Two halves of 6000 and 2000: I = sum L dA, whatever is where.
// A ball of 5000 cd/m^2 and radius R whose surface is d away: sin a = R / (d + R), E = pi L sin^2
// a, I = pi R^2 L. Size, intensity and luminance are one ball's.
TEST_F(SourceSession, ABallsIntensityAndLuminanceBelongToItsSize) {
  FlatLamp lamp;
  const double sine = 0.15 / (lamp.distance_m + 0.15),
               tangent = sine / std::sqrt(1.0 - sine * sine);
  lamp.shines = [&](double r, double u) { return std::hypot(r, u) < tangent * lamp.distance_m; };
  Shoot(lamp, {1.0 / 800.0, 1.0 / 200.0, 1.0 / 100.0});
  const std::string anchor = "anchor_illuminance_lx = " + Text(5000.0 * pi * sine * sine) + "\n";
  const json light = Run(InTheDark(Toml("kind = \"sphere\"\n", anchor)));
  EXPECT_NEAR(double(light["diameter_m"]), 0.3, 0.005);
  EXPECT_NEAR(Value(light["luminance_nits"]) / 5000.0, 1.0, 0.04);
  EXPECT_NEAR(Value(light["intensity_cd"]) / (5000.0 * pi * 0.15 * 0.15), 1.0, 0.02);
}

TEST_F(SourceSession, AnUnevenLampIsItsSum) {
  FlatLamp lamp;
  lamp.nits = 2000.0;
  lamp.shines = [](double r, double u) { return std::hypot(r, u) < 0.1; };
  FlatLamp bright = lamp;
  bright.nits = 4000.0;
  bright.room_nits = 0.0;
  bright.shines = [](double r, double u) { return std::hypot(r, u) < 0.1 && r > 0.0; };
  const std::vector<double> more = LookAt(bright), base = LookAt(lamp);
  std::vector<double> sum;
  for (std::size_t i = 0; i < base.size(); ++i) sum.push_back(base[i] + more[i]);
  Shoot(sum, {1.0 / 400.0, 1.0 / 100.0});
  const json light = Run(Toml("kind = \"point\"\nfixture = \"panel\"\n"));
  EXPECT_NEAR(Value(light["intensity_cd"]) / (3997.0 * pi * 0.01), 1.0, 0.015);
}

TEST_F(SourceSession, ALuxReadingAtTheCameraTakesItsScaleOut) {
  FlatLamp lamp;
  lamp.shines = [](double r, double u) { return std::hypot(r, u) < 0.1; };
  Shoot(lamp, {1.0 / 200.0, 1.0 / 100.0});
  // E = pi L sin^2 of the disk's half angle: 0.1 m at 1 m.
  const double lux = pi * 4000.0 * 0.01 / 1.01;
  const json light =
      Run(InTheDark(Toml("kind = \"disk\"\n", "anchor_illuminance_lx = " + Text(lux) + "\n")));
  EXPECT_NEAR(Value(light["luminance_nits"]) / 4000.0, 1.0, 0.01);
  EXPECT_FALSE(dome::Warns(document_, "scale_prior"));
}

// A meter at the camera reads what the walls throw back, a picture of the lamp does not: of an
// anchored one a fifth too much would be the lamp's.
TEST_F(SourceSession, AnAnchorHoldsWhatTheWallsThrowBack) {
  FlatLamp lamp;
  lamp.shines = [](double r, double u) { return std::hypot(r, u) < 0.1; };
  Shoot(lamp, {1.0 / 200.0, 1.0 / 100.0});
  const double lux = pi * 4000.0 * 0.01 / 1.01;
  const double candela = 4000.0 * pi * 0.01;
  const std::string anchor = "anchor_illuminance_lx = " + Text(1.2 * lux) + "\n";
  const json room = Run(Toml("kind = \"disk\"\n", anchor))["intensity_cd"];
  EXPECT_LT(Value(room), 1.16 * candela);
  EXPECT_LE(double(room["low95"]), candela);
  EXPECT_GE(double(room["high95"]), candela);
  const json dark = Run(InTheDark(Toml("kind = \"disk\"\n", anchor)))["intensity_cd"];
  EXPECT_NEAR(Value(dark) / (1.2 * candela), 1.0, 0.01);
  EXPECT_GT(double(dark["low95"]), candela);
}

TEST_F(SourceSession, ALampsOwnPictureHasTheLensAndTheShutterButNoOtherLight) {
  FlatLamp lamp;
  lamp.shines = [](double r, double u) { return std::hypot(r, u) < 0.1; };
  Shoot(lamp, {1.0 / 800.0, 1.0 / 200.0, 1.0 / 100.0});
  std::map<std::string, double> bounds;
  const json light = Run(Toml("kind = \"disk\"\n"));
  for (const json& one : light["effects"]) {
    if (one["state"] != "off") bounds[one["name"]] = one["bound"];
  }
  EXPECT_FALSE(bounds.contains("room_bounce"));
  EXPECT_FALSE(bounds.contains("ambient"));
  // Half the light rippling at 100 Hz, in the longest frame that is not clipped: 1/100 s.
  EXPECT_NEAR(bounds["rolling_shutter"], 0.5 / pi, 1e-3);
  EXPECT_NEAR(bounds["veiling_glare"], 0.03, 1e-9);
  // cos^4 at where the lamp hangs in its picture.
  EXPECT_NEAR(bounds["vignetting"], 2.0 * (0.06 * 0.06 + 0.04 * 0.04), 1e-4);
}

TEST_F(SourceSession, WhatCannotBeMeasuredIsNamed) {
  FlatLamp lamp;
  lamp.shines = [](double r, double u) { return std::hypot(r, u) < 0.1; };
  Shoot(lamp, {1.0 / 50.0, 1.0 / 25.0});
  EXPECT_EQ(Refusal(Toml("kind = \"disk\"\n")), "source_clipped");
  EXPECT_EQ(Refusal(Toml("kind = \"disk\"\n", "rect = [180, 60, 120, 100]\n")), "source_cut");
  EXPECT_EQ(Refusal(Toml("kind = \"disk\"\n", "rect = [5, 5, 40, 40]\n")), "no_source");
}

TEST_F(SourceSession, ASizeThatThePictureContradictsIsSaid) {
  FlatLamp lamp;
  lamp.shines = [](double r, double u) { return std::hypot(r, u) < 0.1; };
  Shoot(lamp, {1.0 / 200.0, 1.0 / 100.0});
  const json light = Run(Toml("kind = \"disk\"\ndiameter_m = 0.3\n"));
  EXPECT_TRUE(dome::Warns(document_, "source_size_differs"));
  EXPECT_NEAR(light["diameter_m"].get<double>(), 0.3, 1e-12);
}

class DomeSession : public testing::Test {
 protected:
  [[nodiscard]] std::string Toml(const std::string& more, const char* kind = "dome") const {
    return std::string("lightcal = 1\n[[light]]\nname = \"sky\"\nkind = \"") + kind +
           "\"\n[[capture]]\nlight = \"sky\"\nframes = \"sky.exr\"\nuse = \"dome\"\n" + more;
  }
  CliResult Run(const std::string& toml) {
    return RunLightcal({"run", folder_.Write("session.toml", toml), "-o", folder_.path() + "/out",
                        "--force", "--json"});
  }
  json Light(const std::string& toml) {
    const CliResult result = Run(toml);
    EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
    return json::parse(result.out)["lights"].at(0);
  }
  std::string Refusal(const std::string& toml) {
    const CliResult result = Run(toml);
    EXPECT_EQ(result.exit_code, 3) << result.out << result.err;
    return json::parse(result.out)["error"]["code"];
  }
  void WriteSky(double nits_per_unit, bool absolute) {
    dome::WritePicture(folder_, "sky.exr", Photograph(scene_, LatLongView(512, 256), 512, 256),
                       nits_per_unit, absolute);
  }

  const SkyScene scene_ = dome::ClearSky(RayAt(40.0, 50.0));
  TempDir folder_;
};

TEST_F(DomeSession, APanoramaAndALuxReadingAreADomeLight) {
  WriteSky(70.0, false);
  const json light = Light(Toml("anchor_illuminance_lx = 18000\n"));
  EXPECT_EQ(light["kind"], "dome");
  EXPECT_NEAR(Value(light["illuminance_lx"]), 18000.0, 1.0);
  EXPECT_TRUE(light["color"].contains("cct_K"));
}

TEST_F(DomeSession, APictureInCandelasNeedsNone) {
  WriteSky(1.0, true);
  const json light = Light(Toml(""));
  EXPECT_NEAR(Value(light["illuminance_lx"]) / TrueLux(scene_, {0.0, 0.0, 1.0}), 1.0, 0.005);
}

TEST_F(DomeSession, WithoutScaleOrOfAnotherKindItIsRefused) {
  WriteSky(70.0, false);
  EXPECT_EQ(Refusal(Toml("")), "no_scale");
  EXPECT_EQ(Refusal(Toml("anchor_illuminance_lx = 18000\n", "point")), "not_a_dome");
}

}  // namespace
}  // namespace lightcal::test
