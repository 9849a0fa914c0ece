// SPDX-License-Identifier: Apache-2.0
// Fisheye and other views of one place -> one lat-long dome on one scale.
#pragma once

#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/imaging/panorama/dome_input.h"

namespace lightcal {

// The pictures of request.files, in their order, each as it was read. Views in cd/m^2 among others
// give the scale; else their common mean does. Warned: views_disagree.
// Refused: views_differ (one in colour and one without, or in other primaries), bad_view, and as
// SolveViewScales and JudgeOverlaps.
[[nodiscard]] Result<DomeInput> ComposeViews(std::vector<DomeInput> pictures,
                                             const DomeInputRequest& request);

}  // namespace lightcal
