// SPDX-License-Identifier: Apache-2.0
// Answers that also fail: a table or document about many things, some of which went wrong.
#pragma once

#include "console.h"
#include "lightcal/core/result.h"

namespace lightcal::app {

// Ends a command whose whole answer is given, with the exit code of `error`: adds "error" to the
// document and prints it, or says the error on stderr. main prints nothing more.
[[nodiscard]] Result<void> EndTold(Console& console, records::Node document, const Error& error);

}  // namespace lightcal::app
