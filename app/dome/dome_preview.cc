// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "dome/dome_outputs.h"
#include "lightcal/colorimetry/srgb_encoding.h"
#include "lightcal/core/base64.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/imaging/panorama/turn_north.h"
#include "picture_file.h"
#include "raster_png.h"

namespace lightcal::app {
namespace {

constexpr double kMiddleGrey = 0.18;
constexpr double kLeastRadius = 7.0, kRingShare = 1.1;
constexpr double kTextHeight = 15.0;

// The geometric mean becomes middle grey.
double Exposure(const std::vector<float>& nits) {
  double sum = 0.0, count = 0.0;
  for (const float v : nits) {
    if (!(v > 0.0F)) continue;
    sum += std::log(double{v});
    count += 1.0;
  }
  return count > 0.0 ? kMiddleGrey / std::exp(sum / count) : 1.0;
}

// The code of a value that rolls off towards 1.
std::uint8_t Shown(double linear) {
  const double v = 1.0 - std::exp(-std::max(0.0, linear));
  return static_cast<std::uint8_t>(std::lround(255.0 * SrgbEncoded(v)));
}

std::string PictureOf(const Dome& dome) {
  const double exposure = Exposure(dome.nits);
  const Matrix3 srgb_from_xyz = RgbFromXyzMatrix(RgbSpace::kSrgb);
  std::vector<std::uint8_t> pixels;
  pixels.reserve(dome.nits.size() * 3);
  for (std::size_t i = 0; i < dome.nits.size(); ++i) {
    Column3 rgb{dome.nits[i], dome.nits[i], dome.nits[i]};
    if (dome.channels == 3) {
      const float* s = &dome.samples[3 * i];
      rgb = Times(srgb_from_xyz, Times(dome.xyz_from_rgb, {s[0], s[1], s[2]}));
    }
    for (const double v : rgb) pixels.push_back(Shown(exposure * v));
  }
  return EncodePng(View2d<const std::uint8_t>(pixels.data(), dome.width, dome.height, 3));
}

std::string Px(double v) { return RoundedText(v, 6); }

// A ring around what the light fills, and its name beside it.
std::string Mark(const LatLongGrid& grid, const Vec3& direction, const DomeLight& light,
                 const std::string& label, bool taken) {
  const LatLongGrid::Point at = grid.PointOf(direction);
  const double pixels = kRingShare / 2.0 / grid.pitch().value();
  const double stretch = std::max(0.1, std::hypot(direction[0], direction[1]));
  const double rx =
      std::min(grid.width() / 4.0, kLeastRadius + pixels * light.angular_width.value() / stretch);
  const double ry = kLeastRadius + pixels * light.angular_height.value();
  const bool left = at.x > grid.width() - 220.0;
  const double tx = left ? at.x - rx - 5.0 : at.x + rx + 5.0;
  const double ty = std::clamp(at.y + 5.0, kTextHeight, grid.height() - 4.0);
  std::string svg;
  for (const auto& [colour, width] : {std::pair{"#000", 4.0}, std::pair{"#ffd23f", 1.8}}) {
    svg += "<ellipse cx=\"" + Px(at.x) + "\" cy=\"" + Px(at.y) + "\" rx=\"" + Px(rx) + "\" ry=\"" +
           Px(ry) + "\" fill=\"none\" stroke=\"" + colour + "\" stroke-width=\"" + Px(width) +
           "\"" + (taken ? "" : " stroke-dasharray=\"5 4\"") + "/>\n";
  }
  for (const auto& [colour, stroke] : {std::pair{"#000", 4.0}, std::pair{"#ffd23f", 0.0}}) {
    svg += "<text x=\"" + Px(tx) + "\" y=\"" + Px(ty) + "\" text-anchor=\"" +
           (left ? "end" : "start") + "\" fill=\"" + colour + "\" stroke=\"" + colour +
           "\" stroke-width=\"" + Px(stroke) +
           "\" stroke-linejoin=\"round\" font-family=\"sans-serif\" font-size=\"15\">" + label +
           "</text>\n";
  }
  return svg;
}

}  // namespace

Result<OutputFile> DomePreview(const std::string& path, const MadeDome& made) {
  const MeasuredDome& measured = made.measured;
  const Dome& small = made.preview;
  const LatLongGrid grid = small.grid();
  const std::string size =
      " width=\"" + std::to_string(small.width) + "\" height=\"" + std::to_string(small.height);
  std::string svg =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" "
      "xmlns:xlink=\"http://www.w3.org/1999/xlink\"" +
      size + "\" viewBox=\"0 0 " + std::to_string(small.width) + " " +
      std::to_string(small.height) + "\">\n<!-- written by lightcal -->\n<image" + size +
      "\" xlink:href=\"data:image/png;base64," + Base64(PictureOf(small)) + "\"/>\n";
  for (std::size_t i = 0; i < made.names.size(); ++i) {
    const DomeLight& light = measured.lights[i];
    svg += Mark(grid, TurnedNorth(light.direction, measured.north), light,
                i < made.extracted
                    ? made.names[i] + ": " + RoundedText(light.illuminance.value(), 3) + " lx"
                    : std::to_string(i + 1),
                i < made.extracted);
  }
  return PictureFile(path, svg + "</svg>\n");
}

}  // namespace lightcal::app
