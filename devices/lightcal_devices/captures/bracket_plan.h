// SPDX-License-Identifier: Apache-2.0
// A bracket out of the choices a camera offers. Pure.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/core/units.h"
#include "lightcal/photometry/lamp_flicker.h"

namespace lightcal::devices {

// An exposure time as a camera's menu words it.
struct ShutterTime {
  Seconds time{1.0};      // true: 2^-6 s for "1/60"
  Seconds rounding{0.0};  // half of the label's last digit: 0.05 ms for "0.0001s"
};

// "1/60" "0.0166s" "0,5" "2s" "13/10"; absent for Bulb, Auto, and what is no time (1e-5 s to an
// hour). A label on the dials' grid stands for its true time (TimeOfLabel); one rounded to few
// digits for the only third stop within its rounding; any other for what it says.
[[nodiscard]] std::optional<ShutterTime> TimeOfChoice(std::string_view label);
// "f/5.6" "5.6" -> 5.6; "ISO 100" "100" -> 100. Absent: Auto, ...
[[nodiscard]] std::optional<double> FNumberOfChoice(std::string_view label);
[[nodiscard]] std::optional<double> IsoOfChoice(std::string_view label);

// The one that makes RAW alone ("RAW", "NEF (Raw)"), else the first that makes RAW besides JPEG,
// uncompressed and full-size before others; absent: none does.
[[nodiscard]] std::optional<std::string> RawFormat(const std::vector<std::string>& choices);

struct BracketRange {
  double half_range_ev = 0.0;
  double step_ev = 0.0;
  std::vector<LampFlicker> lamps;  // those in the picture that flicker
};

// "±4EV/1EV" "+-4EV/1EV" "4EV/1EV" "4/1": half the range and the step; at most 61 frames, steps of
// a third of a stop and more.   Wrong usage: anything else.
[[nodiscard]] Result<BracketRange> ParseBracket(std::string_view text);

struct PlannedFrame {
  std::string shutter;  // the camera's word
  ShutterTime time;
  double ev = 0.0;       // log2(time / centre): above 0 is brighter
  double flicker = 0.0;  // the worst WorstFlickerError of the lamps
};

struct BracketPlan {
  std::vector<PlannedFrame> frames;  // shortest first
  // bracket_clipped (the camera has no shutter for some steps), flicker_unsafe_shutter
  Warnings warnings;
};

// A flicker-safe exposure errs by no more than shutters themselves repeat to.
inline constexpr double kFlickerSafe = 0.03;

// One frame a step of the range: the choice nearest to it, or, where a lamp flickers, the nearest
// that is flicker-safe within a third of a step. No choice is used twice.
// Refused: no_bracket (fewer than two frames come out).
[[nodiscard]] Result<BracketPlan> PlanBracket(const std::vector<std::string>& choices,
                                              Seconds centre, const BracketRange& range);

}  // namespace lightcal::devices
