// SPDX-License-Identifier: Apache-2.0
// The keys of one reading, the same in session.toml and in the journal. Internal to the records
// room; ReadingToJson and ReadingFromJson are declared in session_codec.h.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/records/field_reader.h"
#include "lightcal/records/reading.h"

namespace lightcal::records {

// Reads every key of a reading and checks that they agree with one another.
void ReadReading(FieldReader& reader, Reading& reading);

// The keys of a reading that names every lit lamp instead of one light.
struct LitKeys {
  bool given = false;
  std::vector<std::string> lit;
  std::vector<std::pair<std::string, Metres>> distances;
};
// The same with those keys; a reading has light or lit.
void ReadReading(FieldReader& reader, Reading& reading, LitKeys& keys);

// FaultOf, of a reading that no file writes: a position without a normal is of a meter that faced
// the lamp.
[[nodiscard]] std::optional<ReadingFault> FaultInMemory(const Reading& reading);

// One journal line; on failure also whether it is no JSON at all, and whether it merely stops
// early.
struct LineError {
  Error error;
  bool syntax = false;
  bool torn = false;
};
[[nodiscard]] tl::expected<Reading, LineError> ReadingFromLine(std::string_view line,
                                                               std::string_view where);
[[nodiscard]] tl::expected<Reading, LineError> ReadingFromLine(std::string_view line,
                                                               std::string_view where,
                                                               LitKeys& keys);

}  // namespace lightcal::records
