// SPDX-License-Identifier: Apache-2.0
// The work-precision diagram: what each setting takes in time and costs in accuracy.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lightcal::report {

enum class WorkPointKind : std::uint8_t { kSetting, kUsual, kRecommended };

// One setting. Times in seconds: the median of its runs and their quartiles; what a knob is
// credited with may lie outside them. error: relative, against the reference.
struct WorkPoint {
  std::string name;
  double seconds = 0.0, low = 0.0, high = 0.0;
  double error = 0.0;
  WorkPointKind kind = WorkPointKind::kSetting;
};

struct WorkPrecision {
  std::string title;
  std::vector<WorkPoint> points;
  std::vector<WorkPoint> best;  // that none beats in both, cheapest first: joined by steps
  double tolerance = 0.01;
  std::optional<double> allowed;  // a third of the session's own standard uncertainty
};

// A whole SVG file: error in percent against milliseconds, both logarithmic. Settings without any
// error of 1e-6 or more stand on the lower edge. Names do not overlap: those of the best line, the
// usual and the recommended setting stand near or at the end of a line, others where there is room.
// At least one point.
[[nodiscard]] std::string WorkPrecisionPlot(const WorkPrecision& study);

}  // namespace lightcal::report
