// SPDX-License-Identifier: Apache-2.0
// The whole command line on one page. A new command is one file in commands/ and one line here.
#include "commands.h"

#include <array>

namespace lightcal::app {

// clang-format off
// clang-format on

std::span<const CommandRow> Commands() { return {}; }

}  // namespace lightcal::app
