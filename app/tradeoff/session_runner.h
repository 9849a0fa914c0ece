// SPDX-License-Identifier: Apache-2.0
// What `tradeoff` measures: a session's whole job, by any profile.
#pragma once

#include <string>

#include "lightcal/tradeoff/outcome.h"
#include "session_input.h"

namespace lightcal::app {

// Runs the whole job in memory, session to presets, nothing written.
[[nodiscard]] tradeoff::Runner SessionRunner(const std::string& session);

// The last stage of it: presets of every engine, then what was found and what each stage took.
[[nodiscard]] Result<tradeoff::Outcome> OutcomeOf(const CalibratedSession& calibrated,
                                                  StageClock& clock);

// Neither answers nor warnings: for work done many times over.
[[nodiscard]] Console MutedConsole();

}  // namespace lightcal::app
