// SPDX-License-Identifier: Apache-2.0
// A point whose light is confined to a cone, in the profiles that engines know.
#pragma once

#include "lightcal/light/models/point_source.h"
#include "lightcal/photometry/spot_profile.h"

namespace lightcal {

struct SpotSource {
  SpotCone cone;
  SpotFalloff falloff = SpotFalloff::kSquaredLinear;
};

//   E/I = f(theta) max(0, cr)/d^2, theta between +z and the receiver                    [lx/cd]
template <class T>
[[nodiscard]] T LuxPerCandela(const SpotSource& source, const Receiver<T>& at) {
  using S = Scalar<T>;
  const T direct = PointLuxPerCandela(at);
  if (!(direct > S(0))) return T(0);
  return direct * SpotProfile(HalfVersine(at.position),
                              T(HalfVersine(static_cast<S>(source.cone.inner.value()))),
                              T(HalfVersine(static_cast<S>(source.cone.outer.value()))),
                              source.falloff);
}

}  // namespace lightcal
