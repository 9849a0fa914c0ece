// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/chromaticity_plot.h"

#include <utility>

#include "lightcal/report/figures.h"
#include "lightcal/report/style.h"

namespace lightcal::report {

std::string ChromaticityPlot(const FittedColor& color) {
  FittedLight light;
  light.color = color;
  std::string svg = ChromaticityFigure(light, "chromaticity");
  return svg.empty() ? svg : StandaloneSvg(std::move(svg));
}

}  // namespace lightcal::report
