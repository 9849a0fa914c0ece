// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/sekonic/reading.h"

#include <algorithm>
#include <cmath>

#include "lightcal/core/numbers_text.h"

namespace lightcal::devices::sekonic {
namespace {

constexpr double kLowestCctKelvin = 1563.0;
constexpr double kHighestCctKelvin = 100000.0;
constexpr double kCctOverKelvin = 50000.0;
constexpr double kFarthestDuv = 0.1;

bool AllFinite(std::span<const double> values) {
  return std::ranges::all_of(values, [](double v) { return std::isfinite(v); });
}

bool CctInRange(const Measurement& m) {
  return m.cct_K >= kLowestCctKelvin && m.cct_K <= kHighestCctKelvin && m.cct_K != kCctOverKelvin &&
         std::abs(m.duv) <= kFarthestDuv;
}

void AddColor(const Measurement& m, MeterReading& result) {
  Reading& reading = result.reading;
  if (std::isfinite(m.xy.x) && std::isfinite(m.xy.y) && m.xy.x > 0.0 && m.xy.y > 0.0) {
    reading.xy = m.xy;
    reading.color_source = ColorSource::kSpectrometer;
  }
  if (CctInRange(m)) {
    reading.cct = Kelvin(m.cct_K);
    reading.duv = m.duv;
    reading.color_source = ColorSource::kSpectrometer;
  } else {
    result.warnings.push_back({"cct_out_of_range", reading.device,
                               "the light is no white the meter has a colour temperature for; "
                               "its chromaticity xy is kept"});
  }
}

void AddSpectrum(const Measurement& m, MeterReading& result) {
  if (std::isfinite(m.cri_Ra)) result.cri_Ra = m.cri_Ra;
  if (AllFinite(m.cri_R)) result.cri_R.assign(m.cri_R.begin(), m.cri_R.end());
  if (!AllFinite(m.spectrum)) return;
  Spectrum spectrum{{}, m.spectrum, SpectralQuantity::kIrradiance};
  for (int i = 0; i < kSpectrumSamples; ++i) {
    spectrum.wavelengths_nm.push_back(kSpectrumStartNm + i);
  }
  result.spectrum = std::move(spectrum);
}

}  // namespace

MeterReading ReadingFromMeasurement(const Measurement& m, const std::string& device) {
  MeterReading result;
  Reading& reading = result.reading;
  reading.device = device;
  reading.quality = MeterQuality::kSpectral;
  reading.sigma_relative = kSigmaRelative;
  reading.illuminance = Lux(m.illuminance_lx);
  reading.over_range = m.illuminance_lx > kHighestIlluminanceLx;
  if (reading.over_range) {
    reading.illuminance = Lux(kHighestIlluminanceLx);
    return result;
  }
  reading.under_range = m.illuminance_lx < kLowestIlluminanceLx;
  if (reading.under_range) {
    reading.illuminance = Lux(kLowestIlluminanceLx);  // at most
    return result;
  }
  if (m.illuminance_lx < kLowestColorLx) {
    result.warnings.push_back({"low_light_color", device,
                               RoundedText(m.illuminance_lx, 3) +
                                   " lx: below 5 lx the meter's colour means nothing and is left "
                                   "out; move closer to measure colour"});
  } else {
    AddColor(m, result);
    AddSpectrum(m, result);
  }
  const Warnings checks = SelfCheck(m, device);
  result.warnings.insert(result.warnings.end(), checks.begin(), checks.end());
  return result;
}

}  // namespace lightcal::devices::sekonic
