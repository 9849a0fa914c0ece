// SPDX-License-Identifier: Apache-2.0
// A name as the stem of file names.
#pragma once

#include <string>

namespace lightcal {

// Never a path, never hidden: slashes become "_", a dot in front gets one before it. Blanks stay.
[[nodiscard]] inline std::string FileStem(std::string name) {
  for (char& c : name) {
    if (c == '/' || c == '\\') c = '_';
  }
  if (name.empty() || name.front() == '.') name.insert(0, "_");
  return name;
}

}  // namespace lightcal
