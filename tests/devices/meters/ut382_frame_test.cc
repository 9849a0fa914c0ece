// SPDX-License-Identifier: Apache-2.0
// Truth: a frame of 123.4 lx put together from the published segment map (no real meter sent it),
// and frames this test draws segment by segment.
#include <gmock/gmock.h>

#include <array>

#include "hex_bytes.h"
#include "lightcal_devices/meters/ut382/frame.h"

namespace lightcal::devices::ut382 {
namespace {

using test::Altered;
using test::FromHex;

// Without the byte that follows a frame.
const char* const k123lx =
    "30 30 35 36 3C 3F 3E 35 30 36 30 30 30 30 30 30 30 30 38 32 32 3E 30 30 30 30 30 30 30 30 "
    "0D 0A";

// A frame of these fifteen bytes, low nibble first.
Bytes Frame(const std::array<unsigned, 15>& segments) {
  Bytes frame;
  for (const unsigned s : segments) {
    frame.push_back(static_cast<std::byte>(0x30U | (s & 0x0FU)));
    frame.push_back(static_cast<std::byte>(0x30U | (s >> 4U)));
  }
  frame.push_back(std::byte{0x0D});
  frame.push_back(std::byte{0x0A});
  return frame;
}

// ones, tens, hundreds, thousands, then the flags of bytes 9, 10 and 11.
Bytes Drawn(std::array<unsigned, 4> digits, unsigned flags = 0x28, unsigned range = 0x02,
            unsigned mode = 0) {
  return Frame(
      {0, digits[0], digits[1], digits[2], digits[3], 0, 0, 0, 0, flags, range, mode, 0, 0, 0});
}

double LuxOf(const Bytes& frame) {
  const auto display = DecodeDisplay(frame);
  EXPECT_TRUE(display) << display.error().message;
  return display ? LuxFromDisplay(display->shown) : -1.0;
}

TEST(Ut382Frame, ThePublishedVectorIs123Point4Lux) {
  const auto display = DecodeDisplay(FromHex(k123lx));
  ASSERT_TRUE(display) << display.error().message;
  EXPECT_EQ(LuxFromDisplay(display->shown), 123.4);
  EXPECT_EQ(display->shown.counts, 1234);
  EXPECT_EQ(display->shown.decimals, 1);
  EXPECT_TRUE(display->automatic_range);
  EXPECT_FALSE(display->battery_low || display->in_menu || display->overload);
  EXPECT_EQ(display->frozen, "");
}

TEST(Ut382Frame, EveryDigitHasItsShape) {
  constexpr std::array<unsigned, 10> kShapes = {0x7B, 0x60, 0x5E, 0x7C, 0x65,
                                                0x3D, 0x3F, 0x70, 0x7F, 0x7D};
  for (unsigned digit = 0; digit < kShapes.size(); ++digit) {
    const unsigned s = kShapes[digit];
    EXPECT_EQ(LuxOf(Drawn({s, 0x60, 0, 0})), 10.0 + digit);
    EXPECT_EQ(LuxOf(Drawn({0x7B, 0x7B, 0x7B, s})), 1000.0 * digit);
  }
}

TEST(Ut382Frame, ThePointStandsWhereItsBitIs) {
  EXPECT_EQ(LuxOf(Drawn({0x65, 0xFC, 0x5E, 0x60})), 123.4);
  EXPECT_EQ(LuxOf(Drawn({0x65, 0x7C, 0xDE, 0x60})), 12.34);
  EXPECT_EQ(LuxOf(Drawn({0x65, 0x7C, 0x5E, 0xE0})), 1.234);
  EXPECT_FALSE(DecodeDisplay(Drawn({0x65, 0xFC, 0xDE, 0x60})));
}

TEST(Ut382Frame, TenTimesFootCandlesAndBatteryAreFlags) {
  EXPECT_EQ(LuxOf(Drawn({0x65, 0x7C, 0x5E, 0x60}, 0x29)), 12340.0);
  EXPECT_NEAR(LuxOf(Drawn({0x65, 0xFC, 0x5E, 0x60}, 0x24)), 123.4 * 10.763910417, 1e-6);
  EXPECT_TRUE(DecodeDisplay(Drawn({0x65, 0x7C, 0x5E, 0x60}, 0x38))->battery_low);
  EXPECT_FALSE(DecodeDisplay(Drawn({0x65, 0x7C, 0x5E, 0x60}, 0x20)));  // no unit
  EXPECT_FALSE(DecodeDisplay(Drawn({0x65, 0x7C, 0x5E, 0x60}, 0x2C)));  // two
}

TEST(Ut382Frame, HoldMaxAndMinAreNamed) {
  const std::array<unsigned, 4> digits = {0x65, 0x7C, 0x5E, 0x60};
  EXPECT_EQ(DecodeDisplay(Drawn(digits, 0x28, 2, 0x10))->frozen, "HOLD");
  EXPECT_EQ(DecodeDisplay(Drawn(digits, 0x28, 2, 0x20))->frozen, "MAX");
  EXPECT_EQ(DecodeDisplay(Drawn(digits, 0x28, 2, 0x40))->frozen, "MIN");
}

TEST(Ut382Frame, TheLettersOLAreAnOverload) {
  const auto display = DecodeDisplay(Drawn({0x00, 0x0B, 0x7B, 0x00}, 0x28, 0x02));
  ASSERT_TRUE(display);
  EXPECT_TRUE(display->overload);
  EXPECT_TRUE(display->automatic_range);
  EXPECT_FALSE(DecodeDisplay(Drawn({0x00, 0x0B, 0x7B, 0x00}, 0x28, 0x00))->automatic_range);
}

TEST(Ut382Frame, AMenuIsNoMeasurement) {
  auto frame = FromHex(k123lx);
  frame[1] = std::byte{0x32};  // byte 0 = 20: the menu "USB"
  EXPECT_TRUE(DecodeDisplay(frame)->in_menu);
}

TEST(Ut382Frame, ADisplayWithoutDigitsIsDamage) {
  EXPECT_FALSE(DecodeDisplay(Drawn({0, 0, 0, 0})));
  EXPECT_FALSE(DecodeDisplay(Drawn({0x65, 0, 0x5E, 0x60})));  // a blank within
  EXPECT_FALSE(DecodeDisplay(Drawn({0x01, 0, 0, 0})));        // a shape that is none
}

TEST(Ut382Frame, EveryDamagedFormIsRefused) {
  const Bytes frame = FromHex(k123lx);
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const auto damaged = DecodeDisplay(Altered(frame, i, 0x7F));
    ASSERT_FALSE(damaged) << i;
    EXPECT_EQ(damaged.error().code, "bad_reply");
  }
  for (std::size_t length = 0; length < frame.size(); ++length) {
    EXPECT_FALSE(DecodeDisplay(std::span(frame).first(length))) << length;
    EXPECT_TRUE(MayBeginFrame(std::span(frame).first(length))) << length;
  }
  EXPECT_FALSE(DecodeDisplay(FromHex(std::string(k123lx) + " 00")));
}

TEST(Ut382Frame, WhatEndsAFrameCannotBeginOne) {
  EXPECT_FALSE(MayBeginFrame(FromHex("30 30 0D 0A")));
  EXPECT_FALSE(MayBeginFrame(FromHex("00 30 30")));
}

}  // namespace
}  // namespace lightcal::devices::ut382
