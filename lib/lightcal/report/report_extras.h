// SPDX-License-Identifier: Apache-2.0
// What a report shows beside the fitted lights themselves: what engines make of them, the spectra
// and the pictures they were measured by. The app gathers it; every part may be empty.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lightcal/colorimetry/color_fidelity.h"
#include "lightcal/colorimetry/spectrum.h"
#include "lightcal/records/control_sweep.h"
#include "lightcal/records/engine_answers.h"
#include "lightcal/records/reading_plan.h"
#include "lightcal/report/false_color.h"
#include "lightcal/report/match_sheet.h"

namespace lightcal {

// A light's spectrum as it was read, with what it does to colours where that is defined.
struct LightSpectrum {
  std::string light;
  std::string file;  // as the session names it
  Spectrum spectrum;
  struct Rendering {
    double Ra = 0.0;
    ColorFidelity fidelity;
    GamutAndBins gamut;
  };
  std::optional<Rendering> rendering{};
};

// A picture that a light was measured in, in cd/m^2, made small.
struct LuminancePicture {
  std::string light;
  std::string what;  // "wall", "card": what the picture was used for
  int width = 0, height = 0;
  ValueScale scale;                               // cd/m^2
  std::string image_uri;                          // FalseColors of it as a data: URI
  std::string scale_uri;                          // ScaleColors as a data: URI
  std::optional<std::array<double, 4>> region{};  // x, y, width, height of what was measured
};

// What to do next about a light, and what it is enough for by now.
struct LightAdvice {
  std::string light;
  std::string label;  // "1 minute better", "next"
  std::string text;
  std::string enough;  // "look-dev"; "" = nothing yet
};

// What a camera sees of a light, of what it is to match, and of it behind gels.
struct LightMatchSheet {
  std::string light;
  report::MatchSheet sheet;
};

struct ReportExtras {
  EngineAnswers engines{};
  std::vector<LightSpectrum> spectra{};
  std::vector<LuminancePicture> pictures{};
  std::vector<MinutesLadder> ladders{};
  std::vector<LightAdvice> advice{};
  std::vector<LightMatchSheet> matches{};
  std::vector<ControlSweep> sweeps{};
};

}  // namespace lightcal
