// SPDX-License-Identifier: Apache-2.0
// The chromaticity figure as a file of its own.
#pragma once

#include <string>

#include "lightcal/records/fitted_light.h"
#include "lightcal/report/plot_keys.h"

namespace lightcal::report {

// A whole SVG file: ChromaticityFigure of this colour with its style sheet inside. Holds for a
// colour with an xy or a CCT; empty otherwise.
[[nodiscard]] std::string ChromaticityPlot(const FittedColor& color);

// What its marks mean. `region`: its ellipse is drawn.
[[nodiscard]] PlotCaption ChromaticityCaption(bool region);

}  // namespace lightcal::report
