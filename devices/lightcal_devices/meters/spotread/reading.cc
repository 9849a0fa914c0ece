// SPDX-License-Identifier: Apache-2.0
// What a report of spotread may be believed to say.
#include <cmath>

#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/meters/spotread/meter.h"

namespace lightcal::devices::spotread {
namespace {

constexpr double kSigmaSpectral = 0.05;     // 1 sigma of E, our estimate: no maker states one
constexpr double kSigmaColorimeter = 0.06;  // filters near V(lambda), a small diffuser
constexpr double kSigmaOneChannel = 0.10;   // Spyder, Huey: a light sensor beside the colorimeter
constexpr double kFarthestDuv = 0.1;
constexpr double kLowestCctKelvin = 1000.0;
constexpr double kHighestCctKelvin = 100000.0;
constexpr double kSpectrumAgrees = 0.03;  // spotread integrates with tables of its own

bool IsSpectral(const Report& report) {
  return report.spectrum || report.cri_Ra || report.tlci_Qa || report.tm30_Rf;
}

void AddColor(const Report& report, MeterReading& result) {
  Reading& reading = result.reading;
  const bool spectral = IsSpectral(report);
  const Xyz& xyz = *report.xyz;
  if (xyz.X > 0.0 && xyz.Y > 0.0 && xyz.Z >= 0.0) {
    reading.xy = XyFromXyz(xyz);
    reading.color_source = spectral ? ColorSource::kSpectrometer : ColorSource::kColorimeter;
  }
  if (!report.cct_K) return;
  const bool white = *report.cct_K >= kLowestCctKelvin && *report.cct_K <= kHighestCctKelvin &&
                     (!report.duv || std::abs(*report.duv) <= kFarthestDuv);
  if (white) {
    reading.cct = Kelvin(*report.cct_K);
    reading.duv = report.duv;
  } else {
    result.warnings.push_back({"cct_out_of_range", reading.device,
                               "the light is no white that has a colour temperature; its "
                               "chromaticity xy is kept"});
  }
}

void AddSpectrum(const Report& report, MeterReading& result) {
  result.cri_Ra = report.cri_Ra;
  result.cri_R = report.cri_R;
  result.tlci_Qa = report.tlci_Qa;
  result.tm30_Rf = report.tm30_Rf;
  result.tm30_Rg = report.tm30_Rg;
  if (report.rendering_doubtful) {
    result.warnings.push_back({"rendering_doubtful", result.reading.device,
                               "the light is too far from white for its rendering indices"});
  }
  if (!report.spectrum) return;
  const auto integral = XyzFromSpectrum(*report.spectrum);
  const double lux = *report.illuminance_lx;
  if (!integral || std::abs(integral->Y - lux) > kSpectrumAgrees * lux) {
    const std::string found = integral ? RoundedText(integral->Y, 5) + " lx" : "no illuminance";
    result.warnings.push_back({"self_check", result.reading.device,
                               "spotread says " + RoundedText(lux, 5) +
                                   " lx but its spectrum integrates to " + found +
                                   "; measure again, and keep a tape ({meter.tape}) to report"});
  }
  result.spectrum = report.spectrum;
}

}  // namespace

MeterReading ReadingFromReport(const Report& report, const std::string& device) {
  MeterReading result;
  Reading& reading = result.reading;
  reading.device = device;
  if (!report.illuminance_lx) return result;
  reading.illuminance = Lux(*report.illuminance_lx);
  if (!report.xyz) {
    reading.quality = MeterQuality::kPhotometer;
    reading.sigma_relative = kSigmaOneChannel;
    return result;
  }
  const bool spectral = IsSpectral(report);
  reading.quality = spectral ? MeterQuality::kSpectral : MeterQuality::kColorimeter;
  reading.sigma_relative = spectral ? kSigmaSpectral : kSigmaColorimeter;
  AddColor(report, result);
  AddSpectrum(report, result);
  return result;
}

}  // namespace lightcal::devices::spotread
