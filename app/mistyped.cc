// SPDX-License-Identifier: Apache-2.0
#include "mistyped.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "command_tree.h"
#include "lightcal/core/nearest_word.h"

namespace lightcal::app {
namespace {

// "read", "lights list": the parser the words went to and what it is called.
struct Chosen {
  const CLI::App* parser = nullptr;
  std::string name = "lightcal";
};

Chosen ChosenParser(const CLI::App& parser) {
  Chosen chosen{&parser};
  for (auto below = parser.get_subcommands(); !below.empty();
       below = chosen.parser->get_subcommands()) {
    chosen.parser = below.front();
    chosen.name += " " + chosen.parser->get_name();
  }
  return chosen;
}

Error Usage(std::string subject, std::string message) {
  return WrongUsage(std::move(subject), std::move(message)).value();
}

// What commands, and people, call one thing by.
constexpr std::array<std::array<std::string_view, 5>, 6> kOneThing = {{
    {"--light", "--lamp", "--lights", "--name"},
    {"--to", "--engine", "--target", "--format"},
    {"--output", "--out", "--file", "--save"},
    {"--cct", "--kelvin", "--temperature", "--color-temperature", "--colour-temperature"},
    {"--accuracy", "--sigma", "--uncertainty", "--error"},
    {"--lux", "--illuminance", "--lx"},
}};

// What the command calls that thing, "" where it has no name for it.
std::string OtherName(const std::string& typed, const std::vector<std::string>& names) {
  for (const auto& thing : kOneThing) {
    if (std::ranges::find(thing, typed) == thing.end()) continue;
    const auto here = std::ranges::find_first_of(thing, names);
    if (here != thing.end()) return std::string(*here);
  }
  return "";
}

// An option by another name means the one it has here; one cut short ("--dist") the one that begins
// so; else the nearest by its letters.
std::string NearestOption(const std::string& typed, const std::vector<std::string>& names) {
  if (typed.size() <= 2) return "";  // "-x" is as near to every other letter
  if (std::string other = OtherName(typed, names); !other.empty()) return other;
  const auto begins = [&](const std::string& name) { return name.starts_with(typed); };
  const auto first = std::ranges::find_if(names, begins);
  if (first != names.end() && std::ranges::count_if(names, begins) == 1) return *first;
  const std::vector<std::string_view> known(names.begin(), names.end());
  return NearestWord(typed, known);
}

// The command's own options, and those of the one above it where it hands words on.
std::vector<std::string> OptionNames(const CLI::App* parser) {
  std::vector<std::string> names;
  for (bool more = true; more && parser != nullptr; parser = parser->get_parent()) {
    for (const CLI::Option* option : parser->get_options()) {
      const TypedOption typed = DescribeOption(*option);
      names.insert(names.end(), typed.names.begin(), typed.names.end());
    }
    more = parser->get_fallthrough();
  }
  return names;
}

bool LooksLikeOption(const std::string& word) {
  return word.size() > 1 && word[0] == '-' && word != "--";
}

std::string Hint(const std::string& nearest, const Chosen& chosen) {
  return (nearest.empty() ? "" : "; did you mean " + nearest + "?") + " (see " + chosen.name +
         " --help)";
}

std::optional<Error> UnknownCommand(const Chosen& chosen, const std::vector<std::string>& left) {
  const auto named = [](const CLI::App* sub) { return !sub->get_name().empty(); };
  const auto below = chosen.parser->get_subcommands(named);
  if (below.empty() || left.empty() || LooksLikeOption(left.front())) return std::nullopt;
  std::vector<std::string_view> known;
  for (const CLI::App* sub : below) known.push_back(sub->get_name());
  return Usage(left.front(), "no such command" + Hint(NearestWord(left.front(), known), chosen));
}

std::optional<Error> UnknownOption(const Chosen& chosen, const std::vector<std::string>& left) {
  const std::vector<std::string> names = OptionNames(chosen.parser);
  for (const std::string& word : left) {
    const std::string typed = word.substr(0, word.find('='));
    if (!LooksLikeOption(typed) || std::ranges::find(names, typed) != names.end()) continue;
    return Usage(typed, "no such option" + Hint(NearestOption(typed, names), chosen));
  }
  return std::nullopt;
}

std::optional<Error> UnknownWord(const Chosen& chosen, const std::string& said) {
  for (const CLI::Option* option : chosen.parser->get_options()) {
    const std::vector<std::string> words = DescribeOption(*option).words;
    if (words.empty() || !said.starts_with(option->get_name() + ":")) continue;
    for (const std::string& typed : option->results()) {
      if (std::ranges::find(words, typed) != words.end()) continue;
      const std::vector<std::string_view> known(words.begin(), words.end());
      const std::string nearest = NearestWord(typed, known);
      return Usage(option->get_name(),
                   "\"" + typed + "\" is none of " + CLI::detail::join(words, ", ") +
                       (nearest.empty() ? "" : "; did you mean " + nearest + "?"));
    }
  }
  return std::nullopt;
}

// Of an option that takes so many values together, too few.
std::optional<Error> TooFewValues(const Chosen& chosen, const std::string& said) {
  for (const CLI::Option* option : chosen.parser->get_options()) {
    const int count = option->get_items_expected_min();
    if (count < 2 || !said.starts_with(option->get_name() + ":")) continue;
    return Usage(option->get_name(), "takes " + std::to_string(count) + " values: " +
                                         option->get_description() + Hint("", chosen));
  }
  return std::nullopt;
}

// Words beyond what the command takes in its place.
std::optional<Error> TooManyWords(const Chosen& chosen, const std::vector<std::string>& left) {
  if (left.empty()) return std::nullopt;
  for (const CLI::Option* option : chosen.parser->get_options()) {
    if (!option->get_positional() || option->get_items_expected_max() != 1) continue;
    if (option->count() == 0) continue;
    return Usage(left.front(), "one word too many: " + option->get_name() + " is " +
                                   option->results().front() + ", and it takes one" +
                                   Hint("", chosen));
  }
  return std::nullopt;
}

}  // namespace

Error MistypedLine(const CLI::App& parser, const CLI::ParseError& thrown) {
  const Chosen chosen = ChosenParser(parser);
  // What the command could not use, then what it handed back to those above it.
  std::vector<std::string> left = chosen.parser->remaining();
  for (std::string& word : parser.remaining(true)) left.push_back(std::move(word));
  if (auto command = UnknownCommand(chosen, left)) return *std::move(command);
  if (auto option = UnknownOption(chosen, left)) return *std::move(option);
  if (thrown.get_name() == "ValidationError") {
    if (auto word = UnknownWord(chosen, thrown.what())) return *std::move(word);
  }
  if (thrown.get_name() == "ArgumentMismatch") {
    if (auto few = TooFewValues(chosen, thrown.what())) return *std::move(few);
  }
  if (thrown.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError)) {
    if (auto many = TooManyWords(chosen, left)) return *std::move(many);
  }
  return Usage("", std::string(thrown.what()) + " (see " + chosen.name + " --help)");
}

}  // namespace lightcal::app
