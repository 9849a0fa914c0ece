// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/konica/reading.h"

#include <algorithm>

#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/meters/display.h"
#include "lightcal_devices/transport/framing.h"

namespace lightcal::devices::konica {
namespace {

// Below zero, the remainder of a zero adjustment, counts as nothing.
DisplayedIlluminance Displayed(const Number& number) {
  return {std::max(number.n, 0), number.decimals, false};
}

Result<MeterReading> IlluminanceFrom(const LongReply& ev, double highest_lx,
                                     const std::string& device) {
  const DisplayLimits limits = {kSigmaRelative, highest_lx};
  if (ev.status.condition == Condition::kOverRange) {
    return OverRangeReading(highest_lx, limits, device);
  }
  if (!ev.data[0]) {
    return Failed(std::string(kBadReply), device, "the meter gave no illuminance; try again");
  }
  return ReadingFromDisplay(Displayed(*ev.data[0]), limits, device);
}

void AddTemperature(const LongReply& temperature, MeterReading& result) {
  Reading& reading = result.reading;
  const auto& [ev, cct, duv] = temperature.data;
  if (temperature.status.condition == Condition::kCctOutOfRange || !cct || !duv || cct->n <= 0) {
    result.warnings.push_back({"cct_out_of_range", reading.device,
                               "the light is no white the meter has a colour temperature for; its "
                               "chromaticity xy is kept"});
    return;
  }
  reading.cct = Kelvin(cct->Value());
  reading.duv = duv->Value();
}

}  // namespace

Result<MeterReading> ReadingFromT10a(const LongReply& ev, const std::string& device) {
  return IlluminanceFrom(ev, kT10aHighestLx, device);
}

Result<MeterReading> ReadingFromCl200a(const LongReply& chromaticity, const LongReply& temperature,
                                       const std::string& device) {
  auto result = IlluminanceFrom(chromaticity, kCl200aHighestLx, device);
  if (!result) return result;
  Reading& reading = result->reading;
  reading.quality = MeterQuality::kColorimeter;
  if (reading.over_range) return result;
  const auto& [ev, x, y] = chromaticity.data;
  const auto& again = temperature.data[0];
  if (again && again->Value() != ev->Value()) {
    result->warnings.push_back(
        {"self_check", device,
         "two questions about one measurement gave " + RoundedText(ev->Value(), 4) + " and " +
             RoundedText(again->Value(), 4) + " lx; the meter is not held, measure again"});
  }
  if (chromaticity.status.condition == Condition::kLowLuminance || !x || !y || x->n <= 0 ||
      y->n <= 0) {
    result->warnings.push_back(
        {"low_light_color", device, "too dark for the meter to tell a colour; move closer"});
    return result;
  }
  reading.xy = Xy{x->Value(), y->Value()};
  reading.color_source = ColorSource::kColorimeter;
  AddTemperature(temperature, *result);
  return result;
}

}  // namespace lightcal::devices::konica
