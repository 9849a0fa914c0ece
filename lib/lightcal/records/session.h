// SPDX-License-Identifier: Apache-2.0
// A calibration session: lamps, meters, the room, and the readings in the order they count.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/units.h"
#include "lightcal/core/vec3.h"
#include "lightcal/light/intensity_table.h"
#include "lightcal/photometry/light_kind.h"
#include "lightcal/records/camera_frames.h"
#include "lightcal/records/capture.h"
#include "lightcal/records/reading.h"

namespace lightcal {

struct Room {
  Vec3 size_m{};
  double reflectance = 0.5;
};

// What the person says of a lamp; everything absent is fitted, defaulted or a prior, and marked so.
struct LightDescription {
  std::string name;
  LightKind kind = LightKind::kPoint;
  std::optional<Vec3> position_m;
  std::optional<Vec3> aim;               // unit length after loading
  std::optional<Vec3> axis;              // of a tube's length or a rect's width, unit length
  std::optional<Metres> diameter;        // sphere, disk
  std::optional<Metres> width, height;   // rect
  std::optional<Metres> length, radius;  // tube
  std::optional<Radians> inner, outer;   // half angles of the cone
  std::optional<Watts> electrical;       // data sheet
  std::optional<Lumens> flux;            // data sheet
  std::optional<Radians> beam, field;    // data sheet: full angles at 50 % and 10 % of the peak
  std::string distribution_file{};       // photometric: an IES or EULUMDAT file, "" = none named
  // What that file holds, type C about the aim; whoever loads the session fills it.
  std::optional<IntensityTable> distribution{};
};

// 1 sigma of one reading, relative.
inline constexpr double kSigmaUnnamedMeter = 0.05;
inline constexpr double kSigmaDataSheet = 0.02;
// The reserved meter name for figures a manufacturer prints.
inline constexpr const char* kDataSheetMeter = "data_sheet";

struct MeterDescription {
  std::string name;
  double sigma_relative = kSigmaUnnamedMeter;
  std::optional<double> cosine_f2;
  std::optional<double> spectral_f1;
  std::optional<Metres> head_radius;
};

// A reading with the place it was written, for messages and for `rejected`.
struct SessionReading {
  Reading reading;
  std::string where;  // "session.toml [[reading]] 3", "readings.jsonl:7"
};

struct Session {
  std::string name;
  std::string directory;  // base of relative paths
  std::string stem;       // the directory's name (or the .toml's stem)
  std::optional<Room> room;
  std::vector<LightDescription> lights;
  std::vector<MeterDescription> meters;
  std::vector<SessionReading> readings;  // session.toml's first, then the journal's
  std::vector<CaptureDescription> captures;
  CameraDescription camera;
  std::vector<CameraFramesDescription> camera_frames;
  std::vector<std::string> input_files;  // what was read, for provenance, in reading order
};

// The sigma a reading carries: its own, its meter's, the data sheet's, or the unnamed meter's.
[[nodiscard]] double SigmaRelative(const Session& session, const Reading& reading);
[[nodiscard]] const LightDescription* FindLight(const Session& session, std::string_view name);

}  // namespace lightcal
