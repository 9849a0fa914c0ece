// SPDX-License-Identifier: Apache-2.0
// Where the absolute scale of a picture comes from.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace lightcal {

enum class ScaleSource : std::uint8_t {
  kIsoPrior,  // what the ISO speed promises
  kAnchor,    // a meter's reading of a part of the picture
  kCamera,    // the camera's profile, which measured it
  kPicture,   // the picture is in cd/m^2 already
};
inline constexpr std::array<std::string_view, 4> kScaleSourceWords = {"iso_prior", "anchor",
                                                                      "camera", "picture"};
[[nodiscard]] constexpr std::string_view WordOf(ScaleSource source) {
  return kScaleSourceWords[static_cast<std::size_t>(source)];
}

}  // namespace lightcal
