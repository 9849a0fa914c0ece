// SPDX-License-Identifier: Apache-2.0
// A plane's illuminance in false colours, with isolux lines, a scale in lux and one in metres.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/view2d.h"
#include "lightcal/report/false_color.h"

namespace lightcal::report {

struct LampMark {
  std::string name;
  double x = 0.0, y = 0.0;          // foot on the plane, in its own coordinates
  double aim_x = 0.0, aim_y = 0.0;  // the aim's part along the plane
};

struct IlluminanceFigure {
  std::string title;                                        // "desk lamp, floor"
  std::vector<std::string> notes;                           // below the picture
  View2d<const float> lux;                                  // rows from the top
  double left = 0.0, right = 1.0, top = 1.0, bottom = 0.0;  // the picture's edges [m]
  std::string x_title, y_title;                             // "x (m)"
  std::vector<LampMark> lamps;
};

// image_uri: the false colours as an image of the map's own size. Written with the class names of
// style.h and complete with its style sheet.
[[nodiscard]] std::string IlluminancePicture(const IlluminanceFigure& figure,
                                             const ValueScale& scale, std::string_view image_uri,
                                             std::string_view scale_uri);

}  // namespace lightcal::report
