// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/light_models.h"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/colorimetry/cie_tables/tables.h"
#include "lightcal/core/numbers_text.h"

namespace lightcal {
namespace {

constexpr Nanometres kPumpPeak{455.0};
constexpr Nanometres kPumpFwhm{20.0};

Spectrum Mixture(const Spectrum& pump, const Spectrum& phosphor, double pump_share) {
  Spectrum sum = phosphor;
  for (std::size_t i = 0; i < sum.values.size(); ++i) {
    sum.values[i] = pump_share * pump.values[i] + (1.0 - pump_share) * phosphor.values[i];
  }
  return sum;
}

// Reciprocal temperature; -1 where the mixture has no valid CCT.
double MiredsOf(const Spectrum& spectrum) {
  const auto xyz = XyzFromSpectrum(spectrum);
  if (!xyz) return -1.0;
  const CctResult cct = CctFromXy(XyFromXyz(*xyz));
  return cct.valid() ? MiredsFromKelvin(cct.temperature).value() : -1.0;
}

}  // namespace

Result<Spectrum> GaussianSpectrum(Nanometres peak, Nanometres fwhm) {
  const bool holds = peak.value() >= kCmfFirstNm && peak.value() <= kCmfLastNm &&
                     fwhm.value() >= 1.0 && fwhm.value() <= 400.0;
  if (!holds) {
    return Refused("out_of_range", "Gaussian spectrum",
                   "give a peak of 360 to 830 nm and a full width at half maximum of 1 to 400 nm");
  }
  Spectrum spectrum;
  for (int nm = kCmfFirstNm; nm <= kCmfLastNm; ++nm) {
    const double off = (nm - peak.value()) / fwhm.value();
    spectrum.wavelengths_nm.push_back(nm);
    spectrum.values.push_back(100.0 * std::exp(-4.0 * std::numbers::ln2 * off * off));
  }
  return spectrum;
}

Result<Spectrum> PhosphorLedSpectrum(Kelvin temperature, Nanometres phosphor_peak,
                                     Nanometres phosphor_fwhm) {
  const auto phosphor = GaussianSpectrum(phosphor_peak, phosphor_fwhm);
  if (!phosphor) return tl::unexpected(phosphor.error());
  const Spectrum pump = *GaussianSpectrum(kPumpPeak, kPumpFwhm);
  const double wanted = MiredsFromKelvin(temperature).value();
  // More pump, fewer mireds: walk to the first mixture that is hot enough, then halve.
  constexpr int kSteps = 200;
  double low = -1.0;
  double high = -1.0;
  for (int i = 0; i < kSteps && high < 0.0; ++i) {
    const double share = static_cast<double>(i) / kSteps;
    const double mireds = MiredsOf(Mixture(pump, *phosphor, share));
    if (mireds < 0.0) continue;
    (mireds >= wanted ? low : high) = share;
  }
  if (!(low >= 0.0 && high > low)) {
    return Refused("out_of_range", "LED spectrum",
                   "no mixture of this phosphor and a blue pump has a CCT of " +
                       RoundedText(temperature.value(), 5) +
                       " K; a longer phosphor wavelength gives warmer light");
  }
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2.0;
    (MiredsOf(Mixture(pump, *phosphor, middle)) >= wanted ? low : high) = middle;
  }
  return Mixture(pump, *phosphor, (low + high) / 2.0);
}

}  // namespace lightcal
