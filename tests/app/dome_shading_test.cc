// SPDX-License-Identifier: Apache-2.0
// A card held before one light: which one it was. Truth is brute force: tests/tools/synthetic_sky.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "dome_pictures.h"

namespace lightcal::test::dome {
namespace {

using nlohmann::json;

constexpr int kAcross = 512;
constexpr double kUnit = 100.0;    // cd/m^2 of 1.0 in the file
constexpr float kClipNits = 2e4F;  // 4 lx are left of the sun: less than of the practical
constexpr double kSunLux = 2887.0, kPracticalLux = 129.5;

class ACardBeforeOneOfTwoLights : public testing::Test {
 protected:
  ACardBeforeOneOfTwoLights() {
    scene_.background = [](const Ray& ray) {
      const double nits = ray[2] > 0.0 ? 90.0 : 30.0;
      return Rgb3{nits, nits, nits};
    };
    scene_.lamps = {{.direction = sun_, .radius_deg = 1.0, .lux = kSunLux},
                    {.direction = practical_, .radius_deg = 3.0, .lux = kPracticalLux}};
  }
  [[nodiscard]] double Lux(const Ray& normal) const { return TrueLux(scene_, normal); }
  [[nodiscard]] double LuxWithout(std::size_t lamp, const Ray& normal) const {
    SkyScene left = scene_;
    left.lamps.erase(left.lamps.begin() + static_cast<std::ptrdiff_t>(lamp));
    return TrueLux(left, normal);
  }
  std::string Write(float clip_nits) {
    SkyPicture picture =
        Photograph(scene_, LatLongView(kAcross, kAcross / 2), kAcross, kAcross / 2);
    for (float& v : picture.rgb) v = std::min(v, clip_nits);
    return WritePicture(folder_, "sky.exr", picture, kUnit, false);
  }
  static Words Readings(double lux, double shaded) {
    return {"--lux", Text(lux), "--lux-shaded", Text(shaded), "--extract", "2", "--force"};
  }
  void ExpectBoth(const json& got, const char* sun_source, const char* practical_source) const {
    EXPECT_NEAR(got["scale"]["factor"].get<double>() / kUnit, 1.0, 0.02);
    const json sun = LightAt(got, sun_).light, practical = LightAt(got, practical_).light;
    EXPECT_NEAR(sun["illuminance_lx"]["value"].get<double>() / kSunLux, 1.0, 0.02);
    EXPECT_NEAR(practical["illuminance_lx"]["value"].get<double>() / kPracticalLux, 1.0, 0.05);
    EXPECT_EQ(sun["source"], sun_source);
    EXPECT_EQ(practical["source"], practical_source);
  }

  const Ray sun_ = RayAt(50.0, 35.0), practical_ = RayAt(-100.0, 25.0);
  SkyScene scene_;
  TempDir folder_;
  std::string out_ = folder_.path() + "/out";
};

TEST_F(ACardBeforeOneOfTwoLights, ShadedTheOneThatIsClipped) {
  const std::string file = Write(kClipNits);
  for (const Words& clip : {Words{"--clip", "199"}, Words{}}) {
    Words words = Readings(Lux(kUp), LuxWithout(0, kUp));
    words.insert(words.end(), clip.begin(), clip.end());
    ExpectBoth(DomeJson(file, out_, words), "inferred", "pixels");
  }
}

TEST_F(ACardBeforeOneOfTwoLights, IsSeenByAMeterTurnedToIt) {
  const std::string file = Write(kClipNits);
  Words words = Readings(Lux(sun_), LuxWithout(0, sun_));
  words.insert(words.end(), {"--lux-direction", "50,35"});
  ExpectBoth(DomeJson(file, out_, words), "inferred", "pixels");
}

TEST_F(ACardBeforeOneOfTwoLights, ShadedTheOneWhosePixelsSaySo) {
  const std::string file = Write(1e9F);
  ExpectBoth(DomeJson(file, out_, Readings(Lux(kUp), LuxWithout(0, kUp))), "inferred", "pixels");
  ExpectBoth(DomeJson(file, out_,
                      [&] {
                        Words words = Readings(Lux(practical_), LuxWithout(1, practical_));
                        words.insert(words.end(),
                                     {"--lux-direction", "-100,25", "--lux-sigma", "1%"});
                        return words;
                      }()),
             "pixels", "inferred");
}

TEST_F(ACardBeforeOneOfTwoLights, OfTwoClippedOnesTellsNothing) {
  const std::string file = Write(1e4F);
  Words words = Readings(Lux(kUp), LuxWithout(0, kUp));
  ExpectRefused(file, out_, "several_clipped", [&] {
    Words all = words;
    all.insert(all.end(), {"--clip", "99.9"});
    return all;
  }());
  // Nor do the pixels, which both end at one value.
  ExpectRefused(file, out_, "several_clipped", words);
}

TEST_F(ACardBeforeOneOfTwoLights, ThatTookLessThanItShowsIsNamed) {
  const std::string file = Write(1e9F);
  const double half = 0.5 * (Lux(kUp) + LuxWithout(0, kUp));
  EXPECT_TRUE(Warns(DomeJson(file, out_, Readings(Lux(kUp), half)), "shading_conflict"));
}

}  // namespace
}  // namespace lightcal::test::dome
