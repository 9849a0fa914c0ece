// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/cri.h"

#include <cmath>
#include <cstddef>

#include "lightcal/colorimetry/cie_tables/samples.h"
#include "lightcal/colorimetry/sample_colors.h"

namespace lightcal {
namespace {

constexpr double kFirstDaylightOfCriKelvin = 5000.0;
constexpr std::size_t kSamplesOfRa = 8;

const SampleSet& CriSampleSet() {
  static const SampleSet samples({CriSamples().front().data(), kCriRowCount * kCriSampleCount},
                                 kCriFirstNm, kCriSampleCount);
  return samples;
}

NanometrePowers Reference(const RenderingInput& light) {
  const Kelvin t = light.color.temperature;
  return ReferencePowers(light, t.value() < kFirstDaylightOfCriKelvin
                                    ? BlackBodyAt(t, light.reference_nm)
                                    : DaylightAt(t, light.reference_nm));
}

// CIE 13.3, eq. 5: the coordinates in which the adaptation is a scaling.
struct ConeRatios {
  double c, d;
};
ConeRatios RatiosOf(Uv1960 uv) {
  return {(4.0 - uv.u - 10.0 * uv.v) / uv.v, (1.708 * uv.v + 0.404 - 1.481 * uv.u) / uv.v};
}

// CIE 13.3, eq. 4: what a sample seen under the light looks like under the reference.
Uv1960 Adapted(Uv1960 sample, ConeRatios light, ConeRatios reference) {
  const ConeRatios s = RatiosOf(sample);
  const double c = reference.c / light.c * s.c;
  const double d = reference.d / light.d * s.d;
  const double denominator = 16.518 + 1.481 * c - d;
  return {(10.872 + 0.404 * c - 4.0 * d) / denominator, 5.520 / denominator};
}

Uv1960 UvOf(const Xyz& color) { return Uv1960FromXy(XyFromXyz(color)); }

struct Uvw1964 {
  double U, V, W;
};
Uvw1964 UvwOf(Uv1960 uv, double Y, Uv1960 white) {
  const double w = 25.0 * std::cbrt(Y) - 17.0;
  return {13.0 * w * (uv.u - white.u), 13.0 * w * (uv.v - white.v), w};
}

}  // namespace

ColorRendering ColorRenderingOf(const RenderingInput& light) {
  const auto [test, reference] = CriSampleSet().Under(light.powers, Reference(light), Cie1931Cmf());
  const Uv1960 test_white = UvOf(test.white);
  const Uv1960 white = UvOf(reference.white);
  const ConeRatios from = RatiosOf(test_white);
  const ConeRatios to = RatiosOf(white);
  ColorRendering result;
  result.chromaticity_difference = std::hypot(test_white.u - white.u, test_white.v - white.v);
  for (std::size_t i = 0; i < result.R.size(); ++i) {
    const Xyz& a = test.samples[i];
    const Xyz& b = reference.samples[i];
    const Uvw1964 seen = UvwOf(Adapted(UvOf(a), from, to), a.Y, white);
    const Uvw1964 meant = UvwOf(UvOf(b), b.Y, white);
    result.R[i] = 100.0 - 4.6 * std::hypot(seen.U - meant.U, seen.V - meant.V, seen.W - meant.W);
    if (i < kSamplesOfRa) result.Ra += result.R[i] / kSamplesOfRa;
  }
  return result;
}

}  // namespace lightcal
