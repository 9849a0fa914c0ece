// SPDX-License-Identifier: Apache-2.0
// Names of lights as parts of file names.
#pragma once

#include <set>
#include <string>
#include <string_view>

#include "lightcal/core/numbers_text.h"

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

// With "_" behind it until no other of `taken` is one name with it to Windows and macOS, whatever
// its case.
[[nodiscard]] inline std::string DistinctFileName(std::string name, std::set<std::string>& taken) {
  while (!taken.insert(LowerAscii(name)).second) name += "_";
  return name;
}

}  // namespace lightcal
