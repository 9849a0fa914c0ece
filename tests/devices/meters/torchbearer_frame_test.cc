// SPDX-License-Identifier: Apache-2.0
// Truth: four requests the reference prints; one masked measurement worked out with the published
// formula in another language; and an encoder that works on bytes (torchbearer_encoder.h). No real
// device's measurement is public.
#include <gmock/gmock.h>

#include <random>

#include "hex_bytes.h"
#include "lightcal_devices/meters/torchbearer/frame.h"
#include "torchbearer_encoder.h"

namespace lightcal::devices::torchbearer {
namespace {

using test::Altered;
using test::FromHex;
using test::TorchMeasurement;
using test::TorchMessage;

TEST(TorchbearerFrame, RequestsArePublishedByteForByte) {
  EXPECT_EQ(EncodeRequest(MessageType::kDeviceId, FromHex("18")),
            FromHex("CC 01 0A 00 00 08 18 F7 0D 0A"));
  EXPECT_EQ(EncodeRequest(MessageType::kSetExposureMode, FromHex("01")),
            FromHex("CC 01 0A 00 00 0A 01 E2 0D 0A"));
  EXPECT_EQ(EncodeRequest(MessageType::kRange), FromHex("CC 01 09 00 00 0F E5 0D 0A"));
  EXPECT_EQ(EncodeRequest(MessageType::kData), FromHex("CC 01 09 00 00 33 09 0D 0A"));
  EXPECT_EQ(EncodeRequest(MessageType::kStop), FromHex("CC 01 09 00 00 04 DA 0D 0A"));
}

TEST(TorchbearerFrame, AMessageIsTakenApart) {
  const Bytes bytes = TorchMessage(0x0F, FromHex("54 01 1A 04"));
  EXPECT_EQ(bytes.size(), 13U);
  EXPECT_EQ(*MessageLength(std::span(bytes).first(kHeaderBytes)), 13U);
  const auto message = DecodeMessage(bytes);
  ASSERT_TRUE(message) << message.error().message;
  EXPECT_EQ(message->type, 0x0FU);
  const auto range = DecodeRange(message->data);
  ASSERT_TRUE(range);
  EXPECT_EQ(range->start_nm, 340);
  EXPECT_EQ(range->end_nm, 1050);
  EXPECT_EQ(range->samples(), 711U);
}

TEST(TorchbearerFrame, EveryFlippedByteIsNoticed) {
  const Bytes bytes = TorchMessage(0x0F, FromHex("54 01 1A 04"));
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const auto damaged =
        DecodeMessage(Altered(bytes, i, std::to_integer<unsigned>(bytes[i]) ^ 0x20U));
    ASSERT_FALSE(damaged) << i;
    EXPECT_EQ(damaged.error().code, "bad_reply");
  }
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_FALSE(DecodeMessage(std::span(bytes).first(length))) << length;
  }
}

TEST(TorchbearerFrame, ALengthBeyondReasonIsRefusedBeforeItIsRead) {
  EXPECT_FALSE(MessageLength(FromHex("CC 81 FF FF FF")));
  EXPECT_FALSE(MessageLength(FromHex("CC 81 08 00 00")));
  EXPECT_FALSE(MessageLength(FromHex("CC 01 09 00 00")));
  EXPECT_TRUE(MayBeginMessage(FromHex("CC 81 FF")));
  EXPECT_FALSE(MayBeginMessage(FromHex("CC 01")));
}

// 20 ms, exponent 6, number 1234ABCD, extra 0102030405060708, samples 1000 2000 3000 4000 65535.
TEST(TorchbearerFrame, AMeasurementWorkedOutElsewhereIsUnmasked) {
  const Bytes data = FromHex(
      "00 20 4E 00 00 22 96 CD AB 34 12 08 07 06 05 04 03 02 01 FE 59 C6 5D 71 A3 69 A7 36 57");
  const auto m = DecodeMeasurement(data, {500, 504});
  ASSERT_TRUE(m) << m.error().message;
  EXPECT_EQ(m->exposure, Exposure::kOk);
  EXPECT_EQ(m->exposure_ms, 20.0);
  EXPECT_THAT(m->irradiance_W_m2_nm, testing::ElementsAre(1e-3, 2e-3, 3e-3, 4e-3, 0.065535));
  TorchMeasurement sent;
  sent.samples = {1000, 2000, 3000, 4000, 65535};
  EXPECT_EQ(test::TorchData(sent), data) << "the encoder of the tests agrees";
}

TEST(TorchbearerFrame, WhateverIsMaskedComesBack) {
  std::mt19937_64 random(20261121);
  for (int trial = 0; trial < 200; ++trial) {
    TorchMeasurement sent;
    sent.status = static_cast<unsigned>(random() % 3);
    sent.microseconds = static_cast<std::uint32_t>(random());
    sent.exponent = static_cast<unsigned>(random() % 10);
    sent.number = static_cast<std::uint32_t>(random());
    sent.extra = random();
    const auto count = 2 + random() % 40;
    for (std::size_t i = 0; i < count; ++i) {
      sent.samples.push_back(static_cast<std::uint16_t>(random()));
    }
    const auto m = DecodeMeasurement(test::TorchData(sent), {340, 339 + static_cast<int>(count)});
    ASSERT_TRUE(m) << m.error().message;
    EXPECT_EQ(static_cast<unsigned>(m->exposure), sent.status);
    double scale = 1.0;
    for (unsigned i = 0; i < sent.exponent; ++i) scale *= 10.0;
    for (std::size_t i = 0; i < count; ++i) {
      ASSERT_EQ(m->irradiance_W_m2_nm[i], sent.samples[i] / scale) << trial << " " << i;
    }
  }
}

TEST(TorchbearerFrame, AMeasurementOfAnotherLengthStatusOrScaleIsRefused) {
  TorchMeasurement sent;
  sent.samples.assign(5, 1000);
  const Bytes data = test::TorchData(sent);
  EXPECT_TRUE(DecodeMeasurement(data, {500, 504}));
  EXPECT_FALSE(DecodeMeasurement(data, {500, 505}));
  EXPECT_FALSE(DecodeMeasurement(std::span(data).first(data.size() - 1), {500, 504}));
  EXPECT_FALSE(DecodeMeasurement({}, {500, 504}));
  EXPECT_FALSE(DecodeMeasurement(Altered(data, 0, 3), {500, 504}));
  sent.exponent = 19;
  EXPECT_FALSE(DecodeMeasurement(test::TorchData(sent), {500, 504}));
}

TEST(TorchbearerFrame, ShortAnswersSayOneThing) {
  EXPECT_TRUE(DecodeAccepted(FromHex("00")));
  EXPECT_EQ(DecodeAccepted(FromHex("01")).error().code, "nak");
  EXPECT_EQ(DecodeAccepted({}).error().code, "bad_reply");
  EXPECT_TRUE(*DecodeExposureMode(FromHex("01")));
  EXPECT_FALSE(*DecodeExposureMode(FromHex("00")));
  EXPECT_FALSE(DecodeExposureMode(FromHex("02")));
  EXPECT_EQ(*DecodeDeviceId(FromHex("59 32 31 2D 31 00 00")), "Y21-1");
  EXPECT_FALSE(DecodeDeviceId(FromHex("59 80")));
  EXPECT_FALSE(DecodeDeviceId({}));
  EXPECT_FALSE(DecodeRange(FromHex("1A 04 54 01")));  // 1050 to 340
  EXPECT_FALSE(DecodeRange(FromHex("00 00 1A 04")));
  EXPECT_FALSE(DecodeRange(FromHex("54 01 1A")));
}

}  // namespace
}  // namespace lightcal::devices::torchbearer
