// SPDX-License-Identifier: Apache-2.0
// A plane's illuminance in false colours, with isolux lines, a scale in lux and one in metres.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/view2d.h"
#include "lightcal/report/axis.h"

namespace lightcal::report {

// Which lux take which colour.
struct LuxScale {
  AxisScale way = AxisScale::kLinear;
  double low = 0.0, high = 1.0;  // lx, round numbers; beyond them the end colours
};
// Logarithmic where more than a factor of 20 lies between the brightest and the dimmest twentieth,
// over three decades at most; else linear from 0.
[[nodiscard]] LuxScale ScaleFor(View2d<const float> lux);
[[nodiscard]] LuxScale ScaleFor(View2d<const float> lux, AxisScale way);

// 8 bit sRGB, three bytes a sample: from near black over blue, magenta and orange to pale yellow,
// lightness rising all the way, so that it also reads in grey and to every colour vision.
[[nodiscard]] std::vector<std::uint8_t> FalseColors(View2d<const float> lux, const LuxScale& scale);

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
[[nodiscard]] std::string IlluminancePicture(const IlluminanceFigure& figure, const LuxScale& scale,
                                             std::string_view image_uri,
                                             std::string_view scale_uri);

// The scale itself as an image, one column of `height` samples from the high end down.
[[nodiscard]] std::vector<std::uint8_t> ScaleColors(int height);

}  // namespace lightcal::report
