// SPDX-License-Identifier: Apache-2.0
// Files of text and tables as Sources gives them: each is read once, whoever asks how often.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "lightcal/core/result.h"
#include "lightcal/records/sources.h"
#include "lightcal_devices/files/file_bytes.h"

namespace lightcal::devices {

// By path. Used by several threads at once.
class ReadFiles {
 public:
  using Bytes = std::shared_ptr<const files::FileBytes>;

  // Read now, unless it was read before without a fault.
  [[nodiscard]] Bytes Read(const std::string& path, std::size_t most);
  // Null where it was not read before, or not well.
  [[nodiscard]] Bytes Held(const std::string& path);
  // Fails: not_found, unreadable.
  [[nodiscard]] Result<std::string> Text(const std::string& path);

 private:
  std::mutex mutex_;
  std::map<std::string, Bytes> read_;
};

// exists, read_text, read_spectra and read_photometric.
void AddFileSources(const std::shared_ptr<ReadFiles>& files, Sources& sources);

}  // namespace lightcal::devices
