// SPDX-License-Identifier: Apache-2.0
#include "lightcal/photometry/exposure.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace lightcal {
namespace {

constexpr double kSaturationLuxSeconds = 78.0;  // at ISO 1
constexpr double kReflectedMeterConstant = 12.5;
constexpr double kIncidentMeterConstant = 250.0;

}  // namespace

bool IsPossible(const CameraSettings& camera) {
  const auto positive = [](double v) { return std::isfinite(v) && v > 0.0; };
  return positive(camera.f_number) && positive(camera.shutter.value()) && positive(camera.iso);
}

Seconds ShutterFromAngle(Radians angle, double frames_per_second) {
  return Seconds(angle.value() / (2.0 * std::numbers::pi) / frames_per_second);
}

double ApertureValue(double f_number) { return 2.0 * std::log2(f_number); }
double TimeValue(Seconds shutter) { return -std::log2(shutter.value()); }
double Ev(const CameraSettings& camera) {
  return ApertureValue(camera.f_number) + TimeValue(camera.shutter);
}
double Ev100(const CameraSettings& camera) { return Ev(camera) - std::log2(camera.iso / 100.0); }

double Ev100FromLuminance(Nits l) { return std::log2(l.value() * 100.0 / kReflectedMeterConstant); }
double Ev100FromIlluminance(Lux e) { return std::log2(e.value() * 100.0 / kIncidentMeterConstant); }

double LensConstant(const LensTransmission& lens) {
  const double c = std::cos(lens.field_angle.value());
  return std::numbers::pi / 4.0 * lens.transmittance * lens.vignetting * c * c * c * c;
}

LuxSeconds SensorExposure(Nits l, const CameraSettings& camera, double q) {
  return {q * camera.shutter.value() * l.value() / (camera.f_number * camera.f_number)};
}

LuxSeconds SaturatingExposure(double iso) { return {kSaturationLuxSeconds / iso}; }

Nits MaximumLuminance(const CameraSettings& camera, double q) {
  const double per_nit = SensorExposure(Nits(1.0), camera, q).value;
  if (!(per_nit > 0.0)) return Nits(std::numeric_limits<double>::infinity());
  return Nits(SaturatingExposure(camera.iso).value / per_nit);
}

double ExposureScale(const CameraSettings& camera, double q) {
  return 1.0 / MaximumLuminance(camera, q).value();
}

}  // namespace lightcal
