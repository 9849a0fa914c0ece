// SPDX-License-Identifier: Apache-2.0
#include "lamp_twin.h"

#include <algorithm>
#include <cmath>

namespace lightcal::test {

double TrueDirect(const LampTruth& truth, double distance_m) {
  const double path = distance_m + truth.offset_m;
  return truth.intensity_cd * std::exp(-truth.extinction_per_m * distance_m) / (path * path);
}

TwinSession::TwinSession(const LampTruth& truth, double sigma, std::uint64_t seed)
    : truth_(truth), sigma_(sigma), random_(seed) {
  session_.name = "twin";
  session_.lights.emplace_back();
  session_.lights.back().name = "lamp";
  session_.lights.back().lamp_class = LampClass::kWhiteLed;
  session_.lights.back().in_time.minutes_on = 120.0;
  session_.lights.back().distance_sigma = Metres(0.0);  // its meters stand where they say
  session_.surroundings = Surroundings::kDark;          // a twin shines in the open
}

Reading& TwinSession::Add(double illuminance_lx) {
  SessionReading row;
  row.reading.light = "lamp";
  row.reading.illuminance = Lux(illuminance_lx * std::exp(sigma_ * normal_(random_)));
  // No reading is sure: what the fit takes the surest to be.
  row.reading.sigma_relative = std::max(sigma_, 1e-4);
  session_.readings.push_back(row);
  return session_.readings.back().reading;
}

TwinSession& TwinSession::On(double distance_m, double times) {
  Reading& reading =
      Add(times * (TrueDirect(truth_, distance_m) + truth_.bounce_lx + truth_.ambient_lx));
  reading.distance = Metres(distance_m);
  return *this;
}

TwinSession& TwinSession::On(const std::vector<double>& distances_m) {
  for (const double d : distances_m) On(d);
  return *this;
}

TwinSession& TwinSession::Off() {
  Add(truth_.ambient_lx).lamp = LampState::kOff;
  return *this;
}

TwinSession& TwinSession::ShadowCard(double distance_m) {
  Reading& reading = Add(truth_.bounce_lx + truth_.ambient_lx);
  reading.distance = Metres(distance_m);
  reading.shadow_card = true;
  return *this;
}

Session TypedSession(const std::vector<TypedReading>& readings, double sigma) {
  Session session;
  session.lights.emplace_back();
  session.lights.back().name = "lamp";
  session.lights.back().fixture = Fixture::kBulb;
  session.lights.back().lamp_class = LampClass::kWhiteLed;
  session.lights.back().in_time.minutes_on = 120.0;
  session.surroundings = Surroundings::kDark;
  for (const TypedReading& typed : readings) {
    SessionReading row;
    row.reading.light = "lamp";
    row.reading.distance = Metres(typed.distance_m);
    row.reading.illuminance = Lux(typed.illuminance_lx);
    row.reading.sigma_relative = sigma;
    session.readings.push_back(row);
  }
  return session;
}

}  // namespace lightcal::test
