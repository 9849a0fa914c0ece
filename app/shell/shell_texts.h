// SPDX-License-Identifier: Apache-2.0
// What shells and man read, written from the tree of commands. Pure: text out, nothing is opened.
#pragma once

#include <string>

#include "command_tree.h"

namespace lightcal::app {

// A script that completes commands, options, the words an option takes, and files.
[[nodiscard]] std::string BashCompletion(const TypedCommand& lightcal);
[[nodiscard]] std::string ZshCompletion(const TypedCommand& lightcal);
[[nodiscard]] std::string FishCompletion(const TypedCommand& lightcal);

// lightcal(1) in the man(7) language. `date` is "2026-11-21", `version` "lightcal 0.1.0".
[[nodiscard]] std::string ManPage(const TypedCommand& lightcal, const std::string& date,
                                  const std::string& version);

// "lights list": a command's words, joined.
[[nodiscard]] std::string PathText(const TypedCommand& command, const std::string& between = " ");

// The text with `what` replaced by `by` wherever it stands.
[[nodiscard]] std::string Replaced(std::string text, const std::string& what,
                                   const std::string& by);

}  // namespace lightcal::app
