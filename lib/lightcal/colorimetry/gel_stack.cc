// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/gel_stack.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace lightcal {

double AtNodes(const NodeValues& values, double nm) {
  const double place = std::clamp((nm - kNodeFirstNm) / kNodeStepNm, 0.0, kNodeCount - 1.0);
  const auto i = std::min(static_cast<std::size_t>(place), std::size_t{kNodeCount - 2});
  const double t = place - static_cast<double>(i);
  return values[i] + t * (values[i + 1] - values[i]);
}

GelNodes GelAtNodes(std::span<const double> nm, std::span<const double> values) {
  GelNodes gel;
  gel.known_from = kNodeCount;
  gel.known_to = -1;
  std::size_t right = 1;
  for (std::size_t k = 0; k < kNodeCount; ++k) {
    const double at = NodeNm(k);
    if (at >= nm.front() && at <= nm.back()) {
      gel.known_from = std::min(gel.known_from, static_cast<int>(k));
      gel.known_to = static_cast<int>(k);
    }
    const double held = std::clamp(at, nm.front(), nm.back());
    while (right + 1 < nm.size() && nm[right] < held) ++right;
    const double t = (held - nm[right - 1]) / (nm[right] - nm[right - 1]);
    gel.transmittance[k] = values[right - 1] + t * (values[right] - values[right - 1]);
  }
  return gel;
}

double SheetReflectance(double transmittance) {
  constexpr double r = kSheetFaceReflectance;
  constexpr double through = (1.0 - r) * (1.0 - r);
  // t from T: r^2 T t^2 + (1-r)^2 t - T = 0, without cancellation.
  const double T = transmittance;
  const double t = 2.0 * T / (through + std::sqrt(through * through + 4.0 * r * r * T * T));
  return r * (1.0 + std::min(t, 1.0) * T);
}

NodeValues StackOf(const NodeValues& first, const NodeValues& second, SheetGap gap) {
  NodeValues out{};
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = first[k] * second[k];
  if (gap == SheetGap::kNone) return out;
  for (std::size_t k = 0; k < out.size(); ++k) {
    out[k] /= 1.0 - SheetReflectance(first[k]) * SheetReflectance(second[k]);
  }
  return out;
}

Spectrum SpectrumBehind(const Spectrum& light, const NodeValues& transmittance) {
  Spectrum out = light;
  for (std::size_t i = 0; i < out.values.size(); ++i) {
    out.values[i] *= AtNodes(transmittance, out.wavelengths_nm[i]);
  }
  return out;
}

}  // namespace lightcal
