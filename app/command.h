// SPDX-License-Identifier: Apache-2.0
// What a command is: a row of the table in commands.cc. build() adds options to the command's CLI11
// parser and returns what to run after parsing.
#pragma once

#include <functional>
#include <string_view>

#include "console.h"
#include "lightcal/core/result.h"

namespace CLI {
class App;
}

namespace lightcal::app {

using Run = std::function<Result<void>(Console&)>;

struct CommandRow {
  std::string_view name;
  std::string_view summary;   // one line of `lightcal --help`
  std::string_view examples;  // real command lines, shown under `lightcal <command> --help`
  Run (*build)(CLI::App& parser);
};

}  // namespace lightcal::app
