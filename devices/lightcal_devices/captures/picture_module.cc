// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/captures/picture_module.h"

#include <utility>

#include "lightcal_devices/transport/module_door.h"

namespace lightcal::devices {
namespace {

Result<OiioRead> OpenPictureReader() {
  auto symbol = OpenModule(kOiioModuleName, kOiioReadSymbol, "no_picture_module",
                           "the part that reads HDR, TIFF, PNG and JPEG");
  if (!symbol) return Propagate(std::move(symbol));
  return reinterpret_cast<OiioRead>(*symbol);
}

}  // namespace

Result<OiioRead> PictureModule() {
  static const Result<OiioRead> module = OpenPictureReader();
  return module;
}

}  // namespace lightcal::devices
