// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/captures/board_module.h"

#include <utility>

#include "lightcal_devices/captures/module_door.h"

namespace lightcal::devices {
namespace {

Result<const BoardFunctions*> Open() {
  auto symbol = OpenModule("lightcal_board.so", kBoardEntrySymbol, "no_board_module",
                           "the part that knows boards, charts and features");
  if (!symbol) return Propagate(std::move(symbol));
  return reinterpret_cast<BoardEntry>(*symbol)();
}

}  // namespace

Result<const BoardFunctions*> BoardModule() {
  static const Result<const BoardFunctions*> module = Open();
  return module;
}

}  // namespace lightcal::devices
