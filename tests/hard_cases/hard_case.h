// SPDX-License-Identifier: Apache-2.0
// What all hard cases share: a session typed in, lightcal asked, and the promise every row holds:
// exit 0, 2 or 3, one JSON document, and no NaN or infinity in anything that is written.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "run_cli.h"

namespace lightcal::test::hard {

using nlohmann::json;
using Words = std::vector<std::string>;

struct Answer {
  int exit_code = -1;
  json document;
  std::string err;
};

// lightcal `words` --json.
Answer Ask(Words words, const std::string& input = "");

bool Warns(const Answer& answer, const std::string& code);
void ExpectAnswered(const Answer& answer);
// Exit 0 with this warning, exit 3 with --strict: ask again with it.
void ExpectWarned(const Answer& answer, const std::string& code);
// Exit 3 with this code and a message.
void ExpectRefused(const Answer& answer, const std::string& code);

// Whether text has nan, inf or infinity as a word of its own.
bool HoldsNonFinite(const std::string& text);
// No file at or below the directory does.
void ExpectFiniteFiles(const std::string& directory);

// The shortest text that reads back as this double; nan and inf as TOML writes them.
std::string Text(double value);

// Lines after [[light]]: readings made by the inverse square law have no walls in them; and a lamp
// whose light starts where it is measured from, within 3 cm.
inline constexpr const char* kDark = "[room]\ndark = true";
inline constexpr const char* kDarkBulb = "fixture = \"bulb\"\n[room]\ndark = true";

// One lamp, "key", in a session of its own folder.
class KeySession {
 public:
  explicit KeySession(const std::string& kind = "point", const std::string& light_lines = "");
  // A reading at a distance; `more`: further lines.
  KeySession& At(double distance_m, double lux, const std::string& more = "");
  // One of a meter that lies flat, facing up.
  KeySession& Flat(const std::array<double, 3>& position_m, double lux,
                   const std::string& more = "");
  // A line of the journal, as it is.
  KeySession& Journal(const std::string& line);

  // `lightcal run` with every preset and the report, whose files are checked.
  [[nodiscard]] Answer Run(Words more = {}) const;
  // The file of the last run that ends so: ".gltf", ".tscn"; as text, or as JSON.
  [[nodiscard]] std::string PresetText(const std::string& ending) const;
  [[nodiscard]] json Preset(const std::string& ending) const;
  [[nodiscard]] std::string path() const { return folder_.path(); }

 private:
  TempDir folder_;
  std::string toml_;
  std::string journal_;
};

const json& Lamp(const Answer& answer);
double Value(const Answer& answer, const char* key);
double U95(const Answer& answer, const char* key);
// Whether a parameter stands among fit.prior or fit.learned.
bool IsPrior(const Answer& answer, const std::string& parameter);
bool IsLearned(const Answer& answer, const std::string& parameter);
std::vector<int> Rejected(const Answer& answer);

}  // namespace lightcal::test::hard
