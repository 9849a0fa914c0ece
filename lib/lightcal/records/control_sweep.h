// SPDX-License-Identifier: Apache-2.0
// A lamp's light and colour along one of its controls, the others as at its reference state.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/records/fixture_state.h"

namespace lightcal {

struct ControlSweep {
  std::string light, control;
  std::string others;      // what the other controls say: "cct_K=4000"
  double reference = 0.0;  // the control's label there
  struct Point {
    double at = 0.0;     // the label
    Uncertain relative;  // light over that at the reference state
    std::optional<Uncertain> cct_K{};
    std::optional<Xy> xy{};
    std::optional<double> promised_cct_K{};  // by the label
  };
  std::vector<Point> read;   // states that were read
  std::vector<Point> curve;  // between them, ascending
};

}  // namespace lightcal
