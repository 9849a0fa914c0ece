// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/files/read_files.h"

#include <filesystem>
#include <limits>
#include <system_error>

#include "lightcal_devices/files/import_file.h"
#include "lightcal_devices/files/read_photometric.h"

namespace lightcal::devices {
namespace {

constexpr std::size_t kAnySize = std::numeric_limits<std::size_t>::max();
constexpr std::size_t kMostOfAnExport = std::size_t{256} << 20U;

}  // namespace

ReadFiles::Bytes ReadFiles::Read(const std::string& path, std::size_t most) {
  const std::lock_guard lock(mutex_);
  Bytes& read = read_[path];
  if (!read || read->fault != files::FileFault::kNone) {
    read = std::make_shared<const files::FileBytes>(files::ReadFileBytes(path, most));
  }
  return read;
}

ReadFiles::Bytes ReadFiles::Held(const std::string& path) {
  const std::lock_guard lock(mutex_);
  const auto read = read_.find(path);
  if (read == read_.end() || read->second->fault != files::FileFault::kNone) return nullptr;
  return read->second;
}

Result<std::string> ReadFiles::Text(const std::string& path) {
  const Bytes read = Read(path, kAnySize);
  if (read->fault == files::FileFault::kMissing) {
    return Failed("not_found", path, "no such file");
  }
  if (read->fault != files::FileFault::kNone) {
    return Failed("unreadable", path, "cannot be read; is it a file you may open?");
  }
  return read->bytes;
}

void AddFileSources(const std::shared_ptr<ReadFiles>& files, Sources& sources) {
  sources.exists = [](const std::string& path) {
    std::error_code ignored;
    return std::filesystem::exists(path, ignored);
  };
  sources.read_text = [files](const std::string& path) { return files->Text(path); };
  sources.read_spectra = [files](const std::string& path) {
    return ImportRead(*files->Read(path, kMostOfAnExport), path);
  };
  sources.read_photometric = [files](const std::string& path) {
    return PhotometricRead(*files->Read(path, kMaxPhotometricBytes), path);
  };
}

}  // namespace lightcal::devices
