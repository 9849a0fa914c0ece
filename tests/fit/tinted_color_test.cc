// SPDX-License-Identifier: Apache-2.0
// A lamp's colour where walls, day or other lamps shine in what was read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "fitted.h"
#include "lightcal/colorimetry/cct.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/records/session_codec.h"

namespace lightcal {
namespace {

using testing::HasSubstr;

struct Light {
  double lux = 0.0;
  Xy xy;
};
Light operator+(const Light& a, const Light& b) {
  const double sum = a.lux / a.xy.y + b.lux / b.xy.y;
  return {a.lux + b.lux,
          {(a.lux / a.xy.y * a.xy.x + b.lux / b.xy.y * b.xy.x) / sum, (a.lux + b.lux) / sum}};
}

std::string Row(const std::string& where, const Light& seen, const std::string& more = "") {
  const auto number = [](double value) { return std::to_string(value); };
  return "[[reading]]\nmeter = \"m\"\ncolor_source = \"spectrometer\"\n" + where +
         "\nilluminance_lx = " + number(seen.lux) + "\nxy = [" + number(seen.xy.x) + ", " +
         number(seen.xy.y) + "]\n" + more;
}

std::string Head(const std::string& room = "") {
  return "lightcal = 1\nname = \"s\"\n" + room +
         "[[meter]]\nname = \"m\"\nsigma_relative = 0.02\n"
         "[[light]]\nname = \"key\"\nkind = \"point\"\nfixture = \"bulb\"\n";
}
std::string At(double metres) { return "light = \"key\"\ndistance_m = " + std::to_string(metres); }

FittedSession Fit(const std::string& text) {
  const auto session = ParseSessionToml(text, "session.toml");
  EXPECT_TRUE(session.has_value()) << (session ? "" : session.error().message);
  auto fitted = FitSession(*session, {});
  EXPECT_TRUE(fitted.has_value()) << (fitted ? "" : fitted.error().message);
  return *std::move(fitted);
}
FittedColor ColorOf(const std::string& text) { return Fit(text).lights.lights.front().color; }

const Xy kLamp = XyFromCct(Kelvin(4000.0), 0.001);
const Xy kCream = XyFromCct(Kelvin(3400.0), 0.001);  // the same off cream walls
constexpr double kBulb_cd = 400.0;

Light Direct(double metres) { return {kBulb_cd / (metres * metres), kLamp}; }

TEST(TintedColor, WhatWallsBringWidensOneSideMoreWithTheDistance) {
  const auto seen = [](const std::string& room, double metres) {
    return ColorOf(Head(room) + Row(At(metres), Direct(metres)));
  };
  const FittedColor dark = seen("[room]\ndark = true\n", 2.0);
  const FittedColor near = seen("", 0.4);
  const FittedColor far = seen("", 2.0);
  EXPECT_NEAR(dark.cct_K->value, 4000.0, 0.5);
  EXPECT_GT(near.cct_K->u95, dark.cct_K->u95);
  EXPECT_GT(far.cct_K->u95, 3.0 * dark.cct_K->u95);
  // Walls warm: the lamp itself is likelier bluer than what was read.
  EXPECT_GT(far.cct_K->value, near.cct_K->value);
  EXPECT_GT(*far.cct_K->high - far.cct_K->value, far.cct_K->value - *far.cct_K->low);
}

TEST(TintedColor, BehindTheCardAtItsOwnPlaceLeavesTheDifference) {
  const Light walls = {60.0, kCream};
  const std::string open = Head() + Row(At(2.0), Direct(2.0) + walls);
  const std::string told = open + Row(At(2.0), walls, "shadow_card = true\n");
  const FittedColor alone = ColorOf(open);
  const FittedColor beside = ColorOf(told);
  EXPECT_NEAR(beside.cct_K->value, 4000.0, 5.0);
  EXPECT_NEAR(beside.duv->value, 0.001, 1e-4);
  EXPECT_LT(beside.cct_K->u95, 0.5 * alone.cct_K->u95);
  EXPECT_LE(*alone.cct_K->low, 4000.0);
  EXPECT_GE(*alone.cct_K->high, 4000.0);
}

// E_walls as in an ordinary room: .13 exp(-1.05 x - .27 x^2) lx/cd, x = ln(d / 3 m).
Light Walls(double metres) {
  const double x = std::log(metres / 3.0);
  return {kBulb_cd * 0.13 * std::exp(-1.05 * x - 0.27 * x * x), kCream};
}

TEST(TintedColor, TwoDistancesTellWhatTheWallsDo) {
  const auto row = [](double metres) { return Row(At(metres), Direct(metres) + Walls(metres)); };
  const FittedColor far = ColorOf(Head() + row(2.0));
  const FittedColor both = ColorOf(Head() + row(2.0) + row(0.5));
  EXPECT_LT(both.cct_K->u95, 0.4 * far.cct_K->u95);
  EXPECT_NEAR(both.cct_K->value, 4000.0, both.cct_K->u95);
  EXPECT_LT(std::abs(1e6 / both.cct_K->value - 250.0),
            4.0);  // mireds; 35 lie between lamp and walls
}

TEST(TintedColor, OfALampWhosePlaceIsSoughtToo) {
  const Vec3 lamp = {1.0, 2.0, 1.8};
  std::string readings;
  Light farthest;
  for (const Vec3& at : std::vector<Vec3>{{0.4, 1.5, 1.2},
                                          {1.7, 1.6, 1.0},
                                          {1.1, 3.1, 1.3},
                                          {0.2, 2.6, 0.8},
                                          {2.4, 2.9, 1.4},
                                          {1.2, 0.6, 0.5}}) {
    const Vec3 way = lamp - at;
    const double r = Length(way);
    const auto triple = [](const Vec3& v) {
      return "[" + std::to_string(v[0]) + ", " + std::to_string(v[1]) + ", " +
             std::to_string(v[2]) + "]";
    };
    const Light seen = Direct(r) + Walls(r);
    if (farthest.lux == 0.0 || seen.lux < farthest.lux) farthest = seen;
    readings +=
        Row("light = \"key\"\nposition_m = " + triple(at) + "\nnormal = " + triple(way), seen);
  }
  const FittedColor color = ColorOf(Head() + readings);
  EXPECT_LE(*color.cct_K->low, 4000.0);
  EXPECT_GE(*color.cct_K->high, 4000.0);
  EXPECT_GT(color.cct_K->value, CctFromXy(farthest.xy).temperature.value() + 50.0);
}

TEST(TintedColor, DayThatWasReadWithTheLampOffIsTakenOut) {
  const Light day = {40.0, XyFromCct(Kelvin(6500.0), 0.003)};
  const std::string lit = Head("[room]\ndark = true\n") + Row(At(1.0), Direct(1.0) + day);
  const FittedColor told = ColorOf(lit + Row(At(1.0), day, "lamp = \"off\"\n"));
  EXPECT_NEAR(told.cct_K->value, 4000.0, 15.0);
  // Without its colour the same lux leave the lamp's open.
  const std::string lux_only =
      "[[reading]]\nmeter = \"m\"\n" + At(1.0) + "\nlamp = \"off\"\nilluminance_lx = 40\n";
  const FittedColor untold = ColorOf(lit + lux_only);
  EXPECT_GT(untold.cct_K->u95, 2.0 * told.cct_K->u95);
  EXPECT_LE(*untold.cct_K->low, 4000.0);
  EXPECT_GE(*untold.cct_K->high, 4000.0);
}

TEST(TintedColor, ALampAmongOthersIsWhatItAddsToThem) {
  const Light fill = {90.0, XyFromCct(Kelvin(5600.0), 0.0)};
  const std::string two =
      Head("[room]\ndark = true\n") + "[[light]]\nname = \"fill\"\nkind = \"point\"\n";
  const std::string place = "distances_m = { key = 2.0, fill = 3.0 }";
  const std::string both = Row("lit = [\"key\", \"fill\"]\n" + place, Direct(2.0) + fill);
  const std::string other = Row("lit = [\"fill\"]\n" + place, fill);
  const FittedSession fitted = Fit(two + both + other);
  const FittedColor& key = fitted.lights.lights[0].color;
  EXPECT_NEAR(key.cct_K->value, 4000.0, 5.0);
  EXPECT_NEAR(fitted.lights.lights[1].color.cct_K->value, 5600.0, 5.0);
  for (const Warning& one : fitted.warnings) EXPECT_NE(one.code, "color_disagrees");
}

TEST(TintedColor, WhatTheBoxSaysIsNoReading) {
  const FittedColor color = ColorOf(
      Head() +
      "[[reading]]\nlight = \"key\"\ndistance_m = 2.0\nilluminance_lx = 100\ncct_K = 2700\n");
  EXPECT_NEAR(color.cct_K->value, 2700.0, 0.01);
}

TEST(TintedColor, ANoteSaysWhatWouldMakeItSurer) {
  const FittedSession fitted = Fit(Head() + Row(At(2.0), Direct(2.0)));
  ASSERT_EQ(fitted.notes.size(), 1U);
  EXPECT_THAT(fitted.notes.front(), HasSubstr("key: its colour was read where"));
  EXPECT_THAT(fitted.notes.front(), HasSubstr("behind the shadow card"));
  EXPECT_TRUE(Fit(Head() + Row(At(0.3), Direct(0.3))).notes.empty());
}

}  // namespace
}  // namespace lightcal
