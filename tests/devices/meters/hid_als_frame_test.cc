// SPDX-License-Identifier: Apache-2.0
// Report descriptors and the reports of HID light sensors.
#include <gmock/gmock.h>

#include "hid_descriptors.h"
#include "lightcal_devices/meters/hid_als/frame.h"

namespace lightcal::devices::hid_als {
namespace {

using test::AmdDescriptor;
using test::ColorHugDescriptor;
using test::FromHex;
using test::TinyDescriptor;

Layout LayoutOf(const Bytes& descriptor) {
  const auto parsed = ParseReportDescriptor(descriptor);
  EXPECT_TRUE(parsed) << parsed.error().message;
  const auto layout = FindAmbientLight(*parsed);
  EXPECT_TRUE(layout) << layout.error().message;
  return *layout;
}

TEST(ReportDescriptor, TheTinyOneHasOneFieldOf32BitsAfterTheNumber) {
  const auto parsed = ParseReportDescriptor(TinyDescriptor());
  ASSERT_TRUE(parsed) << parsed.error().message;
  ASSERT_EQ(parsed->fields.size(), 1U);
  const Field& field = parsed->fields[0];
  EXPECT_EQ(field.usage, SensorUsage(0x04D1));
  EXPECT_EQ(field.report, 1);
  EXPECT_EQ(field.bit_offset, 8U);
  EXPECT_EQ(field.bit_count, 32);
  EXPECT_EQ(field.unit_exponent, -2);
  EXPECT_EQ(field.logical_max, 65535) << "unsigned where the minimum is not negative";
  EXPECT_EQ(parsed->ReportBytes(ReportKind::kInput, 1), 5U);
}

TEST(ReportDescriptor, WithoutAReportCountThereIsNoField) {
  Bytes without = TinyDescriptor();
  const auto count = std::ranges::search(without, FromHex("95 01"));
  without.erase(count.begin(), count.end());
  EXPECT_TRUE(ParseReportDescriptor(without)->fields.empty());
}

TEST(ReportDescriptor, PushAndPopKeepTheGlobals) {
  // Exponent -2 pushed, exponent 3 for one field, popped for the next.
  const auto parsed = ParseReportDescriptor(
      FromHex("05 20 15 00 25 7F 75 08 95 01 55 0E A4 55 03 0A D2 04 81 02 B4 0A D1 04 81 02"));
  ASSERT_TRUE(parsed) << parsed.error().message;
  EXPECT_EQ(parsed->fields.at(0).unit_exponent, 3);
  EXPECT_EQ(parsed->fields.at(1).unit_exponent, -2);
  EXPECT_EQ(parsed->fields.at(1).bit_offset, 8U);
}

TEST(ReportDescriptor, AUsageRangeNamesFieldAfterField) {
  const auto parsed =
      ParseReportDescriptor(FromHex("05 20 15 00 25 7F 75 04 95 03 1A D1 04 2A D3 04 81 02"));
  ASSERT_EQ(parsed->fields.size(), 3U);
  EXPECT_EQ(parsed->fields[2].usage, SensorUsage(0x04D3));
  EXPECT_EQ(parsed->fields[2].bit_offset, 8U);
}

TEST(ReportDescriptor, PaddingTakesRoomAndIsNoField) {
  const auto parsed = ParseReportDescriptor(
      FromHex("05 20 15 00 25 7F 75 03 95 01 81 01 75 08 0A D1 04 81 02 75 05 81 03"));
  ASSERT_EQ(parsed->fields.size(), 1U);
  EXPECT_EQ(parsed->fields[0].bit_offset, 3U);
  EXPECT_EQ(parsed->ReportBytes(ReportKind::kInput, 0), 2U);
}

TEST(ReportDescriptor, ANegativeMinimumMakesItsNumbersSigned) {
  const auto parsed =
      ParseReportDescriptor(FromHex("05 20 15 80 25 7F 75 08 95 01 0A D1 04 81 02"));
  const Field& field = parsed->fields.at(0);
  EXPECT_EQ(field.RawIn(FromHex("FF")), -1);
  EXPECT_EQ(field.RawIn(FromHex("80")), -128);
  EXPECT_EQ(field.RawIn({}), std::nullopt);
}

TEST(ReportDescriptor, WhatIsWrittenIntoAFieldIsReadFromItAndNothingElseChanges) {
  Field field;
  field.bit_offset = 5;
  field.bit_count = 13;
  field.logical_min = -4096;
  field.logical_max = 4095;
  for (const std::int64_t raw : {-4096, -1, 0, 1, 4095}) {
    Bytes report = FromHex("FF FF FF");
    ASSERT_TRUE(field.Put(raw, report));
    EXPECT_EQ(field.RawIn(report), raw);
    EXPECT_EQ(report[0] & std::byte{0x1F}, std::byte{0x1F});
    EXPECT_EQ(report[2] & std::byte{0xFC}, std::byte{0xFC});
  }
  Bytes tooshort(2);
  EXPECT_FALSE(field.Put(1, tooshort));
}

class DamagedDescriptor : public testing::TestWithParam<const char*> {};
TEST_P(DamagedDescriptor, IsRefused) {
  const auto parsed = ParseReportDescriptor(FromHex(GetParam()));
  ASSERT_FALSE(parsed);
  EXPECT_EQ(parsed.error().code, kBadDescriptor);
}
INSTANTIATE_TEST_SUITE_P(ReportDescriptor, DamagedDescriptor,
                         testing::Values("26 FF",                 // an item cut short
                                         "B4",                    // pops what was never pushed
                                         "C0",                    // ends what never began
                                         "A1 01",                 // never ends
                                         "85 00",                 // report number 0
                                         "1A 05 00 2A 01 00",     // a range backwards
                                         "19 00 2B FF FF FF 7F",  // a range of 2^31 usages
                                         "09 01 75 20 97 FF FF FF FF 81 02",  // 2^32 fields
                                         "FE FF"));  // a long item cut short

TEST(ReportDescriptor, EveryBeginningOfOneIsRefusedOrShorter) {
  const Bytes whole = ColorHugDescriptor();
  for (std::size_t n = 0; n < whole.size(); ++n) {
    EXPECT_FALSE(ParseReportDescriptor(std::span(whole).first(n)) && n > 0 && n > 10) << n;
  }
}

TEST(HidAlsFrame, TheTinyReportIs123Lux) {
  const auto light = DecodeInput(LayoutOf(TinyDescriptor()), FromHex("01 39 30 00 00"));
  ASSERT_TRUE(light) << light.error().message;
  EXPECT_EQ(light->illuminance_lx, 123.45);
  EXPECT_EQ(light->step_lx, 0.01);
  EXPECT_FALSE(light->over_range);
}

TEST(HidAlsFrame, TheColorHugReportHasStateEventAndIlluminance) {
  EXPECT_EQ(ColorHugDescriptor().size(), 269U);
  const Layout layout = LayoutOf(ColorHugDescriptor());
  EXPECT_EQ(layout.input_bytes, 7U);
  const auto light = DecodeInput(layout, FromHex("01 01 03 39 30 00 00"));
  ASSERT_TRUE(light) << light.error().message;
  EXPECT_EQ(light->illuminance_lx, 123.45);
  EXPECT_EQ(light->state, SensorState::kReady);
  EXPECT_EQ(DecodeInput(layout, FromHex("01 02 03 39 30 00 00"))->state, SensorState::kNotReady);
  EXPECT_EQ(DecodeInput(layout, FromHex("01 04 03 39 30 00 00"))->state,
            SensorState::kAccessDenied);
  EXPECT_EQ(DecodeInput(layout, FromHex("01 05 03 39 30 00 00"))->state, SensorState::kError);
}

TEST(HidAlsFrame, TheColorHugIsSwitchedOnByTheSecondOfEachChoice) {
  const Layout layout = LayoutOf(ColorHugDescriptor());
  ASSERT_EQ(layout.power_up.size(), 2U);
  EXPECT_EQ(layout.power_up[0].field.bit_offset, 24U) << "power, the third byte after the number";
  EXPECT_EQ(layout.power_up[0].raw, 1);
  EXPECT_EQ(layout.power_up[1].field.bit_offset, 16U) << "reporting";
  EXPECT_EQ(layout.power_up[1].raw, 1);
}

TEST(HidAlsFrame, AnAmdSensorsChromaticityOfWholeNumbersIsNotBelieved) {
  const Layout layout = LayoutOf(AmdDescriptor());
  const auto light =
      DecodeInput(layout, FromHex("04 D2 04 00 00 A0 0F 00 00 00 00 00 00 00 00 00 00"));
  ASSERT_TRUE(light) << light.error().message;
  EXPECT_EQ(light->illuminance_lx, 123.4);
  EXPECT_TRUE(light->color_dropped);
  EXPECT_FALSE(light->cct_K);
  EXPECT_FALSE(light->xy);
}

TEST(HidAlsFrame, ACountAtTheEndOfItsScaleIsALimit) {
  const auto light = DecodeInput(LayoutOf(TinyDescriptor()), FromHex("01 FF FF 00 00"));
  EXPECT_TRUE(light->over_range);
  EXPECT_EQ(light->illuminance_lx, 655.35);
}

TEST(HidAlsFrame, ReportsCutShortOfAnotherNumberOrOutOfRangeAreRefused) {
  const Layout layout = LayoutOf(TinyDescriptor());
  EXPECT_EQ(DecodeInput(layout, FromHex("01 39 30 00")).error().code, kBadReply);
  EXPECT_EQ(DecodeInput(layout, {}).error().code, kBadReply);
  EXPECT_EQ(DecodeInput(layout, FromHex("02 39 30 00 00")).error().code, kBadReply);
  EXPECT_EQ(DecodeInput(layout, FromHex("01 00 00 01 00")).error().code, kBadReply);
}

TEST(HidAlsFrame, ADeviceWithoutIlluminanceIsNoLightSensor) {
  Bytes other = TinyDescriptor();
  other.at(13) = std::byte{0xD5};
  EXPECT_EQ(FindAmbientLight(*ParseReportDescriptor(other)).error().code, kBadDescriptor);
}

}  // namespace
}  // namespace lightcal::devices::hid_als
