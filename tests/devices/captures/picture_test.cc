// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/captures/picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "lightcal_devices/captures/radiance_header.h"
#include "run_cli.h"

// OpenImageIO's PNG reader leaks where libpng jumps out of a damaged file.
extern "C" const char* __lsan_default_suppressions();   // NOLINT(bugprone-reserved-identifier)
extern "C" const char* __lsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier)
  return "leak:libOpenImageIO";
}

namespace lightcal::devices {
namespace {

using test::SampleData;
using test::TempDir;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

Frame Read(const std::string& path) {
  auto frame = ReadPicture(path);
  EXPECT_TRUE(frame) << frame.error().code << ": " << frame.error().message;
  return frame ? *frame : Frame{};
}
const View2d<const float>& Floats(const Frame& frame) {
  return std::get<View2d<const float>>(frame.samples);
}
const View2d<const std::uint16_t>& Codes(const Frame& frame) {
  return std::get<View2d<const std::uint16_t>>(frame.samples);
}

// Mean luminance of an RGB picture by Rec. 709's weights.
double MeanLuminance(const Frame& frame) {
  const auto& view = Floats(frame);
  double sum = 0.0;
  for (int y = 0; y < view.height(); ++y) {
    for (int x = 0; x < view.width(); ++x) {
      sum += 0.2126 * view(x, y, 0) + 0.7152 * view(x, y, 1) + 0.0722 * view(x, y, 2);
    }
  }
  return sum / (view.width() * view.height());
}

// The value published with the pictures: mean Y 0.284656.
TEST(ExrPictures, RgbAndLuminanceChromaGiveOneLuminance) {
  const Frame rgb = Read(SampleData("pictures/exr/Rec709.exr"));
  const Frame yc = Read(SampleData("pictures/exr/Rec709_YC.exr"));
  EXPECT_EQ(rgb.info.width, yc.info.width);
  EXPECT_THAT(yc.info.channel_names, ElementsAre("R", "G", "B"));
  EXPECT_FALSE(rgb.info.chromaticities);
  EXPECT_NEAR(MeanLuminance(rgb), 0.284656, 1e-6);
  EXPECT_NEAR(MeanLuminance(yc) / MeanLuminance(rgb), 1.0, 1e-3);
}

class ExrRoundTrip : public testing::Test {
 protected:
  ExrRoundTrip() : samples_(7 * 5 * 3) {
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      samples_[i] = static_cast<float>(
          std::ldexp(1.0 + 0.01 * static_cast<double>(i), static_cast<int>(i % 40) - 20));
    }
    samples_[4] = -0.25F;  // noise below black stays
    picture_.samples = View2d<const float>(samples_.data(), 7, 5, 3);
    picture_.channel_names = {"R", "G", "B"};
  }
  std::vector<float> samples_;
  ExrPicture picture_;
  TempDir dir_;
  std::string path_ = dir_.path() + "/a.exr";
};

TEST_F(ExrRoundTrip, FloatsColourSpaceAndProvenanceComeBack) {
  picture_.chromaticities = PrimariesOf(RgbSpace::kAcescg);
  picture_.white_luminance = Nits(1.0);
  picture_.attributes = {{"generator", "lightcal test"}, {"scale", "iso_prior"}};
  for (const bool compressed : {true, false}) {
    picture_.compressed = compressed;
    ASSERT_TRUE(WriteExr(path_, picture_));
    const Frame frame = Read(path_);
    ASSERT_EQ(frame.info.channels, 3);
    for (int y = 0; y < 5; ++y) {
      for (std::size_t i = 0; i < 21; ++i) {
        EXPECT_EQ(Floats(frame).row(y)[i], samples_[y * 21 + i]);
      }
    }
    EXPECT_NEAR(frame.info.chromaticities->red.x, PrimariesOf(RgbSpace::kAcescg).red.x, 1e-6);
    EXPECT_DOUBLE_EQ(frame.info.white_luminance->value(), 1.0);
    EXPECT_THAT(frame.info.lightcal_attributes,
                ElementsAre(testing::Pair("generator", "lightcal test"),
                            testing::Pair("scale", "iso_prior")));
  }
  EXPECT_THAT(test::ReadFile(path_).substr(0, 4096), HasSubstr("lightcal"));
}

TEST_F(ExrRoundTrip, TheSamePictureIsTheSameBytes) {
  ASSERT_TRUE(WriteExr(path_, picture_));
  const std::string first = test::ReadFile(path_);
  ASSERT_TRUE(WriteExr(path_, picture_));
  EXPECT_EQ(test::ReadFile(path_), first);
}

TEST_F(ExrRoundTrip, ARegionOfALargerPictureIsWrittenAsItself) {
  picture_.samples = picture_.samples.Crop(2, 1, 3, 2);
  ASSERT_TRUE(WriteExr(path_, picture_));
  const Frame frame = Read(path_);
  EXPECT_EQ(frame.info.width, 3);
  EXPECT_EQ(frame.info.height, 2);
  EXPECT_EQ(Floats(frame)(0, 0, 0), samples_[1 * 21 + 2 * 3]);
  EXPECT_EQ(Floats(frame)(2, 1, 2), samples_[2 * 21 + 4 * 3 + 2]);
}

TEST_F(ExrRoundTrip, LuminanceAloneIsOneChannel) {
  picture_.samples = View2d<const float>(samples_.data(), 15, 7);
  picture_.channel_names = {"Y"};
  ASSERT_TRUE(WriteExr(path_, picture_));
  const Frame frame = Read(path_);
  EXPECT_EQ(frame.info.channels, 1);
  EXPECT_THAT(frame.info.channel_names, ElementsAre("Y"));
  EXPECT_EQ(Floats(frame)(14, 6), samples_[104]);
}

TEST_F(ExrRoundTrip, ChromaticitiesThatMakeNoSpaceAreRefused) {
  const Xy one{0.3, 0.3};
  picture_.chromaticities = RgbPrimaries{one, one, one, one};
  ASSERT_TRUE(WriteExr(path_, picture_));
  EXPECT_EQ(ReadPictureInfo(path_).error().code, "unsupported_picture");
}

TEST_F(ExrRoundTrip, ALayerIsTakenAndNamedAndDepthIsNoPicture) {
  picture_.channel_names = {"key.R", "key.G", "key.B"};
  ASSERT_TRUE(WriteExr(path_, picture_));
  const auto info = ReadPictureInfo(path_);
  ASSERT_TRUE(info);
  ASSERT_EQ(info->warnings.size(), 1U);
  EXPECT_EQ(info->warnings[0].code, "layer_chosen");
  picture_.channel_names = {"Z", "N", "V"};
  ASSERT_TRUE(WriteExr(path_, picture_));
  EXPECT_EQ(ReadPictureInfo(path_).error().code, "no_color_channels");
}

TEST_F(ExrRoundTrip, WhatNoLightHasIsNeitherWrittenNorRead) {
  for (const float bad : {std::nanf(""), std::numeric_limits<float>::infinity(), 1e31F, -1e31F}) {
    samples_[40] = bad;
    const auto written = WriteExr(path_, picture_);
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, "bad_samples");
    EXPECT_THAT(written.error().message, HasSubstr("pixel 6,1"));
  }
  // A value inside the range, made infinite behind the writer's back.
  samples_[40] = 1.5e29F;
  picture_.compressed = false;
  ASSERT_TRUE(WriteExr(path_, picture_));
  std::string bytes = test::ReadFile(path_);
  const float good = 1.5e29F, infinite = std::numeric_limits<float>::infinity();
  const std::size_t at = bytes.find(std::string(reinterpret_cast<const char*>(&good), 4));
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, 4, reinterpret_cast<const char*>(&infinite), 4);
  const auto read = ReadPicture(dir_.Write("inf.exr", bytes));
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, "bad_samples");
  EXPECT_THAT(read.error().message, HasSubstr("1 infinite; the first at pixel 6,1"));
}

TEST_F(ExrRoundTrip, APlaceThatCannotBeWrittenIsNamed) {
  const auto written = WriteExr(dir_.path() + "/no/such/folder/a.exr", picture_);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, "unwritable");
}

// The ramps: (x + y in green)/(48 + 32) of the top code, red and blue without the y.
TEST(OtherPictures, CodesAreThoseInTheFile) {
  const Frame png = Read(SampleData("pictures/own/ramp_16bit.png"));
  EXPECT_EQ(png.info.format, "png");
  EXPECT_EQ(png.info.channels, 1);
  EXPECT_EQ(png.info.meaning, SampleMeaning::kEncoded);
  EXPECT_EQ(png.info.levels->maximum, 65535.0F);
  EXPECT_EQ(Codes(png)(40, 9), std::lround(65535.0 * 40 / 80));
  const Frame tiff = Read(SampleData("pictures/own/ramp_16bit.tif"));
  EXPECT_EQ(Codes(tiff)(40, 9, kGreenChannel), std::lround(65535.0 * 49 / 80));
  // Alpha 0.5 is left out, and not multiplied in.
  const Frame alpha = Read(SampleData("pictures/own/ramp_8bit_alpha.png"));
  EXPECT_EQ(alpha.info.channels, 3);
  EXPECT_EQ(alpha.info.levels->maximum, 255.0F);
  EXPECT_NEAR(Codes(alpha)(40, 9, kGreenChannel), 255.0 * 49 / 80, 1.0);
  const Frame jpeg = Read(SampleData("pictures/own/ramp_8bit.jpg"));
  EXPECT_NEAR(Codes(jpeg)(40, 9, kGreenChannel), 255.0 * 49 / 80, 6.0);
}

TEST(OtherPictures, FloatTiffIsLinear) {
  const Frame frame = Read(SampleData("pictures/own/ramp_float.tif"));
  EXPECT_EQ(frame.info.meaning, SampleMeaning::kLinear);
  EXPECT_NEAR(Floats(frame)(40, 9, kGreenChannel), 1000.0 * 49 / 80, 1e-3);
  EXPECT_FALSE(frame.info.levels);
}

TEST(OtherPictures, ExifOfJpegAndPngIsRead) {
  for (const char* name : {"ramp_8bit.jpg", "ramp_16bit.png", "ramp_16bit.tif"}) {
    const auto info = ReadPictureInfo(SampleData(std::string("pictures/own/") + name));
    ASSERT_TRUE(info) << name;
    if (!info->exposure.time) continue;  // asserted for the JPEG below
    EXPECT_DOUBLE_EQ(info->exposure.time->value(), 1.0 / 64) << name;
    EXPECT_DOUBLE_EQ(*info->exposure.f_number, std::exp2(2.5)) << name;
  }
  const auto jpeg = ReadPictureInfo(SampleData("pictures/own/ramp_8bit.jpg"));
  EXPECT_TRUE(jpeg->exposure.time);
  EXPECT_DOUBLE_EQ(*jpeg->exposure.iso, 200.0);
  EXPECT_NEAR(jpeg->focal_length->value(), 0.05, 1e-9);
  EXPECT_EQ(jpeg->camera, "Synthetic One");
  EXPECT_EQ(jpeg->time, "2026-11-21T12:00:00");
}

TEST(OtherPictures, ARealPngBracketTellsItsExposures) {
  // 1/50, 1/13, 0.4 s at f/8, ISO 800 (Nikon D40).
  const std::pair<const char*, double> thirds[] = {
      {"parliament_0.png", -17}, {"parliament_1.png", -11}, {"parliament_2.png", -4}};
  for (const auto& [name, third] : thirds) {
    const auto info = ReadPictureInfo(SampleData("pictures/png_bracket") + "/" + name);
    ASSERT_TRUE(info);
    EXPECT_NEAR(info->exposure.time->value(), std::exp2(third / 3.0), 1e-9);
    EXPECT_DOUBLE_EQ(*info->exposure.f_number, 8.0);
    EXPECT_DOUBLE_EQ(*info->exposure.iso, 800.0);
  }
}

std::string FlatHdr(const std::string& header, unsigned char r, unsigned char e) {
  std::string bytes = header + "\n-Y 4 +X 4\n";
  for (int i = 0; i < 16; ++i) {
    for (const unsigned char b : {r, r, r, e}) bytes.push_back(static_cast<char>(b));
  }
  return bytes;
}

TEST(RadiancePictures, ExposureLinesMultiplyAndZeroPrimariesAreNone) {
  const TempDir dir;
  const Frame frame = Read(dir.Write(
      "a.hdr", FlatHdr("#?RADIANCE\nEXPOSURE=2\nEXPOSURE= 0.25\nPRIMARIES=0 0 0 0 0 0 0 0\n"
                       "FORMAT=32-bit_rle_rgbe\n",
                       128, 129)));
  EXPECT_EQ(frame.info.format, "hdr");
  EXPECT_DOUBLE_EQ(frame.info.radiance_exposure, 0.5);
  EXPECT_FALSE(frame.info.chromaticities);
  EXPECT_DOUBLE_EQ(Floats(frame)(3, 3, 0), 128.5 / 256.0 * 2.0);
}

TEST(RadiancePictures, AdobesHeaderIsReadAndPixelsAreWhereTheyAre) {
  const Frame frame = Read(SampleData("pictures/latlong/studio.hdr"));
  EXPECT_EQ(frame.info.width, 1024);
  EXPECT_EQ(frame.info.height, 512);
  EXPECT_FALSE(frame.info.chromaticities);
  EXPECT_DOUBLE_EQ(frame.info.radiance_exposure, 1.0);
  // The published brightest pixel.
  const auto& view = Floats(frame);
  const auto luminance = [&](int x, int y) {
    return 0.2126 * view(x, y, 0) + 0.7152 * view(x, y, 1) + 0.0722 * view(x, y, 2);
  };
  double most = 0.0;
  for (int y = 0; y < 512; ++y) {
    for (int x = 0; x < 1024; ++x) most = std::max(most, luminance(x, y));
  }
  EXPECT_DOUBLE_EQ(luminance(235, 133), most);
}

TEST(RadianceHeaders, PrimariesAndFormatAreRead) {
  const auto header = ParseRadianceHeader(
      "#?RADIANCE\nPRIMARIES= .64 .33 .29 .6 .15 .06 .333 .333\r\nFORMAT=32-bit_rle_xyze\n\n-Y 1",
      "a");
  ASSERT_TRUE(header);
  EXPECT_DOUBLE_EQ(header->primaries->green.x, 0.29);
  EXPECT_TRUE(header->xyz);
}

TEST(RadianceHeaders, WhatCannotBeMeantIsRefused) {
  const auto code = [](const std::string& line) {
    const auto header = ParseRadianceHeader("#?RADIANCE\n" + line + "\n\n", "a.hdr");
    return header ? std::string("read") : header.error().code;
  };
  EXPECT_EQ(code("EXPOSURE=0"), "bad_picture");
  EXPECT_EQ(code("EXPOSURE=-1"), "bad_picture");
  EXPECT_EQ(code("EXPOSURE=bright"), "bad_picture");
  EXPECT_EQ(code("EXPOSURE=1e-200\nEXPOSURE=1e-200"), "bad_picture");
  EXPECT_EQ(code("EXPOSURE=1e300\nEXPOSURE=1e300"), "bad_picture");
  EXPECT_EQ(code("PRIMARIES=1 2 3"), "bad_picture");
  EXPECT_EQ(code("PRIMARIES=.3 .3 .3 .3 .3 .3 .3 .3"), "bad_picture");
  EXPECT_EQ(code("PRIMARIES=.64 .33 .29 .6 .15 .06 .333 0"), "bad_picture");
  EXPECT_EQ(code("PRIMARIES=1 0 0 1 0 0 .333 .333"), "read");  // XYZ's own
  EXPECT_EQ(code("COLORCORR=1 1 2"), "unsupported_picture");
  EXPECT_EQ(code("COLORCORR=1 1 1"), "read");
  EXPECT_EQ(code("# a remark\nVIEW= -vtv"), "read");
  EXPECT_EQ(ParseRadianceHeader("#?RADIANCE\nEXPOSURE=1\n", "a").error().code, "bad_picture");
  EXPECT_EQ(ParseRadianceHeader("", "a").error().code, "bad_picture");
}

// A pixel of the file is (m + 1/2) 2^(e - 136): 0 where e is 0, half a step where m is.
TEST(RadiancePictures, ASampleIsHalfAStepAboveItsMantissaWhateverWayItIsWritten) {
  const std::string head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
  const TempDir dir;
  const auto expect = [&](const char* name, const std::string& size, const std::string& rows,
                          int width, int height, const std::vector<int>& mantissas) {
    const Frame frame = Read(dir.Write(name, head + size + "\n" + rows));
    ASSERT_EQ(frame.info.width, width) << name;
    ASSERT_EQ(frame.info.height, height) << name;
    for (int i = 0; i < width * height; ++i) {
      const double step = std::ldexp(1.0, 130 - 136);
      EXPECT_EQ(Floats(frame)(i % width, i / width, 0), (mantissas[i] + 0.5) * step) << name << i;
      EXPECT_EQ(Floats(frame)(i % width, i / width, 2), 0.5 * step) << name << i;
    }
  };
  const auto pixel = [](int m) { return std::string{static_cast<char>(m), 4, 0, '\x82'}; };
  const std::string six = pixel(10) + pixel(20) + pixel(30) + pixel(40) + pixel(50) + pixel(60);
  expect("flat.pic", "-Y 2 +X 3", six, 3, 2, {10, 20, 30, 40, 50, 60});
  expect("up.hdr", "+Y 2 -X 3", six, 3, 2, {60, 50, 40, 30, 20, 10});
  expect("turned.hdr", "+X 3 -Y 2", six, 3, 2, {10, 30, 50, 20, 40, 60});
  const std::string again{1, 1, 1, 2};
  expect("old.hdr", "-Y 2 +X 3", pixel(10) + again + pixel(40) + again, 3, 2,
         {10, 10, 10, 40, 40, 40});
  std::string runs{2, 2, 0, 8};  // red: a run of 5 and three alone; the others runs of 8
  runs += std::string{'\x85', 7, 3, 1, 2, 3};
  runs += std::string{'\x88', 4, '\x88', 0, '\x88', '\x82'};
  expect("new.hdr", "-Y 1 +X 8", runs, 8, 1, {7, 7, 7, 7, 7, 1, 2, 3});

  const Frame dark = Read(dir.Write("dark.hdr", head + "-Y 1 +X 1\n" + std::string(4, '\0')));
  EXPECT_EQ(Floats(dark)(0, 0, 0), 0.0F);
  for (const std::string& cut :
       {runs.substr(0, 9), std::string{2, 2, 0, 9}, std::string("\x01\x01\x01\x02")}) {
    const auto frame = ReadPicture(dir.Write("cut.hdr", head + "-Y 1 +X 8\n" + cut));
    ASSERT_FALSE(frame);
    EXPECT_EQ(frame.error().code, "bad_picture");
  }
}

TEST(RadianceHeaders, ViewLinesSayHowThePictureWasProjected) {
  const auto view = [](const std::string& lines) {
    return *ParseRadianceHeader("#?RADIANCE\n" + lines + "\n\n", "a.hdr");
  };
  const auto fisheye = view("VIEW= -vta -vh 180 -vv 182 -vp 0 0 0");
  ASSERT_TRUE(fisheye.view);
  EXPECT_EQ(fisheye.view->projection, Projection::kEquidistant);
  EXPECT_NEAR(DegreesFromRadians(fisheye.view->field_of_view), 180.0, 1e-12);
  EXPECT_NEAR(DegreesFromRadians(view("VIEW= -vta -vv 182").view->field_of_view), 182.0, 1e-12);
  const auto later = view("VIEW= -vta -vv 182\nVIEW= -vtv -vh 60 -vv 40");
  EXPECT_EQ(later.view->projection, Projection::kRectilinear);
  EXPECT_NEAR(DegreesFromRadians(later.view->field_of_view), 60.0, 1e-12);
  EXPECT_FALSE(view("VIEW= -vth -vh 180 -vv 180").view);
  EXPECT_TRUE(view("VIEW= -vth -vh 180 -vv 180").unknown_view);
  EXPECT_FALSE(view("\tVIEW= -vta -vv 180").view);  // of an earlier picture
  EXPECT_FALSE(view("EXPOSURE=1").unknown_view);
}

// All samples of either kind.
std::vector<double> AllSamples(const Frame& frame) {
  return std::visit(
      [](const auto& view) {
        std::vector<double> all;
        for (int y = 0; y < view.height(); ++y) {
          all.insert(all.end(), view.row(y).begin(), view.row(y).end());
        }
        return all;
      },
      frame.samples);
}

TEST(HostilePictures, AFileCutAnywhereIsRefusedUnlessItsSamplesAreWhole) {
  const TempDir dir;
  for (const char* name :
       {"own/ramp_8bit.jpg", "own/ramp_8bit_alpha.png", "own/ramp_16bit.png", "own/ramp_16bit.tif",
        "own/ramp_float.tif", "png_bracket/parliament_2.png", "exr/Rec709_YC.exr"}) {
    const std::string path = SampleData(std::string("pictures/") + name);
    const std::string bytes = test::ReadFile(path);
    const std::vector<double> whole = AllSamples(Read(path));
    for (std::size_t size = 0; size < bytes.size() - 16; size += 1 + bytes.size() / 23) {
      const auto frame = ReadPicture(dir.Write("cut", bytes.substr(0, size)));
      if (frame) {  // a TIFF may lose tags that stand behind its samples
        EXPECT_EQ(AllSamples(*frame), whole) << name << ", " << size << " of " << bytes.size();
        continue;
      }
      EXPECT_EQ(frame.error().kind, ErrorKind::kRefused);
      EXPECT_FALSE(frame.error().message.empty());
    }
  }
}

TEST(HostilePictures, DamagedBytesNeverCrashAReader) {
  const TempDir dir;
  std::uint32_t state = 7;
  const auto next = [&] { return state = state * 1664525U + 1013904223U; };
  for (const char* name : {"own/ramp_8bit.jpg", "own/ramp_8bit_alpha.png", "own/ramp_16bit.tif"}) {
    const std::string whole = test::ReadFile(SampleData(std::string("pictures/") + name));
    for (int trial = 0; trial < 60; ++trial) {
      std::string bytes = whole;
      for (int i = 0; i < 4; ++i) {
        bytes[4 + (next() >> 8) % (bytes.size() - 4)] = static_cast<char>(next() >> 24);
      }
      const auto frame = ReadPicture(dir.Write("bad", bytes));
      EXPECT_TRUE(frame || !frame.error().code.empty());
    }
  }
}

TEST(HostilePictures, WhatIsNoPictureIsNamed) {
  const TempDir dir;
  EXPECT_EQ(ReadPicture(dir.path() + "/none.exr").error().code, "not_found");
  EXPECT_EQ(ReadPicture(dir.path()).error().code, "unreadable");
  EXPECT_EQ(ReadPicture(dir.Write("a.png", "")).error().code, "bad_picture");
  EXPECT_EQ(ReadPicture(dir.Write("a.txt", "light")).error().code, "unknown_format");
  EXPECT_EQ(ReadPicture(dir.Write("a.exr", std::string("\x76\x2f\x31\x01", 4))).error().code,
            "bad_picture");
}

TEST(HostilePictures, APictureOfAbsurdSizeIsRefusedBeforeMemoryIsAskedFor) {
  const TempDir dir;
  std::string bytes = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 60000 +X 60000\n";
  const auto frame = ReadPicture(dir.Write("big.hdr", bytes));
  ASSERT_FALSE(frame);
  EXPECT_EQ(frame.error().code, "too_large");
}

}  // namespace
}  // namespace lightcal::devices
