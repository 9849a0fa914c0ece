// SPDX-License-Identifier: Apache-2.0
// How sure a match is.
#pragma once

#include <vector>

#include "lightcal/match/match_scene.h"

namespace lightcal::match {

// Draws shared by all matches of one scene, from seeds fixed by the gels' places: gels, the lamp's
// and the target's meter, the cameras' channels.
class MatchDraws {
 public:
  explicit MatchDraws(const MatchScene& scene);

  // 2.5 and 97.5 % of the match under the draws. A gel's transmittance outside its table is
  // anything of 0..1 there, the same on one side. Of many cameras the interval is that of one more
  // camera: the order statistics (n + 1) p of those seen, with the draws of the median one in
  // quadrature on each side.
  [[nodiscard]] Match::Intervals Of(const Match& match) const;

 private:
  struct Draw {
    NodeValues lamp, target;            // factors
    std::array<NodeValues, 3> channel;  // factors
    double level = 1.0;                 // of the two illuminances' ratio
    double plain_Y = 1.0;               // of the lamp without gels, as drawn
    Spectrum target_spectrum;
  };
  [[nodiscard]] NodeValues Through(const Match& match, std::size_t draw) const;

  const MatchScene& scene_;
  std::vector<Draw> draws_;
};

}  // namespace lightcal::match
