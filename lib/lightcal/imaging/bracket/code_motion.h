// SPDX-License-Identifier: Apache-2.0
// Brackets of codes (JPEG, PNG) from the hand: the camera's curve and its way hang on each other.
#pragma once

#include <span>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/imaging/bracket/frame_motions.h"
#include "lightcal/imaging/bracket/resample_frame.h"
#include "lightcal/imaging/bracket/response.h"
#include "lightcal/imaging/bracket/signal.h"
#include "lightcal/records/frame.h"

namespace lightcal {

// In order of exposure; all three of one length.
struct MovedCodes {
  std::span<const SignalFrame> signals;
  std::vector<const Frame*> frames;
  std::vector<double> exposure;  // any unit
};

// What all frames that were followed show, in pixels of the reference.
[[nodiscard]] Region RegionOf(const BracketMotion& motion, const SignalFrame& like);

// The response of codes that are brought to one place first. Refused: as RecoverResponse.
[[nodiscard]] Result<RecoveredResponse> CurveInPlace(const MovedCodes& codes,
                                                     const BracketMotion& motion,
                                                     const Region& region);

// MeasureMotion in two looks: through a power law of 2.2, which most cameras' curves are near, for
// places within a pixel; then through the curve that the codes have there. A curve's bend that is
// taken for a slope of the scene's moves edges by up to half a pixel, and every tile's alike, so
// that no standard deviation shows it. The first look stands where too few codes are shared for a
// curve. Refused: as MeasureMotion.
[[nodiscard]] Result<BracketMotion> MotionOfCodes(const MovedCodes& codes);

}  // namespace lightcal
