// SPDX-License-Identifier: Apache-2.0
// capture.json: what a tethered camera was asked for and gave, one file beside its frames. It is
// written anew after every frame, so that a shoot that was broken off can be continued.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/core/units.h"
#include "lightcal/records/capture.h"

namespace lightcal {

inline constexpr std::string_view kTetheredShootFile = "capture.json";

// A setting of the camera, in the camera's words.
struct NamedSetting {
  std::string name;
  std::string value;
};

struct ShotFrame {
  std::string shutter;      // the camera's word for it: "1/60"
  double planned_s = 0.0;   // the true time that word stands for
  double rounding_s = 0.0;  // half of the word's last digit
  std::string file;         // in the folder of the record; "" = not taken yet
  // As the file's own tags say it.
  std::optional<Seconds> exposure;
  std::optional<double> f_number, iso;
};

struct TetheredShoot {
  bool complete = false;
  std::string light;
  std::string device;                   // "gphoto2:usb:001,004"
  std::string camera;                   // its model
  std::string time;                     // of the beginning, ISO 8601
  std::string shutter_setting;          // name of the setting the frames differ in
  int pictures = 1;                     // files that one exposure makes
  bool delete_from_card = false;        // each frame, once it is here
  std::optional<double> f_number, iso;  // what the frames were asked to have
  std::vector<NamedSetting> settings;   // of all frames, in the order they were set
  std::vector<NamedSetting> restore;    // what the camera had before and has not got back yet
  std::vector<ShotFrame> frames;        // shortest first
  // What the session makes of the frames; absent: nobody said yet.
  std::optional<CaptureDescription> capture;
};

// "schema": "lightcal.capture/1", indented; the keys of "capture" are those of a [[capture]].
[[nodiscard]] std::string TetheredShootToJson(const TetheredShoot& shoot);

// Refused: bad_capture, unknown_key; the subject is `where`.
[[nodiscard]] Result<TetheredShoot> TetheredShootFromJson(std::string_view text,
                                                          std::string_view where);

}  // namespace lightcal
