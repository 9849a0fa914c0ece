// SPDX-License-Identifier: Apache-2.0
// The report: one self-contained HTML page (no network, no script), for screen, phone and paper.
#pragma once

#include <string>
#include <string_view>

#include "lightcal/records/fitted_light.h"
#include "lightcal/report/report_extras.h"

namespace lightcal {

// Same input, same bytes; well-formed XML. Every text from outside is escaped. Numbers that are not
// finite must not come in (LightFileToJson refuses them).
[[nodiscard]] std::string ReportPage(const LightFile& lights, std::string_view title,
                                     const ReportExtras& extras = {});

}  // namespace lightcal
