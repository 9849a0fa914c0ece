// SPDX-License-Identifier: Apache-2.0
#include "session_names.h"

#include <algorithm>

namespace lightcal::app {

Result<std::string> LightMeant(const Session& session, const std::string& named) {
  if (named.empty() && session.lights.size() == 1) return session.lights.front().name;
  if (named.empty()) {
    return WrongUsage("--light", "say which lamp is meant" + DidYouMean("", session.lights));
  }
  if (auto known = CheckNames(session, named, ""); !known) return Propagate(std::move(known));
  return named;
}

Result<void> CheckNames(const Session& session, const std::string& light,
                        const std::string& meter) {
  if (FindLight(session, light) == nullptr) {
    return Refused("unknown_light", light,
                   "the session has no such light" + DidYouMean(light, session.lights));
  }
  const bool meter_known =
      meter.empty() || meter == kDataSheetMeter || FindMeter(session, meter) != nullptr;
  if (!meter_known) {
    const std::string instead = DidYouMean(meter, session.meters);
    return Refused(
        "unknown_meter", meter,
        "the session has no such meter" +
            (instead.empty() ? "; describe it in a [[meter]] of session.toml" : instead));
  }
  return {};
}

Result<void> CheckState(const Session& session, const Reading& reading) {
  if (reading.lamp == LampState::kOff) return {};
  const FixtureState reference = ReferenceState(session, reading.light);
  const bool read = std::ranges::any_of(session.readings, [&](const SessionReading& row) {
    const bool of_box = row.reading.meter == kDataSheetMeter && row.reading.state.empty();
    return row.reading.light == reading.light && row.reading.lamp == LampState::kOn && !of_box;
  });
  if (!read || (reference.empty() && reading.state.empty())) return {};
  if (reading.state.empty()) {
    return Refused("state_missing", reading.light,
                   "its other readings say what its controls stood at (" + StateText(reference) +
                       "); say it of this one, too");
  }
  if (reference.empty()) {
    return Refused("state_controls", reading.light,
                   "the session holds readings of it that do not say what its controls stood at; "
                   "give those a state in session.toml and readings.jsonl, or begin a session");
  }
  const bool same = std::ranges::equal(
      reference, reading.state, [](const ControlValue& one, const ControlValue& other) {
        return one.name == other.name && one.IsWord() == other.IsWord();
      });
  if (same) return {};
  return Refused("state_controls", reading.light,
                 "its other readings say " + StateText(reference) + ", this one " +
                     StateText(reading.state) + ": the same controls belong to every reading");
}

}  // namespace lightcal::app
