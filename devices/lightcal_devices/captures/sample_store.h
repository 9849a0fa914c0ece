// SPDX-License-Identifier: Apache-2.0
// Where decoded samples live.
#pragma once

#include "lightcal/records/frame.h"

namespace lightcal {

// A scratch file is mapped and already deleted: the system drops its pages when memory is short, so
// that any number of frames can be open at once.
enum class SampleStore { kMemory, kScratchFile };

// Says that rows [first, first + count) are not needed for now: those in a scratch file leave this
// process's memory and come back when they are looked at. Others stay.
void LetGo(const Frame& frame, int first, int count);

}  // namespace lightcal
