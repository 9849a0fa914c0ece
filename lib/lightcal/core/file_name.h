// SPDX-License-Identifier: Apache-2.0
// Names of lights as parts of file names.
#pragma once

#include <string>
#include <string_view>

namespace lightcal {

// ASCII letters, digits, - _ . and everything beyond ASCII stay; what a shell or a file system may
// take amiss becomes "_".
[[nodiscard]] inline std::string FileNamePart(std::string_view name) {
  std::string out;
  for (const char c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '-' || c == '_' || c == '.' || static_cast<unsigned char>(c) >= 0x80U;
    out += plain ? c : '_';
  }
  return out;
}

}  // namespace lightcal
