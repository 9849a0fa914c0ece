// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <pugixml.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/report/figures.h"
#include "lightcal/report/svg.h"
#include "parsed_svg.h"
#include "run_cli.h"
#include "sample_lights.h"

namespace lightcal::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::vector<FittedLight> ManyLights() {
  FittedLight evil = Spot();
  evil.name = "<script>alert(1)</script> & \"key\" \x02";
  evil.effects = {{"x<y", EffectState::kOn, 0.1, 0.05, 1.0, "a < b & c"}};
  FittedLight bare = SimpleLight("no colour", LightKind::kPoint, 12.0);
  bare.color = {};
  FittedLight single = SimpleLight("one reading", LightKind::kPoint, 48.0);
  ResidualRow row;
  row.distance_m = 0.5;
  row.measured_lx = row.predicted_lx = 192.0;
  row.sigma_relative = 0.05;
  single.residuals = {row};
  return {WarmPoint(), evil, Sun(), bare, single, FittedLight{}};
}

// Strict XML: every tag closed, every entity known, no control character.
CliResult ParseStrictly(const std::string& page) {
  const TempDir folder;
  const std::string path = folder.Write("page.html", page);
  return RunProgram({"/usr/bin/python3", "-c",
                     "import sys, xml.dom.minidom; xml.dom.minidom.parse(sys.argv[1])", path});
}

TEST(ReportPage, IsWellFormedWhateverTheLights) {
  const std::string page = ReportPage(FileOf(ManyLights()), "Stage <1> & more");
  const CliResult parsed = ParseStrictly(page);
  EXPECT_EQ(parsed.exit_code, 0) << parsed.err;
  EXPECT_EQ(ParseStrictly(page + "<p>").exit_code, 1) << "the parser must be able to fail";
}

TEST(ReportPage, NamesAreTextNeverMarkup) {
  const std::string page = ReportPage(FileOf(ManyLights()), "t");
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, HasSubstr("&lt;script&gt;alert(1)&lt;/script&gt; &amp; &quot;key&quot;"));
  EXPECT_THAT(page, HasSubstr("a &lt; b &amp; c"));
}

TEST(ReportPage, NeedsNoNetworkAndNoScript) {
  const std::string page = ReportPage(FileOf(ManyLights()), "t");
  for (const char* word : {"src=", "@import", "<link", "href=\"http", "url(http", "url(//"}) {
    EXPECT_THAT(page, Not(HasSubstr(word)));
  }
}

TEST(ReportPage, HasNoNumberThatIsNone) {
  const std::regex none("\\b(nan|inf|infinity)\\b", std::regex::icase);
  EXPECT_TRUE(std::regex_search("cx=\"-nan\"", none));
  const std::string page = ReportPage(FileOf(ManyLights()), "t");
  for (std::istringstream lines(page); lines;) {
    std::string line;
    std::getline(lines, line);
    EXPECT_FALSE(std::regex_search(line, none)) << line;
  }
}

TEST(ReportPage, SaysWhatAnArtistAndAnAuditorAsk) {
  EngineFigure figure;
  figure.light = "key";
  figure.engine = "glTF";
  figure.field = "intensity";
  figure.value = "1928.4";
  figure.unit = "cd";
  figure.note = "with its colour";
  EngineFigure others = figure;
  others.light = "other";
  others.engine = "x";
  const std::string page = ReportPage(FileOf({WarmPoint()}), "Desk lamp",
                                      {.engines = {.figures = {figure, others}, .parity = {}}});
  for (const char* words : {"Desk lamp",
                            "key",
                            "point light",
                            "4.0\u00A0%",
                            "961 … 1041\u00A0cd",
                            "from 4 of 5 readings",
                            "2700 ±\u00A035\u00A0K",
                            "370.4 mired",
                            "6.0 ±\u00A02.0\u00A0cm",
                            "behind the reference point, learned",
                            "The number to type in",
                            "<span class=\"copy\">1928.4</span> <span class=\"unit\">cd</span>",
                            "distance from the reference point (m)",
                            "illuminance (lx)",
                            "measured − model (%)",
                            "Degrees of freedom",
                            "Leave-one-out error",
                            "1.8\u00A0%",
                            "Rejected",
                            "no. 2",
                            "Effects considered",
                            "room bounce",
                            "below 1 %",
                            "Provenance",
                            "readings.jsonl",
                            "lightcal 0.1.0",
                            "2026-05-01"}) {
    EXPECT_THAT(page, HasSubstr(words));
  }
  EXPECT_THAT(page, HasSubstr(std::string(64, 'b')));
}

TEST(ReportPage, ADuvWithinItsUncertaintyIsNotCalledATint) {
  FittedLight light = WarmPoint();
  EXPECT_THAT(ReportPage(FileOf({light}), "t"), HasSubstr("greenish"));
  light.color.duv->u95 = 0.002;
  EXPECT_THAT(ReportPage(FileOf({light}), "t"), HasSubstr("on the Planckian locus"));
}

TEST(ReportPage, WithoutADegreeOfFreedomNoRmsIsClaimed) {
  EXPECT_THAT(ReportPage(FileOf({Spot()}), "t"), HasSubstr("not claimed"));
}

TEST(ReportPage, SameLightsGiveTheSameBytes) {
  EXPECT_EQ(ReportPage(FileOf(ManyLights()), "t"), ReportPage(FileOf(ManyLights()), "t"));
}

TEST(ReportPage, EveryIdIsUniqueAndEveryReferenceHasOne) {
  pugi::xml_document page;
  ASSERT_TRUE(page.load_string(ReportPage(FileOf(ManyLights()), "t").c_str()));
  std::set<std::string> ids;
  for (const auto& node : page.select_nodes("//*[@id]")) {
    EXPECT_TRUE(ids.insert(node.node().attribute("id").value()).second)
        << node.node().attribute("id").value();
  }
  for (const auto& node : page.select_nodes("//a[starts-with(@href,'#')]")) {
    EXPECT_TRUE(ids.contains(std::string(node.node().attribute("href").value()).substr(1)));
  }
}

// ---- figures ----

// Readings from 0.5 to 3 m with a quarter of room on each side: x is logarithmic from 0.4 to 3.75 m
// over the 384 px between 84 and 468.
double ExpectedX(double distance) {
  return 84.0 + 384.0 * std::log(distance / 0.4) / std::log(3.75 / 0.4);
}

TEST(DistanceFigure, PutsReadingsWhereTheirDistanceAndLuxBelong) {
  const FittedLight light = WarmPoint();
  const auto svg = Parsed(report::DistanceFigure(light, "d"));
  const auto dots = svg.select_nodes("//circle[@class='used']");
  ASSERT_EQ(dots.size(), 4U);
  EXPECT_EQ(svg.select_nodes("//path[@class='rejected']").size(), 1U);
  const double top = (1000.0 / (0.46 * 0.46) + 1.5) * 1.3;
  const double bottom = (1000.0 / (3.81 * 3.81) + 1.5) / 1.3;
  std::size_t dot = 0;
  for (const ResidualRow& row : light.residuals) {
    if (!row.used) continue;
    const auto circle = dots[dot++].node();
    EXPECT_NEAR(circle.attribute("cx").as_double(), ExpectedX(*row.distance_m), 0.0051);
    const double y = 286.0 - 270.0 * std::log(row.measured_lx / bottom) / std::log(top / bottom);
    EXPECT_NEAR(circle.attribute("cy").as_double(), y, 0.0051);
  }
}

TEST(DistanceFigure, HasNoBandWithoutACovarianceAndNoFigureWithoutReadings) {
  FittedLight light = WarmPoint();
  EXPECT_THAT(report::DistanceFigure(light, "d"), HasSubstr("class=\"band\""));
  light.covariance_lnI_d0_E0.reset();
  EXPECT_THAT(report::DistanceFigure(light, "d"), Not(HasSubstr("class=\"band\"")));
  light.residuals.clear();
  EXPECT_EQ(report::DistanceFigure(light, "d"), "");
  EXPECT_EQ(report::DistanceFigure(Sun(), "d"), "");
}

TEST(DistanceFigure, StaysInFrontOfASourceThatLiesInFrontOfTheReferencePoint) {
  FittedLight light = WarmPoint();
  light.distance_offset_m->value = -0.45;  // 5 cm in front of the nearest reading
  for (ResidualRow& row : light.residuals) row.relative = 0.0;
  const std::string svg = report::DistanceFigure(light, "d");
  EXPECT_FALSE(std::regex_search(svg, std::regex("\\b(nan|inf)\\b"))) << svg;
  EXPECT_THAT(svg, HasSubstr("class=\"model\""));
}

// Distances from 0 to 1.12 times the farthest over the 384 px from 84; E d^2 from 0 at 286 px.
TEST(RoomFigure, MultipliesByTheSquareOfTheDistanceOnTwoLinearAxes) {
  FittedLight light = WarmPoint();
  const auto svg = Parsed(report::RoomFigure(light, "w"));
  const auto dots = svg.select_nodes("//circle[@class='used']");
  ASSERT_EQ(dots.size(), 4U);
  std::size_t dot = 0;
  double unit = 0.0;
  for (const ResidualRow& row : light.residuals) {
    if (!row.used) continue;
    const auto circle = dots[dot++].node();
    const double d = *row.distance_m;
    EXPECT_NEAR(circle.attribute("cx").as_double(), 84.0 + 384.0 * d / (1.12 * 3.0), 0.0051);
    const double px = (286.0 - circle.attribute("cy").as_double()) / (row.measured_lx * d * d);
    if (unit == 0.0) unit = px;
    EXPECT_NEAR(px / unit, 1.0, 2e-4);
  }
  EXPECT_EQ(svg.select_nodes("//path[@class='wedge']").size(), 0U) << "no room is known";
  light.in_room = {
      {1.0, std::log(1000.0), 0.06, 0.0, std::log(0.12), -1.0, -0.27, 0.07, 0.0, 0.0, {}}};
  EXPECT_THAT(report::RoomFigure(light, "w"), HasSubstr("class=\"wedge\""));
  light.residuals.clear();
  EXPECT_EQ(report::RoomFigure(light, "w"), "");
}

// At 60 degrees to the lamp a meter shows half of what it shows facing it.
TEST(RoomFigure, AReadingThatWasTurnedStandsAsIfItFacedTheLamp) {
  FittedLight light = WarmPoint();
  light.residuals.erase(light.residuals.begin() + 2);  // rejected
  const auto heights = [](const FittedLight& one) {
    std::vector<std::string> out;
    const auto svg = Parsed(report::RoomFigure(one, "w"));
    for (const auto& dot : svg.select_nodes("//circle[@class='used']")) {
      out.emplace_back(dot.node().attribute("cy").value());
    }
    return out;
  };
  const auto facing = heights(light);
  EXPECT_THAT(report::RoomFigure(light, "w"), Not(HasSubstr("facing")));
  ResidualRow& row = light.residuals.front();
  row.facing_lx = row.predicted_lx;
  row.predicted_lx /= 2.0;
  row.measured_lx /= 2.0;
  EXPECT_EQ(heights(light), facing);
  EXPECT_THAT(report::RoomFigure(light, "w"), HasSubstr("lux facing the lamp"));
  EXPECT_THAT(report::DistanceFigure(light, "d"), HasSubstr("illuminance facing the lamp"));
}

TEST(RoomFigure, TheLampsNameStandsOnNoReading) {
  constexpr double kLeastCharacter = 6.0, kHeight = 11.0;  // px of its 13 px sans-serif
  for (const double part : {0.80, 0.86, 0.92, 0.96, 1.0, 1.04, 1.1}) {
    FittedLight light = WarmPoint();
    for (ResidualRow& row : light.residuals) {
      row.measured_lx = part * light.intensity_cd->value / (*row.distance_m * *row.distance_m);
    }
    const auto svg = Parsed(report::RoomFigure(light, "w"));
    const auto name = svg.select_node("//text[starts-with(., 'your lamp')]").node();
    ASSERT_TRUE(name);
    const double left = name.attribute("x").as_double(), base = name.attribute("y").as_double();
    const double right = left + kLeastCharacter * double(std::string(name.text().get()).size());
    for (const auto& found : svg.select_nodes("//circle[@class='used']")) {
      const double x = found.node().attribute("cx").as_double();
      const double y = found.node().attribute("cy").as_double();
      EXPECT_FALSE(x > left && x < right && y > base - kHeight && y < base) << part << " at " << x;
    }
  }
}

TEST(ResidualFigure, PutsPercentOnALinearAxisAndNamesWhatLiesBeyond) {
  const FittedLight light = WarmPoint();
  const std::string text = report::ResidualFigure(light, "r");
  const auto svg = Parsed(text);
  const auto dots = svg.select_nodes("//circle[@class='used']");
  ASSERT_EQ(dots.size(), 4U);
  const double half = 1.15 * (1.5 + 100.0 * kZ95 * 0.02);
  EXPECT_NEAR(dots[0].node().attribute("cx").as_double(), ExpectedX(0.5), 0.0051);
  EXPECT_NEAR(dots[0].node().attribute("cy").as_double(), 151.0 - 135.0 * 1.0 / half, 0.0051);
  EXPECT_NEAR(dots[1].node().attribute("cy").as_double(), 151.0 + 135.0 * 1.5 / half, 0.0051);
  EXPECT_THAT(text, HasSubstr("+35.0\u00A0% ↑"));
}

TEST(ChromaticityFigure, HasTheLightInTheMiddleAndOneScaleOnBothAxes) {
  const auto svg = Parsed(report::ChromaticityFigure(WarmPoint(), "c"));
  const auto dot = svg.select_node("//circle[@class='used']").node();
  EXPECT_NEAR(dot.attribute("cx").as_double(), 276.0, 0.01);
  EXPECT_NEAR(dot.attribute("cy").as_double(), 151.0, 0.01);
  EXPECT_EQ(svg.select_nodes("//path[@class='ellipse']").size(), 1U);
  FittedLight colorless = WarmPoint();
  colorless.color = {};
  EXPECT_EQ(report::ChromaticityFigure(colorless, "c"), "");
}

// The ellipse's extent along v' from the Duv interval alone, re-derived from UvFromCct.
TEST(ChromaticityFigure, TheEllipseSpansTheIntervals) {
  const auto svg = Parsed(report::ChromaticityFigure(WarmPoint(), "c"));
  std::istringstream data(
      svg.select_node("//path[@class='ellipse']").node().attribute("d").value());
  std::string path = data.str();
  std::ranges::replace_if(path, [](char c) { return c == 'M' || c == 'L' || c == 'Z'; }, ' ');
  std::istringstream numbers(path);
  double low_u = 1e9;
  double high_u = -1e9;
  for (double x = 0.0, y = 0.0; numbers >> x >> y;) {
    low_u = std::min(low_u, x);
    high_u = std::max(high_u, x);
  }
  const double px_per_unit = 270.0 / 0.09;
  const double expected =
      (UvFromCct(Kelvin(2665.0), 0.001).u - UvFromCct(Kelvin(2735.0), 0.001).u) * px_per_unit;
  EXPECT_NEAR(high_u - low_u, expected, 0.12 * expected);
}

// Text width is at most 0.62 em a character in the common sans-serif faces.
TEST(Figures, NoLabelLeavesTheFigureOrTouchesAnother) {
  for (const FittedLight& light : ManyLights()) {
    for (const std::string& figure :
         {report::DistanceFigure(light, "a"), report::ResidualFigure(light, "b"),
          report::ChromaticityFigure(light, "c")}) {
      if (figure.empty()) continue;
      const auto svg = Parsed(figure);
      double last_right = -1e9;
      double last_y = -1e9;
      for (const auto& found : svg.select_nodes("//text[@class='tick'][@text-anchor='middle']")) {
        const auto text = found.node();
        const std::string label = text.child_value();
        const auto characters = static_cast<double>(std::ranges::count_if(
            label, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
        const double half = 0.62 * 14.0 * characters / 2.0;
        const double x = text.attribute("x").as_double();
        EXPECT_LE(x + half, report::kFigureWidth + 8.0) << label;
        if (text.attribute("y").as_double() == last_y) {
          EXPECT_GT(x - half, last_right) << label;
        }
        last_right = x + half;
        last_y = text.attribute("y").as_double();
      }
    }
  }
}

}  // namespace
}  // namespace lightcal::test
