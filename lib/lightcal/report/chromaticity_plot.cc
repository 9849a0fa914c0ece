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
  if (svg.empty()) return svg;
  return StandaloneSvg(WithCaption(std::move(svg), ChromaticityCaption(color.cct_K.has_value())));
}

PlotCaption ChromaticityCaption(bool region) {
  PlotCaption caption{{DotKey("light")}, ""};
  if (region) {
    caption.keys.push_back(
        {"<ellipse class=\"ellipse\" cx=\"11\" cy=\"6\" rx=\"9\" ry=\"5\"/>", "its 95 % region"});
  }
  caption.keys.push_back(LineKey("locus", "Planckian locus"));
  caption.keys.push_back(LineKey("guide", "Duv ±0.006"));
  return caption;
}

}  // namespace lightcal::report
