// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "command.h"

namespace lightcal::app {

// Every command, in the order --help shows them.
[[nodiscard]] std::span<const CommandRow> Commands();

}  // namespace lightcal::app
