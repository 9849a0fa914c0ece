// SPDX-License-Identifier: Apache-2.0
// Lamps that somebody measured: the CIE's LED tables and the instrument spectra of sample_data.
#pragma once

#include <string>
#include <vector>

#include "lightcal/colorimetry/spectrum.h"
#include "lightcal/imaging/camera/spectral_mismatch.h"
#include "lightcal/records/camera_sensitivities.h"

namespace lightcal::test {

struct MeasuredLamp {
  std::string name;
  LampClass lamp = LampClass::kUnknown;
  Spectrum spectrum;
};

[[nodiscard]] std::vector<MeasuredLamp> MeasuredLamps();
// The 52 cameras of sample_data/camera_sensitivities, by name.
[[nodiscard]] std::vector<CameraSensitivities> MeasuredCameras();

}  // namespace lightcal::test
