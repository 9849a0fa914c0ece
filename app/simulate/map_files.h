// SPDX-License-Identifier: Apache-2.0
// A map as the files a person asks for: .png and .svg in false colours, .exr, .csv.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "output_files.h"
#include "simulate/simulate_answer.h"

namespace lightcal::app {

struct MapPictureWords {
  std::string title;
  std::string scale;  // "" = by the map, log, linear
};

// Wrong usage unless every name ends in .png, .svg, .exr or .csv.
[[nodiscard]] Result<void> CheckMapNames(const std::vector<std::string>& names);

//   .exr  32 bit floats, channels Y (illuminance, lx) and u95 (its 95 % half width, lx)
//   .csv  two coordinates, illuminance_lx, u95_lx; rows from the top of the map
// The map must outlive the writers.   Fails: as PictureFile.
[[nodiscard]] Result<std::vector<OutputWriter>> MapWriters(const Simulated& simulated,
                                                           const std::vector<std::string>& names,
                                                           const MapPictureWords& words);

}  // namespace lightcal::app
