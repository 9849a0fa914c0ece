// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/files/read_photometric.h"

#include <filesystem>
#include <utility>

#include "lightcal_devices/files/delimited_text.h"

namespace lightcal::devices {
namespace {

namespace fs = std::filesystem;

Result<void> Check(files::FileFault fault, const std::string& path) {
  switch (fault) {
    case files::FileFault::kMissing:
      return Failed("not_found", path, "there is no such file");
    case files::FileFault::kTooLarge:
      return Refused("too_large", path, "is larger than 32 MiB, which no lamp's file is");
    case files::FileFault::kDirectory:
    case files::FileFault::kUnreadable:
      return Failed("unreadable", path, "cannot be read; is it a file you may open?");
    case files::FileFault::kNone:
      break;
  }
  return {};
}

// Photometric files are ASCII and what stood near it; programs of Windows also save them in UTF-16.
Result<std::string> TextOf(std::string bytes, const std::string& path) {
  const bool utf16 = bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF");
  if (!utf16) return bytes;
  return files::TextFromBytes(bytes, fs::path(path).filename().string());
}

Result<std::string> TiltBeside(const std::string& path) {
  files::FileBytes file = files::ReadFileBytes(path, kMaxPhotometricBytes);
  if (auto there = Check(file.fault, path); !there) return Propagate(std::move(there));
  return TextOf(std::move(file.bytes), path);
}

}  // namespace

Result<ReadPhotometric> ReadPhotometricFile(const std::string& path, std::optional<int> lamp_set) {
  return PhotometricRead(files::ReadFileBytes(path, kMaxPhotometricBytes), path, lamp_set);
}

Result<ReadPhotometric> PhotometricRead(const files::FileBytes& file, const std::string& path,
                                        std::optional<int> lamp_set) {
  if (auto there = Check(file.fault, path); !there) return Propagate(std::move(there));
  const fs::path folder = fs::path(path).parent_path();
  const auto text = TextOf(file.bytes, path);
  if (!text) return tl::unexpected(text.error());
  return PhotometricFromText(
      *text, fs::path(path).filename().string(),
      [&](const std::string& name) { return TiltBeside(folder / name); }, lamp_set);
}

}  // namespace lightcal::devices
