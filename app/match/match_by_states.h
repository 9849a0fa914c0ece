// SPDX-License-Identifier: Apache-2.0
// lightcal match of lamps that were read at states of their controls: what to set on them.
#pragma once

#include <string>

#include "console.h"
#include "match/match_source.h"

namespace lightcal::app {

// Whether a lamp is to be set, not gelled: ReadMatchLight left it without a spectrum.
[[nodiscard]] bool IsSetByStates(const MatchLight& light);

// The light becomes what it is at "dimmer=50,cct_K=4000". Refused: as AnswerState.
[[nodiscard]] Result<void> SetMatchState(const std::string& text, MatchLight& light);

struct StateMatchWords {
  int count = 5;
  int take = 1;
  double reach = 0.02;
  std::string meter, output;
  bool force = false;
};
// Answers on the console; writes the lamp as it is at the setting that is taken.
// Refused: as MatchStates and MixStates.
[[nodiscard]] Result<void> RunMatchByStates(const StateMatchWords& o, const MatchLight& lamp,
                                            const MatchLight& target, Console& console);
[[nodiscard]] Result<void> RunMixByStates(const StateMatchWords& o, const MatchLight& lamp,
                                          const MatchLight& with, const MatchLight& target,
                                          Console& console);

}  // namespace lightcal::app
