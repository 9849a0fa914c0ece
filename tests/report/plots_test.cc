// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/plots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <pugixml.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "lightcal/report/luminance_figure.h"
#include "lightcal/report/minutes_figure.h"
#include "lightcal/report/spectrum_figure.h"
#include "parsed_svg.h"
#include "sample_lights.h"

namespace lightcal::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// A line of 2 W m^-2 nm^-1 at 550 nm over 1 everywhere, from 300 to 900 nm.
LightSpectrum Line(SpectralQuantity quantity) {
  LightSpectrum light;
  light.light = "key";
  light.file = "lamp.csv";
  for (double nm = 300.0; nm <= 900.0; nm += 10.0) {
    light.spectrum.wavelengths_nm.push_back(nm);
    light.spectrum.values.push_back(nm == 550.0 ? 2.0 : (nm < 400.0 ? -0.5 : 1.0));
  }
  light.spectrum.quantity = quantity;
  return light;
}

std::vector<std::pair<double, double>> PointsOf(const pugi::xml_document& svg, const char* css) {
  std::string data = svg.select_node(("//path[@class='" + std::string(css) + "']").c_str())
                         .node()
                         .attribute("d")
                         .value();
  std::ranges::replace_if(data, [](char c) { return c == 'M' || c == 'L' || c == 'Z'; }, ' ');
  std::istringstream numbers(data);
  std::vector<std::pair<double, double>> points;
  for (double x = 0.0, y = 0.0; numbers >> x >> y;) points.emplace_back(x, y);
  return points;
}

// 380-780 nm lie on 84-468 px; 0 at 286 px, 1.08 times the largest at 16 px.
TEST(SpectrumFigure, PutsThePeakAtItsWavelengthAndNoiseBelowZeroAtZero) {
  const auto svg = Parsed(report::SpectrumFigure(Line(SpectralQuantity::kRelative), "s"));
  const auto points = PointsOf(svg, "outline");
  ASSERT_EQ(points.size(), 41U) << "380 to 780 nm by 10";
  EXPECT_NEAR(points.front().first, 84.0, 0.01);
  EXPECT_NEAR(points.front().second, 286.0, 0.01);
  EXPECT_NEAR(points.back().first, 468.0, 0.01);
  const auto peak = std::ranges::min_element(points, {}, &std::pair<double, double>::second);
  EXPECT_NEAR(peak->first, 84.0 + 384.0 * 170.0 / 400.0, 0.01);
  EXPECT_NEAR(peak->second, 286.0 - 270.0 / 1.08, 0.01);
}

TEST(SpectrumFigure, NamesTheUnitOfAnIrradianceOnly) {
  EXPECT_THAT(report::SpectrumFigure(Line(SpectralQuantity::kIrradiance), "s"),
              HasSubstr("mW m⁻² nm⁻¹"));
  EXPECT_THAT(report::SpectrumFigure(Line(SpectralQuantity::kRelative), "s"),
              HasSubstr("relative spectral power"));
  EXPECT_EQ(report::SpectrumFigure(LightSpectrum{}, "s"), "");
}

LuminancePicture Picture() {
  LuminancePicture picture;
  picture.light = "key";
  picture.what = "card";
  picture.width = 200;
  picture.height = 100;
  picture.scale = {report::AxisScale::kLinear, 0.0, 50.0};
  picture.image_uri = picture.scale_uri = "data:image/png;base64,AA==";
  picture.region = {{50.0, 25.0, 100.0, 50.0}};
  return picture;
}

// The picture is 356 px wide, so a pixel is 1.78.
TEST(LuminanceFigure, FramesWhatWasMeasuredAndNamesTheUnit) {
  const std::string text = report::LuminanceFigure(Picture(), "l");
  const auto svg = Parsed(text);
  const auto points = PointsOf(svg, "region");
  ASSERT_EQ(points.size(), 4U);
  EXPECT_NEAR(points[0].first, 89.0, 0.01);
  EXPECT_NEAR(points[0].second, 34.0 + 44.5, 0.01);
  EXPECT_NEAR(points[2].first, 267.0, 0.01);
  EXPECT_NEAR(points[2].second, 34.0 + 133.5, 0.01);
  EXPECT_THAT(text, HasSubstr(">cd/m²<"));
  EXPECT_EQ(report::LuminanceFigure(LuminancePicture{}, "l"), "");
}

TEST(Plots, EveryNameGivesFilesOfTheLightsThatHaveIt) {
  EXPECT_THAT(
      report::PlotNames(),
      ElementsAre("room", "distance", "residuals", "output", "cct", "output2", "cct2", "luminance",
                  "polar", "chromaticity", "spectrum", "tm30", "minutes", "match", "gate"));
  const LightFile file = FileOf({WarmPoint(), Sun()});
  ReportExtras extras;
  extras.spectra = {Line(SpectralQuantity::kRelative)};
  extras.pictures = {Picture()};
  for (const char* name : {"distance", "residuals", "luminance", "spectrum"}) {
    const auto plots = report::PlotFilesOf(name, file, extras);
    ASSERT_EQ(plots.size(), 1U) << name;
    EXPECT_EQ(plots[0].light, "key");
    EXPECT_THAT(plots[0].svg, HasSubstr("written by lightcal"));
    Parsed(plots[0].svg);
  }
  EXPECT_EQ(report::PlotFilesOf("chromaticity", file, extras).size(), 2U);
  EXPECT_EQ(report::PlotFilesOf("gate", file, extras).size(), 1U);
  EXPECT_TRUE(report::PlotFilesOf("polar", file, extras).empty());
  EXPECT_TRUE(report::PlotFilesOf("tm30", file, extras).empty()) << "no rendering is known";
  EXPECT_TRUE(report::PlotFilesOf("minutes", file, extras).empty()) << "no ladder is known";
  EXPECT_TRUE(report::PlotFilesOf("nonsense", file, extras).empty());
}

// The ordinate is the logarithm, from 0.75 times the least to 1.6 times the most.
TEST(MinutesFigure, StairsGoFromWhatIsKnownDownToWhatTheMeterLeaves) {
  MinutesLadder ladder;
  ladder.light = "key";
  ladder.u95_relative = 0.8;
  ladder.meter_u95_relative = 0.04;
  for (const double u : {0.2, 0.05}) {
    LadderStep step;
    step.reading.distance = Metres(1.0);
    step.reading.u95_relative = u;
    step.minutes = 5.0;
    step.total_minutes = 5.0 * static_cast<double>(ladder.steps.size() + 1);
    ladder.steps.push_back(step);
  }
  const auto svg = Parsed(report::MinutesPlot({&ladder, 1}));
  const auto points = PointsOf(svg, "model");
  ASSERT_EQ(points.size(), 5U) << "one level before the first step, two a step";
  EXPECT_NEAR(points[0].first, 84.0, 0.01);
  EXPECT_NEAR(points[4].first, 84.0 + (468.0 - 84.0) / 1.12, 0.01);
  const double decade = (286.0 - 16.0) / std::log10(128.0 / 3.0);
  EXPECT_NEAR(points[2].second - points[0].second, decade * std::log10(80.0 / 20.0), 0.02);
  EXPECT_NEAR(points[4].second - points[2].second, decade * std::log10(20.0 / 5.0), 0.02);
  ReportExtras extras;
  extras.ladders = {ladder};
  EXPECT_EQ(report::PlotFilesOf("minutes", FileOf({WarmPoint()}), extras).size(), 1U);
  ladder.steps.clear();
  EXPECT_EQ(report::MinutesPlot({&ladder, 1}), "");
}

}  // namespace
}  // namespace lightcal::test
