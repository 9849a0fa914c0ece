// SPDX-License-Identifier: Apache-2.0
// The printed board: what is painted where, and where its corners lie in a picture.
#pragma once

#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/core/view2d.h"
#include "lightcal/records/charuco_board.h"

namespace lightcal {

// What to paint in this order on white paper: black squares, black markers, and over these the
// white cells, joined along rows, so that neighbouring black areas have no seam.
// Markers are those of OpenCV's predefined dictionaries, numbered as its CharucoBoard does.
// Refused: bad_board (fewer than 3 x 3 squares, or more markers than the dictionary has).
[[nodiscard]] Result<std::vector<BoardRectangle>> LayOutBoard(const CharucoBoard& board);

// The chessboard corners that a linear picture shows, found in its local contrast, so that the
// light may fall off over the board. Any scale of luminance.
// Refused: bad_board, board_not_found (no marker, or fewer than 6 corners), board_too_small
// (squares of less than 8 pixels), board_blurred (edges wider than 0.2 squares and 3 pixels).
[[nodiscard]] Result<std::vector<BoardCorner>> FindBoard(View2d<const float> luminance,
                                                         const CharucoBoard& board);

}  // namespace lightcal
