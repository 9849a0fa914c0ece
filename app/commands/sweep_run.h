// SPDX-License-Identifier: Apache-2.0
// A fixture's states, set and read one after another into a session's journal.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "console.h"
#include "lightcal/core/result.h"
#include "read_options.h"

namespace lightcal::app {

// What was asked for, as it was written.
struct SweepOptions {
  std::string session, light, distance, meter, until, sacn, map, settle;
  std::vector<std::string> over, settings;
  MeterRequest request;
  int measurements = 0;
  std::uint64_t seed = 1;
  bool typed = false;
  bool in_order = false;
};

// All states of `over`, or until the lamp is known everywhere within `until`; what the journal
// holds already is not read again. Fails and refused: as the session, its meter and the fixture do.
[[nodiscard]] Result<void> RunSweep(const SweepOptions& options, Console& console);

}  // namespace lightcal::app
