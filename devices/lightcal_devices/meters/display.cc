// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/display.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lightcal/core/units_text.h"

namespace lightcal::devices {
namespace {

constexpr double kLargestSigma = 0.99;
constexpr double kSqrt12 = 2.0 * std::numbers::sqrt3;

MeterReading PhotometerReading(double illuminance_lx, const std::string& device) {
  MeterReading result;
  result.reading.device = device;
  result.reading.quality = MeterQuality::kPhotometer;
  result.reading.illuminance = Lux(illuminance_lx);
  return result;
}

}  // namespace

double LuxFromDisplay(const DisplayedIlluminance& displayed) {
  const double counts = displayed.counts;
  const double scale = std::pow(10.0, std::abs(displayed.decimals));
  const double value = displayed.decimals > 0 ? counts / scale : counts * scale;
  return displayed.footcandles ? value * kLuxPerFootcandle : value;
}

double SigmaOfDisplay(const DisplayedIlluminance& displayed, double instrument_sigma_relative) {
  if (displayed.counts <= 0) return kLargestSigma;
  const double digit = 1.0 / (kSqrt12 * displayed.counts);
  return std::min(std::hypot(instrument_sigma_relative, digit), kLargestSigma);
}

MeterReading ReadingFromDisplay(const DisplayedIlluminance& displayed, const DisplayLimits& limits,
                                const std::string& device) {
  const double lux = LuxFromDisplay(displayed);
  if (lux > limits.highest_lx) return OverRangeReading(limits.highest_lx, limits, device);
  if (displayed.counts == 0) {
    DisplayedIlluminance one_digit = displayed;
    one_digit.counts = 1;
    MeterReading dark = PhotometerReading(LuxFromDisplay(one_digit), device);
    dark.reading.under_range = true;
    dark.reading.sigma_relative = limits.sigma_relative;
    return dark;
  }
  MeterReading result = PhotometerReading(lux, device);
  result.reading.sigma_relative = SigmaOfDisplay(displayed, limits.sigma_relative);
  return result;
}

MeterReading OverRangeReading(double limit_lx, const DisplayLimits& limits,
                              const std::string& device) {
  MeterReading result = PhotometerReading(limit_lx, device);
  result.reading.over_range = true;
  result.reading.sigma_relative = limits.sigma_relative;
  return result;
}

Warning BatteryLow(const std::string& device) {
  return {"battery_low", device, "the meter's battery is low; change it before it reads wrongly"};
}

tl::unexpected<Error> NegativeReading(const std::string& device) {
  return Failed("negative_reading", device,
                "the meter shows less than no light; set its zero with the cap on, then try again");
}

tl::unexpected<Error> FrozenDisplay(std::string_view what, const std::string& device) {
  return Failed("hold", device,
                "the meter shows " + std::string(what) +
                    ", not what it measures now; press that button until it is gone");
}

}  // namespace lightcal::devices
