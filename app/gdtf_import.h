// SPDX-License-Identifier: Apache-2.0
// A fixture's GDTF file for people: what it says, and what of it a session can use.
#pragma once

#include <string>

#include "console.h"
#include "lightcal/core/result.h"
#include "lightcal/records/gdtf.h"

namespace lightcal::app {

[[nodiscard]] bool IsGdtfName(const std::string& path);

// Prints emitters, beams, curves and modes, and a [[light]] to paste into session.toml with the
// data sheet's flux and angles. Warns gdtf_defaults where a beam says no more than GDTF's own
// defaults, gdtf_no_measurement where no emitter holds one.
// Refused: as ReadGdtf.
[[nodiscard]] Result<Node> TellGdtf(const std::string& path, Console& console);

}  // namespace lightcal::app
