// SPDX-License-Identifier: Apache-2.0
// Four measured film lights of the Academy, linear from 2 nm to 1 nm as their reference results
// are.
#include <gtest/gtest.h>

#include <string>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/colorimetry/color_fidelity.h"
#include "lightcal/colorimetry/cri.h"
#include "lightcal/colorimetry/illuminants.h"
#include "lightcal/colorimetry/rendering_input.h"
#include "lightcal/colorimetry/ssi.h"
#include "vector_file.h"

namespace lightcal {
namespace {

class FilmLight : public testing::TestWithParam<test::VectorRow> {
 protected:
  FilmLight() {
    for (const test::VectorRow& row : test::ReadSampleTable("ampas_sources/test_sources_2nm.csv")) {
      const double nm = row.Number("wavelength_nm");
      const double value = row.Number(GetParam().Text("source"));
      if (!light_.values.empty()) {
        light_.wavelengths_nm.push_back(nm - 1.0);
        light_.values.push_back((light_.values.back() + value) / 2.0);
      }
      light_.wavelengths_nm.push_back(nm);
      light_.values.push_back(value);
    }
  }
  [[nodiscard]] double Number(const std::string& column) const { return GetParam().Number(column); }
  [[nodiscard]] double SimilarityTo(const Result<Spectrum>& reference) const {
    return SpectralSimilarity(light_, reference.value()).value();
  }
  Spectrum light_;
};

TEST_P(FilmLight, HasItsExactTemperature) {
  const Xy xy = XyFromXyz(XyzFromSpectrum(light_).value());
  EXPECT_NEAR(xy.x, Number("x"), 1e-6);
  EXPECT_NEAR(xy.y, Number("y"), 1e-6);
  const CctResult cct = CctFromXy(xy);
  EXPECT_NEAR(cct.temperature.value(), Number("cct_exact"), 0.01);
  EXPECT_NEAR(cct.duv, Number("duv_exact"), 1e-6);
}

TEST_P(FilmLight, RendersColoursAsColourScienceLuxpyAndArgyllSay) {
  const RenderingInput input = PrepareRendering(light_).value();
  const ColorRendering cri = ColorRenderingOf(input);
  EXPECT_NEAR(cri.Ra, Number("Ra_colour"), 0.05);
  EXPECT_NEAR(cri.R[8], Number("R9_colour"), 0.1);
  EXPECT_NEAR(cri.Ra, Number("Ra_argyll"), 0.3);
  const ColorFidelity fidelity = ColorFidelityOf(input);
  EXPECT_NEAR(fidelity.Rf, Number("Rf_colour"), 0.01);
  EXPECT_NEAR(fidelity.Rf, Number("Rf_luxpy"), 0.01);
  EXPECT_NEAR(GamutAndBinsOf(fidelity).Rg, Number("Rg_colour"), 0.01);
}

// SSI is printed in whole numbers.
TEST_P(FilmLight, IsAsSimilarToItsReferencesAsColourScienceSays) {
  EXPECT_NEAR(SimilarityTo(IlluminantSpectrum("P3200")), Number("SSI_vs_P3200"), 0.1);
  EXPECT_NEAR(SimilarityTo(IlluminantSpectrum("D55")), Number("SSI_vs_D55"), 0.1);
  EXPECT_NEAR(SimilarityTo(IlluminantSpectrum("D65")), Number("SSI_vs_D65"), 0.1);
  EXPECT_NEAR(SimilarityTo(SimilarityReference(Kelvin(Number("cct_exact")))),
              Number("SSI_vs_same_CCT_ref"), 0.1);
}

TEST_P(FilmLight, HasTheMelanopicRatioOfLuxpy) {
  EXPECT_NEAR(MelanopicDaylightEfficacyRatio(light_).value(), Number("melanopic_DER_luxpy"), 3e-4);
}

INSTANTIATE_TEST_SUITE_P(Ampas, FilmLight,
                         testing::ValuesIn(test::ReadVectors("ampas_sources.csv")),
                         [](const auto& each) {
                           const std::string& name = each.param.Text("source");
                           return name.substr(0, name.find(' '));
                         });

}  // namespace
}  // namespace lightcal
