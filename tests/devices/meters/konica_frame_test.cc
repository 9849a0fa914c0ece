// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "fake_konica.h"
#include "hex_bytes.h"
#include "lightcal_devices/meters/konica/frame.h"

namespace lightcal::devices::konica {
namespace {

using test::FromHex;
using test::KonicaFrame;
using testing::HasSubstr;

// Captured from a CL-200A: 27.3 lx, x 0.4545, y 0.4499.
const std::string kCaptured =
    "\x02"
    "00021 10+ 2733+45450+44990\x03"
    "1F\r\n";

Bytes Of(const std::string& text) {
  const auto bytes = AsBytes(text);
  return {bytes.begin(), bytes.end()};
}

struct CommandCase {
  int head;
  int command;
  const char* parameters;
  const char* frame;
};
class KonicaCommand : public testing::TestWithParam<CommandCase> {};
TEST_P(KonicaCommand, HasTheBytesOfTheManual) {
  const auto& [head, command, parameters, frame] = GetParam();
  EXPECT_EQ(EncodeCommand(head, command, parameters), frame);
}
INSTANTIATE_TEST_SUITE_P(KonicaFrame, KonicaCommand,
                         testing::Values(CommandCase{0, 54, "1   ",
                                                     "\x02"
                                                     "00541   \x03"
                                                     "13\r\n"},
                                         CommandCase{99, 55, "1  0",
                                                     "\x02"
                                                     "99551  0\x03"
                                                     "02\r\n"},
                                         CommandCase{99, 55, "0  0",
                                                     "\x02"
                                                     "99550  0\x03"
                                                     "03\r\n"},
                                         CommandCase{0, 40, "10  ",
                                                     "\x02"
                                                     "004010  \x03"
                                                     "06\r\n"},
                                         CommandCase{99, 40, "21  ",
                                                     "\x02"
                                                     "994021  \x03"
                                                     "04\r\n"},
                                         CommandCase{0, 2, "1200",
                                                     "\x02"
                                                     "00021200\x03"
                                                     "02\r\n"},
                                         CommandCase{0, 8, "1200",
                                                     "\x02"
                                                     "00081200\x03"
                                                     "08\r\n"},
                                         CommandCase{0, 10, "0200",
                                                     "\x02"
                                                     "00100200\x03"
                                                     "00\r\n"}));

TEST(KonicaFrame, PcModeIsFourteenBytes) {
  EXPECT_EQ(Of(EncodeCommand(0, 54, "1   ")), FromHex("02 30 30 35 34 31 20 20 20 03 31 33 0D 0A"));
}

TEST(KonicaFrame, TheCapturedReplyIs27Point3LuxAtItsChromaticity) {
  const auto reply = DecodeLongReply(AsBytes(kCaptured), 0, 2);
  ASSERT_TRUE(reply) << reply.error().message;
  EXPECT_EQ(reply->status.condition, Condition::kOk);
  EXPECT_FALSE(reply->status.battery_low);
  EXPECT_EQ(reply->data[0]->Value(), 27.3);
  EXPECT_EQ(reply->data[1]->Value(), 0.4545);
  EXPECT_EQ(reply->data[2]->Value(), 0.4499);
}

TEST(KonicaFrame, AT10AReplyHasOneNumber) {
  const std::string bytes =
      "\x02"
      "00101 00+12344            \x03"
      "08\r\n";
  const auto reply = DecodeLongReply(AsBytes(bytes), 0, 10);
  ASSERT_TRUE(reply) << reply.error().message;
  EXPECT_EQ(reply->data[0]->Value(), 1234.0);
  EXPECT_FALSE(reply->data[1]);
  EXPECT_FALSE(reply->data[2]);
}

struct NumberCase {
  const char* text;
  double value;
};
class KonicaNumber : public testing::TestWithParam<NumberCase> {};
TEST_P(KonicaNumber, IsItsDigitsTimesAPowerOfTen) {
  const std::string body = std::string("00101 00") + GetParam().text + "            ";
  const auto reply = DecodeLongReply(AsBytes(KonicaFrame(body)), 0, 10);
  ASSERT_TRUE(reply) << reply.error().message;
  EXPECT_EQ(reply->data[0]->Value(), GetParam().value);
}
INSTANTIATE_TEST_SUITE_P(KonicaFrame, KonicaNumber,
                         testing::Values(NumberCase{"+   12", 0.01}, NumberCase{"+ 2733", 27.3},
                                         NumberCase{"-00450", -0.0045}, NumberCase{"=00000", 0.0},
                                         NumberCase{"+29996", 299900.0},
                                         NumberCase{"+99999", 999900000.0}));

class BadNumber : public testing::TestWithParam<const char*> {};
TEST_P(BadNumber, IsABadReply) {
  const std::string body = std::string("00101 00") + GetParam() + "            ";
  const auto reply = DecodeLongReply(AsBytes(KonicaFrame(body)), 0, 10);
  ASSERT_FALSE(reply);
  EXPECT_EQ(reply.error().code, "bad_reply");
  EXPECT_THAT(reply.error().message, HasSubstr("number 1"));
}
INSTANTIATE_TEST_SUITE_P(KonicaFrame, BadNumber,
                         testing::Values("+    3", "+12 43", "*12344", "+1234x", "+12.44", "+-1234",
                                         "  2733"));

struct StatusCase {
  char s1;
  Condition condition;
};
class KonicaStatus : public testing::TestWithParam<StatusCase> {};
TEST_P(KonicaStatus, IsWhatTheManualSays) {
  std::string body = "00021 10+ 2733+45450+44990";
  body[5] = GetParam().s1;
  EXPECT_EQ(DecodeLongReply(AsBytes(KonicaFrame(body)), 0, 2)->status.condition,
            GetParam().condition);
  std::string short_body = "0040    ";
  short_body[5] = GetParam().s1;
  EXPECT_EQ(*DecodeShortReply(AsBytes(KonicaFrame(short_body)), 0, 40), GetParam().condition);
}
INSTANTIATE_TEST_SUITE_P(KonicaFrame, KonicaStatus,
                         testing::Values(StatusCase{' ', Condition::kOk},
                                         StatusCase{'1', Condition::kHeadPowerOff},
                                         StatusCase{'2', Condition::kMemoryError},
                                         StatusCase{'3', Condition::kMemoryError},
                                         StatusCase{'4', Condition::kExtRefused},
                                         StatusCase{'5', Condition::kOverRange},
                                         StatusCase{'6', Condition::kLowLuminance},
                                         StatusCase{'7', Condition::kCctOutOfRange}));

TEST(KonicaFrame, ABatteryOf1Or3IsLow) {
  for (const char s3 : {'0', '1', '2', '3'}) {
    std::string body = "00021 10+ 2733+45450+44990";
    body[7] = s3;
    EXPECT_EQ(DecodeLongReply(AsBytes(KonicaFrame(body)), 0, 2)->status.battery_low,
              s3 == '1' || s3 == '3');
  }
}

TEST(KonicaFrame, EveryTruncationIsABadReply) {
  for (std::size_t length = 0; length < kCaptured.size(); ++length) {
    const auto reply =
        DecodeLongReply(AsBytes(std::string_view(kCaptured).substr(0, length)), 0, 2);
    ASSERT_FALSE(reply) << length;
    EXPECT_EQ(reply.error().code, "bad_reply");
  }
}

// Any one changed bit shows: in the frame, or in the exclusive or.
TEST(KonicaFrame, EverySingleChangedBitIsABadReply) {
  for (std::size_t at = 0; at < kCaptured.size(); ++at) {
    for (unsigned bit = 0; bit < 7; ++bit) {
      std::string damaged = kCaptured;
      damaged[at] = static_cast<char>(damaged[at] ^ (1U << bit));
      const bool lower_case = std::isalpha(static_cast<unsigned char>(kCaptured[at])) && bit == 5;
      EXPECT_EQ(DecodeLongReply(AsBytes(damaged), 0, 2).has_value(), lower_case)
          << at << " " << bit;
    }
  }
}

TEST(KonicaFrame, AReplyToAnotherCommandOrHeadIsABadReply) {
  EXPECT_THAT(DecodeLongReply(AsBytes(kCaptured), 0, 8).error().message,
              HasSubstr("does not answer head 00, command 08"));
  EXPECT_FALSE(DecodeLongReply(AsBytes(kCaptured), 1, 2));
  EXPECT_FALSE(DecodeShortReply(AsBytes(KonicaFrame("0054    ")), 0, 40));
}

}  // namespace
}  // namespace lightcal::devices::konica
