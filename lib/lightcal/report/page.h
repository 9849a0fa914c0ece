// SPDX-License-Identifier: Apache-2.0
// The report: one self-contained HTML page (no network, no script), for screen, phone and paper.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lightcal/records/fitted_light.h"

namespace lightcal {

// A figure to type into an engine, one row of a light's table.
struct EngineFigure {
  std::string light;   // name of the light
  std::string engine;  // "glTF"
  std::string field;   // "intensity (cd)"
  std::string value;   // "1934.2"
  std::string note;    // what must be set with it; may be empty
};

// Same input, same bytes; well-formed XML. Every text from outside is escaped. Numbers that are not
// finite must not come in (LightFileToJson refuses them).
[[nodiscard]] std::string ReportPage(const LightFile& lights, std::string_view title,
                                     const std::vector<EngineFigure>& figures = {});

}  // namespace lightcal
