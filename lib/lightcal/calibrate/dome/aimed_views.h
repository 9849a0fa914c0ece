// SPDX-License-Identifier: Apache-2.0
// Pictures of one place whose aims nobody knows -> one dome.
#pragma once

#include "lightcal/core/result.h"
#include "lightcal/imaging/panorama/dome_input.h"
#include "lightcal/records/sources.h"

namespace lightcal {

// Views, or brackets that are merged first, find their aims, lens and (unless given) field of view
// from what they share (SolveAims), and become a dome (ComposeViews). One view is open at a time;
// it is kept no finer than the dome will be, so that memory grows with views x dome, not with
// frames. Warned: horizon_assumed, and as the parts. Refused: views_differ (another size than the
// first's), too_few_views, level_view (no view of that name), and as GroupBrackets,
// ReadDomePicture, MergeBracket, SolveAims, ComposeViews.
[[nodiscard]] Result<DomeInput> ReadAimedViews(const DomeInputRequest& request,
                                               const Sources& sources);

}  // namespace lightcal
