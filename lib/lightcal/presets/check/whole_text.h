// SPDX-License-Identifier: Apache-2.0
// Whether the text of a preset goes on to its end, or was cut off on its way here.
#pragma once

#include <string>
#include <string_view>

namespace lightcal {

// How a format writes what is no bracket of its own.
struct TextSyntax {
  std::string_view quotes;         // each begins a string, which ends with it; \ takes the next
  std::string_view long_quotes{};  // of them, those that make a string of lines when tripled
  std::string_view plain_quote{};  // one without a backslash: USD's @
  std::string_view line_comment{}, block_comment{}, block_end{};
  bool regexes = false;  // /.../ where no quotient can stand
};
inline constexpr TextSyntax kPythonSyntax{"\"'", "\"'", "", "#", "", "", false};
inline constexpr TextSyntax kJavaScriptSyntax{"\"'`", "", "", "//", "/*", "*/", true};
inline constexpr TextSyntax kUsdaSyntax{"\"'", "\"'", "@", "#", "", "", false};

// Throws std::runtime_error where a bracket, a string or a comment of blocks is open at the end of
// the text.
void RequireClosed(std::string_view text, const TextSyntax& syntax);

// Whether a preset's script is, but for its preset, the very one that lightcal writes
// (presets/scripts), so that it runs as that does. `script`: its name there, "blender.py".
[[nodiscard]] bool IsOwnScript(std::string_view text, std::string_view script);

// That it was cut off, and that `what` is missing.
[[noreturn]] void ThrowCutOff(const std::string& what);

}  // namespace lightcal
