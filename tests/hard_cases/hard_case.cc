// SPDX-License-Identifier: Apache-2.0
#include "hard_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <string_view>

namespace lightcal::test::hard {
namespace {

bool IsOfWord(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

bool IsIn(const json& list, const std::string& word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

}  // namespace

Answer Ask(Words words, const std::string& input) {
  words.emplace_back("--json");
  const CliResult result = RunLightcal(words, input);
  EXPECT_TRUE(result.exit_code == 0 || result.exit_code == 2 || result.exit_code == 3)
      << "exit " << result.exit_code << "\n"
      << result.err;
  Answer answer{result.exit_code, json::parse(result.out, nullptr, false), result.err};
  EXPECT_FALSE(answer.document.is_discarded()) << result.out;
  if (result.exit_code == 0) {
    EXPECT_FALSE(HoldsNonFinite(result.out)) << result.out;
  }
  return answer;
}

bool Warns(const Answer& answer, const std::string& code) {
  const json warnings = answer.document.value("warnings", json::array());
  return std::any_of(warnings.begin(), warnings.end(),
                     [&](const json& warning) { return warning["code"] == code; });
}

void ExpectAnswered(const Answer& answer) {
  EXPECT_EQ(answer.exit_code, 0) << answer.document.dump(2);
}

void ExpectWarned(const Answer& answer, const std::string& code) {
  ExpectAnswered(answer);
  EXPECT_TRUE(Warns(answer, code)) << code << "\n" << answer.document.dump(2);
}

void ExpectRefused(const Answer& answer, const std::string& code) {
  EXPECT_EQ(answer.exit_code, 3) << answer.document.dump(2);
  ASSERT_TRUE(answer.document.contains("error")) << answer.document.dump(2);
  EXPECT_EQ(answer.document["error"]["code"], code) << answer.document.dump(2);
  EXPECT_FALSE(answer.document["error"]["message"].get<std::string>().empty());
}

bool HoldsNonFinite(const std::string& text) {
  std::string lower(text.size(), ' ');
  std::transform(text.begin(), text.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const std::string_view word : {"nan", "inf", "infinity"}) {
    for (auto at = lower.find(word); at != std::string::npos; at = lower.find(word, at + 1)) {
      const auto end = at + word.size();
      const bool starts = at == 0 || !IsOfWord(lower[at - 1]);
      if (starts && (end == lower.size() || !IsOfWord(lower[end]))) return true;
    }
  }
  return false;
}

void ExpectFiniteFiles(const std::string& directory) {
  for (const auto& entry : std::filesystem::recursive_directory_iterator(directory)) {
    if (!entry.is_regular_file()) continue;
    const std::string name = entry.path().filename().string();
    EXPECT_FALSE(name.ends_with(".tmp")) << name;
    EXPECT_FALSE(HoldsNonFinite(ReadFile(entry.path().string()))) << entry.path();
  }
}

std::string Text(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
  std::array<char, 64> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  EXPECT_EQ(error, std::errc());
  return {text.data(), end};
}

KeySession::KeySession(const std::string& kind, const std::string& light_lines)
    : toml_("lightcal = 1\nname = \"hard\"\n[[light]]\nname = \"key\"\nkind = \"" + kind + "\"\n" +
            light_lines + "\n") {}

KeySession& KeySession::At(double distance_m, double lux, const std::string& more) {
  toml_ += "[[reading]]\nlight = \"key\"\ndistance_m = " + Text(distance_m) +
           "\nilluminance_lx = " + Text(lux) + "\n" + more + "\n";
  return *this;
}

KeySession& KeySession::Flat(const std::array<double, 3>& position_m, double lux,
                             const std::string& more) {
  toml_ += "[[reading]]\nlight = \"key\"\nnormal = [0, 0, 1]\nposition_m = [" +
           Text(position_m[0]) + ", " + Text(position_m[1]) + ", " + Text(position_m[2]) +
           "]\nilluminance_lx = " + Text(lux) + "\n" + more + "\n";
  return *this;
}

KeySession& KeySession::Journal(const std::string& line) {
  journal_ += line + "\n";
  return *this;
}

Answer KeySession::Run(Words more) const {
  const std::string out = folder_.path() + "/out";
  std::filesystem::remove_all(out);
  folder_.Write("session.toml", toml_);
  if (!journal_.empty()) folder_.Write("readings.jsonl", journal_);
  more.insert(more.begin(), {"run", folder_.path()});
  Answer answer = Ask(more);
  EXPECT_EQ(std::filesystem::exists(out), answer.exit_code == 0) << answer.err;
  if (answer.exit_code == 0) ExpectFiniteFiles(out);
  return answer;
}

std::string KeySession::PresetText(const std::string& ending) const {
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path() + "/out")) {
    if (entry.path().string().ends_with(ending)) return ReadFile(entry.path().string());
  }
  ADD_FAILURE() << "no file ends in " << ending;
  return "";
}

json KeySession::Preset(const std::string& ending) const {
  return json::parse(PresetText(ending), nullptr, false);
}

const json& Lamp(const Answer& answer) { return answer.document.at("lights").at(0); }

double Value(const Answer& answer, const char* key) {
  return Lamp(answer).at(key).at("value").get<double>();
}
double U95(const Answer& answer, const char* key) {
  return Lamp(answer).at(key).at("u95").get<double>();
}

bool IsPrior(const Answer& answer, const std::string& parameter) {
  return IsIn(Lamp(answer).at("fit").at("prior"), parameter);
}
bool IsLearned(const Answer& answer, const std::string& parameter) {
  return IsIn(Lamp(answer).at("fit").at("learned"), parameter);
}

std::vector<int> Rejected(const Answer& answer) {
  return Lamp(answer).at("fit").at("rejected").get<std::vector<int>>();
}

}  // namespace lightcal::test::hard
