// SPDX-License-Identifier: Apache-2.0
// "distribution" of a light.json. Internal to the records room.
#pragma once

#include <optional>

#include "lightcal/records/field_reader.h"
#include "lightcal/records/field_writer.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal::records {

// {"type","horizontal_deg","vertical_deg","candela","interpolated_share","budget":[..],
// "pattern_sd"}: candela of
// all vertical angles of the first horizontal angle, then of the next.
void VisitDistribution(FieldReader& reader, std::optional<MeasuredDistribution>& out);
void VisitDistribution(FieldWriter& writer, const std::optional<MeasuredDistribution>& given);

}  // namespace lightcal::records
