// SPDX-License-Identifier: Apache-2.0
// OpenEXR files, through OpenEXR itself, in the module of frame_files_module.h: OpenImageIO refuses
// luminance/chroma files, and costs 0.2 s to load where OpenEXR costs 1 ms. The functions mean what
// picture.h says; a half float's infinity comes as 65504, the most it holds, and a picture that
// holds that names it as its levels' maximum.
#pragma once

#include <string>

#include "lightcal/core/result.h"
#include "lightcal/records/frame.h"
#include "lightcal_devices/captures/mapped_file.h"
#include "lightcal_devices/captures/picture.h"

namespace lightcal::devices {

// `file` is what `path` names.
[[nodiscard]] Result<FrameInfo> ReadExrInfo(const std::string& path, const MappedFile& file);
[[nodiscard]] Result<Frame> ReadExr(const std::string& path, const MappedFile& file,
                                    SampleStore store);
[[nodiscard]] Result<void> WriteExrFile(const std::string& path, const ExrPicture& picture);

}  // namespace lightcal::devices
