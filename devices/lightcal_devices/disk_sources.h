// SPDX-License-Identifier: Apache-2.0
// The library's sources, answered from disk.
#pragma once

#include "lightcal/records/sources.h"

namespace lightcal {

// Texts, spectra and photometric files are opened once in the life of these sources and their
// copies, whatever is asked about them; they may be asked from several threads.
[[nodiscard]] Sources DiskSources();

}  // namespace lightcal
