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
#include "lightcal/report/false_color.h"

namespace lightcal {

// A figure to type into an engine: one card of a light.
struct EngineFigure {
  std::string light;   // name of the light
  std::string engine;  // "Unreal Engine"
  std::string field;   // "SpotLight · Intensity"
  std::string value;   // "1934.2", plain digits that can be pasted
  std::string unit;    // "cd"; "" where the engine's number has none
  std::string note;    // what must be set with it; may be empty
};

// What an engine makes of a light where a meter stood.
struct ParityRow {
  std::string light;
  std::string engine;
  double distance_m = 0.0;   // from the lamp's reference point; 0 for lights at infinity
  double expected_lx = 0.0;  // what the measured lamp gives there
  double engine_lx = 0.0;    // what the engine's own law makes of the numbers in its file
  std::string law;           // "1/d², range 164 m"
  std::string executed;      // how its exporter was checked: "rendered in Cycles 3.4: ..."
  bool rendered = false;     // whether that ran the engine itself
};

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

struct ReportExtras {
  std::vector<EngineFigure> figures{};
  std::vector<ParityRow> parity{};
  std::vector<LightSpectrum> spectra{};
  std::vector<LuminancePicture> pictures{};
};

}  // namespace lightcal
