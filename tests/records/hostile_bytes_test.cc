// SPDX-License-Identifier: Apache-2.0
// Bytes nobody writes by accident: an answer, never a crash, and never a message as long as they.
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "lightcal/records/light_codec.h"
#include "lightcal/records/session_codec.h"

namespace lightcal {
namespace {

constexpr std::size_t kMany = 1'000'000;
constexpr std::size_t kLongestMessage = 2000;

std::string Repeat(std::string_view piece, std::size_t times) {
  std::string text;
  text.reserve(piece.size() * times);
  for (std::size_t i = 0; i < times; ++i) text += piece;
  return text;
}

template <class T>
void ExpectShortRefusal(const Result<T>& result) {
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, ErrorKind::kRefused);
  EXPECT_LT(result.error().message.size(), kLongestMessage);
  for (const char c : result.error().message) EXPECT_GE(static_cast<unsigned char>(c), 0x20);
}

std::vector<std::string> HostileJson() {
  return {Repeat("[", kMany),
          Repeat("{\"a\":", kMany),
          Repeat("[", 1000) + Repeat("]", 1000),
          "{\"" + std::string(kMany, 'a') + "\":1}",
          "{\"light\":\"" + std::string(kMany, 'a'),
          "{\"x\\u001b[31m\":1}",
          "{\"light\":\"a\\u0000b\",\"illuminance_lx\":1}",
          std::string(kMany, '\0'),
          std::string("{\"light\":\"a\0b\"}", 15),
          std::string(kMany, '9'),
          "{\"distance_m\":" + std::string(kMany, '9') + "}",
          "{\"distance_m\":1e-" + std::string(kMany, '9') + "}",
          "\xff\xfe{\"light\"",
          "{\"light\":\"\xed\xa0\x80\"}"};
}

TEST(HostileBytes, JournalLineIsRefusedInFewWords) {
  for (const std::string& text : HostileJson()) {
    SCOPED_TRACE(text.substr(0, 40));
    ExpectShortRefusal(ReadingFromJson(text, "readings.jsonl:1"));
  }
}

TEST(HostileBytes, LightJsonIsRefusedInFewWords) {
  for (const std::string& text : HostileJson()) {
    SCOPED_TRACE(text.substr(0, 40));
    ExpectShortRefusal(LightFileFromJson(text, "light.json"));
  }
}

TEST(HostileBytes, SessionTomlIsRefusedInFewWords) {
  const std::vector<std::string> texts = {
      Repeat("a.", kMany) + "a = 1", "[" + Repeat("a.", kMany) + "a]",
      "[" + Repeat("1.", kMany) + "1]", "[" + Repeat("\"=\".", kMany) + "a]",
      "[" + Repeat("1.1 . ", kMany) + "1]", "x = " + Repeat("[", kMany),
      "x = " + Repeat("{a=", kMany), Repeat("x = {" + Repeat("a.", 300) + "b = [\n", 300),
      // The deepest tree the guard lets through: 8 joints on each line, 1000 more on one.
      "x = [\n" + Repeat("{" + Repeat("a.", 8) + "a = [\n", 120) + "{" + Repeat("a.", 990),
      "[" + Repeat("a.", 990) + "a]\nx = 1", std::string(kMany, 'a') + " = 1",
      "a = \"" + std::string(kMany, 'b'), std::string(kMany, '\0'),
      std::string("lightcal = 1\0", 13), "\xff\xfe", "\"\\u001b[31m\" = 1",
      "lightcal = 99999999999999999999999999"};
  for (const std::string& text : texts) {
    SCOPED_TRACE(text.substr(0, 40));
    ExpectShortRefusal(ParseSessionToml(text, "session.toml"));
  }
}

TEST(HostileBytes, ManyDecimalPointsOnOneLineAreNoDeepKey) {
  std::string text = "lightcal = 1\nlight = [{name = \"a\", kind = \"point\"}]\nreading = [";
  constexpr int kReadings = 3000;
  for (int i = 0; i < kReadings; ++i) {
    text += "{light = \"a\", distance_m = 1.5, illuminance_lx = +20.25e1}, ";
  }
  const auto session = ParseSessionToml(text + "]\n", "session.toml");
  ASSERT_TRUE(session) << session.error().message;
  EXPECT_EQ(session->readings.size(), static_cast<std::size_t>(kReadings));
}

// Each byte of a good file in turn replaced: whatever comes out, it comes out.
TEST(HostileBytes, EveryFlippedByteOfAGoodSessionStillAnswers) {
  const std::string good =
      "lightcal = 1\n[[light]]\nname = \"a\"\nkind = \"spot\"\naim = [0, 0, -1]\n[[reading]]\n"
      "light = \"a\"\ndistance_m = 0.5\nilluminance_lx = 1e2\ntime = 2026-01-02\n";
  int refused = 0;
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (const char other : {'\0', '\n', '"', '[', ']', '=', '.', '-', '9', '\x80'}) {
      std::string text = good;
      text[i] = other;
      const auto session = ParseSessionToml(text, "session.toml");
      if (!session) {
        ++refused;
        EXPECT_FALSE(session.error().message.empty());
      }
    }
  }
  EXPECT_GT(refused, static_cast<int>(good.size()) * 5);
}

}  // namespace
}  // namespace lightcal
