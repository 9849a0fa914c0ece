// SPDX-License-Identifier: Apache-2.0
// Sessions whose files somebody else reads.
#pragma once

#include <functional>
#include <string>

#include "lightcal/core/result.h"
#include "lightcal/records/session_codec.h"

namespace lightcal {

// The bytes of a whole file.
using TextReader = std::function<Result<std::string>(const std::string& path)>;

// LoadSession, where `read` gives the bytes of its files.
[[nodiscard]] Result<LoadedSession> LoadSession(const std::string& path, const TextReader& read);

}  // namespace lightcal
