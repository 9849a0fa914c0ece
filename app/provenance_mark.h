// SPDX-License-Identifier: Apache-2.0
// Which of lightcal's own formats a file is, told by the place where that format carries who wrote
// it. The word "lightcal" anywhere else says nothing: a person's session.toml is full of it.
#pragma once

#include <string>
#include <string_view>

#include "lightcal/core/result.h"

namespace lightcal::app {

inline constexpr std::string_view kTapeFormat = "lightcal.tape";

// "lightcal.light", "gltf", "svg", "exr", ...; empty for every file that lightcal did not write,
// and for a session.toml and a journal, which are a person's whoever wrote them first. JSON: its
// "schema", or the "generator" of glTF's asset, of the root or of its provenance. Text for engines:
// a comment of its own, or the format's field for it, in the first lines. SVG, HTML, PNG, PDF,
// OpenEXR, IES and EULUMDAT: the field that our writer fills.
[[nodiscard]] std::string OwnFormatOf(std::string_view contents);

// The same of a file. Empty too where it cannot be read.
[[nodiscard]] std::string OwnFormatOfFile(const std::string& path);

// Refused: wrong_ending, where a name ends as another format than `contents` are in: a .ldt that
// would hold IES. Endings nobody knows say nothing.
[[nodiscard]] Result<void> CheckEnding(const std::string& path, std::string_view format);

// Whether a name ends as a file that lightcal writes.
[[nodiscard]] bool EndsAsOurs(const std::string& path);

}  // namespace lightcal::app
