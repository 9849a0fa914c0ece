// SPDX-License-Identifier: Apache-2.0
// SYNTHETIC: a photograph of a wall as a picture in cd/m^2, of one channel or of three (Rec. 709).
#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "lightcal_devices/captures/picture.h"
#include "synthetic_wall.h"

namespace lightcal::test {

// False, and the reason on stderr, where it cannot be written.
inline bool WriteWallPicture(const std::string& path, const SyntheticWall& wall,
                             const std::vector<float>& nits) {
  const bool rgb = nits.size() > static_cast<std::size_t>(wall.width) * wall.height;
  devices::ExrPicture picture;
  picture.samples = View2d<const float>(nits.data(), wall.width, wall.height, rgb ? 3 : 1);
  picture.channel_names = {"Y"};
  if (rgb) picture.channel_names = {"R", "G", "B"};
  picture.white_luminance = Nits(1.0);
  picture.attributes = {{"note", "SYNTHETIC: no camera took this picture"},
                        {"scale_u95_relative", "0.04"}};
  const auto written = devices::WriteExr(path, picture);
  if (!written) std::fprintf(stderr, "%s\n", written.error().message.c_str());
  return written.has_value();
}

}  // namespace lightcal::test
