// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/captures/exposure_tags.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lightcal::devices {
namespace {

FrameExposure Exposure(const WrittenExposure& written) {
  Warnings warnings;
  const FrameExposure exposure = ExposureFromTags(written, "a.dng", warnings);
  EXPECT_TRUE(warnings.empty());
  return exposure;
}

TEST(ExposureTags, ALabelAloneIsMovedToTheGridAndSaysSo) {
  const FrameExposure exposure = Exposure({.exposure_time_s = 1.0 / 60, .f_number = 5.6});
  EXPECT_DOUBLE_EQ(exposure.time->value(), 1.0 / 64);
  EXPECT_TRUE(exposure.time_snapped);
  EXPECT_DOUBLE_EQ(*exposure.f_number, std::exp2(2.5));
  EXPECT_TRUE(exposure.f_number_snapped);
  EXPECT_DOUBLE_EQ(*exposure.written.exposure_time_s, 1.0 / 60);
}

TEST(ExposureTags, ApexValuesOnTheGridWinOverLabels) {
  const FrameExposure exposure = Exposure(
      {.exposure_time_s = 1.0 / 60, .shutter_apex = 6.0, .f_number = 11, .aperture_apex = 7.0});
  EXPECT_DOUBLE_EQ(exposure.time->value(), 1.0 / 64);
  EXPECT_DOUBLE_EQ(*exposure.f_number, std::exp2(3.5));
}

TEST(ExposureTags, ApexValuesThatRepeatTheLabelAddNothing) {
  const FrameExposure exposure =
      Exposure({.exposure_time_s = 1.0 / 60, .shutter_apex = std::log2(60.0)});
  EXPECT_DOUBLE_EQ(exposure.time->value(), 1.0 / 64);
}

TEST(ExposureTags, ATimeOffEveryDialStaysAsWritten) {
  const FrameExposure exposure =
      Exposure({.exposure_time_s = 1.0 / 48, .shutter_apex = std::log2(48.0)});
  EXPECT_DOUBLE_EQ(exposure.time->value(), 1.0 / 48);
  EXPECT_FALSE(exposure.time_snapped);
}

// Magic Lantern's DNG: every tag is there and 0. LibRaw makes 1 s at f/1 of it.
TEST(ExposureTags, ZeroTagsAreAbsentNotOneSecondAtFOne) {
  const FrameExposure exposure = Exposure({.exposure_time_s = 0.0,
                                           .shutter_apex = 0.0,
                                           .f_number = 0.0,
                                           .aperture_apex = 0.0,
                                           .iso = 0.0});
  EXPECT_FALSE(exposure.time);
  EXPECT_FALSE(exposure.f_number);
  EXPECT_FALSE(exposure.iso);
}

TEST(ExposureTags, OneSecondIsBelievedWhenTheLabelSaysSo) {
  EXPECT_DOUBLE_EQ(Exposure({.exposure_time_s = 1.0, .shutter_apex = 0.0}).time->value(), 1.0);
  EXPECT_DOUBLE_EQ(Exposure({.exposure_time_s = 1.0 / 8, .shutter_apex = 0.0}).time->value(),
                   0.125);
}

TEST(ExposureTags, NothingIsMadeOfNothing) {
  const FrameExposure exposure = Exposure({});
  EXPECT_FALSE(exposure.time || exposure.f_number || exposure.iso);
  EXPECT_FALSE(Exposure({.shutter_apex = 0.0}).time);
  EXPECT_DOUBLE_EQ(Exposure({.shutter_apex = 6.33}).time->value(), std::exp2(-19.0 / 3.0));
}

TEST(ExposureTags, NonsenseIsAbsent) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  for (const double bad : {kInf, -kInf, std::nan(""), -1.0, 1e30, 1e-30}) {
    const FrameExposure exposure = Exposure({.exposure_time_s = bad, .f_number = bad, .iso = bad});
    EXPECT_FALSE(exposure.time || exposure.f_number || exposure.iso) << bad;
  }
  EXPECT_FALSE(Exposure({.shutter_apex = 4000.0}).time);
  EXPECT_FALSE(Exposure({.shutter_apex = std::nan("")}).time);
}

// A dial in half stops writes f/4.5 and Av 4.5, which is 4.757; one in thirds Av 4.333.
TEST(ExposureTags, HalfAndThirdStopsOfOneApertureAreOneValue) {
  EXPECT_DOUBLE_EQ(*Exposure({.f_number = 4.5, .aperture_apex = 4.5}).f_number, std::exp2(2.25));
  EXPECT_DOUBLE_EQ(*Exposure({.f_number = 4.5, .aperture_apex = 4.333}).f_number,
                   std::exp2(13.0 / 6.0));
  EXPECT_DOUBLE_EQ(Exposure({.exposure_time_s = 1.0 / 45, .shutter_apex = 5.3333}).time->value(),
                   std::exp2(-16.0 / 3.0));
}

TEST(ExposureTags, FNumbersThatContradictEachOtherLeaveWhatLiesBetween) {
  Warnings warnings;
  const FrameExposure exposure =
      ExposureFromTags({.f_number = 4.0, .aperture_apex = 5.0}, "a.dng", warnings);
  EXPECT_DOUBLE_EQ(*exposure.f_number, std::exp2(2.25));
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].code, "exposure_tags_disagree");
}

TEST(ExposureTags, TimesThatContradictEachOtherAreNamedAndNeitherIsBelieved) {
  Warnings warnings;
  const FrameExposure exposure =
      ExposureFromTags({.exposure_time_s = 1.0 / 60, .shutter_apex = 3.0}, "a.dng", warnings);
  EXPECT_FALSE(exposure.time);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].code, "exposure_tags_disagree");
  EXPECT_EQ(warnings[0].subject, "a.dng");
  EXPECT_THAT(warnings[0].message, testing::HasSubstr("0.125"));
}

TEST(ExposureTags, ExifTimesBecomeIsoTimes) {
  EXPECT_EQ(IsoTimeFromExif("2026:11:21 12:00:01"), "2026-11-21T12:00:01");
  EXPECT_EQ(IsoTimeFromExif("0000:00:00 00:00:00"), "");
  EXPECT_EQ(IsoTimeFromExif("yesterday, at noon, sharp"), "");
  EXPECT_EQ(IsoTimeFromExif(""), "");
}

}  // namespace
}  // namespace lightcal::devices
