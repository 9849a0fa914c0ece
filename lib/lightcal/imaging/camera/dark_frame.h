// SPDX-License-Identifier: Apache-2.0
// What a sensor answers with the cap on.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "lightcal/core/result.h"
#include "lightcal/core/units.h"
#include "lightcal/imaging/bracket/signal.h"
#include "lightcal/records/camera_profile.h"

namespace lightcal {

// Black of each channel (mean of the samples within five standard deviations of their median) and
// pixels more than ten above it. `sigma` is what the means of frames and of 64 blocks scatter,
// as a standard error: bands and drift are what pixels do not average away. One ISO, one time.
// Refused: no_frames, dark_with_light (more than 2 % of full scale, a picture in the dark, or more
// than 1 % of bright pixels).
[[nodiscard]] Result<CameraDark> MeasureDark(std::span<const SignalFrame> frames, double iso,
                                             Seconds exposure);

struct BlackAt {
  std::array<double, 3> black{};  // raw signal
  double sigma = 0.0;
};
// At an ISO speed that darks were taken at (absent else), linear in time between two of them, the
// nearest outside. A single one, or one far from the time, leaves half of what it says in sigma:
// pedestal and dark current are not told apart.
[[nodiscard]] std::optional<BlackAt> BlackFor(std::span<const CameraDark> darks, double iso,
                                              Seconds exposure);

}  // namespace lightcal
