// SPDX-License-Identifier: Apache-2.0
// The tracer against what is known without it.
#pragma once

namespace traced_rooms {

// Prints one line a law; true when each holds.
bool ClosedFormsHold();

}  // namespace traced_rooms
