// SPDX-License-Identifier: Apache-2.0
// Values as colours, and the scale that says which is which.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/view2d.h"
#include "lightcal/report/axis.h"
#include "lightcal/report/svg.h"

namespace lightcal {

// Which values take which colour.
struct ValueScale {
  report::AxisScale way = report::AxisScale::kLinear;
  double low = 0.0, high = 1.0;  // round numbers; beyond them the end colours
};

namespace report {

// Logarithmic where more than a factor of 20 lies between the brightest and the dimmest twentieth,
// over three decades at most; else linear from 0.
[[nodiscard]] ValueScale ScaleFor(View2d<const float> values);
[[nodiscard]] ValueScale ScaleFor(View2d<const float> values, AxisScale way);

// 8 bit sRGB, three bytes a sample: from near black over blue, magenta and orange to pale yellow,
// lightness rising all the way, so that it also reads in grey and to every colour vision.
[[nodiscard]] std::vector<std::uint8_t> FalseColors(View2d<const float> values,
                                                    const ValueScale& scale);

// The scale itself as an image, one column of `height` samples from the high end down.
[[nodiscard]] std::vector<std::uint8_t> ScaleColors(int height);

// An <image> stretched over a rectangle. Its href is xlink's, which every reader of SVG knows: the
// root needs WithXlink.
[[nodiscard]] std::string ImageElement(PagePoint at, PagePoint size, std::string_view uri);
[[nodiscard]] std::string WithXlink(std::string svg);

// Where a scale's bar stands on the page.
struct ScaleBar {
  double left = 0.0, top = 0.0, width = 18.0, height = 1.0;
};
// The scale's axis along the bar, high end on top, and the round values to mark on it, above 0.
[[nodiscard]] Axis BarAxis(const ValueScale& scale, const ScaleBar& bar);
[[nodiscard]] std::vector<double> BarLevels(const ValueScale& scale, const ScaleBar& bar);
// The bar with its ticks to the right, and `unit` above ("lux" becomes "lux (log)").
void DrawScaleBar(Svg& svg, const ValueScale& scale, const ScaleBar& bar, std::string_view uri,
                  std::string_view unit);

}  // namespace report
}  // namespace lightcal
