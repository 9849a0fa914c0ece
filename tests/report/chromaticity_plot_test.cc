// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/chromaticity_plot.h"

#include <gtest/gtest.h>

#include <pugixml.hpp>
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

}  // namespace
}  // namespace lightcal
