// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/disk_sources.h"

#include <nettle/sha2.h>

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <utility>

#include "lightcal_devices/captures/board_module.h"
#include "lightcal_devices/captures/bracket.h"
#include "lightcal_devices/captures/mapped_file.h"
#include "lightcal_devices/captures/masked_picture.h"
#include "lightcal_devices/files/read_files.h"

namespace lightcal::devices {
namespace {

// Files and pictures that were read or mapped.
class Disk {
 public:
  Result<std::string> Sha256(const std::string& path) {
    if (const auto held = files_->Held(path)) return Sha256Hex(held->bytes);
    if (const auto mapped = open_.Map(path)) {
      std::string hash = Sha256Hex({static_cast<const char*>(mapped->bytes.get()), mapped->size});
      ReleasePages(*mapped);
      return hash;
    }
    const auto text = files_->Text(path);  // empty, no regular file, or not there
    if (!text) return text;
    return Sha256Hex(*text);
  }

  [[nodiscard]] const std::shared_ptr<ReadFiles>& files() const { return files_; }
  [[nodiscard]] OpenFiles* open() { return &open_; }

 private:
  OpenFiles open_;  // pictures
  std::shared_ptr<ReadFiles> files_ = std::make_shared<ReadFiles>();
};

}  // namespace

std::string Sha256Hex(std::string_view bytes) {
  sha256_ctx hash;
  sha256_init(&hash);
  sha256_update(&hash, bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data()));
  std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest{};
  sha256_digest(&hash, digest.size(), digest.data());
  constexpr std::string_view kHex = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : digest) {
    text += kHex[byte >> 4U];
    text += kHex[byte & 0xFU];
  }
  return text;
}

Sources DiskSources() {
  const auto disk = std::make_shared<Disk>();
  Sources sources;
  sources.expand_files = ExpandFiles;
  AddFileSources(disk->files(), sources);
  sources.sha256 = [disk](const std::string& path) { return disk->Sha256(path); };
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
