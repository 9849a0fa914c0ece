// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/captures/sample_check.h"

#include <cmath>
#include <cstddef>
#include <span>

namespace lightcal::devices {
namespace {

constexpr float kMost = 1e30F;

struct Found {
  std::size_t nan = 0, infinite = 0, huge = 0;
  int x = -1, y = -1;  // the first

  void Take(float v, int at_x, int at_y) {
    if (x < 0) {
      x = at_x;
      y = at_y;
    }
    ++(std::isnan(v) ? nan : std::isinf(v) ? infinite : huge);
  }
};

std::string Counted(std::size_t count, const char* what, const std::string& before) {
  if (count == 0) return before;
  return before + (before.empty() ? "" : ", ") + std::to_string(count) + " " + what;
}

}  // namespace

bool IsBadSample(float sample) { return !(std::abs(sample) <= kMost); }

Result<void> CheckSamples(View2d<const float> samples, const std::string& subject) {
  Found found;
  for (int y = 0; y < samples.height(); ++y) {
    const std::span<const float> row = samples.row(y);
    bool any = false;
    for (const float v : row) any = any || IsBadSample(v);
    for (std::size_t i = 0; any && i < row.size(); ++i) {
      if (IsBadSample(row[i])) found.Take(row[i], static_cast<int>(i) / samples.channels(), y);
    }
  }
  if (found.x < 0) return {};
  std::string what = Counted(found.nan, "NaN", "");
  what = Counted(found.infinite, "infinite", what);
  what = Counted(found.huge, "beyond 1e30", what);
  return Refused("bad_samples", subject,
                 "samples that no light has: " + what + "; the first at pixel " +
                     std::to_string(found.x) + "," + std::to_string(found.y) +
                     "; write the picture anew without them");
}

}  // namespace lightcal::devices
