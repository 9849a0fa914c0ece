// SPDX-License-Identifier: Apache-2.0
// The nine kinds of light a session may name, and their words in files.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace lightcal {

enum class LightKind {
  kDirectional,
  kPoint,
  kSpot,
  kSphere,
  kDisk,
  kRect,
  kTube,
  kPhotometric,
  kDome,
};

inline constexpr std::array<std::string_view, 9> kLightKindNames = {
    "directional", "point", "spot", "sphere", "disk", "rect", "tube", "photometric", "dome"};

[[nodiscard]] constexpr std::string_view LightKindName(LightKind kind) {
  return kLightKindNames[static_cast<std::size_t>(kind)];
}
[[nodiscard]] constexpr std::optional<LightKind> LightKindFromName(std::string_view name) {
  for (std::size_t i = 0; i < kLightKindNames.size(); ++i) {
    if (kLightKindNames[i] == name) return static_cast<LightKind>(i);
  }
  return std::nullopt;
}

}  // namespace lightcal
