// SPDX-License-Identifier: Apache-2.0
// Truth: the commands and three frames that reference documents print; no real meter's bytes are
// public.
#include <gmock/gmock.h>

#include "hex_bytes.h"
#include "lightcal_devices/meters/gm1020/frame.h"

namespace lightcal::devices::gm1020 {
namespace {

using test::Altered;
using test::FromHex;

double LuxOf(const std::string& hex) {
  const auto live = DecodeLive(FromHex(hex));
  EXPECT_TRUE(live) << live.error().message;
  return live ? LuxFromDisplay(live->shown) : -1.0;
}

TEST(Gm1020Frame, TheThreePublishedVectors) {
  EXPECT_EQ(LuxOf("33 22 04 D2 01 00 FD 11"), 123.4);
  EXPECT_EQ(LuxOf("33 22 44 D2 01 00 FD 11"), 1234.0);
  EXPECT_EQ(LuxOf("33 22 84 D2 01 00 FD 11"), 12340.0);
  EXPECT_EQ(DecodeLive(FromHex("33 22 04 D2 01 00 FD 11"))->temperature_C, 25.3);
}

TEST(Gm1020Frame, BothFactorsMultiply) {
  EXPECT_EQ(LuxOf("33 22 C4 D2 01 00 FD 11"), 123400.0);
  EXPECT_EQ(LuxOf("33 22 CF FF 01 00 FD 11"), 409500.0);
  EXPECT_EQ(LuxOf("33 22 00 00 01 00 FD 11"), 0.0);
}

TEST(Gm1020Frame, FrostIsBelowZero) {
  EXPECT_EQ(DecodeLive(FromHex("33 22 04 D2 01 FF CE 11"))->temperature_C, -5.0);
}

TEST(Gm1020Frame, CommandsEndWithTheirSum) {
  const auto is = [](const Command& command, const std::string& hex) {
    return Bytes(command.begin(), command.end()) == FromHex(hex);
  };
  EXPECT_TRUE(is(kStartLive, "3C 01 00 00 00 00 00 3D"));
  EXPECT_TRUE(is(kStopLive, "3C 02 00 00 00 00 00 3E"));
  EXPECT_TRUE(is(EncodeCommand(0x1E, 0), "1E 00 00 00 00 00 00 1E"));
}

TEST(Gm1020Frame, TheFourMarksAreChecked) {
  const Bytes frame = FromHex("33 22 04 D2 01 00 FD 11");
  for (const std::size_t at : {0, 1, 4, 7}) {
    const auto damaged = DecodeLive(Altered(frame, at, 0x7E));
    ASSERT_FALSE(damaged) << at;
    EXPECT_EQ(damaged.error().code, "bad_reply");
  }
}

TEST(Gm1020Frame, UnknownBitsAreNotGuessedAt) {
  EXPECT_FALSE(DecodeLive(FromHex("33 22 14 D2 01 00 FD 11")));
  EXPECT_FALSE(DecodeLive(FromHex("33 22 24 D2 01 00 FD 11")));
}

TEST(Gm1020Frame, ATruncatedFrameIsABeginningButNoFrame) {
  const Bytes frame = FromHex("33 22 04 D2 01 00 FD 11");
  for (std::size_t length = 0; length < frame.size(); ++length) {
    EXPECT_FALSE(DecodeLive(std::span(frame).first(length))) << length;
    EXPECT_TRUE(MayBeginFrame(std::span(frame).first(length))) << length;
  }
  EXPECT_FALSE(DecodeLive(FromHex("33 22 04 D2 01 00 FD 11 00")));
}

}  // namespace
}  // namespace lightcal::devices::gm1020
