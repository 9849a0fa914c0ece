// SPDX-License-Identifier: Apache-2.0
#include "raster_png.h"

#include <zlib.h>

#include "lightcal/core/base64.h"
#include "lightcal/core/png.h"

namespace lightcal::app {
std::string EncodePng(View2d<const std::uint8_t> rgb) {
  std::string rows;  // each with its filter type, 0 = none
  for (int y = 0; y < rgb.height(); ++y) {
    rows += '\0';
    const auto row = rgb.row(y);
    rows.append(reinterpret_cast<const char*>(row.data()), row.size());
  }
  uLongf size = compressBound(static_cast<uLong>(rows.size()));
  std::string packed(size, '\0');
  compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
            reinterpret_cast<const Bytef*>(rows.data()), static_cast<uLong>(rows.size()),
            Z_DEFAULT_COMPRESSION);
  packed.resize(size);
  return PngFile(rgb.width(), rgb.height(), PngColor::kRgb, packed);
}

std::string PngUri(View2d<const std::uint8_t> rgb) {
  return "data:image/png;base64," + Base64(EncodePng(rgb));
}

}  // namespace lightcal::app
