// SPDX-License-Identifier: Apache-2.0
// What a program outside lightcal does with its library: one reading in, candela out.
#include <cstdio>

#include "lightcal/fit/fit_light.h"

int main() {
  lightcal::Session session;
  session.surroundings = lightcal::Surroundings::kDark;
  session.lights.push_back({.name = "key", .fixture = lightcal::Fixture::kBulb});
  lightcal::Reading reading;
  reading.light = "key";
  reading.distance = lightcal::Metres(0.5);
  reading.illuminance = lightcal::Lux(192.0);
  session.readings.push_back({reading, "typed"});
  const auto fitted = lightcal::FitSession(session, {});
  if (!fitted) {
    std::puts(fitted.error().message.c_str());
    return 1;
  }
  std::printf("%.0f cd\n", fitted->lights.lights.front().intensity_cd->value);
}
