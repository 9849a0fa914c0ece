// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/torchbearer/reading.h"

#include <utility>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/colorimetry/spectrum.h"

namespace lightcal::devices::torchbearer {
namespace {

void AddColor(const Xyz& xyz, MeterReading& result) {
  Reading& reading = result.reading;
  reading.xy = XyFromXyz(xyz);
  reading.color_source = ColorSource::kSpectrometer;
  const CctResult cct = CctFromXy(*reading.xy);
  if (cct.valid()) {
    reading.cct = cct.temperature;
    reading.duv = cct.duv;
  } else {
    result.warnings.push_back({"cct_out_of_range", reading.device,
                               "the light is no white that has a colour temperature; its "
                               "chromaticity xy is kept"});
  }
}

}  // namespace

MeterReading ReadingFromMeasurement(const Measurement& measurement, const WavelengthRange& range,
                                    const std::string& device) {
  MeterReading result;
  result.reading.device = device;
  result.reading.quality = MeterQuality::kSpectral;
  result.reading.sigma_relative = kSigmaRelative;
  result.warnings.push_back(
      {"experimental", device,
       "is experimental: the driver follows a description of the protocol and was never tried "
       "on a device; compare it with a meter you trust, and please send a "
       "tape ({meter.tape})"});
  Spectrum spectrum{{}, measurement.irradiance_W_m2_nm, SpectralQuantity::kIrradiance};
  for (int nm = range.start_nm; nm <= range.end_nm; ++nm) spectrum.wavelengths_nm.push_back(nm);
  if (!CoversVisibleRange(spectrum)) {
    result.warnings.push_back({"spectrum_range", device,
                               "the spectrum does not reach over 380 to 780 nm; illuminance and "
                               "colour lack what lies outside"});
  }
  // The only spectrum refused here, of finite values that are not negative, is one without light.
  const auto xyz = XyzFromSpectrum(spectrum);
  result.reading.illuminance = Lux(xyz ? xyz->Y : 0.0);
  if (xyz) AddColor(*xyz, result);
  result.spectrum = std::move(spectrum);
  return result;
}

}  // namespace lightcal::devices::torchbearer
