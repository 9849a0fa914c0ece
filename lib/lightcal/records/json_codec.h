// SPDX-License-Identifier: Apache-2.0
// JSON text <-> Node: the one place that knows the syntax.
#pragma once

#include <string>
#include <string_view>

#include "lightcal/core/result.h"
#include "lightcal/records/document.h"

namespace lightcal::records {

struct JsonSyntaxError {
  std::string message;
  bool at_end = false;  // the text stops before the value does: a torn line
};

// One strict JSON value (RFC 8259, UTF-8). Refused besides bad syntax: a key given twice, numbers
// beyond a double, arrays and tables nested deeper than 64.
[[nodiscard]] tl::expected<Node, JsonSyntaxError> ParseJson(std::string_view text);

enum class JsonLayout { kOneLine, kPretty };

// Numbers read back as the same double; one that is not finite is written null, which no reader
// takes for a number. Bytes that are not UTF-8 become U+FFFD.
[[nodiscard]] std::string PrintJson(const Node& node, JsonLayout layout);

// A file of its own: pretty, with a final newline. Fails: not_finite, naming where
// ("lights[0].fit").
[[nodiscard]] Result<std::string> FiniteJson(const Node& node);

}  // namespace lightcal::records
