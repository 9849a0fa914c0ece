// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/scene/patches.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "lightcal/imaging/scene/picture_luminance.h"

namespace lightcal {
namespace {

TEST(MeasureRegion, StatisticsAreThoseOfTheRegionAlone) {
  const std::vector<float> nits = {9, 9, 9, 9,  //
                                   9, 1, 2, 9,  //
                                   9, 4, 9, 9,  //
                                   9, 9, 9, 99};
  const View2d<const float> view(nits.data(), 4, 4);
  const auto got = MeasureRegion(view, {1, 1, 2, 2});
  ASSERT_TRUE(got);
  EXPECT_DOUBLE_EQ(got->min.value(), 1.0);
  EXPECT_DOUBLE_EQ(got->max.value(), 9.0);
  EXPECT_DOUBLE_EQ(got->mean.value(), 4.0);
  EXPECT_DOUBLE_EQ(got->median.value(), 3.0);
  EXPECT_NEAR(got->sd_relative, std::sqrt((9.0 + 4.0 + 0.0 + 25.0) / 4.0) / 4.0, 1e-12);
  EXPECT_EQ(got->peak_x, 2);
  EXPECT_EQ(got->peak_y, 2);
  EXPECT_EQ(MeasureRegion(view, {0, 0, 4, 4})->peak_y, 3);
  EXPECT_DOUBLE_EQ(MeasureRegion(view, {0, 0, 3, 1})->median.value(), 9.0);
  EXPECT_EQ(MeasureRegion(view, {0, 0, 4, 1})->peak_x, 0);  // the first of equals
}

TEST(MeasureRegion, RegionsOutsideThePictureAreRefused) {
  const std::vector<float> nits(12);
  const View2d<const float> view(nits.data(), 4, 3);
  for (const Region region :
       {Region{-1, 0, 2, 2}, Region{3, 0, 2, 1}, Region{0, 2, 1, 2}, Region{0, 0, 0, 1},
        Region{2147483647, 0, 1, 1}, Region{1, 1, 2147483647, 2147483647}}) {
    const auto got = MeasureRegion(view, region);
    ASSERT_FALSE(got);
    EXPECT_EQ(got.error().code, "bad_region");
  }
}

TEST(MeasureIlluminance, AUniformSkyGivesPiAndHalfOfItHalf) {
  const std::vector<float> nits(64 * 32, 100.0F);
  const View2d<const float> view(nits.data(), 64, 32);
  const auto angles = PixelSolidAngles::Create({Projection::kLatLong, 64, 32, {}});
  const auto whole = MeasureIlluminance(view, *angles, {0, 0, 64, 32});
  ASSERT_TRUE(whole);
  EXPECT_NEAR(whole->illuminance.value(), 100.0 * std::numbers::pi, 1e-9);
  EXPECT_NEAR(whole->solid_angle.value(), 4.0 * std::numbers::pi, 1e-9);
  const auto half = MeasureIlluminance(view, *angles, {0, 0, 32, 32});
  EXPECT_NEAR(half->illuminance.value(), 50.0 * std::numbers::pi, 1e-9);
  const auto other = PixelSolidAngles::Create({Projection::kLatLong, 32, 16, {}});
  EXPECT_EQ(MeasureIlluminance(view, *other, {0, 0, 1, 1}).error().code, "bad_view");
}

Frame FrameOf(std::vector<float> samples, int width, int height, int channels) {
  auto owner = std::make_shared<std::vector<float>>(std::move(samples));
  Frame frame;
  frame.info.file = "a.exr";
  frame.info.format = "exr";
  frame.info.width = width;
  frame.info.height = height;
  frame.info.channels = channels;
  frame.samples = View2d<const float>(owner->data(), width, height, channels);
  frame.owner = owner;
  return frame;
}

TEST(LuminanceOfPicture, WeightsAreRec709sUnlessTheFileNamesItsOwn) {
  Frame frame = FrameOf({1, 0, 0, 0, 1, 0, 0, 0, 1}, 3, 1, 3);
  auto got = LuminanceOfPicture(frame);
  ASSERT_TRUE(got);
  EXPECT_NEAR(got->nits[0], 0.2126, 1e-4);  // ITU-R BT.709
  EXPECT_NEAR(got->nits[1], 0.7152, 1e-4);
  EXPECT_NEAR(got->nits[2], 0.0722, 1e-4);
  EXPECT_EQ(got->scale, "assumed_nits");
  ASSERT_EQ(got->warnings.size(), 1U);
  EXPECT_EQ(got->warnings[0].code, "relative_scale");

  frame.info.chromaticities = PrimariesOf(RgbSpace::kAcescg);
  frame.info.white_luminance = Nits(100.0);
  got = LuminanceOfPicture(frame);
  EXPECT_NEAR(got->nits[0], 27.2229, 1e-3);  // S-2014-004: .2722287
  EXPECT_NEAR(got->nits[1], 67.4082, 1e-3);
  EXPECT_EQ(got->scale, "white_luminance");
  EXPECT_TRUE(got->warnings.empty());
}

TEST(LuminanceOfPicture, RadiancesConventionIsItsOwn) {
  Frame frame = FrameOf({1, 0, 0, 0, 1, 0, 0, 0, 1}, 3, 1, 3);
  frame.info.radiance_exposure = 0.5;
  const auto got = LuminanceOfPicture(frame, LuminanceConvention::kRadiance);
  ASSERT_TRUE(got);
  EXPECT_NEAR(got->nits[0], 2.0 * 179.0 * 0.265, 1e-3);
  EXPECT_NEAR(got->nits[1], 2.0 * 179.0 * 0.670, 1e-3);
  EXPECT_NEAR(got->nits[2], 2.0 * 179.0 * 0.065, 1e-3);
  EXPECT_EQ(got->scale, "radiance_179");
  EXPECT_NEAR(LuminanceOfPicture(frame, LuminanceConvention::kRadiometric)->nits[1],
              2.0 * 683.0 * 0.7152, 0.1);
}

TEST(LuminanceOfPicture, AScaleThatNoNumberHoldsIsRefused) {
  Frame frame = FrameOf({1e30F}, 1, 1, 1);
  frame.info.white_luminance = Nits(1e30);
  EXPECT_EQ(LuminanceOfPicture(frame).error().code, "over_range");
  frame.info.white_luminance.reset();
  frame.info.radiance_exposure = 1e-29;
  EXPECT_EQ(LuminanceOfPicture(frame).error().code, "over_range");
}

TEST(LuminanceOfPicture, OneChannelIsLuminanceAndXyzIsItsY) {
  EXPECT_FLOAT_EQ(LuminanceOfPicture(FrameOf({3, 4}, 2, 1, 1))->nits[1], 4.0F);
  Frame frame = FrameOf({1, 5, 9}, 1, 1, 3);
  frame.info.channel_names = {"X", "Y", "Z"};
  EXPECT_FLOAT_EQ(LuminanceOfPicture(frame)->nits[0], 5.0F);
}

TEST(LuminanceOfPicture, SensorValuesAndCodesAreNoLuminance) {
  Frame frame = FrameOf({1, 2}, 2, 1, 1);
  frame.info.meaning = SampleMeaning::kEncoded;
  EXPECT_EQ(LuminanceOfPicture(frame).error().code, "not_linear");
  EXPECT_EQ(LuminanceOfPicture(FrameOf({1, 2}, 1, 1, 2)).error().code, "no_colour");
}

}  // namespace
}  // namespace lightcal
