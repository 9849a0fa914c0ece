// SPDX-License-Identifier: Apache-2.0
// Sessions as directories and files, and journals good, bad and torn.
#include <gmock/gmock.h>

#include <filesystem>
#include <string>

#include "lightcal/records/session_codec.h"
#include "run_cli.h"

namespace lightcal {
namespace {

using test::TempDir;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kToml =
    "lightcal = 1\n[[light]]\nname = \"key\"\nkind = \"point\"\n"
    "[[reading]]\nlight = \"key\"\ndistance_m = 0.5\nilluminance_lx = 192\n";
const std::string kLine = R"({"light":"key","distance_m":1.0,"illuminance_lx":50.0})";

LoadedSession Load(const std::string& path) {
  auto loaded = LoadSession(path);
  if (!loaded) ADD_FAILURE() << loaded.error().subject << ": " << loaded.error().message;
  return loaded ? *loaded : LoadedSession{};
}

LoadedSession LoadWithJournal(const std::string& journal) {
  const TempDir dir;
  dir.Write("session.toml", kToml);
  dir.Write("readings.jsonl", journal);
  return Load(dir.path());
}

TEST(LoadSession, DirectoryGivesItsNameStemAndInputs) {
  const TempDir dir;
  const std::string toml = dir.Write("desk/session.toml", kToml);
  const std::string journal = dir.Write("desk/readings.jsonl", kLine + "\n");
  const Session session = Load(dir.path() + "/desk").session;
  EXPECT_EQ(session.stem, "desk");
  EXPECT_EQ(session.name, "desk");
  EXPECT_EQ(session.directory, dir.path() + "/desk");
  EXPECT_THAT(session.input_files, ElementsAre(toml, journal));
  ASSERT_EQ(session.readings.size(), 2U);
  EXPECT_EQ(session.readings[0].where, "session.toml [[reading]] 1");
  EXPECT_EQ(session.readings[1].where, "readings.jsonl:1");
  EXPECT_EQ(session.readings[1].reading.illuminance, Lux(50.0));
}

TEST(LoadSession, StemIgnoresASlashAtTheEndAndNamesTheWorkingDirectory) {
  const TempDir dir;
  dir.Write("desk/session.toml", kToml);
  EXPECT_EQ(Load(dir.path() + "/desk/").session.stem, "desk");
  const auto former = std::filesystem::current_path();
  std::filesystem::current_path(dir.path() + "/desk");
  EXPECT_EQ(Load(".").session.stem, "desk");
  EXPECT_EQ(Load("session.toml").session.stem, "desk");
  std::filesystem::current_path(former);
}

TEST(LoadSession, SessionTomlItselfMeansItsDirectory) {
  const TempDir dir;
  const std::string toml = dir.Write("desk/session.toml", kToml);
  dir.Write("desk/readings.jsonl", kLine + "\n");
  EXPECT_EQ(Load(toml).session.readings.size(), 2U);
  EXPECT_EQ(JournalPath(toml), dir.path() + "/desk/readings.jsonl");
  EXPECT_EQ(JournalPath(dir.path() + "/desk"), dir.path() + "/desk/readings.jsonl");
}

TEST(LoadSession, AnyOtherTomlHasAJournalOfItsOwnName) {
  const TempDir dir;
  const std::string toml = dir.Write("lamp.toml", kToml);
  dir.Write("readings.jsonl", kLine + "\n");
  EXPECT_EQ(Load(toml).session.stem, "lamp");
  EXPECT_EQ(Load(toml).session.readings.size(), 1U);
  dir.Write("lamp.readings.jsonl", kLine + "\n" + kLine + "\n");
  EXPECT_EQ(JournalPath(toml), dir.path() + "/lamp.readings.jsonl");
  EXPECT_EQ(Load(toml).session.readings.size(), 3U);
}

TEST(LoadSession, MissingPathsSayWhatToCreate) {
  const TempDir dir;
  const auto nothing = LoadSession(dir.path() + "/nowhere");
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().code, "not_found");
  EXPECT_EQ(nothing.error().kind, ErrorKind::kFailed);
  const auto empty = LoadSession(dir.path());
  ASSERT_FALSE(empty);
  EXPECT_EQ(empty.error().code, "not_found");
  EXPECT_THAT(empty.error().message, HasSubstr("session.toml"));
  EXPECT_THAT(empty.error().message, HasSubstr("lightcal = 1"));
}

TEST(LoadSession, WhatIsNoFileIsUnreadable) {
  const TempDir dir;
  std::filesystem::create_directory(dir.path() + "/session.toml");
  const auto loaded = LoadSession(dir.path());
  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.error().code, "unreadable");
  const auto device = LoadSession("/dev/zero");
  ASSERT_FALSE(device);
  EXPECT_EQ(device.error().code, "unreadable");
}

TEST(LoadSession, ConeTheWrongWayRoundIsClosedAndSaid) {
  const TempDir dir;
  dir.Write("session.toml",
            "lightcal = 1\n[[light]]\nname = \"key\"\nkind = \"spot\"\ninner_deg = 40\n"
            "outer_deg = 20\n");
  const LoadedSession loaded = Load(dir.path());
  ASSERT_EQ(loaded.warnings.size(), 1U);
  EXPECT_EQ(loaded.warnings[0].code, "cone_order");
  EXPECT_EQ(loaded.warnings[0].subject, "key");
  EXPECT_EQ(loaded.session.lights[0].inner, RadiansFromDegrees(20.0));
}

TEST(Journal, BadRowIsRejectedWithItsLineAndTheOthersCount) {
  const LoadedSession loaded =
      LoadWithJournal(kLine + "\n" +                                                     // 1
                      R"({"light":"kye","distance_m":1,"illuminance_lx":50})" + "\n" +   // 2
                      "\n" +                                                             // 3, blank
                      R"({"light":"key","distance_m":0,"illuminance_lx":50})" + "\n" +   // 4
                      R"({"light":"key","meter":"x","illuminance_lx":50})" + "\n" +      // 5
                      R"({"distance_m":1,"illuminance_lx":50})" + "\n" +                 // 6
                      R"({"light":"key","distnace_m":1,"illuminance_lx":50})" + "\n" +   // 7
                      kLine + "\n" +                                                     // 8
                      R"({"light":"key","distance_m":1,"illuminance_lx":NaN})" + "\n");  // 9
  ASSERT_EQ(loaded.session.readings.size(), 3U);
  EXPECT_EQ(loaded.session.readings[1].where, "readings.jsonl:1");
  EXPECT_EQ(loaded.session.readings[2].where, "readings.jsonl:8");
  const std::vector<std::pair<std::string, std::string>> expected = {
      {"readings.jsonl:2", "\"key\""},        {"readings.jsonl:4", "above 0"},
      {"readings.jsonl:5", "\"x\""},          {"readings.jsonl:6", "light is missing"},
      {"readings.jsonl:7", "\"distance_m\""}, {"readings.jsonl:9", "not JSON"}};
  ASSERT_EQ(loaded.warnings.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(loaded.warnings[i].code, "bad_reading");
    EXPECT_EQ(loaded.warnings[i].subject, expected[i].first);
    EXPECT_THAT(loaded.warnings[i].message, HasSubstr(expected[i].second));
  }
}

TEST(Journal, OnlyBadRowsStillLoad) {
  const LoadedSession loaded = LoadWithJournal("{\"light\":\"key\"}\n{\"light\":\"key\"}\n");
  EXPECT_EQ(loaded.session.readings.size(), 1U);
  EXPECT_EQ(loaded.warnings.size(), 2U);
}

TEST(Journal, WindowsLineEndsAndByteOrderMarkAreRead) {
  const LoadedSession loaded = LoadWithJournal("\xEF\xBB\xBF" + kLine + "\r\n" + kLine + "\r\n");
  EXPECT_EQ(loaded.session.readings.size(), 3U);
  EXPECT_THAT(loaded.warnings, IsEmpty());
}

TEST(Journal, LastLineTornAtAnyByteIsIgnoredAndReported) {
  for (std::size_t kept = 1; kept < kLine.size(); ++kept) {
    const LoadedSession loaded = LoadWithJournal(kLine + "\n" + kLine.substr(0, kept));
    EXPECT_EQ(loaded.session.readings.size(), 2U) << kept;
    ASSERT_EQ(loaded.warnings.size(), 1U) << kept;
    EXPECT_EQ(loaded.warnings[0].code, "torn_journal") << kept;
    EXPECT_EQ(loaded.warnings[0].subject, "readings.jsonl:2");
  }
}

TEST(Journal, LineThatOnlyLacksItsNewlineIsWhole) {
  const LoadedSession loaded = LoadWithJournal(kLine + "\n" + kLine);
  EXPECT_EQ(loaded.session.readings.size(), 3U);
  EXPECT_THAT(loaded.warnings, IsEmpty());
}

TEST(Journal, TornLineClosedByANewlineIsTornAtTheEndAndBadInTheMiddle) {
  const std::string torn = kLine.substr(0, 20) + "\n";
  const LoadedSession last = LoadWithJournal(kLine + "\n" + torn);
  ASSERT_EQ(last.warnings.size(), 1U);
  EXPECT_EQ(last.warnings[0].code, "torn_journal");
  const LoadedSession middle = LoadWithJournal(torn + kLine + "\n");
  ASSERT_EQ(middle.warnings.size(), 1U);
  EXPECT_EQ(middle.warnings[0].code, "bad_reading");
  EXPECT_EQ(middle.session.readings.size(), 2U);
}

TEST(Journal, ZeroBytesLeftByAPowerCutAreATornLine) {
  const LoadedSession loaded = LoadWithJournal(kLine + "\n" + std::string(512, '\0'));
  EXPECT_EQ(loaded.session.readings.size(), 2U);
  ASSERT_EQ(loaded.warnings.size(), 1U);
  EXPECT_EQ(loaded.warnings[0].code, "torn_journal");
}

}  // namespace
}  // namespace lightcal
