// SPDX-License-Identifier: Apache-2.0
// What an exporter gets and what it gives: a pure function from fitted lights to the text of files.
#pragma once

#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal {

struct PresetOptions {
  bool bare = false;  // the lights alone: no cards, no camera
};

struct PresetFile {
  std::string name;  // "<stem>.gltf", relative to the output directory
  std::string contents;
};

struct Preset {
  std::vector<PresetFile> files;
  Warnings warnings;  // color_unknown, out_of_gamut, substituted, position_unknown, ...
};

// Same input, same bytes. Refused: no_intensity, no_illuminance (a light without the figure its
// kind is exported by), no_lights. Fails: not_finite.
using Exporter = Result<Preset> (*)(const LightFile& lights, const std::string& stem,
                                    const PresetOptions& options);

}  // namespace lightcal
