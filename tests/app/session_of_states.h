// SPDX-License-Identifier: Apache-2.0
// Sessions of a lamp with controls as a person writes them, in a dark room by a meter "m" of 2 %.
#pragma once

#include <string>

namespace lightcal::test {

inline std::string DarkSession(const std::string& light = "kind = \"point\"\n") {
  return "lightcal = 1\n[room]\ndark = true\n[[light]]\nname = \"key\"\n" + light +
         "[[meter]]\nname = \"m\"\nsigma_relative = 0.02\n";
}

// One reading of it; `more` are further lines of it.
inline std::string StateRow(double distance_m, double lux, const std::string& state,
                            const std::string& more = "") {
  return "[[reading]]\nlight = \"key\"\nmeter = \"m\"\ndistance_m = " + std::to_string(distance_m) +
         "\nilluminance_lx = " + std::to_string(lux) + "\n" + more +
         (state.empty() ? "" : "state = { " + state + " }\n");
}

}  // namespace lightcal::test
