// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <vector>

#include "lightcal/core/joined.h"
#include "shell/shell_texts.h"

namespace lightcal::app {
namespace {

std::string FishQuoted(const std::string& text) {
  return "'" + Replaced(Replaced(text, "\\", "\\\\"), "'", "\\'") + "'";
}

// "__fish_seen_subcommand_from lights; and __fish_seen_subcommand_from list"
std::string Condition(const TypedCommand& command) {
  if (command.path.empty()) return "__fish_use_subcommand";
  return "__fish_seen_subcommand_from " +
         Joined(command.path, "; and __fish_seen_subcommand_from ");
}

std::string OptionLine(const std::string& start, const TypedOption& option) {
  std::string words;
  for (const std::string& word : option.words) words += " " + word;
  std::string line = start;
  for (const std::string& name : option.names) {
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  if (option.names.empty()) {
    return words.empty() ? "" : line + " -f -a " + FishQuoted(words.substr(1)) + "\n";
  }
  if (!words.empty()) {
    line +=
        " -x -a " + FishQuoted(option.commas ? "(__fish_append ," + words + ")" : words.substr(1));
  } else if (option.values > 0) {
    line += option.number ? " -x" : " -r -F";
  }
  return line + " -d " + FishQuoted(option.summary) + "\n";
}

std::string Lines(const TypedCommand& command) {
  const std::string start = "complete -c lightcal -n " + FishQuoted(Condition(command));
  std::string text;
  for (const TypedOption& option : command.options) text += OptionLine(start, option);
  for (const TypedCommand& below : command.commands) {
    text += start + " -f -a " + below.path.back() + " -d " + FishQuoted(below.summary) + "\n";
  }
  for (const TypedCommand& below : command.commands) text += Lines(below);
  return text;
}

}  // namespace

std::string FishCompletion(const TypedCommand& lightcal) {
  return "# fish completion of lightcal, made by: lightcal completion fish\n" + Lines(lightcal);
}

}  // namespace lightcal::app
