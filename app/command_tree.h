// SPDX-License-Identifier: Apache-2.0
// What can be typed, read off the CLI11 tree that parses it: completion, the manual page and the
// names of mistyped words all come from here, so that none of them is written by hand.
#pragma once

#include <string>
#include <vector>

#include "command.h"

namespace CLI {
class Option;
}

namespace lightcal::app {

struct TypedOption {
  std::vector<std::string> names;  // "-o", "--output"; none for a word that has no name
  std::string placeholder;         // "FILE.svg|png", a nameless word's name; empty for a flag
  std::vector<std::string> words;  // all it takes, where they are few; else empty
  std::string summary;
  std::string usual;    // its value when it is not given; may be empty
  int values = 0;       // how many follow it; 0 for a flag
  bool many = false;    // further ones may follow or it may be repeated
  bool again = false;   // of those that may be repeated alone
  bool commas = false;  // several words in one, joined by commas
  bool number = false;  // only numbers: no file has such a name
  bool required = false;
};

struct TypedCommand {
  std::vector<std::string> path;  // {"export"}; empty for lightcal itself
  std::string summary;
  std::string examples;
  std::vector<TypedOption> options;  // nameless words last
  std::vector<TypedCommand> commands;
};

// Help that says "again: more" of an option that takes one value a time, where CLI11 would have
// " ...", as if several could follow it.
void SayWhatRepeats(CLI::App& parser);

// Adds a command's parser without its own options, which row.build gives it.
CLI::App& AddCommand(CLI::App& parser, const CommandRow& row, Console::Flags& flags);

// lightcal itself with every command and option.
[[nodiscard]] TypedCommand DescribeCommands();

[[nodiscard]] TypedOption DescribeOption(const CLI::Option& option);

}  // namespace lightcal::app
