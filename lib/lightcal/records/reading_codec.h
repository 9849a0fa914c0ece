// SPDX-License-Identifier: Apache-2.0
// The keys of one reading, the same in session.toml and in the journal. Internal to the records
// room; ReadingToJson and ReadingFromJson are declared in session_codec.h.
#pragma once

#include <string_view>

#include "lightcal/core/result.h"
#include "lightcal/records/field_reader.h"
#include "lightcal/records/reading.h"

namespace lightcal::records {

// Reads every key of a reading and checks that they agree with one another.
void ReadReading(FieldReader& reader, Reading& reading);

// One journal line; on failure also whether it is no JSON at all, and whether it merely stops
// early.
struct LineError {
  Error error;
  bool syntax = false;
  bool torn = false;
};
[[nodiscard]] tl::expected<Reading, LineError> ReadingFromLine(std::string_view line,
                                                               std::string_view where);

}  // namespace lightcal::records
