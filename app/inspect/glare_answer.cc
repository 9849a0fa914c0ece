// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "console.h"
#include "inspect/glare_words.h"
#include "lightcal/colorimetry/srgb_encoding.h"
#include "lightcal/core/numbers_text.h"
#include "picture_file.h"
#include "raster_png.h"

namespace lightcal::app {
namespace {

constexpr int kGlareDigits = 5;
constexpr std::size_t kMostRows = 12;  // of sources, in the table
constexpr int kNamedSources = 3;       // in the picture: with their luminance

double AzimuthDegrees(const Vec3& d) { return DegreesFromRadians(Radians(std::atan2(d[0], d[1]))); }
double ElevationDegrees(const Vec3& d) {
  return DegreesFromRadians(Radians(std::asin(std::clamp(d[2], -1.0, 1.0))));
}

Node IntervalNode(const Uncertain& value) {
  return {{"value", value.value}, {"low95", value.low}, {"high95", value.high}};
}
Node IntervalNode(const std::optional<Uncertain>& value) {
  return value ? IntervalNode(*value) : Node();
}

Node SourceNode(const FoundGlareSource& found) {
  return {{"luminance_nits", found.source.luminance},
          {"solid_angle_sr", found.source.solid_angle},
          {"azimuth_deg", AzimuthDegrees(found.direction)},
          {"elevation_deg", ElevationDegrees(found.direction)},
          {"position_index", found.source.position_index},
          {"illuminance_lx", found.vertical},
          {"max_nits", found.max},
          {"pixels", found.pixels},
          {"x", found.at[0]},
          {"y", found.at[1]}};
}

std::string IntervalText(const Uncertain& value, int decimals_of) {
  return RoundedText(*value.low, decimals_of) + " … " + RoundedText(*value.high, decimals_of);
}

// What people say of a DGP.   Source: Wienold, Dynamic daylight glare evaluation (2009), table 4.
std::string DgpWord(double dgp) {
  if (dgp <= 0.35) return "imperceptible";
  if (dgp <= 0.40) return "perceptible";
  return dgp <= 0.45 ? "disturbing" : "intolerable";
}

std::string CsvOfGlare(const PictureGlare& glare) {
  std::string out = "# written by " + GeneratorName() +
                    ": glare sources\nsource,luminance_cd_m2,solid_angle_sr,azimuth_deg,"
                    "elevation_deg,position_index,illuminance_lx,max_cd_m2,pixels\n";
  int number = 0;
  for (const FoundGlareSource& found : glare.sources) {
    out += std::to_string(++number);
    for (const double v :
         {found.source.luminance.value(), found.source.solid_angle.value(),
          AzimuthDegrees(found.direction), ElevationDegrees(found.direction),
          found.source.position_index, found.vertical.value(), found.max.value()}) {
      out += "," + RoundedText(v, 6);
    }
    out += "," + std::to_string(found.pixels) + "\n";
  }
  return out;
}

// Colours that grey tells apart, round and round.
constexpr std::array<std::array<double, 3>, 6> kSourceColors = {{{1.0, 0.25, 0.2},
                                                                 {1.0, 0.82, 0.25},
                                                                 {0.3, 0.75, 1.0},
                                                                 {0.5, 0.9, 0.4},
                                                                 {0.85, 0.5, 1.0},
                                                                 {1.0, 0.6, 0.2}}};

// Half the threshold is middle grey; what is over it rolls off.
std::string PaintedPicture(const InspectedPicture& inspected, const PictureGlare& glare) {
  const auto& nits = inspected.luminance.nits;
  const double exposure = 0.36 / std::max(glare.threshold.value(), 1e-9);
  std::vector<std::uint8_t> rgb;
  rgb.reserve(3 * nits.size());
  for (std::size_t i = 0; i < nits.size(); ++i) {
    const double l = std::isnan(nits[i]) ? 0.0 : std::max(0.0, double{nits[i]});
    const double grey = 1.0 - std::exp(-exposure * l);
    const int source = glare.source_of[i];
    for (std::size_t c = 0; c < 3; ++c) {
      double shown = grey;
      if (source > 0) {
        const auto& color = kSourceColors[static_cast<std::size_t>(source - 1) % 6];
        shown = color[c] * (0.35 + 0.65 * grey);
      }
      rgb.push_back(static_cast<std::uint8_t>(std::lround(255.0 * SrgbEncoded(shown))));
    }
  }
  return PngUri({rgb.data(), inspected.luminance.width, inspected.luminance.height, 3});
}

std::string GlarePx(double v) { return RoundedText(v, 6); }

std::string GlareLabel(double x, double y, double size, const std::string& text, bool left) {
  std::string svg;
  for (const auto& [color, stroke] : {std::pair{"#000", size / 4.0}, std::pair{"#fff", 0.0}}) {
    svg += "<text x=\"" + GlarePx(x) + "\" y=\"" + GlarePx(y) + "\" text-anchor=\"" +
           (left ? "end" : "start") + "\" fill=\"" + color + "\" stroke=\"" + color +
           "\" stroke-width=\"" + GlarePx(stroke) +
           "\" stroke-linejoin=\"round\" font-family=\"sans-serif\" font-size=\"" + GlarePx(size) +
           "\">" + text + "</text>\n";
  }
  return svg;
}

}  // namespace

records::Node GlareNode(const GlareAnswer& answer) {
  const PictureGlare& glare = answer.glare;
  double lux = 0.0, solid_angle = 0.0;
  for (const FoundGlareSource& found : glare.sources) {
    solid_angle += found.source.solid_angle.value();
    lux += found.source.luminance.value() * found.source.solid_angle.value();
  }
  return {{"ev_lx", glare.vertical.value},
          {"ev_low95_lx", glare.vertical.low},
          {"ev_high95_lx", glare.vertical.high},
          {"ev_source", answer.ev_stated ? "stated" : "picture"},
          {"ev_of_picture_lx", glare.vertical_of_picture},
          {"ev_direct_lx", glare.light.direct},
          {"background_nits", glare.background},
          {"mean_nits", glare.mean},
          {"threshold_nits", glare.threshold},
          {"task_nits", glare.task},
          {"dgp", IntervalNode(glare.dgp)},
          {"ugr", IntervalNode(glare.ugr)},
          {"ugr_threshold_nits", glare.ugr_threshold},
          {"brightest_nits", glare.brightest},
          {"dgi", IntervalNode(glare.dgi)},
          {"cgi", IntervalNode(glare.cgi)},
          {"scale_u95_relative", answer.scale_u95},
          {"scale_u95_source", answer.scale_source},
          {"sources_solid_angle_sr", solid_angle},
          {"sources_luminance_nits", solid_angle > 0.0 ? Node(lux / solid_angle) : Node()},
          {"sources", Node::List(glare.sources, SourceNode)}};
}

std::string GlareTable(const GlareAnswer& answer) {
  const PictureGlare& glare = answer.glare;
  const auto row = [](const char* name, const Uncertain& v, int digits, std::string unit) {
    return std::vector<std::string>{name, RoundedText(v.value, digits), IntervalText(v, digits),
                                    std::move(unit)};
  };
  std::vector<std::vector<std::string>> rows = {
      row("illuminance at the eye, Ev", glare.vertical, kGlareDigits,
          answer.ev_stated ? "lx, stated" : "lx"),
      row("daylight glare probability, DGP", glare.dgp, 3, DgpWord(glare.dgp.value))};
  if (glare.ugr) rows.push_back(row("unified glare rating, UGR", *glare.ugr, 3, ""));
  if (glare.dgi) rows.push_back(row("daylight glare index, DGI", *glare.dgi, 3, ""));
  if (glare.cgi) rows.push_back(row("CIE glare index, CGI", *glare.cgi, 3, ""));
  rows.push_back({"background", RoundedText(glare.background.value(), kGlareDigits), "", "cd/m²"});
  if (glare.task) rows.push_back({"task", RoundedText(glare.task->value(), 5), "", "cd/m²"});
  std::string out = TextTable({"glare", "value", "95 %", ""}, rows);
  out += glare.sources.empty() ? "no source above " : "sources above ";
  out += RoundedText(glare.threshold.value(), 4) + " cd/m²; cd/m² are taken as sure to ± " +
         PercentText(answer.scale_u95) +
         (answer.scale_source == "assumed" ? " (nobody says: --scale-u95)\n" : "\n");
  if (glare.ugr_threshold) {
    out += "UGR is by what is above " + RoundedText(glare.ugr_threshold->value(), 4) +
           " cd/m², 5 times the mean (-b 5 names the sources)\n";
  } else if (glare.brightest) {
    out += "no UGR: nothing is above 5 times the mean (" + RoundedText(glare.mean.value(), 4) +
           " cd/m²) either; the brightest is " + RoundedText(glare.brightest->value(), 4) +
           " cd/m²: -b says from where on it counts\n";
  }
  if (glare.sources.empty()) return out;
  rows.clear();
  for (const FoundGlareSource& found : glare.sources) {
    if (rows.size() == kMostRows) break;
    rows.push_back({std::to_string(rows.size() + 1), RoundedText(found.source.luminance.value(), 4),
                    RoundedText(found.source.solid_angle.value(), 3),
                    RoundedText(AzimuthDegrees(found.direction), 3),
                    RoundedText(ElevationDegrees(found.direction), 3),
                    RoundedText(found.source.position_index, 3),
                    RoundedText(found.vertical.value(), 4)});
  }
  out += TextTable({"source", "cd/m²", "sr", "° right", "° up", "position index", "lx"}, rows);
  if (glare.sources.size() > kMostRows) {
    out += "and " + std::to_string(glare.sources.size() - kMostRows) + " weaker ones\n";
  }
  return out;
}

std::string GlareSvg(const InspectedPicture& inspected, const GlareAnswer& answer) {
  const PictureGlare& glare = answer.glare;
  const int width = inspected.luminance.width, height = inspected.luminance.height;
  const std::string size =
      " width=\"" + std::to_string(width) + "\" height=\"" + std::to_string(height);
  std::string svg =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\"" +
      size + "\" viewBox=\"0 0 " + std::to_string(width) + " " + std::to_string(height) +
      "\">\n<!-- written by lightcal -->\n<image" + size + "\" xlink:href=\"" +
      PaintedPicture(inspected, glare) + "\"/>\n";
  const double letter = std::max(9.0, std::min(width, height) / 36.0);
  int number = 0;
  for (const FoundGlareSource& found : glare.sources) {
    if (++number > static_cast<int>(kMostRows)) break;
    const bool left = found.at[0] > 0.7 * width;
    svg += GlareLabel(found.at[0] + (left ? -letter / 2.0 : letter / 2.0),
                      std::clamp(found.at[1] + letter / 3.0, letter, height - letter / 3.0), letter,
                      number > kNamedSources
                          ? std::to_string(number)
                          : std::to_string(number) + ": " +
                                RoundedText(found.source.luminance.value(), 2) + " cd/m²",
                      left);
  }
  svg += GlareLabel(
      letter / 2.0, 1.2 * letter, letter,
      "DGP " + RoundedText(glare.dgp.value, 2) + " (" + IntervalText(glare.dgp, 2) + ")", false);
  svg += GlareLabel(letter / 2.0, 2.4 * letter, letter,
                    "Ev " + RoundedText(glare.vertical.value, 3) + " lx" +
                        (glare.ugr ? ", UGR " + RoundedText(glare.ugr->value, 3) : ""),
                    false);
  return svg + "</svg>\n";
}

Result<void> WriteGlare(const GlareWords& words, const InspectedPicture& inspected,
                        const GlareAnswer& answer) {
  std::vector<OutputFile> files;
  for (const std::string& path : words.outputs) {
    if (LowerAscii(path).ends_with(".csv")) {
      files.push_back({path, CsvOfGlare(answer.glare)});
      continue;
    }
    auto file = PictureFile(path, GlareSvg(inspected, answer));
    if (!file) return Propagate(std::move(file));
    files.push_back(std::move(*file));
  }
  return WriteOutputs(files, words.force);
}

}  // namespace lightcal::app
