// SPDX-License-Identifier: Apache-2.0
// The curve by which a camera turned light into the codes of a JPEG or PNG, from a bracket.
#pragma once

#include <span>

#include "lightcal/core/result.h"
#include "lightcal/imaging/bracket/code_exposures.h"
#include "lightcal/imaging/bracket/signal.h"
#include "lightcal/records/frame.h"

namespace lightcal {

// Of codes: the top one; 255 where nothing says it.
[[nodiscard]] double HighestCode(const FrameInfo& info);

struct RecoveredResponse {
  ResponseCurves curves;
  CodeExposures exposures;
};

// For each channel the curve g = ln(signal) over codes that makes neighbours in exposure agree:
//   min sum n(a, b) w (g(b) - g(a) - ln(e_b/e_a))^2 + s sum_z ((dg/dln z)' / z)^2
// over all pairs of codes (a, b) that one pixel shows in two frames, n times; w from what one step
// of code means in ln(signal) and, in a second turn, small for pixels where something moved. This
// is Debevec and Malik's objective (SIGGRAPH 1997) with every pixel in it, the scene's luminances
// eliminated pairwise, and weights of a known noise instead of a hat. Then made increasing (pool
// adjacent violators). Its slope over ln(code) changes little, below code 32 of 8 bits alike in
// every ln(code), so that a straight toe (sRGB's) is followed: no power law is preferred, be the
// codes a display's or linear. The top code is signal 1.
// `exposure` of each frame, > 0, in any unit, are labels; where frames contradict them, exposures
// are measured (code_exposures.h). With two frames an error of 6 % in their ratio bends the curve
// as much. Codes of more than 8 bits are seen through 256 steps of their square root, finer in the
// dark. Refused: no_response (not encoded, fewer than two exposures, or too few codes that two
// frames share: less than a third of them in some channel), exposures_disagree (codes fall, nearly
// everywhere they change, in a frame that should have half a stop more light or above).
[[nodiscard]] Result<RecoveredResponse> RecoverResponse(std::span<const Frame> frames,
                                                        std::span<const double> exposure);

}  // namespace lightcal
