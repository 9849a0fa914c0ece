// SPDX-License-Identifier: Apache-2.0
// Lists as text.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace lightcal {

// What text_of tells of each member (a string, or what one is made of), `separator` between them.
template <class Range, class TextOf = std::identity>
[[nodiscard]] std::string Joined(const Range& range, std::string_view separator = ", ",
                                 const TextOf& text_of = {}) {
  std::string out;
  bool more = false;
  for (const auto& each : range) {
    if (more) out += separator;
    more = true;
    out += std::invoke(text_of, each);
  }
  return out;
}

}  // namespace lightcal
