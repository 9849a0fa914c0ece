// SPDX-License-Identifier: Apache-2.0
// Lamps placed by mirror balls, driven as a shell would. Truth is a ray tracer of its own: one
// camera, perfect chrome spheres, a small glowing lamp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "plain_exr.h"
#include "run_cli.h"

namespace lightcal::test {
namespace {

using nlohmann::json;
using std::numbers::pi;
using Point = std::array<double, 3>;

Point Sum(const Point& a, const Point& b, double s = 1.0) {
  return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}
double Dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double Norm(const Point& a) { return std::sqrt(Dot(a, a)); }
Point Unit(const Point& a) { return Sum({}, a, 1.0 / Norm(a)); }

// Distance along the unit ray to a sphere, or below 0.
double Hit(const Point& from, const Point& ray, const Point& middle, double radius) {
  const Point way = Sum(middle, from, -1.0);
  const double along = Dot(way, ray), under = along * along - Dot(way, way) + radius * radius;
  return under < 0.0 || along < 0.0 ? -1.0 : along - std::sqrt(under);
}

constexpr int kWidth = 600, kHeight = 400, kRays = 3;
constexpr double kFovDeg = 20.0, kBallRadius = 0.06;

struct Scene {
  Point camera{0.1, -0.2, 1.0};
  Point aim{0.0, 1.0, -0.05};  // not at the ball
  Point ball{0.1, 1.3, 0.93};
  Point lamp{0.45, 0.35, 2.1};
  double lamp_radius = 0.02, lamp_value = 200.0;
};

struct Picture {
  std::vector<float> samples;
  int left = kWidth, right = -1, top = kHeight, bottom = -1;  // of the ball
};

Picture Trace(const Scene& scene) {
  const Point forward = Unit(scene.aim);
  const Point right = Unit({forward[1], -forward[0], 0.0});
  const Point up = {right[1] * forward[2] - right[2] * forward[1],
                    right[2] * forward[0] - right[0] * forward[2],
                    right[0] * forward[1] - right[1] * forward[0]};
  const double focal = kWidth / 2.0 / std::tan(kFovDeg / 2.0 * pi / 180.0);
  Picture picture;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      double sum = 0.0;
      int on_ball = 0;
      for (int i = 0; i < kRays * kRays; ++i) {
        const double px = x + (i % kRays + 0.5) / kRays - kWidth / 2.0;
        const double py = kHeight / 2.0 - y - (i / kRays + 0.5) / kRays;
        const Point ray = Unit(Sum(Sum(Sum({}, forward, focal), right, px), up, py));
        const double far = Hit(scene.camera, ray, scene.ball, kBallRadius);
        if (far < 0.0) {
          sum += 0.2;
          continue;
        }
        ++on_ball;
        const Point at = Sum(scene.camera, ray, far);
        const Point normal = Unit(Sum(at, scene.ball, -1.0));
        const Point away = Sum(ray, normal, -2.0 * Dot(ray, normal));
        sum += Hit(at, away, scene.lamp, scene.lamp_radius) > 0.0 ? scene.lamp_value
                                                                  : 0.4 + 0.3 * away[2];
      }
      if (2 * on_ball >= kRays * kRays) {
        picture.left = std::min(picture.left, x);
        picture.right = std::max(picture.right, x);
        picture.top = std::min(picture.top, y);
        picture.bottom = std::max(picture.bottom, y);
      }
      picture.samples.push_back(static_cast<float>(sum / (kRays * kRays)));
    }
  }
  return picture;
}

std::string Text(const Point& p) {
  return "[" + std::to_string(p[0]) + ", " + std::to_string(p[1]) + ", " + std::to_string(p[2]) +
         "]";
}

class BallSession : public testing::Test {
 protected:
  // One [[capture]] of this scene.
  std::string Capture(const Scene& scene, const std::string& more = "") {
    const Picture picture = Trace(scene);
    const std::string name = "ball_" + std::to_string(count_++) + ".exr";
    folder_.Write(name, EncodeExr(kWidth, kHeight, picture.samples));
    return "[[capture]]\nlight = \"lamp\"\nframes = \"" + name +
           "\"\nuse = \"ball\"\nfov_deg = 20\n" + more + "[capture.ball]\ndiameter_m = 0.12\n" +
           "rect = [" + std::to_string(picture.left) + ", " + std::to_string(picture.top) + ", " +
           std::to_string(picture.right - picture.left + 1) + ", " +
           std::to_string(picture.bottom - picture.top + 1) + "]\n" +
           "camera_position_m = " + Text(scene.camera) + "\ncamera_aim = " + Text(scene.aim) + "\n";
  }
  // Two lux readings of a lamp of 100 cd.
  static std::string Readings(const Point& lamp) {
    std::string toml;
    for (const Point& at : {Point{0.0, 0.0, 0.8}, Point{0.6, 0.9, 0.8}}) {
      const Point way = Sum(lamp, at, -1.0);
      const double lux = 100.0 * way[2] / std::pow(Norm(way), 3);
      toml += "[[reading]]\nlight = \"lamp\"\nposition_m = " + Text(at) +
              "\nnormal = [0, 0, 1]\nilluminance_lx = " + std::to_string(lux) + "\n";
    }
    return toml;
  }
  CliResult Fit(const std::string& captures, const Point& lamp, const std::string& place = "") {
    const std::string toml =
        "lightcal = 1\n[room]\ndark = true\n[[light]]\nname = \"lamp\"\nkind = \"point\"\n" +
        place + Readings(lamp) + captures;
    return RunLightcal({"fit", folder_.Write("session.toml", toml), "-o",
                        folder_.path() + "/light.json", "--force", "--json"});
  }
  std::string Refusal(const std::string& captures, const Point& lamp) {
    const CliResult result = Fit(captures, lamp);
    EXPECT_EQ(result.exit_code, 3) << result.out << result.err;
    return json::parse(result.out)["error"]["code"];
  }
  static void ExpectTheLamp(const CliResult& result, const Point& lamp) {
    ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
    const json light = json::parse(result.out)["lights"].at(0);
    const Point found = light["position_m"].get<Point>();
    EXPECT_LT(Norm(Sum(found, lamp, -1.0)), 0.03) << light["position_m"];
    const Point u95 = light["position_u95_m"].get<Point>();
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_LT(std::abs(found[i] - lamp[i]), u95[i] + 1e-3) << i;
      EXPECT_LT(u95[i], 0.15);
    }
    EXPECT_NEAR(light["intensity_cd"]["value"].get<double>(), 100.0, 5.0);
  }

  TempDir folder_;
  int count_ = 0;
};

Scene Elsewhere() {
  Scene scene;
  scene.ball = {-0.35, 0.9, 1.1};
  scene.camera = {0.5, -0.1, 1.2};
  scene.aim = {-0.65, 0.75, -0.05};
  return scene;
}

TEST_F(BallSession, TwoBallsShowWhereTheLampIs) {
  const Scene scene;
  ExpectTheLamp(Fit(Capture(scene) + Capture(Elsewhere()), scene.lamp), scene.lamp);
}

TEST_F(BallSession, OneBallAndADistanceDoToo) {
  const Scene scene;
  const double distance = Norm(Sum(scene.lamp, scene.ball, -1.0));
  ExpectTheLamp(Fit(Capture(scene, "distance_m = " + std::to_string(distance) + "\n"), scene.lamp),
                scene.lamp);
}

TEST_F(BallSession, WhatItCannotTellIsRefused) {
  const Scene scene;
  EXPECT_EQ(Refusal(Capture(scene), scene.lamp), "one_ball");
  EXPECT_EQ(Refusal(Capture(scene) + Capture(scene), scene.lamp), "rays_parallel");
  Scene other = Elsewhere();
  other.lamp = {-0.6, 0.2, 1.6};
  EXPECT_EQ(Refusal(Capture(scene) + Capture(other), scene.lamp), "rays_miss");
  Scene dark = scene;
  dark.lamp_value = 0.5;
  EXPECT_EQ(Refusal(Capture(dark), scene.lamp), "no_highlight");
  EXPECT_EQ(Refusal(Capture(scene, "distance_m = 0.01\n"), scene.lamp), "bad_distance");
}

TEST_F(BallSession, AStatedPlaceIsBelievedAndTheDifferenceSaid) {
  const Scene scene;
  const CliResult result =
      Fit(Capture(scene) + Capture(Elsewhere()), scene.lamp, "position_m = [0.45, 0.35, 1.6]\n");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json document = json::parse(result.out);
  EXPECT_EQ(document["lights"][0]["position_m"][2], 1.6);
  EXPECT_TRUE(std::ranges::any_of(document["warnings"],
                                  [](const json& w) { return w["code"] == "position_differs"; }));
}

}  // namespace
}  // namespace lightcal::test
