// SPDX-License-Identifier: Apache-2.0
// Opens lightcal_pictures.so at the first call and keeps it.
#pragma once

#include "lightcal/core/result.h"
#include "lightcal_devices/captures/oiio_module.h"

namespace lightcal::devices {

// Fails as OpenModule: no_picture_module.
[[nodiscard]] Result<OiioRead> PictureModule();

}  // namespace lightcal::devices
