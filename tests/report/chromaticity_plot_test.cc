// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/chromaticity_plot.h"

#include <gtest/gtest.h>

#include <pugixml.hpp>
#include <sstream>
#include <string>
#include <string_view>

namespace lightcal {
namespace {

TEST(ChromaticityPlot, IsOneWellFormedPictureWithItsOwnStyle) {
  FittedColor color;
  color.xy = Xy{0.4476, 0.4074};
  const std::string svg = report::ChromaticityPlot(color);
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(svg.c_str()));
  const pugi::xml_node root = document.child("svg");
  ASSERT_TRUE(root);
  EXPECT_TRUE(root.child("style"));
  EXPECT_TRUE(root.find_node([](const pugi::xml_node& node) {
    return std::string_view(node.attribute("class").value()) == "locus";
  }));
  EXPECT_NE(svg.substr(0, 4096).find("lightcal"), std::string::npos);
}

TEST(ChromaticityPlot, OfNoColorIsEmpty) {
  EXPECT_TRUE(report::ChromaticityPlot(FittedColor{}).empty());
}

// Far off it, at u' .229, v' .032, no axis goes where no colours are.
TEST(ChromaticityPlot, OfAColorFarOffTheLocusShowsBoth) {
  FittedColor color;
  color.xy = Xy{0.16, 0.01};
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(report::ChromaticityPlot(color).c_str()));
  const auto dot = document.select_node("//circle[@class='used']").node();
  EXPECT_GT(dot.attribute("cy").as_double(), 16.0);
  EXPECT_LT(dot.attribute("cy").as_double(), 286.0);
  const std::string locus =
      document.select_node("//path[@class='locus']").node().attribute("d").value();
  bool inside = false;
  std::istringstream points(locus);
  char letter = 0;
  for (double x = 0.0, y = 0.0; points >> letter >> x;) {
    if (points.peek() == ',' || points.peek() == ' ') points.get();
    if (!(points >> y)) break;
    inside = inside || (x > 84.0 && x < 468.0 && y > 16.0 && y < 286.0);
  }
  EXPECT_TRUE(inside) << locus;
  for (const auto& tick : document.select_nodes("//text")) {
    EXPECT_FALSE(std::string_view(tick.node().text().get()).starts_with("\u2212"))
        << tick.node().text().get();
  }
}

}  // namespace
}  // namespace lightcal
