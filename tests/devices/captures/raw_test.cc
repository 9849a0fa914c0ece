// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/captures/raw.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <fstream>

#include "run_cli.h"
#include "synthetic_dng.h"

namespace lightcal::devices {
namespace {

using test::EncodeDng;
using test::Expose;
using test::SampleData;
using test::SyntheticCamera;
using test::SyntheticDngOptions;
using test::SyntheticExposure;
using test::TempDir;
using ::testing::HasSubstr;

class RawFile : public testing::Test {
 protected:
  RawFile() {
    camera_.width = 62;
    camera_.height = 46;
    picture_ = Expose(camera_, exposure_, [](int x, int y) { return test::XyzOf(10.0 * x + y); });
  }
  std::string Dng(const SyntheticDngOptions& options = {}) {
    return dir_.Write("a.dng", EncodeDng(camera_, exposure_, picture_, options));
  }
  static FrameInfo Info(const std::string& path) {
    auto info = ReadRawInfo(path);
    EXPECT_TRUE(info) << info.error().message;
    return info ? *info : FrameInfo{};
  }
  static Frame Read(const std::string& path, SampleStore store = SampleStore::kMemory) {
    auto frame = ReadRaw(path, store);
    EXPECT_TRUE(frame) << frame.error().message;
    return frame ? *frame : Frame{};
  }
  void ExpectTheSamplesAreThosePut(const Frame& frame) {
    const auto& view = std::get<View2d<const std::uint16_t>>(frame.samples);
    ASSERT_EQ(view.width(), camera_.width);
    ASSERT_EQ(view.height(), camera_.height);
    for (int y = 0; y < view.height(); ++y) {
      for (int x = 0; x < view.width(); ++x) {
        ASSERT_EQ(view(x, y), picture_[y * camera_.width + x]) << x << ", " << y;
      }
    }
  }

  SyntheticCamera camera_;
  SyntheticExposure exposure_;
  std::vector<std::uint16_t> picture_;
  TempDir dir_;
};

TEST_F(RawFile, SamplesComeAsTheSensorGaveThem) {
  ExpectTheSamplesAreThosePut(Read(Dng()));
  ExpectTheSamplesAreThosePut(Read(Dng({.lossless_jpeg = true})));
}

TEST_F(RawFile, SamplesAreTheSameInAScratchFile) {
  ExpectTheSamplesAreThosePut(Read(Dng(), SampleStore::kScratchFile));
}

TEST_F(RawFile, SamplesOutliveTheFrameTheyCameWith) {
  Frame copy;
  {
    const Frame frame = Read(Dng());
    copy = frame;
  }
  ExpectTheSamplesAreThosePut(copy);
}

TEST_F(RawFile, LevelsAndColourFilterArrayAreTheSensors) {
  const FrameInfo info = Info(Dng());
  EXPECT_EQ(info.meaning, SampleMeaning::kMosaic);
  EXPECT_EQ(info.format, "dng");
  ASSERT_EQ(info.cfa.width, 2);
  ASSERT_EQ(info.cfa.height, 2);
  EXPECT_THAT(info.cfa.values,
              testing::ElementsAre(kRedChannel, kGreenChannel, kGreenChannel, kBlueChannel));
  ASSERT_TRUE(info.levels);
  for (const float black : info.levels->black.values) EXPECT_EQ(black, 512.0F);
  for (const float white : info.levels->white) EXPECT_EQ(white, 15871.0F);
}

TEST_F(RawFile, LabelsBecomeTrueExposuresAndBothAreKept) {
  const FrameExposure exposure = Info(Dng()).exposure;
  EXPECT_DOUBLE_EQ(exposure.time->value(), 1.0 / 64);
  EXPECT_TRUE(exposure.time_snapped);
  EXPECT_DOUBLE_EQ(*exposure.written.exposure_time_s, 1.0 / 60);
  EXPECT_DOUBLE_EQ(*exposure.f_number, 8.0);
  EXPECT_FALSE(exposure.f_number_snapped);
  EXPECT_DOUBLE_EQ(*exposure.iso, 100.0);
}

TEST_F(RawFile, ShutterAndApertureValuesAreRead) {
  exposure_.label_f_number = 11.0;
  exposure_.apex_tags = true;
  const FrameExposure exposure = Info(Dng()).exposure;
  EXPECT_DOUBLE_EQ(*exposure.written.shutter_apex, 6.0);
  EXPECT_DOUBLE_EQ(*exposure.written.aperture_apex, 7.0);
  EXPECT_DOUBLE_EQ(*exposure.f_number, std::exp2(3.5));
}

TEST_F(RawFile, NoiseColourDistanceAndTimeAreRead) {
  const FrameInfo info =
      Info(Dng({.white_x = 0.4476, .white_y = 0.4074, .subject_distance_m = 1.5}));
  ASSERT_EQ(info.noise.size(), 1U);
  EXPECT_DOUBLE_EQ(info.noise[0].scale, 1.0 / 60000);
  EXPECT_NEAR(info.noise[0].offset, std::pow(3.5 / 60000, 2), 1e-9);
  ASSERT_TRUE(info.matrices);
  EXPECT_NEAR(info.matrices->cool[1][1], camera_.camera_from_xyz[1][1], 1e-6);
  EXPECT_DOUBLE_EQ(info.subject_distance->value(), 1.5);
  EXPECT_NEAR(info.focal_length->value(), 0.035, 1e-9);
  EXPECT_EQ(info.time, "2026-11-21T12:00:00");
  EXPECT_THAT(info.camera, HasSubstr("Synthetic"));
  // The matrices explain the neutral the file was given.
  ASSERT_TRUE(info.as_shot_neutral);
  const auto white = XyFromCameraNeutral(*info.matrices, *info.as_shot_neutral);
  ASSERT_TRUE(white);
  EXPECT_NEAR(white->x, 0.4476, 1e-4);
  EXPECT_NEAR(white->y, 0.4074, 1e-4);
}

TEST_F(RawFile, AMonochromeSensorHasNoColourFilterArray) {
  camera_.monochrome = true;
  picture_ = Expose(camera_, exposure_, [](int x, int y) { return test::XyzOf(10.0 * x + y); });
  const Frame frame = Read(Dng());
  EXPECT_EQ(frame.info.meaning, SampleMeaning::kSensor);
  EXPECT_EQ(frame.info.channels, 1);
  EXPECT_TRUE(frame.info.cfa.values.empty());
  EXPECT_EQ(frame.info.levels->black(0, 0), 512.0F);
  ExpectTheSamplesAreThosePut(frame);
}

TEST_F(RawFile, AFileCutAnywhereIsRefusedOrReadWhole) {
  for (const bool lossless_jpeg : {false, true}) {
    const std::string bytes =
        EncodeDng(camera_, exposure_, picture_, {.lossless_jpeg = lossless_jpeg});
    for (std::size_t size = 0; size < bytes.size(); size += 1 + bytes.size() / 97) {
      const auto frame = ReadRaw(dir_.Write("cut.dng", bytes.substr(0, size)));
      ASSERT_FALSE(frame) << size << " of " << bytes.size();
      EXPECT_EQ(frame.error().kind, ErrorKind::kRefused);
      EXPECT_THAT(frame.error().code, testing::AnyOf("bad_picture", "unknown_format",
                                                     "unsupported_picture", "too_large"));
      EXPECT_THAT(frame.error().subject, HasSubstr("cut.dng"));
    }
  }
}

TEST_F(RawFile, DamagedBytesNeverCrashAReader) {
  std::uint32_t state = 1;
  const auto next = [&] { return state = state * 1664525U + 1013904223U; };
  for (const bool lossless_jpeg : {false, true}) {
    const std::string whole =
        EncodeDng(camera_, exposure_, picture_, {.lossless_jpeg = lossless_jpeg});
    for (int trial = 0; trial < 400; ++trial) {
      std::string bytes = whole;
      for (int i = 0; i < 4; ++i) bytes[(next() >> 8) % 900] = static_cast<char>(next() >> 24);
      const auto frame = ReadRaw(dir_.Write("bad.dng", bytes));
      if (frame) {
        std::visit([&](const auto& v) { EXPECT_EQ(v.width(), frame->info.width); }, frame->samples);
        continue;
      }
      EXPECT_FALSE(frame.error().code.empty());
    }
  }
}

TEST_F(RawFile, WhatIsNoRawIsNamed) {
  EXPECT_EQ(ReadRawInfo(dir_.path() + "/none.dng").error().code, "not_found");
  EXPECT_EQ(ReadRawInfo(dir_.path()).error().code, "unreadable");
  EXPECT_EQ(ReadRawInfo(dir_.Write("t.dng", "hello, world")).error().code, "unknown_format");
  EXPECT_EQ(ReadRawInfo(dir_.Write("e.dng", "")).error().code, "bad_picture");
}

// Magic Lantern's chart: ExposureTime, FNumber and ISO are 0, LibRaw says 1 s, f/1.
TEST(RawSamples, TheMagicLanternDngHasNoExposure) {
  const auto frame = ReadRaw(SampleData("raw/colorchart.dng"));
  ASSERT_TRUE(frame) << frame.error().message;
  EXPECT_FALSE(frame->info.exposure.time);
  EXPECT_FALSE(frame->info.exposure.f_number);
  EXPECT_FALSE(frame->info.exposure.iso);
  EXPECT_EQ(frame->info.width, 1734);
  EXPECT_EQ(frame->info.height, 1156);
  EXPECT_EQ(frame->info.levels->black(0, 0), 2056.0F);
  EXPECT_EQ(frame->info.levels->white[kGreenChannel], 15000.0F);
  // Its active area starts behind a masked border: the first pixel is scene, not border.
  const auto& view = std::get<View2d<const std::uint16_t>>(frame->samples);
  EXPECT_EQ(view.width(), 1734);
  EXPECT_GT(view.row_stride(), view.width());
}

TEST(RawSamples, TheKodakDc50Decodes) {
  const auto frame = ReadRaw(SampleData("raw/kodak_dc50.kdc"));
  ASSERT_TRUE(frame) << frame.error().message;
  EXPECT_EQ(frame->info.width, 768);
  EXPECT_EQ(frame->info.height, 512);
  EXPECT_NEAR(frame->info.exposure.time->value(), 1.0 / 230, 1e-4);
  EXPECT_NEAR(*frame->info.exposure.f_number, 6.2, 1e-6);
  const auto& view = std::get<View2d<const std::uint16_t>>(frame->samples);
  double sum = 0.0;
  for (int y = 0; y < view.height(); ++y) {
    for (const std::uint16_t sample : view.row(y)) {
      ASSERT_LE(sample, frame->info.levels->maximum);
      sum += sample;
    }
  }
  EXPECT_GT(sum / (768 * 512), 100.0);
}

}  // namespace
}  // namespace lightcal::devices
