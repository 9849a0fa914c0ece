// SPDX-License-Identifier: Apache-2.0
// The module's side of lightcal_devices/captures/frame_files_module.h.
#include "lightcal_devices/captures/exr.h"
#include "lightcal_devices/captures/frame_files_module.h"
#include "lightcal_devices/captures/raw_decode.h"

extern "C" __attribute__((visibility("default"))) const lightcal::devices::FrameFileFunctions*
lightcal_frame_file_functions() noexcept {
  using namespace lightcal::devices;
  static constexpr FrameFileFunctions kFunctions = {&ReadExrInfo, &ReadExr, &WriteExrFile,
                                                    &DecodeRaw};
  return &kFunctions;
}
