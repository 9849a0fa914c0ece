// SPDX-License-Identifier: Apache-2.0
// Where a meter stood before the lamp, from what a reading says of it.
#pragma once

#include <string>

#include "lightcal/core/result.h"
#include "lightcal/records/session.h"

namespace lightcal::fit {

struct ReadingGeometry {
  double distance_m = 1.0;   // from the lamp's reference point; 1 where none is known or counts
  double tilt_rad = 0.0;     // of the meter's normal from the lamp
  bool from_center = false;  // by positions, or of a light without a distance law
};

// From the reading's distance and tilt, or from its position, its normal and the lamp's place.
// `name` is the row's in errors. Refused: negative_distance, no_distance (lit, and neither distance
// nor position).
[[nodiscard]] Result<ReadingGeometry> GeometryOfReading(const LightDescription& light,
                                                        const Reading& reading,
                                                        const std::string& name, bool lit);

// Intensity towards the meter over the peak's, by the lamp's table; 1 without one. Readings without
// positions stand on the lamp's aim; a lamp without an aim shines down.
[[nodiscard]] double TablePartTowards(const LightDescription& light, const Reading& reading);

// Why no law of light can hold for a reading (which has an illuminance) there; "" = one can.
[[nodiscard]] std::string FaultOfReading(const LightDescription& light, const Reading& reading,
                                         const ReadingGeometry& geometry, bool lit);

}  // namespace lightcal::fit
