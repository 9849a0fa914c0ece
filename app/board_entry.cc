// SPDX-License-Identifier: Apache-2.0
// The module's side of lightcal_devices/captures/board_module.h.
#include "lightcal/imaging/camera/find_chart.h"
#include "lightcal/imaging/panorama/find_features.h"
#include "lightcal/imaging/scene/charuco.h"
#include "lightcal_devices/captures/board_module.h"

extern "C" __attribute__((visibility("default"))) const lightcal::devices::BoardFunctions*
lightcal_board_functions() noexcept {
  static constexpr lightcal::devices::BoardFunctions kFunctions = {
      &lightcal::LayOutBoard, &lightcal::FindBoard, &lightcal::FindColorChart,
      &lightcal::FindFeatures};
  return &kFunctions;
}
