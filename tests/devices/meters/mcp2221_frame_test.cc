// SPDX-License-Identifier: Apache-2.0
// The bridge's reports, byte for byte as its data sheet has them.
#include <gmock/gmock.h>

#include "hex_bytes.h"
#include "lightcal_devices/meters/mcp2221/frame.h"

namespace lightcal::devices::mcp2221 {
namespace {

using test::Altered;
using test::FromHex;

// A report of 64 bytes that begins so.
Bytes Report(const std::string& hex) {
  Bytes report = FromHex(hex);
  report.resize(kReportBytes);
  return report;
}

// What hidapi is given: a 0, then the report.
Bytes Sent(const std::string& hex) {
  Bytes report = FromHex("00 " + hex);
  report.resize(1 + kReportBytes);
  return report;
}

TEST(Mcp2221Request, IsTheBytesOfTheDataSheet) {
  EXPECT_EQ(EncodeStatus(), Sent("10"));
  EXPECT_EQ(EncodeCancel(), Sent("10 00 10"));
  EXPECT_EQ(EncodeSpeed(kDivider100kHz), Sent("10 00 00 20 75"));
  EXPECT_EQ(EncodeWrite(Command::kWrite, 0x23, FromHex("01")), Sent("90 01 00 46 01"));
  EXPECT_EQ(EncodeWrite(Command::kWriteNoStop, 0x44, FromHex("7E")), Sent("94 01 00 88 7E"));
  EXPECT_EQ(EncodeRead(Command::kRead, 0x23, 2), Sent("91 02 00 47"));
  EXPECT_EQ(EncodeRead(Command::kReadRepeatedStart, 0x44, 16), Sent("93 10 00 89"));
  EXPECT_EQ(EncodeFetch(), Sent("40"));
}

TEST(Mcp2221Status, TellsTheEngineAndAnAddressNobodyAcknowledged) {
  EXPECT_EQ(DecodeStatus(Report("10"))->engine, kEngineIdle);
  EXPECT_EQ(DecodeStatus(Altered(Report("10"), 8, 0x45))->engine, kEngineWroteNoStop);
  EXPECT_FALSE(DecodeStatus(Report("10"))->address_nack);
  EXPECT_TRUE(DecodeStatus(Altered(Report("10"), 20, 0x40))->address_nack);
  EXPECT_TRUE(DecodeStatus(Report("10 00 00 20"))->speed_taken);
  EXPECT_FALSE(DecodeStatus(Report("10 00 00 21"))->speed_taken);
}

TEST(Mcp2221Acceptance, IsTheSecondByte) {
  EXPECT_TRUE(DecodeAcceptance(Report("90 00"), Command::kWrite)->accepted);
  const auto refused = DecodeAcceptance(Report("90 01 25"), Command::kWrite);
  EXPECT_FALSE(refused->accepted);
  EXPECT_EQ(refused->engine, kEngineAddressNack);
}

TEST(Mcp2221Fetch, GivesTheBytesOrNothingYet) {
  EXPECT_EQ(**DecodeFetched(Report("40 00 55 02 00 29")), FromHex("00 29"));
  EXPECT_FALSE(DecodeFetched(Report("40 41"))->has_value()) << "partial";
  EXPECT_FALSE(DecodeFetched(Report("40 00 55 7F"))->has_value()) << "an error's count";
}

TEST(Mcp2221Fetch, RefusesMoreBytesThanAReportHolds) {
  EXPECT_EQ(DecodeFetched(Report("40 00 55 3D")).error().code, kBadReply);
}

TEST(Mcp2221Reply, TruncatedOrOfAnotherCommandIsRefused) {
  Bytes cut = Report("10");
  cut.pop_back();
  EXPECT_EQ(DecodeStatus(cut).error().code, kBadReply);
  EXPECT_EQ(DecodeStatus({}).error().code, kBadReply);
  EXPECT_EQ(DecodeStatus(Report("40")).error().code, kBadReply);
  EXPECT_EQ(DecodeAcceptance(Report("91"), Command::kWrite).error().code, kBadReply);
  EXPECT_EQ(DecodeFetched(Report("10")).error().code, kBadReply);
}

TEST(Mcp2221Engine, EveryFaultIsSaidInWords) {
  for (const unsigned state : {0x12U, 0x17U, 0x23U, 0x25U, 0x44U, 0x52U, 0x62U}) {
    EXPECT_FALSE(EngineFault(state).empty()) << state;
  }
  EXPECT_TRUE(EngineFault(kEngineIdle).empty());
  EXPECT_TRUE(EngineFault(kEngineWroteNoStop).empty());
}

}  // namespace
}  // namespace lightcal::devices::mcp2221
