// SPDX-License-Identifier: Apache-2.0
// A colour chart of known colours -> a camera's matrix.
#pragma once

#include <array>
#include <span>

#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal/core/result.h"
#include "lightcal/records/camera_profile.h"

namespace lightcal {

// What the camera saw of a patch, and its colour in the light that lit it (Y = 100: perfect white).
struct ChartPatch {
  std::array<double, 3> raw{};
  Xyz reference;
};

// XYZ = M raw by least squares, each patch weighted by Y^(-2/3) (equal steps of lightness count
// alike), no offset and no higher terms: exposure must stay linear. Scaled so that the lightest
// patch with green 1 has Y = 1. Residuals are distances in CAM02-UCS under `white` (Y = 100).
// Refused: chart_too_small (fewer than six patches, or colours that do not span the space),
// chart_disagrees (mean residual above 10: the corners are in another order, or another chart).
[[nodiscard]] Result<CameraColor> FitChart(std::span<const ChartPatch> patches, const Xyz& white);

// Where the patches of a flat grid are in a picture, seen in perspective.
class ChartGrid {
 public:
  // Centres of the corner patches x, y: upper left, upper right, lower right, lower left, as the
  // chart is read.  Refused: bad_corners (three on one line).
  [[nodiscard]] static Result<ChartGrid> Make(const std::array<double, 8>& corners, int columns,
                                              int rows);
  // Centre of a patch; columns and rows count from 0.
  [[nodiscard]] std::array<double, 2> Place(double column, double row) const;

 private:
  std::array<double, 8> h_{};  // x = (h0 u + h1 v + h2)/(h6 u + h7 v + 1), y likewise
  double columns_ = 1.0, rows_ = 1.0;
};

}  // namespace lightcal
