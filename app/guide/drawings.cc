// SPDX-License-Identifier: Apache-2.0
#include "guide/drawings.h"

namespace lightcal::app {

std::string ShadowCardDrawing() {
  return R"(The shadow card: what the walls and other lamps add, measured and taken off.

        wall  . . . . . . . . . . . . . .
             .                           ' .   light from the walls
            .             card               ' .   still arrives
       .-.                 |                    [o]  meter
      ( * )  - - - - - - - |  . . shadow . . .  [ ]  facing the lamp
       '-'   direct light  |                    [ ]
       lamp                ^ half way, just large enough
                             that its shadow covers the sensor
)";
}

}  // namespace lightcal::app
