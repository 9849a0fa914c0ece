// SPDX-License-Identifier: Apache-2.0
// SYNTHETIC: a photograph of a wall as a picture in cd/m^2.
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
  devices::ExrPicture picture;
  picture.samples = View2d<const float>(nits.data(), wall.width, wall.height);
  picture.channel_names = {"Y"};
  picture.white_luminance = Nits(1.0);
  picture.attributes = {{"note", "SYNTHETIC: no camera took this picture"},
                        {"scale_u95_relative", "0.04"}};
  const auto written = devices::WriteExr(path, picture);
  if (!written) std::fprintf(stderr, "%s\n", written.error().message.c_str());
  return written.has_value();
}

}  // namespace lightcal::test
