// SPDX-License-Identifier: Apache-2.0
#include "terminal.h"

#include <unistd.h>

#include <cstdio>
#include <iostream>

#include "lightcal/core/numbers_text.h"

namespace lightcal::app {

bool CanAsk() { return ::isatty(STDIN_FILENO) == 1 && ::isatty(STDERR_FILENO) == 1; }

std::optional<std::string> Ask(const std::string& prompt) {
  std::fwrite(prompt.data(), 1, prompt.size(), stderr);
  std::string line;
  if (!std::getline(std::cin, line)) return std::nullopt;
  return std::string(TrimBlanks(line));
}

}  // namespace lightcal::app
