// SPDX-License-Identifier: Apache-2.0
// lightcal color --batch: a stream of chromaticities.
#pragma once

#include <string>

#include "console.h"
#include "lightcal/core/result.h"

namespace lightcal::app {

// x,y lines -> x,y,cct_K,duv lines, cct_K empty where a CCT means nothing. A first line of column
// names (x and y among them, any others ignored) is answered by a line of names; without one a line
// is two numbers. Empty lines are skipped. A file is read through once before the first line is
// written, so that a bad row writes nothing; standard input ("-") is answered line by line, and
// what was written before a bad row stays. Fails: not_found, unreadable. Refused: bad_row,
// bad_chromaticity (with the line), no_rows.
[[nodiscard]] Result<void> RunColorBatch(const std::string& path, Console& console);

// refused/"bad_chromaticity".
[[nodiscard]] tl::unexpected<Error> NotAChromaticity(const std::string& subject);

}  // namespace lightcal::app
