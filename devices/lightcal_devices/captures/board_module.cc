// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/captures/board_module.h"

#include "lightcal_devices/transport/module_door.h"

namespace lightcal::devices {

Result<const BoardFunctions*> BoardModule() {
  static const auto module =
      OpenModuleFunctions<BoardFunctions>("lightcal_board.so", kBoardEntrySymbol, "no_board_module",
                                          "the part that knows boards, charts and features");
  return module;
}

}  // namespace lightcal::devices
