// SPDX-License-Identifier: Apache-2.0
// A program named spotread in a folder of its own, to stand earlier in PATH than a real one.
#pragma once

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "run_cli.h"

namespace lightcal::test {

// What one run of the program does, as shell words; $D is the program's folder.
namespace spotread_does {
// Prints a text and ends.
inline std::string Print(const std::string& text, int exit_code = 0) {
  return "cat <<'END_OF_TEXT'\n" + text + "\nEND_OF_TEXT\nexit " + std::to_string(exit_code);
}
// Prints a text, then asks as spotread does: q ends it, any other key and the end of its input
// make it ask again.
inline std::string AskToRetry(const std::string& text) {
  return "while :; do cat <<'END_OF_TEXT'\n" + text +
         "\nEND_OF_TEXT\nread key; echo \"key:$key\" >> $D/keys; "
         "if [ \"$key\" = q ]; then exit 0; fi; done";
}
// Says the same for ever.
inline std::string Repeat(const std::string& text) {
  return "while :; do cat <<'END_OF_TEXT'\n" + text + "\nEND_OF_TEXT\ndone";
}
inline std::string Hang() { return "echo $$ > $D/pid; sleep 600"; }
inline std::string Crash() { return "kill -SEGV $$"; }
}  // namespace spotread_does

class FakeSpotread {
 public:
  // The n-th run does the n-th of `runs`; later runs the last again.
  explicit FakeSpotread(const std::vector<std::string>& runs) {
    std::string script = "#!/bin/sh\nD=" + dir_.path() +
                         "\necho \"$@\" >> $D/runs\nn=$(wc -l < $D/runs)\ncase $n in\n";
    for (std::size_t i = 0; i + 1 < runs.size(); ++i) {
      script += std::to_string(i + 1) + ")\n" + runs[i] + "\n;;\n";
    }
    script += "*)\n" + runs.back() + "\n;;\nesac\n";
    const std::string path = dir_.Write("spotread", script);
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  }
  [[nodiscard]] std::string program() const { return dir_.path() + "/spotread"; }
  // For a program's environment.
  [[nodiscard]] std::string Path() const { return "PATH=" + dir_.path() + ":/usr/bin:/bin"; }
  // The arguments of each run.
  [[nodiscard]] std::vector<std::string> Runs() const { return Lines("runs"); }
  // What came from its standard input.
  [[nodiscard]] std::vector<std::string> Keys() const { return Lines("keys"); }
  [[nodiscard]] const TempDir& dir() const { return dir_; }

 private:
  [[nodiscard]] std::vector<std::string> Lines(const std::string& name) const {
    std::vector<std::string> lines;
    std::istringstream stream(ReadFile(dir_.path() + "/" + name));
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
  }
  TempDir dir_;
};

}  // namespace lightcal::test
