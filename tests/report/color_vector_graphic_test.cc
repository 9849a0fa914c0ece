// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/color_vector_graphic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <pugixml.hpp>
#include <string>

#include "lightcal/colorimetry/illuminants.h"
#include "lightcal/colorimetry/rendering_input.h"

namespace lightcal::report {
namespace {

struct Drawn {
  explicit Drawn(const std::string& name, const std::string& title = "a lamp")
      : fidelity(ColorFidelityOf(PrepareRendering(IlluminantSpectrum(name).value()).value())),
        gamut(GamutAndBinsOf(fidelity)) {
    const std::string text = ColorVectorGraphic(fidelity, gamut, title);
    const auto parsed = svg.load_string(text.c_str());
    EXPECT_TRUE(parsed) << parsed.description();
    EXPECT_EQ(text.find("nan"), std::string::npos);
  }
  // The arrows.
  [[nodiscard]] pugi::xpath_node_set Arrows() const {
    return svg.select_nodes("//line[@class='shift']");
  }

  ColorFidelity fidelity;
  GamutAndBins gamut;
  pugi::xml_document svg;
};

TEST(ColorVectorGraphic, AnArrowLeavesTheCircleInEveryBin) {
  const Drawn drawn("FL4");
  ASSERT_EQ(drawn.Arrows().size(), 16u);
  for (const auto& arrow : drawn.Arrows()) {
    const pugi::xml_node line = arrow.node();
    EXPECT_NEAR(std::hypot(line.attribute("x1").as_double() - 240.0,
                           line.attribute("y1").as_double() - 240.0),
                150.0, 0.02);
  }
}

// An arrow's length is the bin's shift relative to the reference chroma, as Rcs and Rhs have it.
TEST(ColorVectorGraphic, AnArrowIsAsLongAsTheBinsShift) {
  const Drawn drawn("FL4");
  const auto arrows = drawn.Arrows();
  for (std::size_t i = 0; i < arrows.size(); ++i) {
    const pugi::xml_node line = arrows[i].node();
    const double dx = line.attribute("x2").as_double() - line.attribute("x1").as_double();
    const double dy = line.attribute("y2").as_double() - line.attribute("y1").as_double();
    const HueBin& bin = drawn.gamut.bins[i];
    EXPECT_NEAR(std::hypot(dx, dy) / 150.0, std::hypot(bin.chroma_shift, bin.hue_shift_rad), 2e-4)
        << i;
  }
}

TEST(ColorVectorGraphic, AReferenceLightsArrowsHaveNoLength) {
  const Drawn drawn("P3000");
  for (const auto& arrow : drawn.Arrows()) {
    const pugi::xml_node line = arrow.node();
    EXPECT_NEAR(line.attribute("x1").as_double(), line.attribute("x2").as_double(), 0.011);
    EXPECT_NEAR(line.attribute("y1").as_double(), line.attribute("y2").as_double(), 0.011);
  }
}

TEST(ColorVectorGraphic, ANameWithMarkupStaysText) {
  const Drawn drawn("LED-B3", "<b>&\"lamp\"");
  EXPECT_STREQ(drawn.svg.select_node("/svg/title").node().text().get(),
               "Colour vector graphic of <b>&\"lamp\"");
}

}  // namespace
}  // namespace lightcal::report
