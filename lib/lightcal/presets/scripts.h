// SPDX-License-Identifier: Apache-2.0
// The programs that go with presets: the files of scripts/, embedded at build.
#pragma once

#include <string>
#include <string_view>

namespace lightcal {

// By its name there, "blender.py".
[[nodiscard]] std::string_view Script(std::string_view file);

// That script with `data` where it says @DATA@.
[[nodiscard]] std::string ScriptWith(std::string_view file, std::string_view data);

// JSON as it may stand inside a quoted string of a script: without apostrophes.
[[nodiscard]] std::string WithoutApostrophes(std::string_view json);

}  // namespace lightcal
