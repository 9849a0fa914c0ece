// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace lightcal {

// The known word closest to an unknown one by edit distance (insert, delete, replace, swap of
// neighbours), for messages such as: unknown key "distnace_m"; did you mean "distance_m"?
// Empty when nothing is within a third of the word's length (at least 2) and shares a letter.
[[nodiscard]] std::string NearestWord(std::string_view word,
                                      std::span<const std::string_view> known);

}  // namespace lightcal
