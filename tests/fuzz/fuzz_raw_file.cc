// SPDX-License-Identifier: Apache-2.0
// A camera RAW out of any bytes: LibRaw may break off in its process, lightcal may not.
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>

#include "lightcal_devices/captures/raw.h"
#include "require.h"

namespace {

// The same file over and over, in memory.
int File() {
  static const int descriptor = memfd_create("fuzz", 0);
  return descriptor;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const int file = File();
  lightcal::fuzz::Require(ftruncate(file, 0) == 0);
  lightcal::fuzz::Require(pwrite(file, data, size, 0) == static_cast<ssize_t>(size));
  const auto frame = lightcal::devices::ReadRaw("/proc/self/fd/" + std::to_string(file));
  if (!frame) return 0;
  // Every row can be looked at, to its end.
  std::visit(
      [](const auto& view) {
        double sum = 0.0;
        for (int y = 0; y < view.height(); ++y) {
          sum += static_cast<double>(view.row(y).front()) + static_cast<double>(view.row(y).back());
        }
        volatile double seen = sum;
        static_cast<void>(seen);
      },
      frame->samples);
  return 0;
}
