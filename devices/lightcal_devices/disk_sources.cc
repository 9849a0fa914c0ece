// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/disk_sources.h"

#include <openssl/evp.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>

#include "lightcal_devices/captures/board_module.h"
#include "lightcal_devices/captures/bracket.h"
#include "lightcal_devices/captures/mapped_file.h"
#include "lightcal_devices/captures/masked_picture.h"
#include "lightcal_devices/files/file_bytes.h"
#include "lightcal_devices/files/import_file.h"
#include "lightcal_devices/files/read_photometric.h"

namespace lightcal::devices {
namespace {

constexpr std::size_t kAnySize = std::numeric_limits<std::size_t>::max();
constexpr std::size_t kMostOfAnExport = std::size_t{256} << 20U;

// Files that were read, by path.
class Disk {
 public:
  using Bytes = std::shared_ptr<const files::FileBytes>;

  Bytes Read(const std::string& path, std::size_t most) {
    const std::lock_guard lock(mutex_);
    Bytes& read = read_[path];
    if (!read || read->fault != files::FileFault::kNone) {
      read = std::make_shared<const files::FileBytes>(files::ReadFileBytes(path, most));
    }
    return read;
  }

  Result<std::string> Text(const std::string& path) {
    const Bytes read = Read(path, kAnySize);
    if (read->fault == files::FileFault::kMissing) {
      return Failed("not_found", path, "no such file");
    }
    if (read->fault != files::FileFault::kNone) {
      return Failed("unreadable", path, "cannot be read; is it a file you may open?");
    }
    return read->bytes;
  }

  Result<std::string> Sha256(const std::string& path) {
    {
      const std::lock_guard lock(mutex_);
      const auto read = read_.find(path);
      if (read != read_.end() && read->second->fault == files::FileFault::kNone) {
        return Sha256Hex(read->second->bytes);
      }
    }
    if (const auto mapped = open_.Map(path)) {
      std::string hash = Sha256Hex({static_cast<const char*>(mapped->bytes.get()), mapped->size});
      ReleasePages(*mapped);
      return hash;
    }
    const auto text = Text(path);  // empty, no regular file, or not there
    if (!text) return text;
    return Sha256Hex(*text);
  }

  [[nodiscard]] OpenFiles* open() { return &open_; }

 private:
  OpenFiles open_;  // pictures
  std::mutex mutex_;
  std::map<std::string, Bytes> read_;
};

}  // namespace

std::string Sha256Hex(std::string_view bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int length = 0;
  EVP_Digest(bytes.data(), bytes.size(), digest.data(), &length, EVP_sha256(), nullptr);
  constexpr std::string_view kHex = "0123456789abcdef";
  std::string text;
  for (unsigned int i = 0; i < length; ++i) {
    text += kHex[digest[i] >> 4U];
    text += kHex[digest[i] & 0xFU];
  }
  return text;
}

Sources DiskSources() {
  const auto disk = std::make_shared<Disk>();
  Sources sources;
  sources.expand_files = ExpandFiles;
  sources.exists = [](const std::string& path) {
    std::error_code ignored;
    return std::filesystem::exists(path, ignored);
  };
  sources.read_text = [disk](const std::string& path) { return disk->Text(path); };
  sources.sha256 = [disk](const std::string& path) { return disk->Sha256(path); };
  sources.read_spectra = [disk](const std::string& path) {
    return ImportRead(*disk->Read(path, kMostOfAnExport), path);
  };
  sources.read_photometric = [disk](const std::string& path) {
    return PhotometricRead(*disk->Read(path, kMaxPhotometricBytes), path);
  };
  sources.open_bracket = [disk](std::span<const std::string> patterns,
                                const BracketOverrides& overrides) {
    return OpenBracket(patterns, overrides, disk->open());
  };
  sources.read_frame_info = [disk](const std::string& path) {
    return ReadFrameInfo(path, disk->open());
  };
  sources.read_frame = [disk](const std::string& path) {
    return ReadFrame(path, SampleStore::kMemory, disk->open());
  };
  sources.load_frame = [disk](const FrameInfo& info) {
    return LoadFrame(info, SampleStore::kMemory, disk->open());
  };
  sources.read_masked_frame = [disk](const std::string& path) {
    return ReadMaskedFrame(path, SampleStore::kMemory, disk->open());
  };
  sources.load_masked_frame = [disk](const FrameInfo& info, SampleStore store) {
    return LoadMaskedFrame(info, store, disk->open());
  };
  sources.find_board = [](View2d<const float> luminance,
                          const CharucoBoard& board) -> Result<std::vector<BoardCorner>> {
    const auto module = BoardModule();
    if (!module) return tl::unexpected(module.error());
    return (*module)->find(luminance, board);
  };
  sources.find_chart = [](View2d<const float> rgb) -> Result<std::array<double, 8>> {
    const auto module = BoardModule();
    if (!module) return tl::unexpected(module.error());
    return (*module)->find_chart(rgb);
  };
  sources.find_features = [](View2d<const std::uint8_t> grey, View2d<const std::uint8_t> seen,
                             int most) -> Result<std::vector<PictureFeature>> {
    const auto module = BoardModule();
    if (!module) return tl::unexpected(module.error());
    return (*module)->find_features(grey, seen, most);
  };
  return sources;
}

}  // namespace lightcal::devices
