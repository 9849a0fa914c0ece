// SPDX-License-Identifier: Apache-2.0
// Lamps that mix two emitters: every colour they make lies on the line between the two.
#pragma once

#include <optional>
#include <vector>

#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal/core/units.h"

namespace lightcal::fit {

// From the outermost colour that was read to the other: what the emitters surely reach.
struct MixingLine {
  Xy first, last;
  double sd_duv = 0.0;  // of the colours beside it
};

// The line through chromaticities of one lamp, by total least squares. Tristimulus values of
// non-negative mixtures of two emitters have rank 2, so their chromaticities lie on a segment
// (Grassmann's law). Absent of fewer than three colours, of colours that hardly differ (less than
// 0.005 apart) and where they scatter by more than 0.0015 about it.
[[nodiscard]] std::optional<MixingLine> MixingLineOf(const std::vector<Xy>& colors);
// Duv of the segment's point of that CCT; absent beyond its ends.
[[nodiscard]] std::optional<double> DuvOnLine(const MixingLine& line, Kelvin cct);

}  // namespace lightcal::fit
