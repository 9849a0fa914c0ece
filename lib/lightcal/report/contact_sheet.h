// SPDX-License-Identifier: Apache-2.0
// Many lights at a glance: a tile each, with its colour, strength and the shape of its light.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/light/intensity_table.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal::report {

struct SheetLight {
  FittedLight light;
  // Type C about the aim, for the small polar plot of its plane C0 - C180; absent: drawn as rays
  // (directional), a half circle (dome), as words (a spot of unknown beam), or not at all.
  std::optional<IntensityTable> distribution;
  std::string note;  // one line: when it was measured, where it lies
};

// One SVG file with all tiles, three a row; for .svg and, painted, .png.
[[nodiscard]] std::string ContactSheetSvg(const std::vector<SheetLight>& lights,
                                          std::string_view title);

// One self-contained page whose tiles flow with its width, light and dark, printable.
[[nodiscard]] std::string ContactSheetPage(const std::vector<SheetLight>& lights,
                                           std::string_view title);

}  // namespace lightcal::report
