// SPDX-License-Identifier: Apache-2.0
// light.json ("schema": "lightcal.light/1") <-> LightFile.
#pragma once

#include <string>
#include <string_view>

#include "lightcal/core/result.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal {

inline constexpr std::string_view kLightSchema = "lightcal.light/1";

// Pretty-printed JSON with a final newline; keys as in the command-line contract. Never NaN or Inf:
// a value that is not finite is an error of the caller and fails: not_finite.
[[nodiscard]] Result<std::string> LightFileToJson(const LightFile& file);

// Fails: bad_light (syntax, wrong type, unknown schema version), unknown_key.
[[nodiscard]] Result<LightFile> LightFileFromJson(std::string_view text, std::string_view where);

}  // namespace lightcal
