// SPDX-License-Identifier: Apache-2.0
// The colour vector graphic of ANSI/IES TM-30.
#pragma once

#include <string>
#include <string_view>

#include "lightcal/colorimetry/color_fidelity.h"
#include "lightcal/report/plot_keys.h"

namespace lightcal::report {

// The reference as a circle, the light's 16 bin means as a closed curve, an arrow from one to the
// other per bin, and Rf, Rg. The reference means are moved onto the circle at their hue, and the
// light's shift is scaled with them:
//   point = (cos h, sin h) + (test - reference)/C,   h and C of the bin's reference mean.
// title says which light; id must be unique in the page. Source: ANSI/IES TM-30-20, annex on
// graphics (shape and meaning; the colours are ours).
[[nodiscard]] std::string ColorVectorFigure(const ColorFidelity& fidelity,
                                            const GamutAndBins& gamut, std::string_view title,
                                            std::string_view id);

// What its marks mean.
[[nodiscard]] PlotCaption Tm30Caption();

// A whole SVG file of it, with its style sheet and that caption.
[[nodiscard]] std::string ColorVectorGraphic(const ColorFidelity& fidelity,
                                             const GamutAndBins& gamut, std::string_view title);

}  // namespace lightcal::report
