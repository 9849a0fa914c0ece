// SPDX-License-Identifier: Apache-2.0
// The door to OpenEXR and LibRaw: what the module lightcal_frames.so answers. Both sides are built
// together.
#pragma once

#include <string>

#include "lightcal/core/result.h"
#include "lightcal_devices/captures/mapped_file.h"
#include "lightcal_devices/captures/picture.h"

namespace lightcal::devices {

// The functions of exr.h and raw_decode.h.
struct FrameFileFunctions {
  Result<FrameInfo> (*read_exr_info)(const std::string& path, const MappedFile& file);
  Result<Frame> (*read_exr)(const std::string& path, const MappedFile& file, SampleStore store);
  Result<void> (*write_exr)(const std::string& path, const ExrPicture& picture);
  void (*decode_raw)(const std::string& path, const MappedFile& file, bool with_samples,
                     int descriptor) noexcept;
};
inline constexpr const char* kFrameFileEntrySymbol = "lightcal_frame_file_functions";

// Opens the module at the first call and keeps it.  Fails: no_picture_module.
[[nodiscard]] Result<const FrameFileFunctions*> FrameFilesModule();

}  // namespace lightcal::devices
