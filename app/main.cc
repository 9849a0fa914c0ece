// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <span>
#include <string>
#include <string_view>

#include "command_tree.h"
#include "commands.h"
#include "console.h"
#include "mistyped.h"
#include "output_files.h"

namespace lightcal::app {
namespace {

constexpr int kExitUsage = 2;

struct Parsed {
  Console::Flags flags;
  Run run;
};

// The arguments say --json even when they do not parse.
bool AsksForJson(int argc, char** argv) {
  return std::any_of(argv, argv + argc, [](const char* a) { return std::string(a) == "--json"; });
}

// 1 where any of what was written to standard output was lost, even in its middle.
int Ended(int code) {
  const bool flushed = std::fflush(stdout) == 0;
  if (flushed && std::ferror(stdout) == 0 && std::cout.good()) return code;
  PrintError(Error{ErrorKind::kFailed, "stdout", "", "standard output cannot be written"}, false);
  return static_cast<int>(ErrorKind::kFailed);
}

int Main(int argc, char** argv) {
  CLI::App parser(
      "Measure real lamps, bring them into renderers, and say how sure it is.\n"
      "Start with:  lightcal quick 192lx@0.5m --cct 2900K");
  parser.name("lightcal");
  parser.set_version_flag("--version", GeneratorName());
  parser.require_subcommand(1);
  SayWhatRepeats(parser);
  Parsed parsed;
  // Only the command that the first word names is built, and the others are listed only where none
  // is: start-up stays the same as commands are added.
  const std::span<char*> words(argv + std::min(argc, 1), argv + argc);
  const auto word = std::ranges::find_if(words, [](const char* a) { return a[0] != '-'; });
  const auto chosen = word == words.end() ? Commands().end()
                                          : std::ranges::find(Commands(), std::string_view(*word),
                                                              &CommandRow::name);
  const bool asks_version = !words.empty() && std::string_view(words[0]) == "--version";
  if (chosen != Commands().end()) {
    parsed.run = chosen->build(AddCommand(parser, *chosen, parsed.flags));
  } else if (!asks_version) {
    for (const CommandRow& row : Commands()) {
      parser.add_subcommand(std::string(row.name), std::string(row.summary));
    }
  }
  try {
    parser.parse(argc, argv);
  } catch (const CLI::CallForHelp& e) {
    return Ended(parser.exit(e));
  } catch (const CLI::CallForVersion& e) {
    return Ended(parser.exit(e));
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return Ended(parser.exit(e));
    PrintError(MistypedLine(parser, e), AsksForJson(argc, argv));
    return kExitUsage;
  }
  Console console(parsed.flags);
  const Result<void> done = parsed.run(console);
  if (const int lost = Ended(0); lost != 0) return lost;
  if (done) return 0;
  PrintError(done.error(), parsed.flags.json);
  return static_cast<int>(done.error().kind);
}

}  // namespace
}  // namespace lightcal::app

int main(int argc, char** argv) {
  // A file at the limit of its size is a write that fails, as on a full disk; programs that are
  // started keep the signal's own way.
  std::signal(SIGXFSZ, [](int) {});
  try {
    return lightcal::app::Main(argc, argv);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "lightcal: internal error: %s\n", e.what());
  } catch (...) {
    std::fprintf(stderr, "lightcal: internal error\n");
  }
  return 1;
}
