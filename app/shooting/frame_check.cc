// SPDX-License-Identifier: Apache-2.0
#include "shooting/frame_check.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/captures/bracket.h"
#include "shooting/camera_setup.h"

namespace lightcal::app {
namespace {

constexpr double kTimeStops = 1.0 / 6.0;

std::string TimeText(double seconds) {
  if (seconds >= 0.3) return RoundedText(seconds, 3) + " s";
  return "1/" + ShortestText(std::round(1.0 / seconds)) + " s";
}

void Compare(const std::string& file, const std::string& what, std::optional<double> asked,
             std::optional<double> said, double near, Warnings& warnings) {
  if (!asked || !said || std::abs(*said / *asked - 1.0) <= near) return;
  warnings.push_back({"exposure_conflict", file,
                      what + " " + RoundedText(*asked, 3) + " was asked, the file says " +
                          RoundedText(*said, 3) + "; the file is believed"});
}

}  // namespace

Result<Warnings> CheckFrame(const std::string& path, const TetheredShoot& shoot, ShotFrame& frame) {
  auto info = devices::ReadFrameInfo(path);
  if (!info) return Propagate(std::move(info));
  Warnings warnings = info->warnings;
  frame.exposure = info->exposure.time;
  frame.f_number = info->exposure.f_number;
  frame.iso = info->exposure.iso;
  if (!frame.exposure) {
    warnings.push_back(
        {"no_exposure_time", frame.file,
         "the file does not say how long it was exposed; " + frame.shutter + " was asked"});
    return warnings;
  }
  const double asked = frame.planned_s, said = frame.exposure->value();
  const double allowed = std::max(asked * (std::exp2(kTimeStops) - 1.0), 2.0 * frame.rounding_s);
  if (std::abs(said - asked) > allowed) {
    warnings.push_back({"exposure_conflict", frame.file,
                        TimeText(asked) + " was asked (" + frame.shutter + "), the file says " +
                            TimeText(said) + "; the file is believed. Is the camera's dial at M?"});
  }
  Compare(frame.file, "f-number", shoot.f_number, frame.f_number, kNearFNumber, warnings);
  Compare(frame.file, "ISO", shoot.iso, frame.iso, kNearIso, warnings);
  return warnings;
}

}  // namespace lightcal::app
