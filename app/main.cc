// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "commands.h"
#include "console.h"
#include "lightcal/core/nearest_word.h"
#include "output_files.h"

namespace lightcal::app {
namespace {

constexpr int kExitUsage = 2;

struct Parsed {
  Console::Flags flags;
  const CommandRow* command = nullptr;
  Run run;
};

void AddCommonFlags(CLI::App& parser, Console::Flags& flags) {
  parser.add_flag("--json", flags.json, "One JSON document on stdout");
  parser.add_flag("--quiet,-q", flags.quiet, "No notes on stderr");
  parser.add_flag("--verbose,-v", flags.verbose, "More on stderr");
  parser.add_flag("--strict", flags.strict, "Warnings refuse the answer (exit 3)");
}

// The arguments say --json even when they do not parse.
bool AsksForJson(int argc, char** argv) {
  return std::any_of(argv, argv + argc, [](const char* a) { return std::string(a) == "--json"; });
}

// A first word that is no command gets the nearest one, not a list.
Result<void> CheckCommandWord(int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return {};
  std::vector<std::string_view> names;
  for (const CommandRow& row : Commands()) names.push_back(row.name);
  if (std::ranges::find(names, std::string_view(argv[1])) != names.end()) return {};
  const std::string nearest = NearestWord(argv[1], names);
  const std::string hint =
      nearest.empty() ? "see lightcal --help" : "did you mean " + nearest + "?";
  return WrongUsage(argv[1], "no such command; " + hint);
}

int Main(int argc, char** argv) {
  if (const auto checked = CheckCommandWord(argc, argv); !checked) {
    PrintError(checked.error(), AsksForJson(argc, argv));
    return kExitUsage;
  }
  CLI::App parser(
      "Measure real lamps, bring them into renderers, and say how sure it is.\n"
      "Start with:  lightcal quick 192lx@0.5m --cct 2900K");
  parser.name("lightcal");
  parser.set_version_flag("--version", GeneratorName());
  parser.require_subcommand(1);
  Parsed parsed;
  for (const CommandRow& row : Commands()) {
    CLI::App* sub = parser.add_subcommand(std::string(row.name), std::string(row.summary));
    if (!row.examples.empty()) sub->footer("Examples:\n" + std::string(row.examples));
    AddCommonFlags(*sub, parsed.flags);
    sub->final_callback([&parsed, &row] { parsed.command = &row; });
    // Only the chosen command builds its options: start-up stays the same as commands are added.
    if (argc > 1 && row.name == argv[1]) parsed.run = row.build(*sub);
  }
  try {
    parser.parse(argc, argv);
  } catch (const CLI::CallForHelp& e) {
    return parser.exit(e);
  } catch (const CLI::CallForVersion& e) {
    return parser.exit(e);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return parser.exit(e);
    PrintError(
        Error{ErrorKind::kUsage, "usage", "", std::string(e.what()) + " (see lightcal --help)"},
        AsksForJson(argc, argv));
    return kExitUsage;
  }
  Console console(parsed.flags);
  const Result<void> done = parsed.run(console);
  if (std::fflush(stdout) != 0) {
    PrintError(Error{ErrorKind::kFailed, "stdout", "", "standard output cannot be written"}, false);
    return static_cast<int>(ErrorKind::kFailed);
  }
  if (done) return 0;
  PrintError(done.error(), parsed.flags.json);
  return static_cast<int>(done.error().kind);
}

}  // namespace
}  // namespace lightcal::app

int main(int argc, char** argv) {
  try {
    return lightcal::app::Main(argc, argv);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "lightcal: internal error: %s\n", e.what());
  } catch (...) {
    std::fprintf(stderr, "lightcal: internal error\n");
  }
  return 1;
}
