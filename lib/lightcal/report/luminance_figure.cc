// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/luminance_figure.h"

#include <algorithm>
#include <array>
#include <vector>

#include "lightcal/report/false_color.h"
#include "lightcal/report/svg.h"

namespace lightcal::report {
namespace {

constexpr double kTop = 34.0, kBelow = 10.0;
constexpr double kWidest = 356.0, kTallest = 340.0, kShortest = 120.0;
constexpr double kScaleBarGap = 16.0, kScaleBarWidth = 16.0;

void DrawRegion(Svg& svg, const std::array<double, 4>& region, double scale_x, double scale_y) {
  const double left = region[0] * scale_x;
  const double right = left + region[2] * scale_x;
  const double top = kTop + region[1] * scale_y;
  const double bottom = top + region[3] * scale_y;
  const std::vector<PagePoint> edge = {{left, top}, {right, top}, {right, bottom}, {left, bottom}};
  svg.Path("region halo", edge, true);
  svg.Path("region", edge, true);
}

}  // namespace

std::string LuminanceFigure(const LuminancePicture& picture, std::string_view id) {
  if (picture.width < 1 || picture.height < 1) return "";
  const double scale = std::min(kWidest / picture.width, kTallest / picture.height);
  const double width = std::max(1.0, scale * picture.width);
  const double height = std::max(kShortest, scale * picture.height);
  Svg svg(std::string(id), "Luminance",
          "Luminance of the picture in cd/m², in false colours, written by lightcal",
          {kFigureWidth, kTop + height + kBelow});
  svg.Element(ImageElement({0.0, kTop}, {width, height}, picture.image_uri));
  if (picture.region) {
    DrawRegion(svg, *picture.region, width / picture.width, height / picture.height);
  }
  DrawScaleBar(svg, picture.scale, {width + kScaleBarGap, kTop, kScaleBarWidth, height},
               picture.scale_uri, "cd/m²");
  return WithXlink(svg.Finish());
}

}  // namespace lightcal::report
