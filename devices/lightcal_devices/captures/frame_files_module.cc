// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/captures/frame_files_module.h"

#include "lightcal_devices/transport/module_door.h"

namespace lightcal::devices {

Result<const FrameFileFunctions*> FrameFilesModule() {
  static const auto module = OpenModuleFunctions<FrameFileFunctions>(
      "lightcal_frames.so", kFrameFileEntrySymbol, "no_picture_module",
      "the part that reads OpenEXR and camera RAW");
  return module;
}

}  // namespace lightcal::devices
