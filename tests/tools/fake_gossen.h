// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "serial_instrument.h"

namespace lightcal::test {

using GossenLines = std::map<std::string, std::string>;

// The lines of the maker's interface description, echo on.
inline const GossenLines kGossenLines = {{"ECH ON", "ECHO ON"},
                                         {"*IDN?", "*IDN GOSSEN,M 502, 20387,01,V 1.00"},
                                         {"RAN:AUTO ON", "RAN:AUTO ON"},
                                         {"?", "MEASURE:PHOTO? 1234E-01 LX"}};

// "" is silence.
inline SerialAnswers GossenAnswers(GossenLines lines) {
  return [lines = std::move(lines)](const std::string& command) {
    const auto line = lines.find(command);
    if (line == lines.end()) return std::string("ERROR = 101\n");
    if (line->second.empty() || line->second == kPullThePlug) return line->second;
    return line->second + "\n";
  };
}

// With one line replaced.
inline GossenLines GossenWith(const std::string& command, const std::string& line) {
  GossenLines lines = kGossenLines;
  lines[command] = line;
  return lines;
}

}  // namespace lightcal::test
