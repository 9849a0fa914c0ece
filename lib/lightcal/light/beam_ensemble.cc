// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/beam_ensemble.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <numbers>

namespace lightcal {
namespace {

constexpr double kSpillShare = 1.0 / 3.0;  // of the flux, in the widest beam-only member

// 2 pi int_0^{pi/2} f(t) sin t dt, composite Simpson.
double SolidAngle(const std::function<double(double)>& relative_intensity) {
  constexpr int kSteps = 2000;
  const double h = 0.5 * std::numbers::pi / kSteps;
  double sum = 0.0;
  for (int i = 0; i <= kSteps; ++i) {
    const int weight = (i == 0 || i == kSteps) ? 1 : (i % 2 == 1 ? 4 : 2);
    sum += weight * relative_intensity(i * h) * std::sin(i * h);
  }
  return 2.0 * std::numbers::pi * sum * h / 3.0;
}

BeamSolidAngles Range(std::initializer_list<double> members) {
  return {Steradians(std::min(members)), Steradians(std::max(members))};
}

BeamSolidAngles FromBeam(double half) {
  const double exponent = std::log(0.5) / std::log(std::cos(half));
  const double uniform = 2.0 * std::numbers::pi * (1.0 - std::cos(half));
  const double cosine = 2.0 * std::numbers::pi / (exponent + 1.0);
  const double gaussian = SolidAngle(
      [half](double t) { return std::exp(-std::numbers::ln2 * (t / half) * (t / half)); });
  return Range({uniform, cosine, gaussian, cosine / (1.0 - kSpillShare)});
}

BeamSolidAngles FromBeamAndField(double half, double tenth) {
  const double ratio = std::log(tenth / half);
  const double p = std::log(std::numbers::ln10 / std::numbers::ln2) / ratio;
  const double q = std::log(9.0) / ratio;
  const double super_gaussian =
      SolidAngle([&](double t) { return std::exp(-std::numbers::ln2 * std::pow(t / half, p)); });
  const double lorentz = SolidAngle([&](double t) { return 1.0 / (1.0 + std::pow(t / half, q)); });
  const double trapezoid = SolidAngle(
      [&](double t) { return std::clamp(0.5 - 0.4 * (t - half) / (tenth - half), 0.0, 1.0); });
  return Range({super_gaussian, lorentz, trapezoid});
}

}  // namespace

Result<BeamSolidAngles> BeamEnsemble(Radians beam, std::optional<Radians> field) {
  const double half = 0.5 * beam.value();
  if (!(half > 0.0) || !(half < RadiansFromDegrees(85.0).value())) {
    return Refused("bad_beam", "beam_deg", "the beam angle must lie between 0 and 170 degrees");
  }
  if (!field) return FromBeam(half);
  const double tenth = 0.5 * field->value();
  if (!(tenth > half) || !(tenth <= 0.5 * std::numbers::pi)) {
    return Refused("bad_beam", "field_deg",
                   "the field angle (10 % of the peak) must exceed the beam angle (50 %) and stay "
                   "within 180 degrees");
  }
  return FromBeamAndField(half, tenth);
}

}  // namespace lightcal
