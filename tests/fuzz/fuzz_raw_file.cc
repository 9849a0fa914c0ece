// SPDX-License-Identifier: Apache-2.0
// A camera RAW that is read has samples of the size, levels and pattern its description says.
#include <sys/mman.h>
#include <unistd.h>

#include <variant>

#include "lightcal_devices/captures/raw.h"
#include "require.h"

namespace {

using lightcal::Frame;
using lightcal::fuzz::Require;

void RequireWhole(const Frame& frame) {
  std::visit(
      [&](const auto& view) {
        Require(view.width() == frame.info.width && view.height() == frame.info.height);
        Require(view.width() > 0 && view.height() > 0);
        double sum = 0.0;
        for (int y = 0; y < view.height(); ++y) {
          sum += static_cast<double>(view.row(y).front()) + static_cast<double>(view.row(y).back());
        }
        Require(sum >= 0.0 || sum < 0.0 || sum != sum);  // every row was there to be read
      },
      frame.samples);
  Require(frame.info.levels.has_value());
  const auto& black = frame.info.levels->black;
  Require(black.values.size() == static_cast<std::size_t>(black.width) * black.height);
  const bool mosaic = frame.info.meaning == lightcal::SampleMeaning::kMosaic;
  Require(mosaic == !frame.info.cfa.values.empty());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const int file = memfd_create("frame.dng", 0);
  Require(ftruncate(file, 0) == 0);
  Require(pwrite(file, data, size, 0) == static_cast<ssize_t>(size));
  const auto frame = lightcal::ReadRaw("/proc/self/fd/" + std::to_string(file));
  if (frame) {
    RequireWhole(*frame);
  } else if (size > 0) {
    lightcal::fuzz::RequireGoodError(frame.error());
  }
  return 0;
}
