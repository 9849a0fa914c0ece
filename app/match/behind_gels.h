// SPDX-License-Identifier: Apache-2.0
// A lamp behind gels that were chosen, for commands that answer about one lamp.
#pragma once

#include <string>
#include <vector>

#include "console.h"
#include "lightcal/match/match_lights.h"
#include "match/match_source.h"

namespace lightcal::app {

struct BehindGels {
  std::string title;             // "L204 Full C.T. Orange + L298 0.15ND"
  std::vector<std::string> ids;  // as the file names them
  match::Match match;            // against the lamp itself
  Spectrum spectrum;
};
// words: as ReadGelChoice; one stack comes with intervals, every gel of a file without.
[[nodiscard]] Result<std::vector<BehindGels>> PutBehindGels(const Spectrum& lamp, bool measured,
                                                            const std::string& words,
                                                            const std::string& gel_file,
                                                            Console& console);

// {"gels","Y_percent":{..},"stops_lost":{..},"cct_K":{..},"duv":{..}}
[[nodiscard]] Node ThroughNode(const BehindGels& behind);
// "behind L204 Full C.T. Orange: 55.3 % ± 1.1 % of the light, 0.85 stops lost"
[[nodiscard]] std::string ThroughText(const BehindGels& behind);

}  // namespace lightcal::app
