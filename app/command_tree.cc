// SPDX-License-Identifier: Apache-2.0
#include "command_tree.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>

#include "commands.h"

namespace lightcal::app {
namespace {

// "TEXT:{planck,daylight}" lists planck and daylight.
std::vector<std::string> WordsOfType(const std::string& type) {
  const std::size_t open = type.find('{'), close = type.find('}');
  if (open == std::string::npos || close == std::string::npos || close < open) return {};
  return CLI::detail::split(type.substr(open + 1, close - open - 1), ',');
}

TypedCommand DescribeParser(const CLI::App& parser, std::vector<std::string> path) {
  TypedCommand command;
  command.path = std::move(path);
  command.summary = parser.get_description();
  for (const CLI::Option* option : parser.get_options()) {
    command.options.push_back(DescribeOption(*option));
  }
  std::ranges::stable_partition(command.options, [](const auto& o) { return !o.names.empty(); });
  const auto all = [](const CLI::App* sub) { return !sub->get_name().empty(); };
  for (const CLI::App* sub : parser.get_subcommands(all)) {
    std::vector<std::string> below = command.path;
    below.push_back(sub->get_name());
    command.commands.push_back(DescribeParser(*sub, std::move(below)));
  }
  return command;
}

constexpr std::string_view kMany = " ...", kAgain = " [again: more]";

class SaysWhatRepeats : public CLI::Formatter {
 public:
  std::string make_option_opts(const CLI::Option* option) const override {
    std::string text = CLI::Formatter::make_option_opts(option);
    const std::size_t at = text.find(kMany);
    if (at != std::string::npos && DescribeOption(*option).again) {
      text.replace(at, kMany.size(), kAgain);
    }
    return text;
  }
};

}  // namespace

void SayWhatRepeats(CLI::App& parser) { parser.formatter(std::make_shared<SaysWhatRepeats>()); }

TypedOption DescribeOption(const CLI::Option& option) {
  TypedOption typed;
  for (const std::string& name : option.get_snames()) typed.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) typed.names.push_back("--" + name);
  const std::string type = option.get_type_name();
  const bool flag = option.get_items_expected_max() == 0;
  typed.values = flag ? 0 : std::max(1, option.get_items_expected_min());
  if (typed.names.empty()) {
    typed.placeholder = option.get_name(true);
  } else if (!flag) {
    typed.placeholder = type.substr(0, type.find(':'));
  }
  typed.words = WordsOfType(type);
  typed.summary = option.get_description();
  if (!flag) typed.usual = option.get_default_str();
  typed.many = !flag && option.get_items_expected_max() >= CLI::detail::expected_max_vector_size;
  typed.again = typed.many && !typed.names.empty() && !option.get_allow_extra_args();
  typed.commas = option.get_delimiter() == ',';
  typed.number = type.starts_with("INT") || type.starts_with("UINT") || type.starts_with("FLOAT");
  typed.required = option.get_required();
  return typed;
}

// Commands that open what a session names.
constexpr std::array<std::string_view, 14> kReadSessions = {
    "run",      "fit",   "explain", "simulate", "report", "plan",  "check",
    "tradeoff", "match", "read",    "watch",    "camera", "state", "sweep"};

CLI::App& AddCommand(CLI::App& parser, const CommandRow& row, Console::Flags& flags) {
  CLI::App* sub = parser.add_subcommand(std::string(row.name), std::string(row.summary));
  if (!row.examples.empty()) sub->footer("Examples:\n" + std::string(row.examples));
  sub->add_flag("--json", flags.json, "One JSON document on stdout");
  sub->add_flag("--quiet,-q", flags.quiet, "No notes on stderr");
  sub->add_flag("--verbose,-v", flags.verbose, "More on stderr");
  sub->add_flag("--strict", flags.strict, "Warnings refuse the answer (exit 3)");
  if (std::ranges::find(kReadSessions, row.name) != kReadSessions.end()) {
    sub->add_flag("--allow-outside", flags.allow_outside,
                  "The session may name files outside of its folder");
  }
  return *sub;
}

TypedCommand DescribeCommands() {
  CLI::App parser;
  parser.name("lightcal");
  parser.set_version_flag("--version", "");
  Console::Flags flags;
  std::vector<Run> kept;  // they own what the parsers write into
  for (const CommandRow& row : Commands())
    kept.push_back(row.build(AddCommand(parser, row, flags)));
  TypedCommand all = DescribeParser(parser, {});
  for (std::size_t i = 0; i < Commands().size(); ++i) {
    all.commands[i].examples = std::string(Commands()[i].examples);
  }
  return all;
}

}  // namespace lightcal::app
