// SPDX-License-Identifier: Apache-2.0
// The pictures that captures are read from, kept small for the report.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/view2d.h"
#include "lightcal/records/session.h"

namespace lightcal {
struct MergedBracket;
}

namespace lightcal::app {

// In cd/m^2; no side longer than kLongestRecordedSide.
struct RecordedPicture {
  std::string light, use;  // "wall", "card", ...
  int width = 0, height = 0;
  std::vector<float> nits;
  std::optional<std::array<double, 4>> region{};  // x, y, width, height of what was measured
};
inline constexpr int kLongestRecordedSide = 400;

// While one lives, each picture that a capture is read from on this thread is kept in it (the
// innermost one). A bracket is merged once, where it is measured; nothing is read for the report.
class PictureRecord {
 public:
  PictureRecord();
  ~PictureRecord();
  PictureRecord(const PictureRecord&) = delete;
  PictureRecord& operator=(const PictureRecord&) = delete;

  [[nodiscard]] const std::vector<RecordedPicture>& pictures() const { return pictures_; }

 private:
  friend void RecordPicture(const CaptureDescription& capture, View2d<const float> nits);
  friend void RecordPicture(const CaptureDescription& capture, const MergedBracket& merged,
                            double factor);
  PictureRecord* outer_;
  std::vector<RecordedPicture> pictures_;
};

// Does nothing where nobody records. factor: cd/m^2 per unit of the merged picture's luminance.
void RecordPicture(const CaptureDescription& capture, View2d<const float> nits);
void RecordPicture(const CaptureDescription& capture, const MergedBracket& merged, double factor);

}  // namespace lightcal::app
