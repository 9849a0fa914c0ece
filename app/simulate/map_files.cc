// SPDX-License-Identifier: Apache-2.0
#include "simulate/map_files.h"

#include <cmath>
#include <utility>

#include "lightcal/core/interval_text.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/report/illuminance_figure.h"
#include "lightcal_devices/captures/picture.h"
#include "picture_file.h"
#include "raster_png.h"

namespace lightcal::app {
namespace {

constexpr int kMapScaleRows = 512;
constexpr int kLuxDigits = 6;

bool EndsWith(const std::string& path, std::string_view ending) {
  return LowerAscii(path).ends_with(ending);
}

std::string UriOf(const std::vector<std::uint8_t>& rgb, int width, int height) {
  return PngUri({rgb.data(), width, height, 3});
}

std::size_t AxisOf(const std::string& name) { return static_cast<std::size_t>(name[0] - 'x'); }

std::vector<report::LampMark> Marks(const Simulated& s) {
  std::vector<report::LampMark> marks;
  const std::size_t across = AxisOf(s.plane->across_axis);
  const std::size_t up = AxisOf(s.plane->up_axis);
  for (const PlacedLamp& lamp : s.lamps) {
    if (IsEverywhere(lamp.source)) continue;
    const bool aimed = !std::holds_alternative<PointSource>(lamp.source) &&
                       !std::holds_alternative<SphereSource>(lamp.source);
    const Vec3& aim = lamp.pose.frame.z;
    marks.push_back({lamp.name, lamp.pose.position_m[across], lamp.pose.position_m[up],
                     aimed ? aim[across] : 0.0, aimed ? aim[up] : 0.0});
  }
  return marks;
}

std::string SvgOf(const Simulated& s, const MapPictureWords& words) {
  const MapPlane& plane = *s.plane;
  const View2d<const float> lux(s.map.lux.data(), s.map.width, s.map.height);
  ValueScale scale = report::ScaleFor(lux);
  if (words.scale == "log") scale = report::ScaleFor(lux, report::AxisScale::kLog);
  if (words.scale == "linear") scale = report::ScaleFor(lux, report::AxisScale::kLinear);
  report::IlluminanceFigure figure;
  figure.title = words.title + (words.title.empty() ? "" : " · ") + plane.name;
  figure.lux = lux;
  figure.left = plane.left;
  figure.right = plane.right;
  figure.top = plane.top;
  figure.bottom = plane.bottom;
  figure.x_title = plane.across_axis + " (m)";
  figure.y_title = plane.up_axis + " (m)";
  figure.lamps = Marks(s);
  const MapSummary summary = Summarize(s.map, plane, s.border_m);
  const auto text = [](double v) { return RoundedText(v, 3); };
  figure.notes.push_back("illuminance: mean " + text(summary.mean_lx) + " lx, least " +
                         text(summary.least_lx) + " lx, most " + text(summary.most_lx) + " lx; " +
                         RelativeText(IntervalOfFactor(summary.median_u95_relative)) +
                         " (95 %, median)");
  figure.notes.push_back(s.settings.room ? "direct light and what the walls return (reflectance " +
                                               RoundedText(s.settings.room->reflectance, 2) +
                                               "), nothing in between"
                                         : "direct light alone: no walls, nothing in between");
  return report::IlluminancePicture(
      figure, scale, UriOf(report::FalseColors(lux, scale), s.map.width, s.map.height),
      UriOf(report::ScaleColors(kMapScaleRows), 1, kMapScaleRows));
}

std::string CsvOf(const Simulated& s) {
  const MapPlane& plane = *s.plane;
  const std::size_t across = AxisOf(plane.across_axis);
  const std::size_t up = AxisOf(plane.up_axis);
  std::string out = "# written by " + GeneratorName() + ": " + plane.name + "\n" +
                    plane.across_axis + "_m," + plane.up_axis + "_m,illuminance_lx,u95_lx\n";
  for (int j = 0; j < s.map.height; ++j) {
    for (int i = 0; i < s.map.width; ++i) {
      const Vec3 at = PointOf(plane, i, j);
      const std::size_t k = static_cast<std::size_t>(j) * s.map.width + i;
      out += RoundedText(at[across], kLuxDigits) + "," + RoundedText(at[up], kLuxDigits) + "," +
             RoundedText(double{s.map.lux[k]}, kLuxDigits) + "," +
             RoundedText(double{s.map.u95[k]}, kLuxDigits) + "\n";
    }
  }
  return out;
}

Result<void> WriteMapExr(const Simulated& s, const std::string& path) {
  std::vector<float> samples;
  samples.reserve(2 * s.map.lux.size());
  for (std::size_t i = 0; i < s.map.lux.size(); ++i) {
    samples.push_back(s.map.lux[i]);
    samples.push_back(s.map.u95[i]);
  }
  const MapPlane& plane = *s.plane;
  const auto number = [](double v) { return ShortestText(v); };
  devices::ExrPicture exr;
  exr.samples = View2d<const float>(samples.data(), s.map.width, s.map.height, 2);
  exr.channel_names = {"Y", "u95"};
  exr.attributes = {
      {"generator", GeneratorName()},
      {"quantity", "illuminance, lx; its 95 % half width, lx"},
      {"plane", plane.name},
      {"axes", plane.across_axis + " to the right, " + plane.up_axis + " up"},
      {"edges_m", "left " + number(plane.left) + " right " + number(plane.right) + " bottom " +
                      number(plane.bottom) + " top " + number(plane.top)}};
  return devices::WriteExr(path, exr);
}

}  // namespace

Result<void> CheckMapNames(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const bool known = EndsWith(name, ".png") || EndsWith(name, ".svg") || EndsWith(name, ".exr") ||
                       EndsWith(name, ".csv");
    if (!known) return WrongUsage("-o", "\"" + name + "\" must end in .png, .svg, .exr or .csv");
  }
  return {};
}

Result<std::vector<OutputWriter>> MapWriters(const Simulated& simulated,
                                             const std::vector<std::string>& names,
                                             const MapPictureWords& words) {
  std::vector<OutputWriter> out;
  for (const std::string& name : names) {
    if (EndsWith(name, ".exr")) {
      out.push_back({name, "exr", [&simulated](const std::string& temporary) {
                       return WriteMapExr(simulated, temporary);
                     }});
    } else if (EndsWith(name, ".csv")) {
      out.push_back(WriterOf({name, CsvOf(simulated)}));
    } else {
      auto picture = PictureFile(name, SvgOf(simulated, words));
      if (!picture) return Propagate(std::move(picture));
      out.push_back(WriterOf(*std::move(picture)));
    }
  }
  return out;
}

}  // namespace lightcal::app
