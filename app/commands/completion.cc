// SPDX-License-Identifier: Apache-2.0
// lightcal completion: what a shell completes of lightcal, as a script for that shell.
#include <CLI/CLI.hpp>
#include <memory>

#include "commands.h"
#include "one_of.h"
#include "shell/shell_texts.h"

namespace lightcal::app {
namespace {

struct Shell {
  std::string_view name;
  std::string (*script)(const TypedCommand& lightcal);
};
constexpr Shell kShells[] = {
    {"bash", &BashCompletion}, {"zsh", &ZshCompletion}, {"fish", &FishCompletion}};

Result<void> RunCompletion(const std::string& name, Console& console) {
  for (const Shell& shell : kShells) {
    if (shell.name != name) continue;
    const std::string script = shell.script(DescribeCommands());
    console.Print(script);
    console.PrintDocument({{"shell", name}, {"script", script}});
  }
  return {};
}

}  // namespace

Run BuildCompletion(CLI::App& parser) {
  auto shell = std::make_shared<std::string>();
  parser.add_option("shell", *shell, "Whose script is printed")
      ->check(OneOf(NamesOf(kShells)))
      ->required();
  return [shell](Console& console) { return RunCompletion(*shell, console); };
}

}  // namespace lightcal::app
