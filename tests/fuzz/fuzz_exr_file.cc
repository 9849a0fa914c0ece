// SPDX-License-Identifier: Apache-2.0
// An OpenEXR file out of any bytes: read with finite samples, or refused.
#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>

#include "lightcal_devices/captures/picture.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using lightcal::fuzz::Require;
  static const int file = memfd_create("fuzz", 0);
  // The magic number stands, so that no other reader is asked.
  static constexpr char kMagic[] = "\x76\x2f\x31\x01";
  Require(ftruncate(file, 0) == 0);
  Require(pwrite(file, kMagic, 4, 0) == 4);
  Require(pwrite(file, data, size, 4) == static_cast<ssize_t>(size));
  const std::string path = "/proc/self/fd/" + std::to_string(file);
  // A few hundred bytes may promise, and by PIZ or DWA truly hold, half a billion samples: reading
  // those takes its time and is no fault. The door looks for faults.
  constexpr double kMostSamples = 4e6;
  if (const auto info = lightcal::devices::ReadPictureInfo(path);
      info && 1.0 * info->width * info->height * info->channels > kMostSamples) {
    return 0;
  }
  const auto frame = lightcal::devices::ReadPicture(path);
  if (!frame) {
    lightcal::fuzz::RequireGoodError(frame.error());
    return 0;
  }
  const auto& view = std::get<lightcal::View2d<const float>>(frame->samples);
  for (int y = 0; y < view.height(); ++y) {
    for (const float sample : view.row(y)) Require(std::isfinite(sample));
  }
  return 0;
}
