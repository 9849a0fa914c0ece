// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/shutter_check.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "lightcal/core/numbers_text.h"
#include "lightcal/photometry/exposure_grid.h"

namespace lightcal {
namespace {

constexpr double kTolerance = 0.03;
// A frame that may miss the lamp errs by 1; rounding must not save it.
constexpr double kHopeless = 1.0 - 1e-9;
constexpr Seconds kShortestOffered{1.0 / 8192.0};
constexpr std::size_t kMostOffered = 8;

// As dials print it: 1/40, 0.5.
std::string LabelText(Seconds label) {
  const double s = label.value();
  const auto thousandths = [](double v) { return ShortestText(std::round(1e3 * v) / 1e3); };
  return s < 0.3 ? "1/" + thousandths(1.0 / s) : thousandths(s);
}

// The smallest error a frame can have, as nobody knows which mains there is.
double ErrorOf(Seconds time, const LampsOnSet& lamps) {
  double error = lamps.mains.empty() ? 0.0 : 1e9;
  for (const LampFlicker& lamp : lamps.mains) {
    error = std::min(error, WorstFlickerError(lamp, time));
  }
  return lamps.pwm ? std::max(error, WorstFlickerError(*lamps.pwm, time)) : error;
}

std::string SafeText(const LampFlicker& lamp) {
  std::string text = " at " + ShortestText(lamp.frequency_hz) + " Hz:";
  const auto safe = FlickerSafeLabels(lamp, kTolerance, kShortestOffered);
  for (std::size_t i = 0; i < std::min(safe.size(), kMostOffered); ++i) {
    text += " " + LabelText(safe[i]);
  }
  return text;
}

std::string SafeShutters(const LampsOnSet& lamps) {
  std::string text;
  for (const LampFlicker& lamp : lamps.mains) text += (text.empty() ? "" : ";") + SafeText(lamp);
  if (lamps.pwm) text += (text.empty() ? "" : ";") + SafeText(*lamps.pwm);
  return text;
}

}  // namespace

Warnings CheckShutters(std::span<const FrameInfo> frames, const LampsOnSet& lamps) {
  const FrameInfo* worst = nullptr;
  double worst_error = kTolerance;
  std::size_t unsafe = 0;
  for (const FrameInfo& frame : frames) {
    if (!frame.exposure.time) continue;
    const double error = ErrorOf(*frame.exposure.time, lamps);
    if (error > kTolerance) ++unsafe;
    if (error > worst_error) {
      worst_error = error;
      worst = &frame;
    }
  }
  if (worst == nullptr) return {};
  return {{"flicker_unsafe_shutter", worst->file,
           std::to_string(unsafe) + " of " + std::to_string(frames.size()) +
               " frames are no whole number of periods of a flickering lamp; it may read up to " +
               RoundedText(100.0 * worst_error, 2) + " % wrong at " +
               LabelText(LabelOfTime(*worst->exposure.time).value_or(*worst->exposure.time)) +
               " s. Safe" + SafeShutters(lamps) +
               " s, with an ND filter against too much light; {shutter.mains} none where nothing "
               "flickers "
               "(daylight, DC)"}};
}

Result<void> RefuseHopelessShutter(std::span<const FrameInfo> frames, const LampsOnSet& lamps) {
  if (frames.size() != 1 || !lamps.pwm || !frames.front().exposure.time) return {};
  const FrameInfo& frame = frames.front();
  const double error = WorstFlickerError(*lamps.pwm, *frame.exposure.time);
  if (!(error > kHopeless)) return {};
  return Refused("flicker_unsafe_shutter", frame.file,
                 "a single frame of a lamp that pulses like this may read up to " +
                     RoundedText(100.0 * error, 2) + " % wrong. Safe" + SafeText(*lamps.pwm) +
                     " s");
}

}  // namespace lightcal
