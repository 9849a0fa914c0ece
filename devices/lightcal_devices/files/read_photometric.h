// SPDX-License-Identifier: Apache-2.0
// A photometric file on disk -> what it says.
#pragma once

#include <optional>
#include <string>

#include "lightcal/core/result.h"
#include "lightcal/records/photometric_codec.h"
#include "lightcal_devices/files/file_bytes.h"

namespace lightcal::devices {

// Reads at most kMaxPhotometricBytes, whatever the path names, and the TILT file beside it.
// Fails: not_found, unreadable. Refused: too_large, and as PhotometricFromText.
[[nodiscard]] Result<ReadPhotometric> ReadPhotometricFile(const std::string& path,
                                                          std::optional<int> lamp_set = {});

// The same of a file whose bytes were read already.
[[nodiscard]] Result<ReadPhotometric> PhotometricRead(const files::FileBytes& file,
                                                      const std::string& path,
                                                      std::optional<int> lamp_set = {});

}  // namespace lightcal::devices
