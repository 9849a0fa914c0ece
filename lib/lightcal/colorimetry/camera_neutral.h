// SPDX-License-Identifier: Apache-2.0
// The chromaticity of the light a camera calls neutral.
#pragma once

#include <array>

#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal/colorimetry/rgb_spaces.h"
#include "lightcal/core/result.h"
#include "lightcal/core/units.h"

namespace lightcal {

// Camera RGB from XYZ under two calibration lights, as DNG files carry them (ColorMatrix1 and 2,
// CameraCalibration multiplied in). Equal temperatures, or equal matrices, stand for one.
struct CameraMatrices {
  Matrix3 warm{}, cool{};
  Kelvin warm_temperature{2855.54}, cool_temperature{6502.71};
};

// Linear in 1/T between the two, the nearer one outside.
[[nodiscard]] Matrix3 CameraMatrixAt(const CameraMatrices& camera, Kelvin temperature);

// The xy whose white the camera sees as `neutral` (AsShotNeutral: the reciprocals of its white
// balance), by the iteration
//   xy -> chromaticity of CM(T(xy))^-1 neutral
// from D50 until |dx| + |dy| < 1e-7; after 30 passes the mean of the last two, should they
// alternate. A colour without a valid CCT takes the matrix of the nearest locus point. Such a light
// carries at least +-5 mired and +-0.005 Duv for LEDs: a camera is no spectrometer. Source: Adobe,
// Digital Negative Specification 1.6, chapter 6. Refused: "bad_neutral" (not positive, or the
// matrices give no colour).
[[nodiscard]] Result<Xy> XyFromCameraNeutral(const CameraMatrices& camera,
                                             const std::array<double, 3>& neutral);

}  // namespace lightcal
