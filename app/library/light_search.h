// SPDX-License-Identifier: Apache-2.0
// Which lights of a library a person asks for, and in which order.
#pragma once

#include <string>
#include <vector>

#include "library/light_library.h"
#include "lightcal/core/result.h"

namespace lightcal::app {

// As typed: "3000..3500", "500..", "..2000", "3200K..", "3200" (that very value); "" = any.
struct SearchWords {
  std::string cct, lm, cd, lx;
  std::string kind;  // point, spot ...
  std::string name;  // part of the light's name or its file's, in any case
  std::string sort;  // name, cct, lm, cd, lx, kind, time; -cd from large to small
};

// The lights whose values lie in every range asked for; one without such a value does not. Sorted,
// those without the value last. Wrong usage: a range, kind or order that is none.
[[nodiscard]] Result<std::vector<LibraryLight>> Search(std::vector<LibraryLight> lights,
                                                       const SearchWords& words);

}  // namespace lightcal::app
