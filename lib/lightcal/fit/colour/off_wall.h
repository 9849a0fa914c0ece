// SPDX-License-Identifier: Apache-2.0
// A lamp's colour as a camera saw its light on a painted wall.
#pragma once

#include <array>
#include <optional>

#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal/core/units.h"
#include "lightcal/fit/colour/other_light.h"
#include "lightcal/light/wall_tint.h"

namespace lightcal::fit {

struct ColorOffWall {
  Xy seen;
  Mireds sigma{0.0};     // 1 sigma of the camera, along the locus
  SurfaceTint paint;     // what the wall's own does to it
  OtherShares others{};  // of what fell on the wall
};

// Of a paint by its maker's sRGB (0 to 255, each above 0), under D65; of any that walls have where
// nobody told.   Source: IEC 61966-2-1.
[[nodiscard]] SurfaceTint TintOfPaint(const std::optional<std::array<int, 3>>& srgb);

}  // namespace lightcal::fit
