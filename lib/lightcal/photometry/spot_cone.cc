// SPDX-License-Identifier: Apache-2.0
#include "lightcal/photometry/spot_cone.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lightcal/photometry/lambert.h"
#include "lightcal/photometry/solid_angle.h"
#include "lightcal/photometry/spot_profile.h"

namespace lightcal {
namespace {

// Inner no wider than outer, as the header promises.
SpotCone Ordered(const SpotCone& cone) { return {std::min(cone.inner, cone.outer), cone.outer}; }

// Mean of the attenuation over the penumbra, uniform in cos theta.
double PenumbraMean(SpotFalloff falloff) {
  switch (falloff) {
    case SpotFalloff::kHard:
      return 1.0;
    case SpotFalloff::kSquaredLinear:
      return 1.0 / 3.0;
    case SpotFalloff::kLinear:
    case SpotFalloff::kSmoothstep:
      break;
  }
  return 0.5;
}

}  // namespace

double SpotAttenuation(Radians from_axis, const SpotCone& cone, SpotFalloff falloff) {
  const SpotCone ordered = Ordered(cone);
  return SpotProfile(HalfVersine(from_axis.value()), HalfVersine(ordered.inner.value()),
                     HalfVersine(ordered.outer.value()), falloff);
}

Radians AngleFromAim(const Vec3& aim, const Vec3& lamp_to_point) {
  return Radians(std::atan2(Length(Cross(aim, lamp_to_point)), Dot(aim, lamp_to_point)));
}

Steradians SolidAngleOfSpot(const SpotCone& cone, SpotFalloff falloff) {
  const SpotCone ordered = Ordered(cone);
  return SolidAngleOfCone(ordered.inner) +
         SolidAngleOfZone(ordered.inner, ordered.outer) * PenumbraMean(falloff);
}

Lumens FluxOfSpot(Candela axial, const SpotCone& cone, SpotFalloff falloff) {
  return Lumens(axial.value() * SolidAngleOfSpot(cone, falloff).value());
}

Candela AxialCandelaOfSpot(Lumens flux, const SpotCone& cone, SpotFalloff falloff) {
  return Candela(flux.value() / SolidAngleOfSpot(cone, falloff).value());
}

Lumens FluxOfSpotByPiConvention(Candela axial) { return FluxOfFlatSource(axial); }

}  // namespace lightcal
