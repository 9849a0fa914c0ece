// SPDX-License-Identifier: Apache-2.0
#include "lightcal/photometry/inverse_square.h"

#include <cmath>

namespace lightcal {

Metres DistanceFromCandelaAndLux(Candela i, Lux e) {
  return Metres(std::sqrt(i.value() / e.value()));
}

}  // namespace lightcal
