// SPDX-License-Identifier: Apache-2.0
// lightcal man: the manual page, of every command and option there is.
#include <CLI/CLI.hpp>

#include "clock.h"
#include "commands.h"
#include "output_files.h"
#include "shell/shell_texts.h"

namespace lightcal::app {

Run BuildMan(CLI::App& /*parser*/) {
  return [](Console& console) -> Result<void> {
    constexpr std::size_t kDate = 10;  // of 2026-11-21T10:00:00Z
    const std::string page =
        ManPage(DescribeCommands(), NowIso8601().substr(0, kDate), GeneratorName());
    console.Print(page);
    console.PrintDocument({{"page", page}});
    return {};
  };
}

}  // namespace lightcal::app
