// SPDX-License-Identifier: Apache-2.0
// What a camera sees of one lamp, of another, and of the first behind gels.
#pragma once

#include <string>
#include <vector>

#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal/colorimetry/gel_stack.h"
#include "lightcal/colorimetry/spectrum.h"

namespace lightcal::report {

// Colours in a viewer's XYZ, Y = 100 for the target's white: the white, the 99 samples of CIE 224,
// two skin tones, as LightView lists them.
struct MatchSheetColumn {
  std::string title;
  std::vector<Xyz> samples;
  std::vector<double> difference;  // from the target, CAM02-UCS; empty for the target itself
  Spectrum spectrum;
};
struct MatchSheet {
  std::string title, viewer;
  MatchSheetColumn lamp, target, gelled;
  NodeValues transmittance{};  // of the stack
  bool has_gels = false;
};

// One SVG: 40 patches in three stripes each (the lamp, the target, the lamp behind its gels; so
// that a stripe that matches vanishes against the middle one), the difference of each, and the
// three spectra with the gels' curve. The target's white is shown as the screen's.
[[nodiscard]] std::string MatchSheetSvg(const MatchSheet& sheet);

}  // namespace lightcal::report
