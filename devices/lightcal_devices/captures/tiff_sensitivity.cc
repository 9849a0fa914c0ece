// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/captures/tiff_sensitivity.h"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace lightcal::devices {
namespace {

constexpr std::uint32_t kExifDirectory = 0x8769;

class TiffBytes {
 public:
  explicit TiffBytes(std::string_view bytes) : bytes_(bytes), little_(bytes.starts_with('I')) {}

  // `size` bytes from `at` on; absent beyond the file's end.
  [[nodiscard]] std::optional<std::uint32_t> Integer(std::size_t at, std::size_t size) const {
    if (size > bytes_.size() || at > bytes_.size() - size) return std::nullopt;
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < size; ++i) {
      value = value << 8 | static_cast<unsigned char>(bytes_[at + (little_ ? size - 1 - i : i)]);
    }
    return value;
  }

  // The first number of a directory's SHORT or LONG.
  [[nodiscard]] std::optional<std::uint32_t> First(std::uint32_t directory,
                                                   std::uint32_t tag) const {
    constexpr std::size_t kEntry = 12;
    const std::uint32_t entries = Integer(directory, 2).value_or(0);
    for (std::uint32_t i = 0; i < entries; ++i) {
      const std::size_t at = std::size_t{directory} + 2 + kEntry * i;
      if (Integer(at, 2) != tag) continue;
      const std::uint32_t type = Integer(at + 2, 2).value_or(0);
      const std::uint32_t count = Integer(at + 4, 4).value_or(0);
      const std::size_t size = type == 3 ? 2 : type == 4 ? 4 : 0;
      if (size == 0 || count == 0) return std::nullopt;
      if (count * std::uint64_t{size} <= 4) return Integer(at + 8, size);
      const auto elsewhere = Integer(at + 8, 4);
      return elsewhere ? Integer(*elsewhere, size) : std::nullopt;
    }
    return std::nullopt;
  }

 private:
  std::string_view bytes_;
  bool little_;
};

}  // namespace

IsoTags IsoTagsOfTiff(std::string_view bytes) {
  const TiffBytes tiff(bytes);
  const auto first = tiff.Integer(4, 4);
  if (tiff.Integer(2, 2) != 42U || !first) return {};
  const auto exif = tiff.First(*first, kExifDirectory);
  if (!exif) return {};
  const auto number = [&](std::uint32_t tag) -> std::optional<double> {
    const auto value = tiff.First(*exif, tag);
    return value ? std::optional(static_cast<double>(*value)) : std::nullopt;
  };
  return {.photographic = number(0x8827),
          .type = number(0x8830),
          .standard_output = number(0x8831),
          .recommended = number(0x8832),
          .iso_speed = number(0x8833)};
}

}  // namespace lightcal::devices
