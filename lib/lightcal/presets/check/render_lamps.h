// SPDX-License-Identifier: Apache-2.0
// What pictures of a rig of several lamps tell of each of them, and of which they tell nothing.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lightcal/presets/check/render_shape.h"

namespace lightcal {

// Lamps that give less than a fifth of the light on the cards of every picture: a tenth of them
// would not show. Empty where the preset does not say what each gives (an older file).
[[nodiscard]] std::vector<std::string> LampsNotSeen(std::span<const SeenRig> seen);

// Says of a verdict that all is right which lamps it cannot mean.
void NameLampsNotSeen(std::span<const SeenRig> seen, RenderCause& cause);

// By what factor a lamp is brighter than it was measured, from the picture whose cards it gives
// most of their light.
struct RenderedLamp {
  std::string name;
  double factor = 1.0;
};
// Of the lamps that give more than half the light of some picture's cards, f of
//   E_p = sum_k f_k E_pk,
// the others taken as measured. Empty where no lamp does, or where such factors leave a picture
// more than 3 % off: then it is no lamp's intensity that is wrong.
[[nodiscard]] std::vector<RenderedLamp> RenderedLamps(std::span<const SeenRig> seen);

// The cause that those factors have. Empty where there are none.
[[nodiscard]] std::vector<RenderCause> JudgeLamps(std::span<const SeenRig> seen);

}  // namespace lightcal
