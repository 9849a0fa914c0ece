// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/cct_noise.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace lightcal {

double SignalToNoise(const Xyz& color, const XyzNoise& noise) {
  const double size = std::hypot(noise.X, noise.Y, noise.Z);
  if (size == 0.0) return std::numeric_limits<double>::infinity();
  return std::hypot(color.X, color.Y, color.Z) / size;
}

XyCovariance XyCovarianceFrom(const Xyz& color, const XyzNoise& noise) {
  const auto [x, y] = XyFromXyz(color);
  const double sum = color.X + color.Y + color.Z;
  const std::array<double, 3> dx = {1.0 - x, -x, -x};
  const std::array<double, 3> dy = {-y, 1.0 - y, -y};
  const std::array<double, 3> sd = {noise.X / sum, noise.Y / sum, noise.Z / sum};
  XyCovariance covariance;
  for (std::size_t i = 0; i < 3; ++i) {
    const double variance = sd[i] * sd[i];
    covariance.xx += dx[i] * dx[i] * variance;
    covariance.xy += dx[i] * dy[i] * variance;
    covariance.yy += dy[i] * dy[i] * variance;
  }
  return covariance;
}

std::optional<CctNoise> NoiseOfCct(const Xyz& color, const XyzNoise& noise) {
  const double snr = SignalToNoise(color, noise);
  if (!std::isfinite(snr)) return std::nullopt;
  const Xy xy = XyFromXyz(color);
  const auto jacobian = CctJacobianAt(xy);
  if (!jacobian) return std::nullopt;
  const CctUncertainty u = PropagateToCct(*jacobian, XyCovarianceFrom(color, noise));
  const double kelvin = CctFromXy(xy).temperature.value();
  const double relative = u.sd_mired.value() * kelvin / 1e6;
  return CctNoise{Kelvin(kelvin * relative * std::sqrt(1.0 + 8.0 * relative * relative)),
                  u.sd_mired, u.sd_duv, snr};
}

}  // namespace lightcal
