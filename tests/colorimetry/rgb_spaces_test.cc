// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/rgb_spaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "lightcal/colorimetry/planckian.h"
#include "run_cli.h"
#include "vector_file.h"

namespace lightcal {
namespace {

void ExpectMatrix(const Matrix3& ours, const nlohmann::json& truth) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_NEAR(ours[i][j], truth[i][j].get<double>(), 1e-14) << i << "," << j;
    }
  }
}

TEST(RgbSpaces, MatricesEqualTheReferenceToRounding) {
  const auto all =
      nlohmann::json::parse(test::ReadFile(test::SampleData("vectors/rgb_matrices.json")));
  ExpectMatrix(XyzFromRgbMatrix(RgbSpace::kSrgb), all["RGB_to_XYZ"]["srgb"]);
  ExpectMatrix(XyzFromRgbMatrix(RgbSpace::kRec2020), all["RGB_to_XYZ"]["rec2020"]);
  ExpectMatrix(XyzFromRgbMatrix(RgbSpace::kAcescg), all["RGB_to_XYZ"]["acescg"]);
  const auto& bradford = all["bradford_D65_to_ACESwhite_XYZ"];
  const Xy d65 = PrimariesOf(RgbSpace::kSrgb).white;
  const Xy aces = PrimariesOf(RgbSpace::kAcescg).white;
  const Xyz unit[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (std::size_t j = 0; j < 3; ++j) {
    const Xyz c = AdaptBradford(unit[j], d65, aces);
    EXPECT_NEAR(c.X, bradford[0][j].get<double>(), 1e-13);
    EXPECT_NEAR(c.Y, bradford[1][j].get<double>(), 1e-13);
    EXPECT_NEAR(c.Z, bradford[2][j].get<double>(), 1e-13);
  }
}

// SMPTE EG 432-1 / Apple's profile, seven digits.
TEST(RgbSpaces, DisplayP3HasItsPublishedMatrix) {
  const Matrix3 m = XyzFromRgbMatrix(RgbSpace::kDisplayP3);
  EXPECT_NEAR(m[0][0], 0.4865709, 1e-7);
  EXPECT_NEAR(m[1][0], 0.2289746, 1e-7);
  EXPECT_NEAR(m[1][1], 0.6917385, 1e-7);
  EXPECT_NEAR(m[2][2], 1.0439444, 1e-7);
}

TEST(RgbSpaces, WhiteIsOneOneOneAtUnitLuminance) {
  for (const RgbSpace space : kRgbSpaces) {
    const Rgb white = LinearRgbFromXyz(XyzFromXyAtUnitY(PrimariesOf(space).white), space);
    EXPECT_NEAR(white.r, 1.0, 1e-14);
    EXPECT_NEAR(white.g, 1.0, 1e-14);
    EXPECT_NEAR(white.b, 1.0, 1e-14);
    EXPECT_NEAR(LuminanceOfRgb({1, 1, 1}, space), 1.0, 1e-14);
  }
}

TEST(RgbSpaces, APrimaryHasItsOwnChromaticity) {
  for (const RgbSpace space : kRgbSpaces) {
    const RgbPrimaries p = PrimariesOf(space);
    const Xy green = XyFromXyz(XyzFromLinearRgb({0, 1, 0}, space));
    EXPECT_NEAR(green.x, p.green.x, 1e-14);
    EXPECT_NEAR(green.y, p.green.y, 1e-14);
  }
}

// The file prints twelve significant digits: half of the last one, and 1e-12 (relative above 1) of
// our own.
void ExpectPrinted(double value, double printed) {
  const double last_digit =
      printed == 0.0 ? 0.0 : std::pow(10.0, std::floor(std::log10(std::abs(printed))) - 11.0);
  EXPECT_NEAR(value, printed, 0.5 * last_digit + 1e-12 * std::max(1.0, std::abs(printed)));
}

TEST(RgbSpaces, BlackBodiesHaveTheirReferenceComponents) {
  for (const auto& row : test::ReadVectors("blackbody_rgb.csv")) {
    SCOPED_TRACE(row.Text("cct_K"));
    const Xyz c = PlanckianXyz(Kelvin(row.Number("cct_K")));
    const auto expect = [&row](const Rgb& rgb, const std::string& prefix) {
      ExpectPrinted(rgb.r, row.Number(prefix + "_R"));
      ExpectPrinted(rgb.g, row.Number(prefix + "_G"));
      ExpectPrinted(rgb.b, row.Number(prefix + "_B"));
    };
    expect(LinearSrgbFromXyz(c), "srgb");
    expect(LinearRgbFromXyz(c, RgbSpace::kRec2020), "rec2020");
    expect(LinearRgbFromXyz(c, RgbSpace::kAcescg), "acescg");
    const Xyz adapted =
        AdaptBradford(c, PrimariesOf(RgbSpace::kSrgb).white, PrimariesOf(RgbSpace::kAcescg).white);
    expect(LinearRgbFromXyz(adapted, RgbSpace::kAcescg), "acescg_bradfordD65");
    EXPECT_NEAR(LuminanceOfRgb(LinearSrgbFromXyz(c), RgbSpace::kSrgb), 1.0, 1e-13);
  }
}

TEST(RgbSpaces, ColdLightLeavesSrgbAndIsNotClamped) {
  EXPECT_LT(LinearSrgbFromXyz(PlanckianXyz(Kelvin(1850))).b, 0.0);
  EXPECT_GT(LinearSrgbFromXyz(PlanckianXyz(Kelvin(1950))).b, 0.0);
  EXPECT_LT(LinearRgbFromXyz(PlanckianXyz(Kelvin(1050)), RgbSpace::kRec2020).b, 0.0);
  EXPECT_GT(LinearRgbFromXyz(PlanckianXyz(Kelvin(1075)), RgbSpace::kRec2020).b, 0.0);
  EXPECT_GT(LinearRgbFromXyz(PlanckianXyz(Kelvin(1000)), RgbSpace::kAcescg).b, 0.0);
}

TEST(RgbSpaces, AdaptationIsUndoneByItsReverse) {
  const Xyz c{0.5, 0.4, 0.3};
  const Xy warm{0.4476, 0.4074}, cool{0.3127, 0.3290};
  const Xyz back = AdaptBradford(AdaptBradford(c, warm, cool), cool, warm);
  EXPECT_NEAR(back.X, c.X, 1e-14);
  EXPECT_NEAR(back.Y, c.Y, 1e-14);
  EXPECT_NEAR(back.Z, c.Z, 1e-14);
}

}  // namespace
}  // namespace lightcal
