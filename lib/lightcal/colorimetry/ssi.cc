// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/ssi.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "lightcal/colorimetry/daylight.h"
#include "lightcal/colorimetry/illuminants.h"

namespace lightcal {
namespace {

constexpr std::size_t kBands = 30;
constexpr double kFirstEdgeNm = 375.0;
constexpr double kBandNm = 10.0;
constexpr double kFirstDaylightOfSsiKelvin = 4000.0;
using Bands = std::array<double, kBands>;

constexpr Bands MakeWeights() {
  Bands weights{};
  weights.fill(1.0);
  weights[0] = 12.0 / 45.0;
  weights[1] = 22.0 / 45.0;
  weights[2] = 32.0 / 45.0;
  weights[3] = 40.0 / 45.0;
  weights[4] = 44.0 / 45.0;
  weights[kBands - 2] = 11.0 / 15.0;
  weights[kBands - 1] = 3.0 / 15.0;
  return weights;
}
constexpr Bands kWeights = MakeWeights();

// The exact integral of each band over straight lines between samples; for a 1 nm spectrum on whole
// nanometres that is the trapezoid with half weights at 375, 385, ...
Bands Integrated(const Spectrum& s) {
  Bands bands{};
  for (std::size_t i = 1; i < s.values.size(); ++i) {
    const double left = s.wavelengths_nm[i - 1];
    const double right = s.wavelengths_nm[i];
    const double slope = (s.values[i] - s.values[i - 1]) / (right - left);
    const auto value_at = [&](double l) { return s.values[i - 1] + slope * (l - left); };
    const double end = std::min(right, kFirstEdgeNm + kBandNm * kBands);
    double from = std::max(left, kFirstEdgeNm);
    while (from < end) {
      const auto band =
          std::min(static_cast<std::size_t>((from - kFirstEdgeNm) / kBandNm), kBands - 1);
      const double edge = kFirstEdgeNm + kBandNm * static_cast<double>(band + 1);
      const double to = std::min(edge, end);
      bands[band] += (value_at(from) + value_at(to)) / 2 * (to - from);
      from = to;
    }
  }
  return bands;
}

Result<Bands> Normalised(const Spectrum& spectrum) {
  if (const auto readable = XyzFromSpectrum(spectrum); !readable) {
    return tl::unexpected(readable.error());
  }
  Bands bands = Integrated(spectrum);
  double sum = 0.0;
  for (const double each : bands) sum += each;
  if (!(sum > 0.0)) {
    return Refused("bad_spectrum", "spectrum", "no power between 375 and 675 nm to compare");
  }
  for (double& each : bands) each /= sum;
  return bands;
}

}  // namespace

Result<double> SpectralSimilarity(const Spectrum& test, const Spectrum& reference) {
  const auto t = Normalised(test);
  if (!t) return tl::unexpected(t.error());
  const auto r = Normalised(reference);
  if (!r) return tl::unexpected(r.error());
  std::array<double, kBands + 4> weighted{};  // two zeros at each end
  for (std::size_t i = 0; i < kBands; ++i) {
    weighted[i + 2] = kWeights[i] * ((*t)[i] - (*r)[i]) / ((*r)[i] + 1.0 / kBands);
  }
  double sum = 0.0;
  for (std::size_t i = 1; i + 1 < weighted.size(); ++i) {
    const double smooth = 0.22 * weighted[i - 1] + 0.56 * weighted[i] + 0.22 * weighted[i + 1];
    sum += smooth * smooth;
  }
  return 100.0 - 32.0 * std::sqrt(sum);
}

Result<Spectrum> SimilarityReference(Kelvin temperature) {
  return temperature.value() < kFirstDaylightOfSsiKelvin ? BlackBodySpectrum(temperature)
                                                         : DaylightSpectrum(temperature);
}

}  // namespace lightcal
