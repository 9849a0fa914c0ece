// SPDX-License-Identifier: Apache-2.0
// Truth: the frame table printed in the makers' manuals, and one frame of 123.4 lx built from it.
#include <gmock/gmock.h>

#include "hex_bytes.h"
#include "lightcal_devices/meters/lutron16/frame.h"

namespace lightcal::devices::lutron16 {
namespace {

using test::Altered;
using test::FromHex;

const Bytes k123lx = FromHex("02 34 31 31 35 30 31 30 30 30 30 31 32 33 34 0D");

// A frame as the manual spells it: display, unit, sign, decimals, eight digits.
Bytes Spelled(const std::string& characters) {
  const std::string text =
      "\x02"
      "4" +
      characters + "\r";
  const auto bytes = AsBytes(text);
  return {bytes.begin(), bytes.end()};
}

double LuxOf(const Bytes& frame) {
  const auto m = DecodeMeasurement(frame);
  EXPECT_TRUE(m) << m.error().message;
  return m ? LuxFromDisplay(m->shown) : -1.0;
}

TEST(Lutron16Frame, ThePublishedVectorIs123Point4Lux) {
  EXPECT_EQ(Spelled("1150100001234"), k123lx);
  EXPECT_EQ(LuxOf(k123lx), 123.4);
  EXPECT_TRUE(DecodeMeasurement(k123lx)->upper_display);
  EXPECT_FALSE(DecodeMeasurement(k123lx)->negative);
}

TEST(Lutron16Frame, DecimalsMoveThePoint) {
  EXPECT_EQ(LuxOf(Spelled("1150000001999")), 1999.0);
  EXPECT_EQ(LuxOf(Spelled("1150200001999")), 19.99);
  EXPECT_EQ(LuxOf(Spelled("1150300001999")), 1.999);
  EXPECT_EQ(LuxOf(Spelled("1150099999999")), 99999999.0);
}

TEST(Lutron16Frame, FootCandlesAreConverted) {
  EXPECT_NEAR(LuxOf(Spelled("1160100001234")), 123.4 * 10.763910417, 1e-6);
}

TEST(Lutron16Frame, AnotherInstrumentsUnitIsNamed) {
  const auto decibels = DecodeMeasurement(Spelled("1170100001234"));
  ASSERT_FALSE(decibels);
  EXPECT_EQ(decibels.error().code, "wrong_unit");
  EXPECT_THAT(decibels.error().message, testing::HasSubstr("code 17"));
}

TEST(Lutron16Frame, TheLowerDisplayIsNotTheLight) {
  const auto lower = DecodeMeasurement(Spelled("2010100000253"));  // 25.3 degrees
  ASSERT_TRUE(lower);
  EXPECT_FALSE(lower->upper_display);
}

TEST(Lutron16Frame, TheSignIsRead) {
  EXPECT_TRUE(DecodeMeasurement(Spelled("1151100000003"))->negative);
}

TEST(Lutron16Frame, DamageIsRefused) {
  for (const std::size_t at : {0, 1, 2, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15}) {
    const auto damaged = DecodeMeasurement(Altered(k123lx, at, '-'));
    ASSERT_FALSE(damaged) << at;
    EXPECT_EQ(damaged.error().code, "bad_reply") << at;
  }
  EXPECT_FALSE(DecodeMeasurement(Altered(k123lx, 6, '4')));  // decimals 0 to 3
  for (std::size_t length = 0; length < k123lx.size(); ++length) {
    EXPECT_FALSE(DecodeMeasurement(std::span(k123lx).first(length))) << length;
    EXPECT_TRUE(MayBeginFrame(std::span(k123lx).first(length))) << length;
  }
}

}  // namespace
}  // namespace lightcal::devices::lutron16
