// SPDX-License-Identifier: Apache-2.0
// The door to OpenCV's board and charts: what the module lightcal_board.so answers. Both sides are
// built together.
#pragma once

#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/imaging/camera/find_chart.h"
#include "lightcal/imaging/scene/charuco.h"

namespace lightcal::app {

struct BoardFunctions {
  decltype(&LayOutBoard) lay_out;
  decltype(&FindBoard) find;
  decltype(&FindColorChart) find_chart;
};
using BoardEntry = const BoardFunctions* (*)() noexcept;
inline constexpr const char* kBoardEntrySymbol = "lightcal_board_functions";

// Opens the module at the first call and keeps it.  Fails: no_board_module.
[[nodiscard]] Result<const BoardFunctions*> BoardModule();

}  // namespace lightcal::app
