// SPDX-License-Identifier: Apache-2.0
// Asking the person at the terminal.
#pragma once

#include <optional>
#include <string>

namespace lightcal::app {

// Whether someone can answer: standard input and standard error are a terminal.
[[nodiscard]] bool CanAsk();

// Shows `prompt` on stderr and returns the line typed, without blanks at its ends; absent at the
// end of input, and where an InterruptGuard lives at the first Ctrl-C.
[[nodiscard]] std::optional<std::string> Ask(const std::string& prompt);

}  // namespace lightcal::app
