// SPDX-License-Identifier: Apache-2.0
// Every plot a report has, by name: on the page, and as a file of its own.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/records/fitted_light.h"
#include "lightcal/report/plot_keys.h"
#include "lightcal/report/report_extras.h"

namespace lightcal::report {

// A plot of one light. The functions give SVG for the page (id unique there) and what its marks
// mean; no SVG where the light has nothing to show.
struct LightPlot {
  std::string_view name;  // "distance"
  std::string_view heading;
  std::string (*draw)(const FittedLight& light, const ReportExtras& extras, std::string_view id);
  PlotCaption (*caption)(const FittedLight& light, const ReportExtras& extras);
};
// In the page's order.
[[nodiscard]] std::span<const LightPlot> LightPlots();

// Those of lights and "gate", which is one of all lights.
[[nodiscard]] std::vector<std::string_view> PlotNames();

// A whole SVG file with its style sheet.
struct PlotFile {
  std::string light;  // "" = of all lights
  std::string svg;
};
// That plot of every light that has it; none for a name that is none of PlotNames.
[[nodiscard]] std::vector<PlotFile> PlotFilesOf(std::string_view name, const LightFile& lights,
                                                const ReportExtras& extras);

}  // namespace lightcal::report
