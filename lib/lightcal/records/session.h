// SPDX-License-Identifier: Apache-2.0
// A calibration session: lamps, meters, the room, and the readings in the order they count.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/core/units.h"
#include "lightcal/core/vec3.h"
#include "lightcal/light/fixture.h"
#include "lightcal/light/intensity_table.h"
#include "lightcal/photometry/light_kind.h"
#include "lightcal/records/camera_frames.h"
#include "lightcal/records/capture.h"
#include "lightcal/records/reading.h"

namespace lightcal {

struct Room {
  Vec3 size_m{};
  double reflectance = 0.5;
  std::optional<double> reflectance_u95{};  // of it, absolute; absent: a fifth of it
};

// What surrounds lamp and meter.
enum class Surroundings : std::uint8_t {
  kIndoors,   // walls send the lamp's light back; `room` says which, where it is known
  kOutdoors,  // no walls but the ground
  kDark,      // walls draped in black, and nothing else shines
};

// How a lamp behaves in time; what is absent keeps its usual size in the interval.
struct LampInTime {
  std::optional<double> minutes_on{};     // before the first reading
  std::optional<double> flicker_hz{};     // twice the mains frequency, or the dimmer's
  std::optional<double> flicker_depth{};  // (max - min)/(max + min) of a smooth ripple
  std::optional<double> pwm_duty{};       // lit part of a period
};

// What the person says of a lamp; everything absent is fitted, defaulted or a prior, and marked so.
// What is known of a lamp at some of its states alone: another zoom, or a modifier before it.
struct StateDescription {
  FixtureState state;  // holds of every state that says the same of these controls
  std::optional<LightKind> kind{};
  std::optional<Fixture> fixture{};
  std::optional<Metres> diameter{}, width{}, height{}, length{}, radius{};
  std::optional<Radians> inner{}, outer{};  // half angles of the cone
};

struct LightDescription {
  std::string name;
  LightKind kind = LightKind::kPoint;
  std::optional<Fixture> fixture{};
  LampClass lamp_class = LampClass::kUnknown;
  LampInTime in_time{};
  std::optional<Vec3> position_m;
  std::optional<Vec3> aim;               // unit length after loading
  std::optional<Vec3> axis;              // of a tube's length, a rect's width, a table's C0; unit
  std::optional<Metres> diameter;        // sphere, disk
  std::optional<Metres> width, height;   // rect
  std::optional<Metres> length, radius;  // tube
  double face_sd = 0.0;                  // of the face's area, relative, where a picture gave it
  std::optional<Radians> inner, outer;   // half angles of the cone
  std::optional<Watts> electrical;       // data sheet
  std::optional<Lumens> flux;            // data sheet
  std::optional<Radians> beam, field;    // data sheet: full angles at 50 % and 10 % of the peak
  // 1 sigma of the angles off its axis that readings say, and of the axis they are counted from.
  std::optional<Radians> angle_sigma{};
  std::optional<Metres> distance_sigma{};  // 1 sigma of each reading's distance by itself
  std::string distribution_file{};         // photometric: an IES or EULUMDAT file, "" = none named
  // What that file holds, type C about the aim; whoever loads the session fills it.
  std::optional<IntensityTable> distribution{};
  std::vector<StateDescription> at{};
};

// 1 sigma of a meter that says no other, of all it reads alike; of a figure a maker prints.
inline constexpr double kSigmaUnnamedMeter = 0.05;
inline constexpr double kSigmaDataSheet = 0.02;
// The reserved meter name for figures a manufacturer prints.
inline constexpr const char* kDataSheetMeter = "data_sheet";

struct MeterDescription {
  std::string name;
  double sigma_relative = kSigmaUnnamedMeter;  // what all its readings share, unless:
  // The part of it that they share; the rest is each reading's own. See CalibrationRelative.
  std::optional<double> calibration_relative{};
  std::optional<double> repeatability_relative{};  // beside it, each reading's own; 1 %
  std::optional<double> cosine_f2;
  std::optional<double> spectral_f1;
  std::optional<Metres> head_radius;
  std::optional<double> window_s{};  // how long one reading gathers its light
  std::optional<Lux> step{};         // the last digit that its display shows
  bool states_sigma{};               // sigma_relative is a person's word, not what is usual
};

// A reading with the place it was written, for messages and for `rejected`.
struct SessionReading {
  Reading reading;
  std::string where;  // "session.toml [[reading]] 3", "readings.jsonl:7"
  // Of a reading that names every lit lamp: which others shone too, and at which of the session's
  // places it was taken (-1: not known to be any other reading's).
  std::vector<std::string> others_lit{};
  int place = -1;
  std::string fault{};  // why it is not used, "" = it is: of one that was set aside
};

// A reading that names every lamp that was lit, as written; SpreadLitReadings gives each light its
// share.
struct LitReading {
  Reading reading;  // without light, lamp and distance
  std::string where;
  std::vector<std::string> lit;
  std::vector<std::pair<std::string, Metres>> distances;  // from each lamp
};

struct Session {
  std::string name;
  std::string directory;  // base of relative paths
  std::string stem;       // the directory's name (or the .toml's stem)
  std::optional<Room> room;
  Surroundings surroundings = Surroundings::kIndoors;
  std::optional<double> haze_per_metre{};  // extinction of the air
  std::vector<LightDescription> lights;
  std::vector<MeterDescription> meters;
  std::vector<SessionReading> readings;  // session.toml's first, then the journal's, then lit ones
  // Of lamps with controls, what was read at other states than the one each is fitted at; of those
  // `readings` holds none.
  std::vector<SessionReading> state_readings{};
  std::vector<LitReading> lit_readings;
  std::vector<CaptureDescription> captures;
  CameraDescription camera;
  std::vector<CameraFramesDescription> camera_frames;
  std::vector<std::string> input_files;  // what was read, for provenance, in reading order
  // Of a session that holds a part of another's readings: how finely each instrument's display
  // shows, as all of them tell, by InstrumentOf. See DisplayStepOf.
  std::map<std::string, Lux> display_steps{};
};

// The sigma a reading carries: its own, its meter's, the data sheet's, or the unnamed meter's.
[[nodiscard]] double SigmaRelative(const Session& session, const Reading& reading);
// Of that, what every reading of the same meter has in common: its calibration, 1 sigma, relative.
// Of a picture its scale's; else the meter's own calibration_relative, else all of the sigma: a
// meter's accuracy is a statement on its scale. 0 for the data sheet and for a sigma written on a
// reading of no named meter or device, whose error is taken as its own.
[[nodiscard]] double CalibrationRelative(const Session& session, const Reading& reading);
// What remains of sigma beside that calibration: sqrt(sigma^2 - calibration^2), but never less than
// what two readings of one meter differ by: 1 %, or sigma where that is less.
[[nodiscard]] double RepeatabilityBeside(double sigma, double calibration);
// That of a reading, or what its meter states.
[[nodiscard]] double RepeatabilityRelative(const Session& session, const Reading& reading);
// Null where the session describes no such [[meter]].
[[nodiscard]] const MeterDescription* FindMeter(const Session& session, std::string_view name);
// The instrument a reading's calibration belongs to: of a picture its scale's, else its meter's
// name, else its device, "" = unnamed.
[[nodiscard]] const std::string& InstrumentOf(const Reading& reading);

// Adds, for each lit reading and each light, a SessionReading with the lamp on or off, the other
// lit lamps beside it and the distance from it. Readings at one position, or at the same distance
// from a lamp both name, stand in one place and share their distances; where none says, all do. A
// reading of one light at such a place (light and distance_m, or position_m) is one with that lamp
// alone lit.
void SpreadLitReadings(Session& session);

// The state that a lamp with controls is fitted at: of those its readings name, the one read at
// most distances, of these the one of the highest dimmer, of these the first that gives at least
// nine tenths of the brightest's light (E d^2). Empty = it has no controls.
[[nodiscard]] FixtureState ReferenceState(const Session& session, std::string_view light);
// Whether a description holds of a state: each of its controls says the same there.
[[nodiscard]] bool HoldsAt(const StateDescription& one, const FixtureState& state);
// The light as its `at` describe it at that state, in their order. One that names a kind takes off
// the sizes and the cone that the light gives for its own.
[[nodiscard]] LightDescription DescriptionAt(const LightDescription& light,
                                             const FixtureState& state);
// Calls visit(row) of every reading, those of other states too.
template <class SomeSession, class Visit>
void VisitReadings(SomeSession& session, const Visit& visit) {
  for (auto& row : session.readings) visit(row);
  for (auto& row : session.state_readings) visit(row);
}

// Moves the readings of every other state from `readings` to `state_readings`: nobody who takes a
// session's readings takes two states for one lamp. A reading with the lamp off holds for all.
// Refused: state_missing (a lit reading of a lamp with controls that does not say them),
// state_controls (a reading that names other controls than the lamp's first).
[[nodiscard]] Result<void> SplitStates(Session& session);

// What a session must obey, whoever made it: what LoadSession demands of a file, of all but the
// rows themselves, which FaultOf(Reading) judges.
// Refused: bad_session (a room, a light or a meter that cannot be), duplicate_name, unknown_light,
// unknown_meter (of a reading).
[[nodiscard]] Result<void> CheckSession(const Session& session);
// The session with each reading that has a fault (FaultOf, but a position without a normal is of a
// meter that faced the lamp) in its place still, telling nothing; absent where none has. A distance
// below 0 stays: whoever needs it refuses it.
[[nodiscard]] std::optional<Session> SetFaultyAside(const Session& session);

// Readings that name no meter, came from no device and have no sigma of their own are the session's
// only [[meter]]'s, where it describes one.
void NameOnlyMeter(Session& session);

// Names in a session are relative to its directory.
[[nodiscard]] std::string PathInSession(const Session& session, const std::string& name);

[[nodiscard]] const LightDescription* FindLight(const Session& session, std::string_view name);

// How a lamp makes its light: what the light says, else the first of its captures that does.
// kUnknown where nobody says it.
[[nodiscard]] LampClass ClassOfLamp(const Session& session, std::string_view light);

}  // namespace lightcal
