// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/plan/one_light.h"

#include <algorithm>

#include "lightcal/records/display_step.h"

namespace lightcal::fit {
namespace {

// Of illuminance alone: what is planned is no colour.
SessionReading Colorless(SessionReading row) {
  row.reading.cct.reset();
  row.reading.duv.reset();
  row.reading.xy.reset();
  row.reading.spectrum_file.clear();
  return row;
}

}  // namespace

Result<Session> AloneIn(const Session& session, const std::string& light) {
  const LightDescription* const found = FindLight(session, light);
  if (found == nullptr) return Refused("unknown_light", light, "the session has no such light");
  Session alone;
  alone.room = session.room;
  alone.surroundings = session.surroundings;
  alone.haze_per_metre = session.haze_per_metre;
  alone.meters = session.meters;
  alone.display_steps = DisplaySteps(session);
  alone.lights = {*found};
  for (const SessionReading& row : session.readings) {
    if (row.reading.light == light) alone.readings.push_back(Colorless(row));
  }
  return alone;
}

Reading LikeTheLast(const Session& session) {
  Reading like;
  like.light = session.lights.front().name;
  if (!session.meters.empty()) like.meter = session.meters.front().name;
  for (const SessionReading& row : session.readings) {
    const Reading& reading = row.reading;
    const bool by_meter =
        reading.meter != kDataSheetMeter && reading.quality != MeterQuality::kDerived;
    if (!reading.illuminance || !by_meter) continue;
    like.meter = reading.meter;
    like.device = reading.device;
    like.sigma_relative = reading.sigma_relative;
  }
  return like;
}

double LastDigit(double display_step_lx) {
  constexpr double kOfMost_lx = 0.1;
  return display_step_lx > 0.0 ? std::min(display_step_lx, kOfMost_lx) : kOfMost_lx;
}

double CoarseStep(const Session& session, double step) {
  const bool counts = std::ranges::any_of(session.readings, [&](const SessionReading& row) {
    return IsLit(row.reading) && row.reading.illuminance->value() < kStepsEnough * step;
  });
  return counts ? step : 0.0;
}

}  // namespace lightcal::fit
