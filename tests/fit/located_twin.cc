// SPDX-License-Identifier: Apache-2.0
#include "located_twin.h"

#include <cmath>
#include <numbers>

namespace lightcal::test {

namespace {
constexpr const char* kMeter = "m";
}

double TrueLux(const PlacedLamp& lamp, const Vec3& meter, const Vec3* normal) {
  constexpr int kEmitters = 400;
  const Vec3 to_lamp = lamp.position_m - meter;
  const Vec3 n =
      normal != nullptr ? *normal * (1.0 / Length(*normal)) : to_lamp * (1.0 / Length(to_lamp));
  double sum = 0.0;
  for (int i = 0; i < kEmitters; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / kEmitters;
    const double turn = std::numbers::pi * (3.0 - std::sqrt(5.0)) * i;
    const double r = std::sqrt(1.0 - z * z);
    const Vec3 outward{r * std::cos(turn), r * std::sin(turn), z};
    const Vec3 v = lamp.position_m + outward * lamp.radius_m - meter;
    const double d = Length(v);
    // Each patch of the ball's skin is Lambertian: 4 I cos/N towards the meter.
    const double leaving = -Dot(v, outward) / d;
    const double arriving = Dot(v, n) / d;
    if (leaving <= 0.0 || arriving <= 0.0) continue;
    sum += 4.0 * lamp.intensity_cd / kEmitters * leaving * arriving / (d * d) *
           std::exp(-lamp.extinction_per_m * d);
  }
  return sum;
}

LocatedTwin::LocatedTwin(const PlacedLamp& lamp, double sigma, std::uint64_t seed)
    : lamp_(lamp), sigma_(sigma), random_(seed) {
  session_.name = "located twin";
  session_.lights.emplace_back();
  session_.lights.back().name = "lamp";
  session_.lights.back().lamp_class = LampClass::kWhiteLed;
  session_.lights.back().in_time.minutes_on = 120.0;
  session_.surroundings = Surroundings::kDark;
  session_.meters.emplace_back();
  session_.meters.back().name = kMeter;
  session_.meters.back().calibration_relative = 0.0;
  session_.meters.back().cosine_f2 = 0.0;  // TrueLux is square to the normal
}

Reading& LocatedTwin::Add(double lux) {
  SessionReading row;
  row.reading.light = "lamp";
  row.reading.meter = kMeter;
  row.reading.illuminance = Lux(lux * std::exp(sigma_ * normal_(random_)));
  row.reading.sigma_relative = sigma_;
  session_.readings.push_back(row);
  return session_.readings.back().reading;
}

Reading& LocatedTwin::Flat(const Vec3& meter, const Vec3& normal, double times) {
  Reading& reading = Add(times * (TrueLux(lamp_, meter, &normal) + lamp_.ambient_lx));
  reading.position_m = meter;
  reading.normal = normal;
  return reading;
}

Reading& LocatedTwin::Facing(const Vec3& meter) {
  Reading& reading = Add(TrueLux(lamp_, meter, nullptr) + lamp_.ambient_lx);
  reading.position_m = meter;
  return reading;
}

Reading& LocatedTwin::Distance(const Vec3& meter) {
  Reading& reading = Add(TrueLux(lamp_, meter, nullptr) + lamp_.ambient_lx);
  reading.distance = Metres(Length(lamp_.position_m - meter));
  return reading;
}

Reading& LocatedTwin::Off() {
  Reading& reading = Add(lamp_.ambient_lx);
  reading.lamp = LampState::kOff;
  return reading;
}

std::vector<Vec3> SquareCorners(double side_m) {
  const double h = 0.5 * side_m;
  return {{-h, -h, 0}, {h, -h, 0}, {h, h, 0}, {-h, h, 0}};
}

}  // namespace lightcal::test
