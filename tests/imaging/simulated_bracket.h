// SPDX-License-Identifier: Apache-2.0
// Brackets of the synthetic camera as frames in memory, with the truth beside them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lightcal/records/frame.h"
#include "synthetic_camera.h"

namespace lightcal::test {

// One exposure as a reader would hand it over.
Frame FrameOf(const SyntheticCamera& camera, const SyntheticExposure& exposure,
              std::vector<std::uint16_t> picture, const std::string& name);

std::vector<Frame> ShootBracket(const SyntheticCamera& camera,
                                const std::vector<SyntheticExposure>& series,
                                const SyntheticScene& scene);

// t S / N^2 from the dial's label moved to the true third stop, as the readers do.
double LabelExposure(const SyntheticExposure& exposure);
double TrueExposure(const SyntheticExposure& exposure);

}  // namespace lightcal::test
