// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/scripts.h"

namespace lightcal {

std::string ScriptWith(std::string_view file, std::string_view data) {
  constexpr std::string_view kMark = "@DATA@";
  std::string text(Script(file));
  return text.replace(text.find(kMark), kMark.size(), data);
}

std::string WithoutApostrophes(std::string_view json) {
  std::string out;
  for (const char c : json) {
    if (c == '\'') {
      out += "\\u0027";
    } else {
      out += c;
    }
  }
  return out;
}

}  // namespace lightcal
