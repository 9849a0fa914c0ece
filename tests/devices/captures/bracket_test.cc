// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/captures/bracket.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "run_cli.h"
#include "synthetic_dng.h"
#include "warning_codes.h"

namespace lightcal::devices {
namespace {

using test::Codes;
using test::SampleData;
using test::SyntheticDngOptions;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class BracketFiles : public testing::Test {
 protected:
  BracketFiles() {
    camera_.width = 32;
    camera_.height = 24;
    series_ = test::ExposureSeries(1.0 / 256, 4, 2.0, 8.0, 0.0, 5);
  }
  std::vector<std::string> Write(const SyntheticDngOptions& options = {}) {
    return WriteDngBracket(
        dir_.path(), "b", camera_, series_, [](int x, int) { return test::XyzOf(20.0 * x); },
        options);
  }
  static Bracket Open(std::vector<std::string> patterns, const BracketOverrides& overrides = {}) {
    auto bracket = OpenBracket(patterns, overrides);
    EXPECT_TRUE(bracket) << bracket.error().message;
    return bracket ? *bracket : Bracket{};
  }
  static std::vector<double> Times(const Bracket& bracket) {
    std::vector<double> times;
    for (const FrameInfo& f : bracket.frames) times.push_back(f.exposure.time->value());
    return times;
  }

  test::SyntheticCamera camera_;
  std::vector<test::SyntheticExposure> series_;
  test::TempDir dir_;
};

TEST_F(BracketFiles, FramesComeInOrderOfTrueExposureHoweverTheyAreNamed) {
  std::vector<std::string> files = Write();
  std::swap(files[0], files[2]);
  std::swap(files[1], files[3]);
  const Bracket bracket = Open(files);
  EXPECT_THAT(Times(bracket), ElementsAre(1.0 / 256, 1.0 / 64, 1.0 / 16, 0.25));
  EXPECT_TRUE(bracket.warnings.empty());
}

TEST_F(BracketFiles, WildcardsAreExpandedAndNumbersCountAsNumbers) {
  Write();
  std::filesystem::rename(dir_.path() + "/b_1.dng", dir_.path() + "/b_10.dng");
  const auto files = ExpandFiles(std::array{dir_.path() + "/b_*.dng"});
  ASSERT_TRUE(files);
  ASSERT_EQ(files->size(), 4U);
  EXPECT_THAT(files->back(), HasSubstr("b_10.dng"));
  EXPECT_EQ(Open({dir_.path() + "/b_*.dng"}).frames.size(), 4U);
  EXPECT_EQ(ExpandFiles(std::array{dir_.path() + "/c_*.dng"}).error().code, "not_found");
}

TEST_F(BracketFiles, TheSessionsExposuresWinAndAreRecorded) {
  BracketOverrides overrides;
  overrides.exposure = {Seconds(8.0), Seconds(4.0), Seconds(2.0), Seconds(1.0)};
  overrides.f_number = 11.0;
  overrides.iso = 400.0;
  const Bracket bracket = Open(Write(), overrides);
  EXPECT_THAT(Times(bracket), ElementsAre(1.0, 2.0, 4.0, 8.0));
  EXPECT_THAT(bracket.frames.front().file, HasSubstr("b_3"));
  for (const FrameInfo& frame : bracket.frames) {
    EXPECT_TRUE(frame.exposure.overridden);
    EXPECT_EQ(frame.exposure.f_number, 11.0);
    EXPECT_EQ(frame.exposure.iso, 400.0);
  }
  const auto frame = LoadFrame(bracket.frames.front());
  ASSERT_TRUE(frame);
  EXPECT_DOUBLE_EQ(frame->info.exposure.time->value(), 1.0);
  overrides.exposure = {Seconds(1.0)};
  EXPECT_EQ(OpenBracket(Write(), overrides).error().code, "exposure_count");
}

TEST_F(BracketFiles, ADuplicateIsLeftOutAndNamed) {
  std::vector<std::string> files = Write();
  std::filesystem::copy_file(files[1], dir_.path() + "/copy.dng");
  files.push_back(dir_.path() + "/copy.dng");
  const Bracket bracket = Open(files);
  EXPECT_EQ(bracket.frames.size(), 4U);
  ASSERT_THAT(Codes(bracket.warnings), ElementsAre("duplicate_frame"));
  EXPECT_THAT(bracket.warnings[0].subject, HasSubstr("copy.dng"));
}

TEST_F(BracketFiles, TwoFramesOfOneExposureAreBothKeptAndNamed) {
  series_[1] = series_[0];
  series_[1].seed = 77;
  const Bracket bracket = Open(Write());
  EXPECT_EQ(bracket.frames.size(), 4U);
  EXPECT_THAT(Codes(bracket.warnings), ElementsAre("repeated_exposure"));
}

TEST_F(BracketFiles, MixedIsoApertureAndFocusAreNamed) {
  series_[1].iso = 200.0;
  series_[2].label_f_number = 11.0;
  Write();
  const auto written = [&](const char* name, std::size_t i, double distance) {
    return dir_.Write(name, EncodeDng(camera_, series_[i],
                                      Expose(camera_, series_[i],
                                             [](int x, int) { return test::XyzOf(20.0 * x); }),
                                      {.subject_distance_m = distance}));
  };
  const Bracket bracket = Open({written("a.dng", 0, 1.0), written("b.dng", 1, 1.0),
                                written("c.dng", 2, 1.0), written("d.dng", 3, 2.0)});
  EXPECT_THAT(Codes(bracket.warnings), ElementsAre("mixed_iso", "mixed_aperture", "mixed_focus"));
}

TEST_F(BracketFiles, SizesAndKindsMayNotMix) {
  std::vector<std::string> files = Write();
  camera_.width = 40;
  files.push_back(dir_.Write(
      "wide.dng", EncodeDng(camera_, series_[0],
                            Expose(camera_, series_[0], [](int, int) { return test::XyzOf(1); }))));
  const auto mixed = OpenBracket(files);
  ASSERT_FALSE(mixed);
  EXPECT_EQ(mixed.error().code, "mixed_size");
  EXPECT_THAT(mixed.error().message, HasSubstr("40 x 24"));

  camera_.width = 32;
  camera_.monochrome = true;
  files.back() = dir_.Write(
      "grey.dng", EncodeDng(camera_, series_[0],
                            Expose(camera_, series_[0], [](int, int) { return test::XyzOf(1); })));
  EXPECT_EQ(OpenBracket(files).error().code, "mixed_kind");
}

TEST_F(BracketFiles, AFrameWithoutTimeIsKeptAndNamed) {
  series_[2].label_time_s = 0.0;
  const Bracket bracket = Open(Write());
  EXPECT_EQ(bracket.frames.size(), 4U);
  EXPECT_FALSE(bracket.frames[2].exposure.time);
  EXPECT_THAT(Codes(bracket.warnings), ElementsAre("no_exposure_time"));
}

TEST_F(BracketFiles, ADamagedFrameIsNamed) {
  std::vector<std::string> files = Write();
  std::filesystem::resize_file(files[2], std::filesystem::file_size(files[2]) - 40);
  const auto bracket = OpenBracket(files);
  ASSERT_FALSE(bracket);
  EXPECT_EQ(bracket.error().code, "bad_picture");
  EXPECT_EQ(bracket.error().subject, files[2]);
}

TEST(RealBracket, ThePngsOfANikonComeInOrder) {
  const auto bracket = OpenBracket(std::array{SampleData("pictures/png_bracket/parliament_*.png")});
  ASSERT_TRUE(bracket);
  ASSERT_EQ(bracket->frames.size(), 3U);
  EXPECT_NEAR(*bracket->frames[2].exposure.time / *bracket->frames[0].exposure.time,
              std::exp2(13.0 / 3.0), 1e-9);
  EXPECT_EQ(bracket->frames[0].meaning, SampleMeaning::kEncoded);
}

}  // namespace
}  // namespace lightcal::devices
