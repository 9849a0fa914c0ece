// SPDX-License-Identifier: Apache-2.0
// What a lamp gives as one of its controls is turned: what was read, the curve between, its 95 %
// band, and what the label promises.
#pragma once

#include <string>
#include <string_view>

#include "lightcal/records/control_sweep.h"

namespace lightcal::report {

// "" where fewer than two states were read along the control; of colour also without a CCT.
[[nodiscard]] std::string OutputFigure(const ControlSweep& sweep, std::string_view id);
[[nodiscard]] std::string TemperatureFigure(const ControlSweep& sweep, std::string_view id);
[[nodiscard]] std::string ControlCaption(const ControlSweep& sweep);

}  // namespace lightcal::report
