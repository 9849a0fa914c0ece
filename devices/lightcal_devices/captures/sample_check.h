// SPDX-License-Identifier: Apache-2.0
// Samples that no measurement can have.
#pragma once

#include <string>

#include "lightcal/core/result.h"
#include "lightcal/core/view2d.h"

namespace lightcal::devices {

// Refused: bad_samples when a sample is NaN, infinite or beyond +-1e30, with how many of each and
// the place of the first.
[[nodiscard]] Result<void> CheckSamples(View2d<const float> samples, const std::string& subject);

// Whether a sample is such a one.
[[nodiscard]] bool IsBadSample(float sample);

}  // namespace lightcal::devices
