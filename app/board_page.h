// SPDX-License-Identifier: Apache-2.0
// The sheet that a ChArUco board is printed on.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/core/units.h"
#include "lightcal/records/charuco_board.h"

namespace lightcal::app {

struct Paper {
  std::string_view name;
  double width_mm = 0.0, height_mm = 0.0;  // landscape
};
// "a4" "a3" "letter"
[[nodiscard]] std::vector<std::string> PaperWords();
// The paper of that name, in any letter case.  Wrong usage: any other word.
[[nodiscard]] Result<Paper> PaperByName(const std::string& name);

// The largest whole millimetre that lets the board fit on the paper, with 10 mm of white around it
// and room for what is written below.  Wrong usage: under 5 mm.
[[nodiscard]] Result<Metres> LargestSquare(const CharucoBoard& board, const Paper& paper);

// One SVG page in true size (its units are millimetres): the board, ticks at its origin, a bar of
// 100 mm to check the print with, and what it is. Rectangles stand in a group whose unit is the
// metre, Z up from the board's lower left corner, with the classes "black" and "white".
// Refused: bad_board. Wrong usage: it does not fit.
[[nodiscard]] Result<std::string> BoardPage(const CharucoBoard& board, const Paper& paper);

}  // namespace lightcal::app
