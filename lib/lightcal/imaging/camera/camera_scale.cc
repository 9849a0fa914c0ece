// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/camera/camera_scale.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "lightcal/core/numbers_text.h"

namespace lightcal {
namespace {

constexpr double kOtherSetting = 0.02;
constexpr double kSameSetting = 0.06;  // relative: a sixth of a stop of aperture
constexpr double kMostSigma = 0.99;

// 95 % points of chi-square by the Wilson-Hilferty cube, 1 % off at one degree of freedom.
double ChiSquare95(double degrees) {
  constexpr double kZ = 1.6449;
  const double h = 2.0 / (9.0 * degrees);
  return degrees * std::pow(1.0 - h + kZ * std::sqrt(h), 3.0);
}

bool Near(double a, double b) { return std::abs(std::log(a / b)) < kSameSetting; }

// Whether no reading was taken at this setting; nobody knows = no.
bool IsOther(const CameraScale& scale, std::optional<double> wanted,
             std::optional<double> ScaleReading::*setting) {
  return wanted && std::ranges::none_of(scale.readings, [&](const ScaleReading& reading) {
           return !(reading.*setting) || Near(*(reading.*setting), *wanted);
         });
}

}  // namespace

Result<CameraScale> CombineScaleReadings(std::span<const WeighedScaleReading> readings,
                                         Warnings& warnings) {
  if (readings.empty()) return Refused("no_readings", "scale", "no reading of luminance was given");
  double sum = 0.0, mean = 0.0, own = 0.0;
  std::map<std::string, double> shared;  // by meter
  const auto weight = [](const WeighedScaleReading& r) {
    return 1.0 / (r.meter_sd * r.meter_sd + r.own_sd * r.own_sd);
  };
  for (const WeighedScaleReading& r : readings) {
    const double w = weight(r);
    sum += w;
    mean += w * std::log(r.reading.full_scale_constant);
    own += w * w * r.own_sd * r.own_sd;
    shared[r.meter] += w * r.meter_sd;
  }
  mean /= sum;
  double variance = own;
  for (const auto& [meter, part] : shared) variance += part * part;
  variance /= sum * sum;

  // What one meter reads wrong, it reads wrong everywhere: only the rest shows between its
  // readings.
  const bool one_meter = shared.size() == 1;
  double chi2 = 0.0;
  for (const WeighedScaleReading& r : readings) {
    const double expected = r.own_sd * r.own_sd + (one_meter ? 0.0 : r.meter_sd * r.meter_sd);
    const double off = std::log(r.reading.full_scale_constant) - mean;
    chi2 += off * off / expected;
  }
  const auto degrees = static_cast<double>(readings.size() - 1);
  CameraScale scale;
  double sd = std::sqrt(variance);
  if (degrees > 0.0 && chi2 > ChiSquare95(degrees)) {
    sd *= std::sqrt(chi2 / degrees);
    const auto worst = std::ranges::max_element(readings, {}, [&](const WeighedScaleReading& r) {
      return std::abs(std::log(r.reading.full_scale_constant) - mean);
    });
    const double off = worst->reading.full_scale_constant / std::exp(mean) - 1.0;
    warnings.push_back({"scale_readings_disagree", worst->reading.frames,
                        "is " + PercentText(std::abs(off)) +
                            " from the mean of all readings of the scale, more than their "
                            "uncertainties allow; the interval is widened. Read one again"});
  }
  scale.full_scale_constant = std::exp(mean);
  scale.sigma_relative = std::min(kMostSigma, sd);
  for (const WeighedScaleReading& r : readings) {
    scale.readings.push_back(r.reading);
    scale.readings.back().sigma_relative = std::min(kMostSigma, std::hypot(r.meter_sd, r.own_sd));
  }
  return scale;
}

double ScaleSigmaAt(const CameraScale& scale, std::optional<double> f_number,
                    std::optional<double> iso) {
  if (scale.readings.empty()) return scale.sigma_relative;
  const double aperture = IsOther(scale, f_number, &ScaleReading::f_number) ? kOtherSetting : 0.0;
  const double speed = IsOther(scale, iso, &ScaleReading::iso) ? kOtherSetting : 0.0;
  return std::min(kMostSigma, std::hypot(scale.sigma_relative, aperture, speed));
}

}  // namespace lightcal
