// SPDX-License-Identifier: Apache-2.0
// lightcal dome on views of several projections, driven as a shell would. Truth is brute force:
// tests/tools/synthetic_sky, with a lens that darkens, exposures that are off, and noise.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <random>

#include "dome_pictures.h"

namespace lightcal::test::dome {
namespace {

using nlohmann::json;

struct Shot {
  double yaw, pitch, roll;
  double exposure;  // what its samples are wrong by
};

// Eight shots of one place: round the horizon, up and down; a camera leaning now and then.
const std::vector<Shot> kEight = {{0, 0, 0, 1.13},    {60, 5, 3, 0.86},    {120, -4, -2, 1.02},
                                  {180, 0, 10, 0.93}, {240, 8, 0, 1.21},   {300, 0, -7, 0.97},
                                  {20, 90, 0, 1.07},  {-35, -90, 15, 0.79}};

struct Camera {
  Lens lens = Lens::kEquidistant;
  const char* word = "equidistant";
  int width = 240, height = 240;
  double fov_deg = 120.0;
  double rim = 0.65;    // what the lens passes there
  double noise = 0.01;  // of a sample, relative
  double level = 1e9;   // clips here
};

// What the camera makes of the scene: vignetting (1 + a r^2)^-2, exposure, noise, clipping.
SkyPicture Shoot(const SkyScene& scene, const Camera& camera, const Shot& shot, unsigned seed) {
  SkyPicture picture = Photograph(scene,
                                  LensView(camera.lens, camera.width, camera.height, camera.fov_deg,
                                           shot.yaw, shot.pitch, shot.roll),
                                  camera.width, camera.height);
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const double farthest = camera.lens == Lens::kRect ? std::hypot(camera.width, camera.height) / 2.0
                                                     : std::min(camera.width, camera.height) / 2.0;
  const double a = 1.0 / std::sqrt(camera.rim) - 1.0;
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const double r =
          std::hypot(x + 0.5 - camera.width / 2.0, y + 0.5 - camera.height / 2.0) / farthest;
      const double lens = std::pow(1.0 + a * r * r, -2.0);
      float* p = &picture.rgb[3 * (static_cast<std::size_t>(y) * camera.width + x)];
      for (int c = 0; c < 3; ++c) {
        const double v = p[c] * lens * shot.exposure * (1.0 + camera.noise * normal(random));
        p[c] = static_cast<float>(std::min(v, camera.level));
      }
    }
  }
  return picture;
}

class DomeViews : public testing::Test {
 protected:
  // Files and the options that say where they look; lightcal's first word is the first file.
  Words Write(const SkyScene& scene, const Camera& camera, const std::vector<Shot>& shots) {
    Words words;
    for (std::size_t i = 0; i < shots.size(); ++i) {
      const Shot& shot = shots[i];
      files_.push_back(WritePicture(folder_, "view" + std::to_string(i) + ".exr",
                                    Shoot(scene, camera, shot, static_cast<unsigned>(i))));
      if (i > 0) words.push_back(files_.back());
    }
    for (const Shot& shot : shots) {
      words.emplace_back("--aim");
      words.push_back(Text(shot.yaw) + "," + Text(shot.pitch) + "," + Text(shot.roll));
    }
    for (const std::string& word : {std::string("--projection"), std::string(camera.word),
                                    std::string("--fov"), Text(camera.fov_deg)}) {
      words.push_back(word);
    }
    return words;
  }
  static void ExpectOneScale(const json& views, const std::vector<Shot>& shots, double tolerance) {
    ASSERT_EQ(views.size(), shots.size());
    double mean = 0.0;
    std::vector<double> off;
    for (std::size_t i = 0; i < shots.size(); ++i) {
      off.push_back(std::log(views[i]["factor"].get<double>() * shots[i].exposure));
      mean += off.back() / static_cast<double>(shots.size());
    }
    double chi2 = 0.0;
    for (std::size_t i = 0; i < shots.size(); ++i) {
      EXPECT_NEAR(off[i] - mean, 0.0, tolerance) << i;
      const double sd = views[i]["u95_relative"].get<double>() / 1.96;
      EXPECT_GT(sd, 0.0);
      EXPECT_LT(sd, tolerance);
      chi2 += std::pow((off[i] - mean) / sd, 2);
      RecordProperty("view" + std::to_string(i),
                     Text(1e3 * (off[i] - mean)) + " +- " + Text(1e3 * sd));
    }
    EXPECT_LT(chi2 / static_cast<double>(shots.size()), 3.0);  // the intervals are meant
    RecordProperty("chi2_per_view", Text(chi2 / static_cast<double>(shots.size())));
  }

  const Ray sun_ = RayAt(140.0, 35.0);
  const SkyLamp lamp_ = {RayAt(30.0, 10.0), 2.0, 3000.0, {1.0, 1.0, 1.0}, 0.0, false};
  std::vector<std::string> files_;
  TempDir folder_;
  std::string out_ = folder_.path() + "/out";
};

// The bar of issue 4: eight overlapping views on one scale to 0.2 %.
TEST_F(DomeViews, EightAgreeOnOneScaleAndMakeOneDome) {
  SkyScene scene = ClearSky(sun_);
  scene.lamps = {lamp_};
  const double lux = TrueLux(scene, kUp);
  Words words = Write(scene, {}, kEight);
  for (const char* word : {"--lux", "0", "--extract", "1"}) words.emplace_back(word);
  words[words.size() - 3] = Text(lux);
  const json got = DomeJson(files_.front(), out_, words);
  ExpectOneScale(got["views"], kEight, 0.002);
  EXPECT_NEAR(got["rim_transmission"].get<double>(), 0.65, 0.02);
  EXPECT_NEAR(got["seen_fraction"].get<double>(), 1.0, 1e-3);
  EXPECT_LT(got["agreement_sd_relative"].get<double>(), 0.01);
  // One reading upward made all planes absolute.
  for (const auto& [name, plane] :
       {std::pair("front", Ray{0, 1, 0}), std::pair("right", Ray{1, 0, 0}),
        std::pair("down", Ray{0, 0, -1})}) {
    EXPECT_NEAR(got["illuminance_lx"][name]["total"].get<double>() / TrueLux(scene, plane), 1.0,
                0.01)
        << name;
  }
  const Found lamp = LightAt(got, lamp_.direction);
  EXPECT_LT(lamp.off_deg, 0.1);
  EXPECT_NEAR(lamp.light["illuminance_lx"]["value"].get<double>() / 3000.0, 1.0, 0.02);
  EXPECT_TRUE(std::filesystem::exists(out_ + "/dome.exr"));
}

// People who walk through the shots, and a lamp that clips in one of two views.
TEST_F(DomeViews, WhatMovedAndWhatClippedDoesNotSpoilTheScale) {
  SkyScene scene = ClearSky(sun_);
  scene.lamps = {lamp_};
  Words words;
  for (std::size_t i = 0; i < kEight.size(); ++i) {
    SkyScene now = scene;
    // A dark figure 20 degrees wide, elsewhere in each shot.
    const Ray figure = RayAt(47.0 * static_cast<double>(i), -10.0);
    now.background = [figure, look = scene.background](const Ray& ray) {
      return AngleBetween(ray, figure) < 0.17 ? Rgb3{60.0, 60.0, 60.0} : look(ray);
    };
    Camera camera;
    if (i == 0) camera.level = 3e5;
    files_.push_back(WritePicture(folder_, "view" + std::to_string(i) + ".exr",
                                  Shoot(now, camera, kEight[i], static_cast<unsigned>(i))));
    if (i > 0) words.push_back(files_.back());
  }
  for (const Shot& shot : kEight) {
    words.emplace_back("--aim");
    words.push_back(Text(shot.yaw) + "," + Text(shot.pitch) + "," + Text(shot.roll));
  }
  for (const char* word : {"--projection", "equidistant", "--fov", "120", "--lux"}) {
    words.emplace_back(word);
  }
  words.push_back(Text(TrueLux(scene, kUp)));
  const json got = DomeJson(files_.front(), out_, words);
  ExpectOneScale(got["views"], kEight, 0.004);
  const Found lamp = LightAt(got, lamp_.direction);
  EXPECT_NEAR(lamp.light["illuminance_lx"]["value"].get<double>() / 3000.0, 1.0, 0.03);
}

TEST_F(DomeViews, OfAnOrdinaryLensAndAnEquisolidFisheyeToo) {
  const SkyScene scene = ClearSky(sun_);
  for (const Camera& camera :
       {Camera{Lens::kEquisolid, "equisolid", 240, 240, 130.0, 0.5, 0.005, 1e9},
        Camera{Lens::kRect, "rect", 270, 225, 105.0, 0.4, 0.005, 1e9}}) {
    files_.clear();
    const Words words = Write(scene, camera, kEight);
    const json got = DomeJson(files_.front(), out_ + camera.word, words);
    ExpectOneScale(got["views"], kEight, 0.003);
    // Views with no unit of their own keep their mean one: the product of the factors is 1.
    EXPECT_TRUE(Warns(got, "relative_scale"));
    const double mean = [&] {
      double sum = 0.0;
      for (const Shot& shot : kEight) sum += std::log(shot.exposure) / 8.0;
      return std::exp(sum);
    }();
    EXPECT_NEAR(got["illuminance_lx"]["up"]["total"].get<double>() / (mean * TrueLux(scene, kUp)),
                1.0, 0.01)
        << camera.word;
  }
}

TEST_F(DomeViews, OneFisheyeThatLooksUpIsTheUpperHemisphere) {
  SkyScene scene = ClearSky(sun_);
  scene.lamps = {{RayAt(-70.0, 40.0), 1.5, 20000.0, {1.0, 1.0, 1.0}, 0.0, false}};
  const Camera camera{Lens::kEquisolid, "equisolid", 500, 500, 180.0, 1.0, 0.0, 1e9};
  const std::string file =
      WritePicture(folder_, "sky.exr", Shoot(scene, camera, {0, 90, 0, 1.0}, 1), 50.0, false);
  const Words words = {"--projection", "equisolid", "--fov", "180", "--lux"};
  const auto with = [&](Words more) {
    Words all = words;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  const json got = DomeJson(file, out_, with({Text(TrueLux(scene, kUp)), "--extract", "1"}));
  EXPECT_NEAR(got["seen_fraction"].get<double>(), 0.5, 0.01);
  EXPECT_TRUE(Warns(got, "partly_seen"));
  EXPECT_NEAR(got["scale"]["factor"].get<double>() / 50.0, 1.0, 0.005);
  const Found lamp = LightAt(got, RayAt(-70.0, 40.0));
  EXPECT_LT(lamp.off_deg, 0.1);
  EXPECT_NEAR(lamp.light["illuminance_lx"]["value"].get<double>() / 20000.0, 1.0, 0.01);
  ExpectRefused(file, out_ + "2", "reading_beyond_view", with({"900", "--lux-direction", "0,0"}));
}

TEST_F(DomeViews, ThatShareNothingAreRefusedByName) {
  const std::vector<Shot> apart = {{0, 0, 0, 1.0}, {40, 0, 0, 1.0}, {200, 0, 0, 1.0}};
  Camera camera;
  camera.width = camera.height = 120;
  camera.fov_deg = 60.0;
  Words words = Write(ClearSky(sun_), camera, apart);
  ExpectRefused(files_.front(), out_, "views_do_not_overlap", words);
  words.emplace_back("--json");
  EXPECT_EQ(json::parse(Dome(files_.front(), out_, words).out)["error"]["subject"], files_[2]);
}

}  // namespace
}  // namespace lightcal::test::dome
