// SPDX-License-Identifier: Apache-2.0
// Symbols: E illuminance at the receiver [lx], I luminous intensity toward it [cd], d distance [m],
// d0 how far the effective source lies behind the point d was measured from [m], cr = cos of the
// angle between the receiver's normal and the direction to the lamp.
#pragma once

#include "lightcal/core/units.h"
#include "lightcal/photometry/cosine_law.h"

namespace lightcal {

// Where the receiver stands. Holds for distance + offset > 0.
struct ReceiverPose {
  Metres distance{1.0};
  Metres offset{0.0};          // d0, negative when the effective source lies in front
  double cos_incidence = 1.0;  // 1 = facing the lamp
};

// Intensity of a small source from the illuminance it casts at normal incidence.
//   I = E d^2                                   [cd] = [lx] [m]^2 (per unit solid angle)
// Holds while d is at least five times the source's largest side (1 % for a disk), and exactly for
// a sphere when d is measured to its centre. Source: CIE e-ILV 17-25-104.   Fails: never.
[[nodiscard]] constexpr Candela CandelaFromLux(Lux e, Metres d) {
  return Candela(e.value() * d.value() * d.value());
}
//   I = E (d + d0)^2 / cr.   Holds for cr > 0: a receiver that faces away says nothing about I.
[[nodiscard]] constexpr Candela CandelaFromLux(Lux e, const ReceiverPose& at) {
  const Candela facing = CandelaFromLux(e, at.distance + at.offset);
  return facing / at.cos_incidence;
}

//   E = I/d^2 at normal incidence.   Holds for d > 0; E has no upper limit as d -> 0, while the
//   flux
// through a sphere of radius d stays 4 pi I, and E -> 0 without ever being 0 as d grows.
[[nodiscard]] constexpr Lux LuxFromCandela(Candela i, Metres d) {
  return Lux(i.value() / (d.value() * d.value()));
}
//   E = I max(0, cr) / (d + d0)^2
[[nodiscard]] constexpr Lux LuxFromCandela(Candela i, const ReceiverPose& at) {
  return LuxOnTiltedPlane(LuxFromCandela(i, at.distance + at.offset), at.cos_incidence);
}

}  // namespace lightcal
