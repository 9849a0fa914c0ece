// SPDX-License-Identifier: Apache-2.0
// Pictures as files have them, those with pixels that hold no light among them.
#pragma once

#include <string>

#include "lightcal/core/result.h"
#include "lightcal/records/masked_picture.h"

namespace lightcal::devices {

class OpenFiles;  // mapped_file.h: here and below, opens the file where given

// As ReadPicture (picture.h), ReadFrame and LoadFrame (bracket.h), but for bad_samples.
[[nodiscard]] Result<MaskedPicture> ReadMaskedPicture(const std::string& path,
                                                      SampleStore store = SampleStore::kMemory,
                                                      OpenFiles* files = nullptr);
[[nodiscard]] Result<MaskedPicture> ReadMaskedFrame(const std::string& path,
                                                    SampleStore store = SampleStore::kMemory,
                                                    OpenFiles* files = nullptr);
[[nodiscard]] Result<MaskedPicture> LoadMaskedFrame(const FrameInfo& info, SampleStore store,
                                                    OpenFiles* files = nullptr);

}  // namespace lightcal::devices
