// SPDX-License-Identifier: Apache-2.0
// A PNG, TIFF or JPEG out of any bytes: read whole, its exposure tags with it, or refused.
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "lightcal_devices/captures/picture.h"
#include "require.h"

namespace {

// The first byte chooses the magic number, so that one of these readers is asked.
constexpr std::array<std::string_view, 4> kMagic = {
    std::string_view("\x89PNG\r\n\x1a\n", 8), std::string_view("II*\0", 4),
    std::string_view("MM\0*", 4), std::string_view("\xff\xd8\xff", 3)};

void Touch(float sample) { lightcal::fuzz::Require(std::isfinite(sample)); }
void Touch(std::uint16_t sample) {
  volatile std::uint16_t seen = sample;
  static_cast<void>(seen);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using lightcal::fuzz::Require;
  if (size == 0) return 0;
  static const int file = memfd_create("fuzz", 0);
  const std::string_view magic = kMagic[data[0] % kMagic.size()];
  Require(ftruncate(file, 0) == 0);
  Require(pwrite(file, magic.data(), magic.size(), 0) == static_cast<ssize_t>(magic.size()));
  Require(pwrite(file, data + 1, size - 1, static_cast<off_t>(magic.size())) ==
          static_cast<ssize_t>(size - 1));
  const auto frame = lightcal::ReadPicture("/proc/self/fd/" + std::to_string(file));
  if (!frame) {
    lightcal::fuzz::RequireGoodError(frame.error());
    return 0;
  }
  std::visit(
      [](const auto& view) {
        for (int y = 0; y < view.height(); ++y) {
          for (const auto sample : view.row(y)) Touch(sample);
        }
      },
      frame->samples);
  return 0;
}
