// SPDX-License-Identifier: Apache-2.0
// Where the names of a figure's points stand so that none lies on another.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/report/svg.h"

namespace lightcal::report {

// In page coordinates; y grows downwards.
struct LabelBox {
  double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;
};
// Touching edges do not overlap.
[[nodiscard]] bool Overlap(const LabelBox& a, const LabelBox& b);

// Baseline to baseline of text of the class "note", which is 13 px high.
inline constexpr double kNoteLine = 15.0;
// At least the width of text of the class "note", by the widest of the usual sans-serif faces.
[[nodiscard]] double NoteWidth(std::string_view text);

struct LabelWish {
  PagePoint point;
  std::string text;
  bool must = true;  // may stand far off and on lines; others beside their point or nowhere
};

struct PlacedLabel {
  std::size_t wish = 0;  // its index
  LabelBox box;
  PagePoint text_at;                // start of the baseline
  std::optional<PagePoint> leader;  // where a line from the point ends, where the label is far off
};

struct LabelGround {
  LabelBox area;                              // labels stay inside
  std::vector<LabelBox> taken;                // marks and other text: nothing stands on them
  std::vector<std::vector<PagePoint>> lines;  // better not crossed
};

// Each label at the free place that lies nearest to its point and on the fewest lines; those that
// must be shown first, then in the order given. What has no room is left out. Same input, same
// answer.
[[nodiscard]] std::vector<PlacedLabel> PlaceLabels(std::span<const LabelWish> wishes,
                                                   const LabelGround& ground);

}  // namespace lightcal::report
