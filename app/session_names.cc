// SPDX-License-Identifier: Apache-2.0
#include "session_names.h"

#include <algorithm>

namespace lightcal::app {

Result<void> CheckNames(const Session& session, const std::string& light,
                        const std::string& meter) {
  if (FindLight(session, light) == nullptr) {
    return Refused("unknown_light", light,
                   "the session has no such light" + DidYouMean(light, session.lights));
  }
  const bool meter_known =
      meter.empty() || meter == kDataSheetMeter ||
      std::ranges::find(session.meters, meter, &MeterDescription::name) != session.meters.end();
  if (!meter_known) {
    const std::string instead = DidYouMean(meter, session.meters);
    return Refused(
        "unknown_meter", meter,
        "the session has no such meter" +
            (instead.empty() ? "; describe it in a [[meter]] of session.toml" : instead));
  }
  return {};
}

}  // namespace lightcal::app
