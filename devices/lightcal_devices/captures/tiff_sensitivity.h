// SPDX-License-Identifier: Apache-2.0
// The sensitivity tags of a TIFF file. Exif 2.3 lets PhotographicSensitivity be several numbers,
// libtiff gives a list of them, and OpenImageIO 2.4 hands over none. Pure.
#pragma once

#include <string_view>

#include "lightcal_devices/captures/exposure_tags.h"

namespace lightcal::devices {

// The first of each, in the Exif directory of the file's first picture; none of what is no TIFF
// with offsets of 32 bits, or is cut short. Source: TIFF 6.0, section 2; Exif 2.3, 4.6.5.
[[nodiscard]] IsoTags IsoTagsOfTiff(std::string_view bytes);

}  // namespace lightcal::devices
