// SPDX-License-Identifier: Apache-2.0
// Places in the pixels that a file stores, and in the picture that viewers show.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "lightcal/core/result.h"
#include "lightcal/records/frame.h"

namespace lightcal {

using PixelBox = std::array<int, 4>;  // x, y, width, height; (0, 0) is the upper left pixel

// Whether it has pixels, and all of them lie in a picture of that size.
[[nodiscard]] bool IsInside(const PixelBox& box, int width, int height);

// What an Orientation tag has a viewer do: rows for columns, then from the right or from below.
// Source: TIFF 6.0 (1 the first row above, 2 to 4 mirrored and turned in place, 5 to 8 with rows
// for columns); of any other number nothing.
struct ShownTurn {
  bool rows_for_columns = false, from_right = false, from_below = false;
};
[[nodiscard]] ShownTurn ShownTurnOf(int orientation);

// Where a box of the picture that viewers show lies among the stored pixels; absent where it is not
// inside that picture.
[[nodiscard]] std::optional<PixelBox> StoredFromShown(const PixelBox& shown, const FrameInfo& info);

// Of a box told in pixels of frames that viewers show turned or mirrored: warns (turned_frames)
// where it may have been read off a viewer and would then lie elsewhere, and says where. Refused:
// bad_region, where it can only have been read off a viewer.
[[nodiscard]] Result<void> CheckTurned(const std::string& subject, const FrameInfo& info,
                                       const PixelBox& box, Warnings& warnings);

}  // namespace lightcal
