// SPDX-License-Identifier: Apache-2.0
// Photometric files that lie, are cut, or mean harm.
#include <gtest/gtest.h>

#include <random>

#include "lightcal/records/photometric_codec.h"

namespace lightcal {
namespace {

const std::string kHead = "IESNA:LM-63-2002\n[TEST] x\nTILT=NONE\n";
const std::string kGood = kHead + "1 1000 1 3 1 1 2 0 0 0\n1 1 60\n0 45 90\n0\n100 80 0\n";

std::string CodeOf(std::string_view text, const TiltText& tilt = {}) {
  const auto read = PhotometricFromText(text, "x", tilt);
  return read ? "read" : read.error().code;
}

TEST(HostilePhotometric, CountsThatTheFileCannotHoldAreRefusedBeforeMemoryIsTaken) {
  EXPECT_EQ(CodeOf(kHead + "1 1000 1 1000000 1000000 1 2 0 0 0\n1 1 60\n0 90\n"),
            "bad_photometric");
  EXPECT_EQ(CodeOf(kHead + "1 1000 1 1e300 1 1 2 0 0 0\n1 1 60\n0 90\n"), "bad_photometric");
  EXPECT_EQ(CodeOf(kHead + "1 1000 1 -3 1 1 2 0 0 0\n1 1 60\n0 90\n"), "bad_photometric");
  EXPECT_EQ(CodeOf(kHead + "1 1000 1 2.5 1 1 2 0 0 0\n1 1 60\n0 90\n"), "bad_photometric");
  EXPECT_EQ(CodeOf("x\n1\n0\n100000\n0\n100000\n0\n"), "unknown_format");
}

TEST(HostilePhotometric, NumbersThatAreNoneAreNamed) {
  for (const char* bad : {"nan", "inf", "1e999", "0x10", "--1", "abc", "1..2"}) {
    std::string text = kGood;
    text.replace(text.find("80"), 2, bad);
    const auto read = PhotometricFromText(text, "lamp.ies");
    ASSERT_FALSE(read) << bad;
    EXPECT_EQ(read.error().code, "bad_photometric");
    EXPECT_NE(read.error().message.find(bad), std::string::npos) << read.error().message;
  }
  std::string negative = kGood;
  negative.replace(negative.find("80"), 2, "-8");
  EXPECT_EQ(CodeOf(negative), "bad_table");
}

TEST(HostilePhotometric, TiltNeverLeadsOutOfTheDirectory) {
  const TiltText never = [](const std::string& name) -> Result<std::string> {
    ADD_FAILURE() << "asked for " << name;
    return std::string();
  };
  for (const char* name :
       {"../secret", "/etc/passwd", "a/b.tlt", "..\\x", "C:x.tlt", ".hidden", "..", "a\tb/c"}) {
    const std::string text = std::string("IESNA:LM-63-1995\nTILT=") + name +
                             "\n1 1000 1 2 1 1 2 0 0 0\n1 1 60\n0 90\n0\n1 1\n";
    EXPECT_EQ(CodeOf(text, never), "unsafe_path") << name;
  }
}

TEST(HostilePhotometric, EndlessLinesAndTooLargeFilesAreRefused) {
  EXPECT_EQ(CodeOf(std::string(kMaxPhotometricBytes + 1, '1')), "too_large");
  EXPECT_EQ(CodeOf(std::string(20'000'000, 'x')), "unknown_format");
  EXPECT_EQ(CodeOf(kHead + std::string(20'000'000, '1')), "bad_photometric");
  const auto read = PhotometricFromText(kHead + std::string(20'000'000, '1'), "x");
  EXPECT_LT(read.error().message.size(), 400U);
  const auto named = PhotometricFromText(
      "[LUMINAIRE] " + std::string(20'000'000, 'x') + "\n" + kGood.substr(kHead.find("TILT")), "x");
  ASSERT_TRUE(named);
  EXPECT_LT(named->file.header.luminaire.size(), 300U);
}

TEST(HostilePhotometric, EveryCutIsRefusedOrStillALamp) {
  for (std::size_t n = 0; n < kGood.size(); ++n) {
    const auto read = PhotometricFromText(kGood.substr(0, n), "x");
    if (!read) {
      EXPECT_FALSE(read.error().message.empty());
      continue;
    }
    EXPECT_GT(read->file.table.Flux().value(), 0.0);
  }
}

TEST(HostilePhotometric, DamagedBytesNeverBreakAnythingAndWhatIsReadCanBeWritten) {
  std::mt19937 random(3);
  const std::string ldt = *EulumdatText(PhotometricFromText(kGood, "x")->file);
  for (int trial = 0; trial < 4000; ++trial) {
    std::string text = trial % 2 == 0 ? kGood : ldt;
    for (int k = 0; k < 3; ++k) {
      text[random() % text.size()] = "0123456789.-,e \n\xff"[random() % 17];
    }
    const auto read = PhotometricFromText(text, "x");
    if (!read) continue;
    const auto again = PhotometricFromText(IesText(read->file), "again");
    if (again) {
      EXPECT_EQ(IesText(again->file), IesText(read->file));
    }
  }
}

}  // namespace
}  // namespace lightcal
