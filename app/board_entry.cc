// SPDX-License-Identifier: Apache-2.0
// The module's side of board_module.h.
#include "board_module.h"

extern "C" __attribute__((visibility("default"))) const lightcal::app::BoardFunctions*
lightcal_board_functions() noexcept {
  static constexpr lightcal::app::BoardFunctions kFunctions = {
      &lightcal::LayOutBoard, &lightcal::FindBoard, &lightcal::FindColorChart};
  return &kFunctions;
}
