// SPDX-License-Identifier: Apache-2.0
// Where a meter stood before the lamp, from what a reading says of it.
#pragma once

#include <functional>
#include <string>

#include "lightcal/core/result.h"
#include "lightcal/records/session.h"

namespace lightcal::fit {

struct ReadingGeometry {
  double distance_m = 1.0;   // from the lamp's reference point; 1 where none is known or counts
  double tilt_rad = 0.0;     // of the meter's normal from the lamp
  bool from_center = false;  // by positions, or of a light without a distance law
};

// From the reading's distance and tilt, or from its position, its normal and the lamp's place; of a
// directional light from its normal and the light's aim. `name` is the row's in errors. Refused:
// negative_distance, no_distance (lit, and neither distance nor position), no_aim (a normal towards
// a directional light without one), no_axis (lit, an angle off the axis of a light that has none
// or, a tube, two).
[[nodiscard]] Result<ReadingGeometry> GeometryOfReading(const LightDescription& light,
                                                        const Reading& reading,
                                                        const std::string& name, bool lit);

// What holds at an angle off an axis, whichever side that is on.
struct PartRound {
  double mean = 0.0;
  double sd_relative = 0.0;  // of one side, all alike likely
};

// `part_of`(radians about the axis), of a full turn.
[[nodiscard]] PartRound MeanRound(const std::function<double(double)>& part_of);

// Intensity towards the meter over the peak's, by the lamp's table, and how far that may lie from a
// smooth lobe's (IntensityTable::InterpolationErrorTowards), relative.
struct TablePart {
  double of_peak = 1.0;
  double error = 0.0;
};

// 1 without a table. A reading by its angle has the mean of all sides; one that says neither angle
// nor position stands on the lamp's aim, and a lamp without an aim shines down.
[[nodiscard]] TablePart TablePartTowards(const LightDescription& light, const Reading& reading);

// Why no law of light can hold for a reading (which has an illuminance) there; "" = one can.
[[nodiscard]] std::string FaultOfReading(const LightDescription& light, const Reading& reading,
                                         const ReadingGeometry& geometry, bool lit);

}  // namespace lightcal::fit
