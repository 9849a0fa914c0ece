// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/session.h"

#include <algorithm>

namespace lightcal {

double SigmaRelative(const Session& session, const Reading& reading) {
  if (reading.sigma_relative) return *reading.sigma_relative;
  const auto meter = std::ranges::find(session.meters, reading.meter, &MeterDescription::name);
  if (meter != session.meters.end()) return meter->sigma_relative;
  return reading.meter == kDataSheetMeter ? kSigmaDataSheet : kSigmaUnnamedMeter;
}

const LightDescription* FindLight(const Session& session, std::string_view name) {
  const auto found = std::ranges::find(session.lights, name, &LightDescription::name);
  return found == session.lights.end() ? nullptr : &*found;
}

}  // namespace lightcal
