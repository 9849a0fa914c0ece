// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/chromaticity_plot.h"

#include "lightcal/report/figures.h"
#include "lightcal/report/style.h"

namespace lightcal::report {

std::string ChromaticityPlot(const FittedColor& color) {
  FittedLight light;
  light.color = color;
  std::string svg = ChromaticityFigure(light, "chromaticity");
  if (svg.empty()) return svg;
  const std::string style =
      "\n<!-- written by lightcal -->\n<style><![CDATA[" + std::string(StyleSheet()) +
      "svg { background: var(--page); font-family: system-ui, sans-serif; }\n]]></style>";
  return svg.insert(svg.find('>') + 1, style);
}

}  // namespace lightcal::report
