// SPDX-License-Identifier: Apache-2.0
// TOML text -> Node with line numbers. Internal to the records room.
#pragma once

#include <string>
#include <string_view>

#include "lightcal/core/result.h"
#include "lightcal/records/document.h"

namespace lightcal::records {

struct TomlSyntaxError {
  std::string message;
  int line = 0;
};

// A TOML 1.0 document as a table. Dates become their ISO 8601 text. Refused besides bad syntax:
// values nested deeper than 256 and keys dotted so often that the tree would not fit a stack.
[[nodiscard]] tl::expected<Node, TomlSyntaxError> ParseToml(std::string_view text);

}  // namespace lightcal::records
