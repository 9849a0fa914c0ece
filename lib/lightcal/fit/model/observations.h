// SPDX-License-Identifier: Apache-2.0
// What the readings of one light say about it: geometry resolved, lamp-off and shadow-card readings
// put to their use, impossible rows set aside.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/fit/model/light_by_tilt.h"
#include "lightcal/fit/model/off_axis_pose.h"
#include "lightcal/fit/model/parameter.h"
#include "lightcal/records/session.h"

namespace lightcal::fit {

// A reading with the lamp on, or (lit false) one of everything but the lamp.
struct Observation {
  int index = 0;  // 0-based over the light's readings
  bool lit = true;
  double distance_m = 1.0;  // from the reference point, or of the two positions; 1 where none
  bool placed = true;       // whether the session says where the meter was
  std::optional<double> distance_sigma_m;  // 1 sigma of it alone; absent: of no person's distance
  double tilt_rad = 0.0;
  double off_axis_rad = 0.0;  // stated; 0 where a position says it
  double measured_lx = 0.0;   // a matching shadow-card reading is subtracted
  double raw_lx = 0.0;        // as read
  double sigma_lx = 0.0;      // 1 sigma of measured_lx
  double by_distance = 0.0;   // of it what the distance's own error does, relative
  bool differenced = false;   // shadow card subtracted: no ambient, no bounce
  // What was read behind a card: subtracted from this reading, or (lit false) this row itself.
  bool behind_card = false;
  double card_lx = 0.0;        // the mean that was subtracted
  double card_sigma_lx = 0.0;  // 1 sigma
  // Of it, what other light is known to leave there: read with the lamp off, there or elsewhere.
  double card_other_lx = 0.0;
  // What the lamp's place or others showed with it off was subtracted (of a reading whose card was,
  // from that): no ambient, no other lamps, its own bounce.
  bool ambient_subtracted = false;
  double calibration = 0.0;  // 1 sigma, relative: of every reading of this instrument alike
  int instrument = 0;        // among this light's
  bool over_range = false;
  bool data_sheet = false;    // what the manufacturer prints
  bool picture = false;       // what a camera read, by its own scale
  bool sees_walls = true;     // false: a manufacturer's figure, or from the lamp's own luminance
  bool of_luminance = false;  // from a picture of the lamp itself, by the camera's scale
  double table_part = 1.0;    // of the peak intensity, towards the meter (photometric lamps)
  double table_error = 0.0;   // of it, relative: IntensityTable::InterpolationErrorTowards
  bool measured_from_center = false;  // by positions, the lamp's known or to be found
  std::optional<Vec3> position_m;
  std::optional<Vec3> normal;           // unit, where the reading gives one
  std::optional<OffAxisPose> off_axis;  // before a source with size and aim (off_axis.h), metres
  double emission = 1.0;                // E/I there over cos(tilt)/d^2
  std::shared_ptr<const LightByTilt> by_aim;  // null: 1
};

// What the card left that was subtracted, less the other light where that was taken off it.
[[nodiscard]] inline double LeftByCard_lx(const Observation& row) {
  return row.card_lx - (row.ambient_subtracted ? row.card_other_lx : 0.0);
}

// 1 sigma of it where its meter stood: of what differs between readings of one place.
[[nodiscard]] inline double SigmaThere_lx(const Observation& row) {
  const double by_distance = row.by_distance * row.measured_lx;
  return std::sqrt(std::max(0.0, row.sigma_lx * row.sigma_lx - by_distance * by_distance));
}

struct ReadingGeometry;

// Fills where the reading's meter stood and how it was turned, and what a table sends there.
void StandMeter(const LightDescription& light, const Reading& reading,
                const ReadingGeometry& geometry, Observation& row);

// Whether it tells how the lamp shines towards a place.
[[nodiscard]] inline bool LitAndPlaced(const Observation& row) {
  return row.lit && row.position_m && row.measured_from_center && !row.over_range;
}

struct Observations {
  std::vector<Observation> rows;
  std::vector<int> rejected;    // indices over the light's readings, ascending
  std::vector<int> subtracted;  // indices of the shadow-card and lamp-off readings that were
  int readings = 0;             // rows of this light, good or bad
  int shadow_readings = 0;
  std::array<ParameterRule, 2> aim{};  // its tilts; held: not sought
  bool by_camera = false;  // one camera's pictures, which share its scale, are all there is
  Warnings warnings;
};

// Sorts the session's readings of `light`. A row that was set aside (SetFaultyAside), lies inside
// the lamp or faces away is rejected with the warning row_rejected. Refused: negative_distance,
// no_distance, not_separated (other lamps were lit in every reading of this one, and none of them
// was taken with this one off), dark_above_lit (a card's or a lamp-off reading above the lit one at
// its place, or a lamp-off reading that leaves the lamp less than its nearer readings allow). A
// reading with other lamps lit counts by its difference from one at the same place with this lamp
// off and the same others lit; every other one by its difference from one behind a card at the same
// place, if there is one, or, where other light differs from place to place, from one there with
// the lamp off; where none was taken there, from the mean of others, as unsure as they differ.
// Other light that no [[light]] names may be daylight and drifts in between (drift_between.h).
// Where one instrument took every reading, sigmas are its repeatability and `calibration` is to be
// added after the fit; beside another's they hold both. Where the lamp has no position, readings
// that give theirs keep a distance of 1 until locate.h finds it.
[[nodiscard]] Result<Observations> CollectObservations(const Session& session,
                                                       const LightDescription& light);

// Whether walls, or outdoors the ground, shine in a reading: not in the dark or in a maker's
// figure, nor in a picture of the lamp itself.
[[nodiscard]] bool HoldsWallLight(const Session& session, const LightDescription& light,
                                  const Reading& reading);

// Whether the light's illuminance follows a distance at all (not for directional and dome).
[[nodiscard]] bool HasDistanceLaw(LightKind kind);

// Readings within this many metres of each other stand in one place.
inline constexpr double kSamePlace_m = 0.005;
// Readings within a thousandth of each other stand at one distance.
[[nodiscard]] bool SameDistance(double a_m, double b_m);
// Whether two readings were taken at one place, as they say: within 5 mm and not turned otherwise,
// or at one distance and one angle; those that say nothing at all stand together.
[[nodiscard]] bool SamePlace(const Reading& a, const Reading& b);
// Whether `row` is what was read behind the card where `reading` was, nothing else lit.
[[nodiscard]] bool IsCardOf(const SessionReading& row, const Reading& reading);
// Of lit readings that are no mere limit (over_range).
[[nodiscard]] int CountDistinctDistances(const std::vector<Observation>& rows);

}  // namespace lightcal::fit
