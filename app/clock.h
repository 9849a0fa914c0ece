// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace lightcal::app {

// Now in UTC, "2026-11-21T10:00:00Z"; the moment SOURCE_DATE_EPOCH names, when it is set, so that
// the same inputs give the same bytes.
[[nodiscard]] std::string NowIso8601();

}  // namespace lightcal::app
