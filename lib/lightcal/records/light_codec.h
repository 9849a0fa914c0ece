// SPDX-License-Identifier: Apache-2.0
// light.json ("schema": "lightcal.light/1") <-> LightFile.
#pragma once

#include <string>
#include <string_view>

#include "lightcal/core/result.h"
#include "lightcal/records/document.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal {

inline constexpr std::string_view kLightSchema = "lightcal.light/1";

// The same as a document, to be part of a larger one.
[[nodiscard]] records::Node DocumentOf(const LightFile& file);
// Of one light: name, effects and budget, as they stand there.
[[nodiscard]] records::Node ExplanationOf(const FittedLight& light);
// {"value","u95"}, and "low95","high95" where the interval is not symmetric.
[[nodiscard]] records::Node DocumentOf(const Uncertain& value);

// Pretty-printed JSON with a final newline; keys as in the command-line contract. Never NaN or Inf:
// a value that is not finite is an error of the caller and fails: not_finite.
[[nodiscard]] Result<std::string> LightFileToJson(const LightFile& file);

// Reads an answer too that holds lights and more beside them (warnings, next_steps, files, ...: the
// schema lists them), which is left out. Refused: bad_light (syntax, wrong type, unknown
// schema version, light below 0, a value outside its own interval), unknown_key.
[[nodiscard]] Result<LightFile> LightFileFromJson(std::string_view text, std::string_view where);

// The same, or the lights of a lightcal.preset/1 (their measured values, not what engines get).
// Refused besides: bad_preset.
[[nodiscard]] Result<LightFile> LightFileOrPresetFromJson(std::string_view text,
                                                          std::string_view where);

}  // namespace lightcal
