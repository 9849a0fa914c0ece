// SPDX-License-Identifier: Apache-2.0
// Opens lightcal_pictures.so at the first call and keeps it.
#pragma once

#include "lightcal/core/result.h"
#include "lightcal_devices/captures/oiio_module.h"

namespace lightcal {

// Looked for beside the executable, then in ../<libdir>/lightcal from there, then where the system
// looks for libraries (LD_LIBRARY_PATH, run path).
// Fails: no_picture_module (says what the loader said).
[[nodiscard]] Result<OiioRead> PictureModule();

}  // namespace lightcal
