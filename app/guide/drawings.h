// SPDX-License-Identifier: Apache-2.0
// Small pictures in plain text.
#pragma once

#include <string>

namespace lightcal::app {

// Where the card goes in a shadow-card reading.
[[nodiscard]] std::string ShadowCardDrawing();

}  // namespace lightcal::app
