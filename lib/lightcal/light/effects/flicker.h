// SPDX-License-Identifier: Apache-2.0
// A lamp that pulses, and a reading that ends within a pulse.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lightcal/light/effects/effect.h"

namespace lightcal::effects {

// What mains leave of a lamp of unknown make: a ripple of one half, at twice 50 Hz.
inline constexpr double kRippleDefault = 0.5;
inline constexpr double kFlickerDefault_Hz = 100.0;
// A hand-held meter reads twice a second.
inline constexpr double kMeterWindow_s = 0.5;

// The largest relative error of a reading `window_s` long over all moments it may begin at:
//   pulses of duty D   min((1 - D)/(f t), max(1/D - 1, 1))
//   a ripple of m      min(m/(pi f t), m)
[[nodiscard]] inline double FlickerBound(const SceneTime& time, double window_s) {
  const double periods = time.flicker_hz.value_or(kFlickerDefault_Hz) * window_s;
  if (time.duty) {
    const double duty = *time.duty;
    return std::min((1.0 - duty) / periods, std::max(1.0 / duty - 1.0, 1.0));
  }
  const double ripple = time.ripple.value_or(kRippleDefault);
  return std::min(ripple / (std::numbers::pi * periods), ripple);
}

//   bound = FlickerBound over the meter's window or the picture's exposure.
[[nodiscard]] inline EffectFinding FindFlicker(const Scene& scene) {
  if (!scene.time.own_lamp) return NotApplicable("a data sheet's lamp does not flicker");
  if (scene.kind == LightKind::kDome) return NotApplicable("an environment does not flicker");
  if (scene.time.daylight) return NotApplicable("daylight does not flicker");
  double window = scene.time.window_s.value_or(kMeterWindow_s);
  if (scene.picture) {
    // What a shutter that rolls sees of it is an effect of its own.
    if (scene.picture->rows_s != 0.0) return NotApplicable("the pictures' rows roll over it");
    window = scene.picture->exposure_s.value_or(1.0 / 60.0);
  }
  const bool stated = scene.time.duty || scene.time.ripple;
  return {.bound = FlickerBound(scene.time, window),
          .treatment = Treatment::kWidens,
          .reason = stated ? "the stated flicker against the time of one reading"
                           : "no flicker stated; half the light rippling at 100 Hz is assumed",
          .own_lamp = true};
}

}  // namespace lightcal::effects
