// SPDX-License-Identifier: Apache-2.0
// Camera exposure. Symbols: N relative aperture f/D, t exposure time [s], S ISO speed, q lens and
// sensor constant, L scene luminance [cd/m^2], H exposure of the sensor [lx s].
#pragma once

#include "lightcal/core/units.h"

namespace lightcal {

struct CameraSettings {
  double f_number =
      1.0;  // N = focal length / diameter of the entrance pupil: larger N, smaller hole
  Seconds shutter{1.0};  // the time, not the speed
  double iso = 100.0;
};

// Whether a camera can be set so: all three finite and above 0.
[[nodiscard]] bool IsPossible(const CameraSettings& camera);

// N = f/D and back.   Source: ISO 517. The larger N, the smaller the hole.
[[nodiscard]] constexpr double FNumber(Metres focal_length, Metres pupil_diameter) {
  return focal_length / pupil_diameter;
}
[[nodiscard]] constexpr Metres PupilDiameter(Metres focal_length, double f_number) {
  return focal_length / f_number;
}

// Exposure time of a rotary shutter: t = angle/360 deg / frames per second.
[[nodiscard]] Seconds ShutterFromAngle(Radians angle, double frames_per_second);

// APEX (ANSI PH2.5-1960): AV = log2 N^2 (f/1 0, f/1.4 1, f/2 2, f/2.8 3), TV = log2(1 s / t),
// EV = AV + TV = log2(N^2/t). One more EV is half the light on the sensor.
[[nodiscard]] double ApertureValue(double f_number);
[[nodiscard]] double TimeValue(Seconds shutter);
[[nodiscard]] double Ev(const CameraSettings& camera);
// EV of the settings that expose the same at ISO 100: EV100 = EV - log2(S/100).
[[nodiscard]] double Ev100(const CameraSettings& camera);
// EV100 a reflected-light meter (K = 12.5) or an incident-light meter (C = 250) asks for:
//   2^EV100 = L 100/K      2^EV100 = E 100/C.     Source: ISO 2720:1974. Holds for L, E > 0.
[[nodiscard]] double Ev100FromLuminance(Nits l);
[[nodiscard]] double Ev100FromIlluminance(Lux e);

// The lens between the scene and the sensor:  q = (pi/4) T v cos^4(theta).   Source: ISO
// 12232:2006, annex A. T transmittance, v vignetting factor, theta angle off the axis.
struct LensTransmission {
  double transmittance = 0.9;
  double vignetting = 0.98;
  Radians field_angle = RadiansFromDegrees(10.0);
};
[[nodiscard]] double LensConstant(const LensTransmission& lens);
// ISO 12232:2006's rounded value of the above (0.6516).
inline constexpr double kIsoLensConstant = 0.65;

// H = q t L / N^2  [lx s].   Source: ISO 12232:2006, annex A.
struct LuxSeconds {
  double value = 0.0;
};
[[nodiscard]] LuxSeconds SensorExposure(Nits l, const CameraSettings& camera,
                                        double q = kIsoLensConstant);
// The exposure that just saturates a sensor of speed S: H = 78/S.   ISO 12232:2006, 6.2 (saturation
// based speed).
[[nodiscard]] LuxSeconds SaturatingExposure(double iso);
// The luminance that just saturates, and the factor that maps it to 1:
//   L_max = 78/(q S) N^2/t        exposure = 1/L_max
// With S = 100 and q = 0.65 this is 1.2 2^EV100. Infinite where no light reaches the sensor.
// Source: ISO 12232:2006, 6.2; Lagarde & de Rousiers 2014, 5.1.
[[nodiscard]] Nits MaximumLuminance(const CameraSettings& camera, double q = kIsoLensConstant);
[[nodiscard]] double ExposureScale(const CameraSettings& camera, double q = kIsoLensConstant);

}  // namespace lightcal
