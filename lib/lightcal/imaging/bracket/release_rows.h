// SPDX-License-Identifier: Apache-2.0
// Samples that lie in files leave this process's memory while nobody looks at them.
#pragma once

#include "lightcal/records/frame.h"

namespace lightcal {

// Says that rows [first, first + count) are not needed for now: those in a scratch file leave this
// process's memory and come back when they are looked at. Others stay.
void ReleaseRows(const Frame& frame, int first, int count);

}  // namespace lightcal
