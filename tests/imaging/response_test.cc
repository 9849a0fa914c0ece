// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/response.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace lightcal {
namespace {

using Curve = std::function<double(double)>;  // signal 0..1 -> code 0..1

// sRGB's own curve, and one with the shoulder and toe of a camera's picture style.
double SrgbCurve(double x) {
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
}
double LinearCurve(double x) { return x; }
double FilmCurve(double x) { return std::pow(x, 0.9) / (std::pow(x, 0.9) + 0.18) * 1.18; }

Frame FrameOf(const std::vector<std::uint16_t>& codes, int width, int height, int top) {
  const auto owner = std::make_shared<const std::vector<std::uint16_t>>(codes);
  Frame frame;
  frame.info.file = "frame.png";
  frame.info.width = width;
  frame.info.height = height;
  frame.info.meaning = SampleMeaning::kEncoded;
  SensorLevels levels;
  levels.black = {1, 1, {0.0F}};
  levels.white.fill(static_cast<float>(top));
  frame.info.levels = levels;
  frame.samples = View2d<const std::uint16_t>(owner->data(), width, height);
  frame.owner = owner;
  return frame;
}

// A scene over five decades, seen with 1 % noise.
std::vector<Frame> Shoot(const Curve& curve, const std::vector<double>& exposures, int top) {
  constexpr int width = 200, height = 150;
  std::mt19937_64 random(7);
  std::normal_distribution<double> noise(0.0, 0.01);
  std::vector<Frame> frames;
  for (const double exposure : exposures) {
    std::vector<std::uint16_t> codes;
    for (int i = 0; i < width * height; ++i) {
      const double scene = std::pow(10.0, -3.0 + 3.5 * i / (width * height));
      const double signal = scene * exposure * (1.0 + noise(random));
      codes.push_back(
          static_cast<std::uint16_t>(std::lround(top * curve(std::clamp(signal, 0.0, 1.0)))));
    }
    frames.push_back(FrameOf(codes, width, height, top));
  }
  return frames;
}

struct Style {
  std::string name;
  Curve curve;
  int top;
};
void PrintTo(const Style& style, std::ostream* out) { *out << style.name; }

class Response : public testing::TestWithParam<Style> {};

TEST_P(Response, IsRecoveredToThreePercentOverTheMiddleCodesAndIncreases) {
  const std::vector<double> exposures = {0.25, 1.0, 4.0, 16.0};
  const auto frames = Shoot(GetParam().curve, exposures, GetParam().top);
  const auto curves = RecoverResponse(frames, exposures);
  ASSERT_TRUE(curves.has_value()) << curves.error().message;
  const auto& signal = curves->curves.signal_of_code[0];
  ASSERT_EQ(signal.size(), static_cast<std::size_t>(GetParam().top) + 1);
  for (std::size_t code = 1; code < signal.size(); ++code) {
    ASSERT_GT(signal[code], signal[code - 1]) << code;
  }
  // The curve is known up to a factor: compare with a middle signal.
  const auto code_of = [&](double x) {
    return static_cast<std::size_t>(std::lround(GetParam().top * GetParam().curve(x)));
  };
  const double factor = signal[code_of(0.3)] / 0.3;
  for (const double x : {0.02, 0.05, 0.1, 0.2, 0.4, 0.6, 0.8}) {
    EXPECT_NEAR(signal[code_of(x)] / factor / x, 1.0, 0.03) << x;
  }
}

INSTANTIATE_TEST_SUITE_P(Styles, Response,
                         testing::Values(Style{"srgb", SrgbCurve, 255},
                                         Style{"film", FilmCurve, 255},
                                         Style{"linear_16_bit", LinearCurve, 65535},
                                         Style{"film_16_bit", FilmCurve, 65535}),
                         [](const auto& style) { return style.param.name; });

TEST(RecoverResponse, OneFrameTellsNoCurve) {
  const auto frames = Shoot(SrgbCurve, {1.0}, 255);
  const auto curves = RecoverResponse(frames, std::vector<double>{1.0});
  ASSERT_FALSE(curves.has_value());
  EXPECT_EQ(curves.error().code, "no_response");
}

TEST(RecoverResponse, FramesThatShareNothingTellNoCurve) {
  const std::vector<double> exposures = {1e-3, 1e3};
  const auto curves = RecoverResponse(Shoot(SrgbCurve, exposures, 255), exposures);
  ASSERT_FALSE(curves.has_value());
  EXPECT_EQ(curves.error().code, "no_response");
}

// A curve would be found for any order: codes that fall under more light refuse it.
TEST(RecoverResponse, ExposuresInAnotherOrderAreRefused) {
  const std::vector<double> exposures = {0.25, 1.0, 4.0, 16.0};
  for (const Curve& curve : {Curve(SrgbCurve), Curve(LinearCurve)}) {
    const auto frames = Shoot(curve, exposures, 255);
    for (const std::vector<double>& given :
         {std::vector{16.0, 4.0, 1.0, 0.25}, {0.25, 4.0, 1.0, 16.0}, {1.0, 4.0, 16.0, 0.25}}) {
      const auto curves = RecoverResponse(frames, given);
      ASSERT_FALSE(curves.has_value());
      EXPECT_EQ(curves.error().code, "exposures_disagree");
    }
  }
}

// A world of five frames one of whose labels is wrong by up to a stop: the exposures come back.
TEST(RecoverResponse, AnOddLabelIsMeasured) {
  const std::vector<double> exposures = {0.0625, 0.25, 1.0, 4.0, 16.0};
  for (const Curve& curve : {Curve(SrgbCurve), Curve(FilmCurve)}) {
    const auto frames = Shoot(curve, exposures, 255);
    for (std::size_t odd = 0; odd < exposures.size(); ++odd) {
      for (const double factor : {0.5, 0.75, 1.33, 2.0}) {
        std::vector<double> given = exposures;
        given[odd] *= factor;
        const auto recovered = RecoverResponse(frames, given);
        ASSERT_TRUE(recovered.has_value());
        const CodeExposures& found = recovered->exposures;
        for (std::size_t i = 1; i < exposures.size(); ++i) {
          EXPECT_NEAR(found.ln_exposure[i] - found.ln_exposure[i - 1], std::log(4.0), 0.02)
              << i << " of " << odd << " times " << factor;
        }
        EXPECT_NEAR(found.off[odd], -std::log(factor), 0.02) << odd;
        EXPECT_LT(found.power_sd, 0.02) << odd;
      }
    }
  }
}

// A disc of .14 to .2 before a ground of .004 to .02, of a film's curve: they share few codes, and
// some other exposures agree as well with another bend. True labels stand; an odd one does not.
TEST(RecoverResponse, TrueLabelsStandWhereFewCodesAreShared) {
  constexpr int width = 160, height = 120;
  for (const Curve& curve : {Curve(SrgbCurve), Curve(FilmCurve)}) {
    for (const std::vector<double>& exposures :
         {std::vector{1.0, 4.0, 16.0}, std::vector{0.25, 1.0, 4.0, 16.0, 64.0}}) {
      std::mt19937_64 random(8);
      std::normal_distribution<double> normal;
      std::vector<Frame> frames;
      for (const double exposure : exposures) {
        std::vector<std::uint16_t> codes;
        for (int i = 0; i < width * height; ++i) {
          const double x = i % width, y = i / width, r = std::hypot(x - 80, y - 60) / 30.0;
          const double scene =
              r < 1.0 ? 0.2 * (1.0 - 0.3 * r * r)
                      : 0.01 * (1.0 + 0.5 * x / width) * (1.0 + 0.3 * std::sin(y / 9.0));
          const double mean = scene * exposure / 4.0;
          const double signal = mean + std::sqrt(mean / 2e4 + 4e-8) * normal(random);
          codes.push_back(
              static_cast<std::uint16_t>(std::lround(255.0 * curve(std::clamp(signal, 0.0, 1.0)))));
        }
        frames.push_back(FrameOf(codes, width, height, 255));
      }
      const auto recovered = RecoverResponse(frames, exposures);
      ASSERT_TRUE(recovered.has_value());
      EXPECT_EQ(recovered->exposures.off, std::vector(exposures.size(), 0.0));
      EXPECT_EQ(recovered->exposures.power_sd, 0.0);
    }
  }
}

// All but a hundredth of the longest frame is clipped: it tells nothing of the others' labels.
TEST(RecoverResponse, AFrameThatSharesFewPixelsKeepsItsLabel) {
  const std::vector<double> exposures = {0.0625, 0.25, 1.0, 4.0, 900.0};
  const auto frames = Shoot(SrgbCurve, exposures, 255);
  for (const double factor : {1.0, 1.33}) {
    std::vector<double> given = exposures;
    given[1] *= factor;
    const auto recovered = RecoverResponse(frames, given);
    ASSERT_TRUE(recovered.has_value());
    EXPECT_NEAR(recovered->exposures.off[1], -std::log(factor), 0.02);
    EXPECT_EQ(recovered->exposures.off[4], 0.0);
  }
}

// Two frames tell nothing of their labels, three not which one is odd.
TEST(RecoverResponse, FewFramesTellLessOfTheirLabels) {
  const auto two = RecoverResponse(Shoot(SrgbCurve, {0.5, 2.0}, 255), std::vector{0.5, 2.6});
  ASSERT_TRUE(two.has_value());
  EXPECT_EQ(two->exposures.off, std::vector(2, 0.0));
  const auto three =
      RecoverResponse(Shoot(SrgbCurve, {0.25, 1.0, 4.0}, 255), std::vector{0.25, 1.4, 4.0});
  ASSERT_TRUE(three.has_value());
  EXPECT_NEAR(three->exposures.off[1], -std::log(1.4), 0.03);
  // An end may be off by twice as much instead: all ratios are then off by ln 1.4 / ln 4.
  EXPECT_GT(three->exposures.power_sd, 0.05);
  EXPECT_LT(three->exposures.power_sd, std::log(1.4) / std::log(4.0));
}

TEST(RecoverResponse, AFrameThatGotNoLightIsRefused) {
  const std::vector<double> exposures = {0.25, 1.0, 4.0, 16.0};
  auto frames = Shoot(SrgbCurve, exposures, 255);
  frames[2] = Shoot(SrgbCurve, {1e-9}, 255).front();
  const auto curves = RecoverResponse(frames, exposures);
  ASSERT_FALSE(curves.has_value());
  EXPECT_EQ(curves.error().code, "exposures_disagree");
}

}  // namespace
}  // namespace lightcal
