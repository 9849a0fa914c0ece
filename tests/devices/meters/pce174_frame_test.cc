// SPDX-License-Identifier: Apache-2.0
// Truth: one synthetic reply that the reference prints, and the published tables of ranges and
// modes, each entry checked by hand.
#include <gmock/gmock.h>

#include "hex_bytes.h"
#include "lightcal_devices/meters/pce174/frame.h"

namespace lightcal::devices::pce174 {
namespace {

using test::Altered;
using test::FromHex;

const Bytes k123lx = FromHex("AA DD 00 26 06 11 21 12 34 56 0C 22 0C 22 81 00 00 01");
constexpr std::size_t kStatus0 = 14;
constexpr std::size_t kStatus1 = 15;

Measurement Decoded(const Bytes& reply) {
  const auto m = DecodeMeasurement(reply);
  EXPECT_TRUE(m) << m.error().message;
  return m.value_or(Measurement{});
}

TEST(Pce174Frame, ThePublishedVectorIs123Point4Lux) {
  const Measurement m = Decoded(k123lx);
  EXPECT_EQ(LuxFromDisplay(m.raw), 123.4);
  EXPECT_EQ(m.mode, "");
  EXPECT_FALSE(m.negative || m.battery_low);
}

TEST(Pce174Frame, TheCommandIsThreeBytes) {
  EXPECT_EQ(Bytes(kReadCommand.begin(), kReadCommand.end()), FromHex("87 83 11"));
}

// 1234 counts in each range: 400k, 400, 4k, 40k lx; 40k, 40, 400, 4k fc.
TEST(Pce174Frame, EachRangeHasItsFactor) {
  const auto shown = [](unsigned status0) {
    return LuxFromDisplay(Decoded(Altered(k123lx, kStatus0, status0)).raw);
  };
  EXPECT_EQ(shown(0x80), 123400.0);
  EXPECT_EQ(shown(0x81), 123.4);
  EXPECT_EQ(shown(0x82), 1234.0);
  EXPECT_EQ(shown(0x83), 12340.0);
  constexpr double kLuxPerFc = 10.763910417;
  EXPECT_NEAR(shown(0x84), 12340.0 * kLuxPerFc, 1e-3);
  EXPECT_NEAR(shown(0x85), 12.34 * kLuxPerFc, 1e-6);
  EXPECT_NEAR(shown(0x86), 123.4 * kLuxPerFc, 1e-5);
  EXPECT_NEAR(shown(0x87), 1234.0 * kLuxPerFc, 1e-4);
}

// In REL the displayed value is a difference; the raw one is not.
TEST(Pce174Frame, TheRawValueIsTaken) {
  auto reply = k123lx;
  reply[10] = std::byte{0};
  reply[11] = std::byte{7};
  EXPECT_EQ(LuxFromDisplay(Decoded(reply).raw), 123.4);
}

TEST(Pce174Frame, EveryModeIsNamed) {
  const auto mode = [](unsigned number) {
    return Decoded(Altered(k123lx, kStatus0, 0x81U | (number << 3U))).mode;
  };
  EXPECT_EQ(mode(0), "");
  EXPECT_EQ(mode(2), "PMIN");
  EXPECT_EQ(mode(3), "PMAX");
  EXPECT_EQ(mode(4), "MAX");
  EXPECT_EQ(mode(5), "MIN");
  EXPECT_EQ(mode(6), "REL");
  for (const unsigned unknown : {1U, 7U}) {
    EXPECT_FALSE(DecodeMeasurement(Altered(k123lx, kStatus0, 0x81U | (unknown << 3U))));
  }
  EXPECT_EQ(Decoded(Altered(k123lx, kStatus0, 0xC1)).mode, "HOLD");
  EXPECT_EQ(Decoded(Altered(k123lx, kStatus1, 0x02)).mode, "LOAD");
  EXPECT_EQ(Decoded(Altered(k123lx, kStatus1, 0x03)).mode, "");  // logging measures on
}

TEST(Pce174Frame, SignAndBatteryAreFlags) {
  EXPECT_TRUE(Decoded(Altered(k123lx, kStatus1, 0x10)).negative);
  EXPECT_TRUE(Decoded(Altered(k123lx, kStatus1, 0x20)).battery_low);
}

TEST(Pce174Frame, AnImpossibleDateDoesNotMatter) {
  auto reply = k123lx;
  for (std::size_t i = 3; i < 10; ++i) reply[i] = std::byte{0xFF};
  EXPECT_EQ(LuxFromDisplay(Decoded(reply).raw), 123.4);
}

TEST(Pce174Frame, DamageIsRefused) {
  for (const std::size_t at : {0, 1, 2, 12, 13}) {
    const auto damaged = DecodeMeasurement(Altered(k123lx, at, 0xF7));
    ASSERT_FALSE(damaged) << at;
    EXPECT_EQ(damaged.error().code, "bad_reply");
  }
  for (std::size_t length = 0; length < k123lx.size(); ++length) {
    EXPECT_FALSE(DecodeMeasurement(std::span(k123lx).first(length))) << length;
    EXPECT_TRUE(MayBeginFrame(std::span(k123lx).first(length))) << length;
  }
  auto longer = k123lx;
  longer.push_back(std::byte{0});
  EXPECT_FALSE(DecodeMeasurement(longer));
}

}  // namespace
}  // namespace lightcal::devices::pce174
