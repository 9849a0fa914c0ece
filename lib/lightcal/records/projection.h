// SPDX-License-Identifier: Apache-2.0
// How a picture's pixels are directions.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "lightcal/core/units.h"

namespace lightcal {

enum class Projection : std::uint8_t {
  kRectilinear,  // an ordinary lens: r = f tan theta
  kLatLong,      // x is azimuth over 360 degrees, y is the angle from the zenith over 180
  kEquidistant,  // fisheye, r = f theta
  kEquisolid,    // fisheye, r = 2 f sin(theta/2): equal areas are equal solid angles
};
inline constexpr std::array<std::string_view, 4> kProjectionWords = {"rect", "latlong",
                                                                     "equidistant", "equisolid"};

// What a picture's own file says of it.
struct WrittenView {
  Projection projection = Projection::kRectilinear;
  Radians field_of_view{0.0};  // full angle: across the width (rect), the image circle (fisheyes)
};

}  // namespace lightcal
