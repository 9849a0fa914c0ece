// SPDX-License-Identifier: Apache-2.0
// lightcal merge --align: frames of a camera that moved.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "lightcal_devices/captures/picture.h"
#include "merge_brackets.h"

namespace lightcal {
namespace {

using nlohmann::json;
using namespace test::merge;  // the words of these tests
using test::SyntheticCamera;
using test::SyntheticScene;

constexpr double kCentreX = 150.0, kCentreY = 100.0;

// Luminance of a wall with posts, at a place of it.
double Wall(double x, double y) {
  return 3000.0 + 2500.0 * std::sin(0.13 * x) * std::sin(0.11 * y + 0.02 * x);
}

// The wall after the camera moved its picture by so many pixels and turned it.
SyntheticScene Moved(double right, double down, double turned_deg = 0.0) {
  const double c = std::cos(turned_deg * M_PI / 180.0), s = std::sin(turned_deg * M_PI / 180.0);
  return [=](int x, int y) {
    const double u = x - right - kCentreX, v = y - down - kCentreY;
    return test::XyzOf(Wall(kCentreX + c * u + s * v, kCentreY - s * u + c * v));
  };
}

class Aligned : public testing::Test {
 protected:
  Words Shot(const std::vector<SyntheticScene>& scenes) {
    const SyntheticCamera camera = Camera();
    const auto series =
        test::ExposureSeries(1.0 / 2048, static_cast<int>(scenes.size()), 1.0, 8.0, 0.03, 3);
    Words files;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      files.push_back(Shoot(folder_, "f" + std::to_string(i), camera, series[i], scenes[i]));
    }
    return files;
  }
  test::TempDir folder_;
  std::string output_ = folder_.path() + "/lum.exr";
};

void ExpectMoved(const json& frame, double right, double down, double within) {
  EXPECT_NEAR(frame["shift_px"][0].get<double>(), right, within) << frame;
  EXPECT_NEAR(frame["shift_px"][1].get<double>(), down, within) << frame;
}

TEST_F(Aligned, WhatMovedIsTakenBackAndReported) {
  const std::string unmoved = folder_.path() + "/unmoved.exr";
  static_cast<void>(MergeJson(Shot({Moved(0, 0), Moved(0, 0), Moved(0, 0)}), unmoved));
  const Words files = Shot({Moved(0, 0), Moved(6, -4), Moved(-8, 10)});
  EXPECT_TRUE(Warns(MergeJson(files, output_), "misaligned"));
  const json answer = MergeJson(files, output_, {"--align", "auto", "--force"});
  EXPECT_FALSE(Warns(answer, "misaligned")) << answer.dump();
  EXPECT_FALSE(Warns(answer, "moved_content")) << answer.dump();
  ExpectMoved(answer["frames"][0], 0.0, 0.0, 1e-12);
  ExpectMoved(answer["frames"][1], 6.0, -4.0, 0.4);
  ExpectMoved(answer["frames"][2], -8.0, 10.0, 0.4);
  EXPECT_EQ(answer["frames"][1]["taken_back_px"], json::array({6, -4}));
  EXPECT_EQ(answer["frames"][2]["taken_back_px"], json::array({-8, 10}));
  EXPECT_EQ(answer["crop"], json::array({8, 4, 286, 186}));
  const Picture lum = ReadExr(output_);
  ASSERT_EQ(lum.width, 286);
  ASSERT_EQ(lum.height, 186);
  const Picture still = ReadExr(unmoved);
  for (const int x : {20, 40, 90, 150, 250}) {
    EXPECT_NEAR(lum.Mean(x, 60, 8, 8) / still.Mean(x + 8, 64, 8, 8), 1.0, 0.005) << x;
  }
}

// A turn in degrees, clockwise, and where the middle of the reference lies.
void ExpectTurned(const json& frame, double turned_deg, double right, double down) {
  EXPECT_NEAR(frame["turned_deg"].get<double>(), turned_deg, 0.05) << frame;
  ExpectMoved(frame, right, down, 0.15);
}

TEST_F(Aligned, WhatLiesBetweenThePatternsPlacesIsInterpolated) {
  const json answer = MergeJson(Shot({Moved(0, 0), Moved(3, 0)}), output_, {"--align", "auto"});
  EXPECT_EQ(answer["aligned_to"], answer["frames"][1]["file"]);
  ExpectTurned(answer["frames"][0], 0.0, -3.0, 0.0);
  ExpectTurned(answer["frames"][1], 0.0, 0.0, 0.0);
  EXPECT_FALSE(Warns(answer, "misaligned"));
}

TEST_F(Aligned, ACameraInTheHandIsTurnedBack) {
  const std::string unmoved = folder_.path() + "/unmoved.exr";
  static_cast<void>(MergeJson(Shot({Moved(0, 0), Moved(0, 0), Moved(0, 0)}), unmoved));
  const Words files = Shot({Moved(4.3, -2.6, 1.2), Moved(0, 0), Moved(-7.4, 5.1, -1.5)});
  const json answer = MergeJson(files, output_, {"--align", "auto"});
  EXPECT_FALSE(Warns(answer, "misaligned")) << answer.dump();
  EXPECT_FALSE(Warns(answer, "moved_content")) << answer.dump();
  EXPECT_EQ(answer["aligned_to"], answer["frames"][1]["file"]);
  ExpectTurned(answer["frames"][0], 1.2, 4.3, -2.6);
  ExpectTurned(answer["frames"][2], -1.5, -7.4, 5.1);
  const int left = answer["crop"][0], top = answer["crop"][1];
  const Picture lum = ReadExr(output_), still = ReadExr(unmoved);
  ASSERT_EQ(lum.width, answer["crop"][2].get<int>());
  ASSERT_GT(lum.width, 260);
  for (const int x : {20, 40, 90, 150, 230}) {
    EXPECT_NEAR(lum.Mean(x, 60, 8, 8) / still.Mean(x + left, 60 + top, 8, 8), 1.0, 0.01) << x;
  }
}

TEST_F(Aligned, AStillBracketIsTheSameWithAndWithout) {
  const Words files = Shot({Moved(0, 0), Moved(0, 0), Moved(0, 0)});
  const std::string plain = folder_.path() + "/plain.exr";
  static_cast<void>(MergeJson(files, plain));
  const json answer = MergeJson(files, output_, {"--align", "auto"});
  for (const json& frame : answer["frames"]) ExpectMoved(frame, 0.0, 0.0, 0.0);
  EXPECT_EQ(ReadExr(plain).samples, ReadExr(output_).samples);
}

// What made another merger shift frames by 712 pixels.
TEST_F(Aligned, ALampOnBlackStaysWhereItIs) {
  const SyntheticScene lamp = [](int x, int y) {
    return test::XyzOf(std::hypot(x - 150.5, y - 100.5) < 12.0 ? 2e4 : 0.05);
  };
  const json answer = MergeJson(Shot({lamp, lamp, lamp}), output_, {"--align", "auto"});
  for (const json& frame : answer["frames"]) ExpectMoved(frame, 0.0, 0.0, 0.0);
  EXPECT_EQ(answer["width"], 300);
}

// Nothing of it is in the wall.
test::SyntheticXyz Other(int x, int y) {
  return test::XyzOf(3000.0 + 2500.0 * std::sin(0.31 * x + 0.002 * y * y) *
                                  std::cos(0.23 * y - 0.001 * x * x));
}

// A lamp in it is full in every frame.
SyntheticScene WithLamp(SyntheticScene scene) {
  return [scene = std::move(scene)](int x, int y) {
    return std::hypot(x - 200.5, y - 60.5) < 8.0 ? test::XyzOf(1e6) : scene(x, y);
  };
}

TEST_F(Aligned, AnotherSceneIsRefused) {
  ExpectRefused(Shot({Moved(0, 0), WithLamp(Other), WithLamp(Other)}), output_, "misaligned",
                {"--align", "auto"});
  ExpectRefused(Shot({Moved(0, 0), Other}), output_, "misaligned", {"--align", "auto"});
}

// Only the dark is noisier without a longer frame; a shorter one alone shows what is bright.
TEST_F(Aligned, ALongerFrameThatCannotBeFollowedIsLeftOut) {
  const json answer =
      MergeJson(Shot({Moved(4.3, -2.6, 1.2), Moved(0, 0), Other}), output_, {"--align", "auto"});
  EXPECT_TRUE(Warns(answer, "frame_left_out")) << answer.dump();
  ExpectTurned(answer["frames"][0], 1.2, 4.3, -2.6);
  ExpectRefused(Shot({Other, WithLamp(Moved(0, 0)), WithLamp(Moved(4.3, -2.6, 1.2))}),
                folder_.path() + "/other.exr", "misaligned", {"--align", "auto"});
}

// Where the next frame is full nowhere the shorter one shows nothing that it does not.
TEST_F(Aligned, AShorterFrameThatShowsNothingMoreIsLeftOut) {
  const json answer =
      MergeJson(Shot({Other, Moved(0, 0), Moved(4.3, -2.6, 1.2)}), output_, {"--align", "auto"});
  EXPECT_TRUE(Warns(answer, "frame_left_out")) << answer.dump();
  ExpectTurned(answer["frames"][2], 1.2, 4.3, -2.6);
}

// Every channel at every pixel: moved by odd pixels too.
TEST_F(Aligned, LinearPicturesMoveByWholePixels) {
  std::mt19937_64 random(7);
  std::normal_distribution<float> noise(0.0F, 1.0F);
  Words files;
  const std::array<float, 2> exposures = {1.0F, 4.0F};
  for (std::size_t f = 0; f < exposures.size(); ++f) {
    std::vector<float> samples;
    for (int y = 0; y < 200; ++y) {
      for (int x = 0; x < 300; ++x) {
        const float signal =
            exposures[f] * static_cast<float>(Wall(x - 5.0 * static_cast<double>(f), y)) / 3e4F;
        samples.push_back(signal + std::sqrt(signal / 4e4F) * noise(random));
      }
    }
    files.push_back(folder_.path() + "/" + std::to_string(f) + ".exr");
    devices::ExrPicture exr;
    exr.samples = View2d<const float>(samples.data(), 300, 200);
    exr.channel_names = {"Y"};
    ASSERT_TRUE(devices::WriteExr(files.back(), exr).has_value());
  }
  const json answer =
      MergeJson(files, output_,
                {"--align", "auto", "--exposures", "1/60,1/15", "--f-number", "8", "--iso", "100"});
  ExpectMoved(answer["frames"][1], 5.0, 0.0, 0.4);
  EXPECT_EQ(answer["frames"][1]["taken_back_px"], json::array({5, 0}));
  EXPECT_EQ(answer["width"], 295);
}

TEST_F(Aligned, WordsOtherThanAutoAndOffAreWrongUsage) {
  const Words files = Shot({Moved(0, 0), Moved(0, 0)});
  EXPECT_EQ(test::RunLightcal(MergeWords(files, output_, {"--align", "yes"})).exit_code, 2);
}

}  // namespace
}  // namespace lightcal
