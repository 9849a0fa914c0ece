// SPDX-License-Identifier: Apache-2.0
// session.toml -> Session with its warnings. Internal to the records room.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "lightcal/core/result.h"
#include "lightcal/records/reading_codec.h"
#include "lightcal/records/session_codec.h"

namespace lightcal::records {

// As ParseSessionToml, with what was put right on the way (cone_order).
[[nodiscard]] Result<LoadedSession> ParseSession(std::string_view text, std::string_view where);

// Why a reading or a capture cannot belong to this session, with the nearest name.
struct StrangeName {
  std::string code;  // unknown_light, unknown_meter, lamp_class_conflict
  std::string key;
  std::string message;
};
[[nodiscard]] std::optional<StrangeName> FindStrangeName(const Session& session,
                                                         const Reading& reading);
[[nodiscard]] std::optional<StrangeName> FindStrangeName(const Session& session,
                                                         const Reading& reading,
                                                         const LitKeys& keys);
// Of a capture; also lamp_class_conflict: its light is said to be of another class.
[[nodiscard]] std::optional<StrangeName> FindStrangeName(const Session& session,
                                                         const CaptureDescription& capture);

}  // namespace lightcal::records
