// SPDX-License-Identifier: Apache-2.0
// A fitted light's illuminance against distance, with the 95 % band of the model.
#pragma once

#include <optional>

#include "lightcal/light/axial_shape.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal {

// What the fit added to every distance before d0: the radius of a sphere whose distances are stated
// to reach its surface (the effect sphere_surface, on). Where that effect is fitted, d0 holds it.
[[nodiscard]] double SurfaceRadius_m(const FittedLight& light);

// For a meter that faces the lamp at distance d from its reference point,
//   E(d) = I g(r)/r^2 + E0,   r = d + d0 (+ the radius of a sphere measured from its surface),
// g the axial shape factor where the light's finite_source effect is on. The band is normal in ln E
// with variance  grad^T C grad,  C the covariance of (ln I, d0, E0).
class LightCurve {
 public:
  // Absent for lights without an intensity above zero (directional, dome).
  [[nodiscard]] static std::optional<LightCurve> Of(const FittedLight& light);

  // Holds for d > nearest_m().
  [[nodiscard]] double LuxAt(double distance_m) const;
  // Standard deviation of ln E; absent when the light carries no covariance.
  [[nodiscard]] std::optional<double> SdOfLogAt(double distance_m) const;
  // The effective source itself: no illuminance is defined there or nearer.
  [[nodiscard]] double nearest_m() const { return -offset_m_; }

 private:
  [[nodiscard]] double DirectAt(double r) const;

  double intensity_cd_ = 0.0;
  double offset_m_ = 0.0;
  double ambient_lx_ = 0.0;
  AxialShape shape_;
  std::optional<std::array<double, 9>> covariance_;
};

}  // namespace lightcal
