// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/files/file_bytes.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace lightcal::devices::files {

FileBytes ReadFileBytes(const std::string& path, std::size_t most) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return {"", FileFault::kMissing};
  if (std::filesystem::is_directory(path, ignored)) return {"", FileFault::kDirectory};
  std::ifstream stream(path, std::ios::binary);
  FileBytes file;
  std::array<char, 1 << 16> chunk{};
  while (stream.read(chunk.data(), chunk.size()) || stream.gcount() > 0) {
    file.bytes.append(chunk.data(), static_cast<std::size_t>(stream.gcount()));
    if (file.bytes.size() > most) return {"", FileFault::kTooLarge};
  }
  if (!stream.eof()) return {"", FileFault::kUnreadable};
  return file;
}

}  // namespace lightcal::devices::files
