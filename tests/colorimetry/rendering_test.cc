// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "lightcal/colorimetry/color_fidelity.h"
#include "lightcal/colorimetry/cri.h"
#include "lightcal/colorimetry/daylight.h"
#include "lightcal/colorimetry/illuminants.h"
#include "lightcal/colorimetry/rendering_input.h"
#include "lightcal/colorimetry/ssi.h"
#include "vector_file.h"

namespace lightcal {
namespace {

using test::ReadVectors;
using test::VectorRow;

RenderingInput Prepared(const Spectrum& s) { return PrepareRendering(s).value(); }

Spectrum EveryNanometre(const Spectrum& coarse) {
  Spectrum fine;
  for (std::size_t i = 1; i < coarse.values.size(); ++i) {
    const double a = coarse.wavelengths_nm[i - 1];
    const double b = coarse.wavelengths_nm[i];
    for (double nm = a; nm < b; nm += 1.0) {
      fine.wavelengths_nm.push_back(nm);
      fine.values.push_back(coarse.values[i - 1] +
                            (coarse.values[i] - coarse.values[i - 1]) * (nm - a) / (b - a));
    }
  }
  fine.wavelengths_nm.push_back(coarse.wavelengths_nm.back());
  fine.values.push_back(coarse.values.back());
  return fine;
}

// ---- Against colour-science, luxpy and Argyll ----

class RenderedIlluminant : public testing::TestWithParam<VectorRow> {
 protected:
  [[nodiscard]] double Number(const std::string& column) const { return GetParam().Number(column); }
  [[nodiscard]] RenderingInput Input() const { return Prepared(Light(GetParam().Text("name"))); }
};

// luxpy sums the 5 nm table, from R_i rounded to whole numbers; colour-science and Argyll make it
// linear to 1 nm first. Each program is met on its own grid, and from the 5 nm sum, which lightcal
// answers with, too: all but Argyll's Ra of HP1 (sodium lines, 0.63 away; 0.2 on its own grid).
TEST_P(RenderedIlluminant, RaAndR9AreThoseOfThreePrograms) {
  const Spectrum light = Light(GetParam().Text("name"));
  const ColorRendering table = ColorRenderingOf(Prepared(light));
  EXPECT_NEAR(table.Ra, Number("Ra_luxpy"), 0.5);
  EXPECT_NEAR(table.R[8], Number("R9_luxpy"), 0.5);
  EXPECT_NEAR(table.R[14], Number("R15_luxpy_JIS"), 0.5);
  EXPECT_NEAR(table.Ra, Number("Ra_colour"), 0.5);
  EXPECT_NEAR(table.R[8], Number("R9_colour"), 2.1);
  EXPECT_NEAR(table.Ra, Number("Ra_argyll"), GetParam().Text("name") == "HP1" ? 0.7 : 0.5);
  EXPECT_NEAR(table.R[8], Number("R9_argyll"), 2.1);
  const ColorRendering fine = ColorRenderingOf(Prepared(EveryNanometre(light)));
  EXPECT_NEAR(fine.Ra, Number("Ra_argyll"), 0.3);
  EXPECT_NEAR(fine.R[8], Number("R9_argyll"), 1.0);
  EXPECT_NEAR(fine.Ra, Number("Ra_colour"), 0.3);
  for (std::size_t i = 0; i < 14; ++i) {
    EXPECT_NEAR(fine.R[i], Number("R" + std::to_string(i + 1) + "_colour"), 1.0) << i + 1;
  }
}

// What the 5 nm tables lose of CIE's own 1 nm tables of the same 36 lamps, by either way of reading
// them: the plain sum is the nearer one.
TEST(ColorRendering, TheFiveNanometreSumIsNearerToTheOneNanometreTableThanInterpolation) {
  const auto rows = test::ReadSampleTable("cie_lamps/cie_lamps_1nm.csv");
  double sum_ra = 0.0, sum_r9 = 0.0, sum_rf = 0.0, linear_ra = 0.0, linear_r9 = 0.0,
         linear_rf = 0.0;
  for (const auto& [name, ignored] : rows.front().cells()) {
    if (name == "wavelength_nm") continue;
    Spectrum lines;
    for (const VectorRow& row : rows) {
      lines.wavelengths_nm.push_back(row.Number("wavelength_nm"));
      lines.values.push_back(row.Number(name));
    }
    const auto off = [&](const Spectrum& read, double& ra, double& r9, double& rf) {
      const ColorRendering truth = ColorRenderingOf(Prepared(lines));
      const ColorRendering cri = ColorRenderingOf(Prepared(read));
      ra += std::abs(cri.Ra - truth.Ra);
      r9 += std::abs(cri.R[8] - truth.R[8]);
      rf += std::abs(ColorFidelityOf(Prepared(read)).Rf - ColorFidelityOf(Prepared(lines)).Rf);
    };
    off(IlluminantSpectrum(name).value(), sum_ra, sum_r9, sum_rf);
    off(EveryNanometre(IlluminantSpectrum(name).value()), linear_ra, linear_r9, linear_rf);
  }
  EXPECT_LT(sum_ra / 36, 0.03);
  EXPECT_LT(sum_r9 / 36, 0.07);
  EXPECT_LT(sum_rf / 36, 0.04);
  EXPECT_GT(linear_ra, 2.0 * sum_ra);
  EXPECT_GT(linear_r9, 4.0 * sum_r9);
  EXPECT_GT(linear_rf, 3.0 * sum_rf);
}

TEST_P(RenderedIlluminant, RfAndRgAreThoseOfTwoPrograms) {
  const ColorFidelity fidelity = ColorFidelityOf(Input());
  const GamutAndBins gamut = GamutAndBinsOf(fidelity);
  EXPECT_NEAR(fidelity.Rf, Number("Rf_cie224_colour"), 0.01);
  EXPECT_NEAR(fidelity.Rf, Number("Rf_tm30_20_luxpy_5nm"), 0.01);
  EXPECT_NEAR(gamut.Rg, Number("Rg_tm30_colour"), 0.01);
  EXPECT_NEAR(gamut.Rg, Number("Rg_tm30_20_luxpy_5nm"), 0.01);
}

TEST_P(RenderedIlluminant, SsiIsThatOfColourScience) {
  const Spectrum light = Light(GetParam().Text("name"));
  const auto reference = SimilarityReference(Kelvin(Number("cct_exact_1nm")));
  EXPECT_NEAR(SpectralSimilarity(light, reference.value()).value(), Number("SSI_vs_ref_colour"),
              0.05);
}

INSTANTIATE_TEST_SUITE_P(Cie, RenderedIlluminant, testing::ValuesIn(ReadVectors("illuminants.csv")),
                         [](const auto& each) {
                           std::string name = each.param.Text("name");
                           std::ranges::replace_if(
                               name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
                           return name;
                         });

// ---- Published values ----

// CIE 15:2004, table T.8.2, whole numbers.
TEST(ColorRendering, HasTheIndicesCie15Prints) {
  for (const VectorRow& row : ReadVectors("cri_cie15_published.csv")) {
    const ColorRendering cri = ColorRenderingOf(Prepared(Light(row.Text("illuminant"))));
    for (std::size_t i = 0; i < 14; ++i) {
      EXPECT_NEAR(cri.R[i], row.Number("R" + std::to_string(i + 1)), 1.0)
          << row.Text("illuminant") << " R" << i + 1;
    }
  }
}

// IES TM-30 calculator for F12, whose 5 nm table it takes linear to 1 nm.
class Tm30OfF12 : public testing::Test {
 protected:
  const ColorFidelity fidelity_ =
      ColorFidelityOf(Prepared(EveryNanometre(IlluminantSpectrum("FL12").value())));
};

TEST_F(Tm30OfF12, SampleColoursAreThePrintedOnes) {
  const auto rows = ReadVectors("tm30_f12_ies_calculator.csv");
  ASSERT_EQ(rows.size(), 99u);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    SCOPED_TRACE(i + 1);
    EXPECT_NEAR(fidelity_.test[i].J, rows[i].Number("J_test"), 0.0055);
    EXPECT_NEAR(fidelity_.test[i].a, rows[i].Number("a_test"), 0.0055);
    EXPECT_NEAR(fidelity_.test[i].b, rows[i].Number("b_test"), 0.0055);
    EXPECT_NEAR(fidelity_.reference[i].J, rows[i].Number("J_ref"), 0.0055);
    EXPECT_NEAR(fidelity_.reference[i].a, rows[i].Number("a_ref"), 0.0055);
    EXPECT_NEAR(fidelity_.reference[i].b, rows[i].Number("b_ref"), 0.0055);
  }
}

TEST_F(Tm30OfF12, RfRgAndBinsAreThePrintedOnes) {
  const GamutAndBins gamut = GamutAndBinsOf(fidelity_);
  EXPECT_NEAR(fidelity_.Rf, 77.667, 0.001);
  EXPECT_NEAR(gamut.Rg, 102.414, 0.001);
  const auto rows = ReadVectors("tm30_f12_ies_bins.csv");
  ASSERT_EQ(rows.size(), 16u);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    SCOPED_TRACE(i + 1);
    EXPECT_NEAR(gamut.bins[i].Rf, rows[i].Number("Rf_hj"), 0.0015);
    EXPECT_NEAR(gamut.bins[i].chroma_shift, rows[i].Number("Rcs_hj_fraction"), 1e-4);
    EXPECT_NEAR(gamut.bins[i].hue_shift_rad, rows[i].Number("Rhs_hj_rad"), 1e-4);
  }
}

// ---- Closed forms ----

// A light that is its own reference is rendered perfectly: 10 ln(1 + e^10) exceeds 100 by 4.5e-4.
TEST(ColorRendering, AReferenceLightScoresOneHundred) {
  for (const double kelvin : {2000.0, 2856.0, 3999.0}) {
    const RenderingInput input = Prepared(BlackBodySpectrum(Kelvin(kelvin)).value());
    const ColorFidelity fidelity = ColorFidelityOf(input);
    EXPECT_NEAR(ColorRenderingOf(input).Ra, 100.0, 1e-3) << kelvin;
    EXPECT_NEAR(ColorRenderingOf(input).R[14], 100.0, 2e-3) << kelvin;
    EXPECT_NEAR(fidelity.Rf, 10.0 * std::log1p(std::exp(10.0)), 1e-3) << kelvin;
    EXPECT_NEAR(GamutAndBinsOf(fidelity).Rg, 100.0, 1e-3) << kelvin;
    EXPECT_LT(ColorRenderingOf(input).chromaticity_difference, 1e-9) << kelvin;
  }
}

// Daylight of 6504 K has a CCT of 6502.7 K: nearly its own reference.
TEST(ColorRendering, DaylightIsRenderedAsDaylight) {
  const RenderingInput input = Prepared(IlluminantSpectrum("D65").value());
  EXPECT_GT(ColorRenderingOf(input).Ra, 99.9);
  EXPECT_GT(ColorFidelityOf(input).Rf, 99.9);
}

TEST(ColorRendering, TheScaleOfASpectrumDoesNotMatter) {
  Spectrum light = IlluminantSpectrum("FL4").value();
  const ColorRendering before = ColorRenderingOf(Prepared(light));
  for (double& value : light.values) value *= 1e-6;
  const ColorRendering after = ColorRenderingOf(Prepared(light));
  EXPECT_NEAR(before.Ra, after.Ra, 1e-9);
  EXPECT_NEAR(before.R[8], after.R[8], 1e-9);
}

// CIE 224 mixes its references from 4000 to 5000 K, so Rf does not jump as Ra does.
TEST(ColorFidelity, TheReferenceMovesWithoutAStepFromBlackBodyToDaylight) {
  for (const double kelvin : {4000.0, 5000.0}) {
    const auto rf = [](double t) {
      return ColorFidelityOf(Prepared(BlackBodySpectrum(Kelvin(t)).value())).Rf;
    };
    EXPECT_NEAR(rf(kelvin - 0.01), rf(kelvin + 0.01), 0.01) << kelvin;
  }
  const auto ra = [](double t) {
    return ColorRenderingOf(Prepared(BlackBodySpectrum(Kelvin(t)).value())).Ra;
  };
  EXPECT_GT(ra(4999.99) - ra(5000.01), 1.0);
}

TEST(ColorFidelity, NoIndexIsBelowZeroAndEverySampleHasABin) {
  const ColorFidelity fidelity = ColorFidelityOf(Prepared(IlluminantSpectrum("HP1").value()));
  const GamutAndBins gamut = GamutAndBinsOf(fidelity);
  int samples = 0;
  for (const HueBin& bin : gamut.bins) samples += bin.samples;
  EXPECT_EQ(samples, 99);
  for (const double rf : fidelity.sample_Rf) EXPECT_GE(rf, 0.0);
}

// ---- Grids ----

// An instrument's grid that starts between whole nanometres sees the same light.
TEST(RenderingInput, AGridBetweenTheTablesRowsGivesTheSameIndices) {
  const auto led = [](double nm) {
    const auto hump = [nm](double centre, double width) {
      const double z = (nm - centre) / width;
      return std::exp(-0.5 * z * z);
    };
    return 0.6 * hump(455, 12) + hump(590, 60);
  };
  const auto sampled = [&](double first, double step) {
    Spectrum s;
    for (double nm = first; nm <= 800.0; nm += step) {
      s.wavelengths_nm.push_back(nm);
      s.values.push_back(led(nm));
    }
    return Prepared(s);
  };
  const RenderingInput truth = sampled(360.0, 1.0);
  for (const auto& [first, step] : std::vector<std::pair<double, double>>{
           {360.37, 1.0}, {360.0, 0.5}, {361.3, 3.3}, {360.0, 5.0}}) {
    SCOPED_TRACE(step);
    const RenderingInput other = sampled(first, step);
    EXPECT_NEAR(ColorRenderingOf(other).Ra, ColorRenderingOf(truth).Ra, 0.05);
    EXPECT_NEAR(ColorFidelityOf(other).Rf, ColorFidelityOf(truth).Rf, 0.05);
  }
}

TEST(RenderingInput, UnequalStepsAreLinearBetweenTheirSamples) {
  Spectrum sparse = IlluminantSpectrum("FL2").value();
  const RenderingInput fine = Prepared(EveryNanometre(sparse));
  // A point in the middle of a straight line changes nothing but makes the steps unequal.
  sparse.wavelengths_nm.insert(sparse.wavelengths_nm.begin() + 1, 382.0);
  sparse.values.insert(sparse.values.begin() + 1,
                       sparse.values[0] + 0.4 * (sparse.values[1] - sparse.values[0]));
  ASSERT_FALSE(HasEqualSteps(sparse));
  const RenderingInput unequal = Prepared(sparse);
  EXPECT_NEAR(ColorRenderingOf(unequal).Ra, ColorRenderingOf(fine).Ra, 0.01);
  EXPECT_NEAR(ColorFidelityOf(unequal).Rf, ColorFidelityOf(fine).Rf, 0.01);
}

TEST(RenderingInput, WhatCannotBeJudgedIsRefused) {
  const auto flat = [](double first, double last, double step) {
    Spectrum s;
    for (double nm = first; nm <= last; nm += step) {
      s.wavelengths_nm.push_back(nm);
      s.values.push_back(1.0);
    }
    return PrepareRendering(s);
  };
  EXPECT_TRUE(flat(400, 700, 10).has_value());
  EXPECT_EQ(flat(420, 700, 5).error().code, "truncated_spectrum");
  EXPECT_EQ(flat(400, 660, 5).error().code, "truncated_spectrum");
  EXPECT_EQ(flat(380, 780, 25).error().code, "coarse_spectrum");
  EXPECT_EQ(flat(380, 380, 5).error().code, "bad_spectrum");
  Spectrum red = IlluminantSpectrum("E").value();
  for (std::size_t i = 0; i < red.values.size(); ++i) {
    red.values[i] = red.wavelengths_nm[i] < 650.0 ? 0.0 : 1.0;
  }
  EXPECT_EQ(PrepareRendering(red).error().code, "no_reference");
}

// Dim readings are noisy and partly negative: refused, or finite throughout.
TEST(RenderingInput, NoiseNeverMakesAnIndexThatIsNoNumber) {
  std::mt19937 random(5);
  int judged = 0, refused = 0;
  for (int trial = 0; trial < 400; ++trial) {
    std::normal_distribution<double> noise(0.0, 0.01 * (trial % 100));
    Spectrum light = Light(trial % 2 == 0 ? "LED-B1" : "HP1");
    for (double& value : light.values) value = value / 100.0 + noise(random);
    const auto input = PrepareRendering(light);
    refused += input ? 0 : 1;
    if (!input) continue;
    ++judged;
    const ColorRendering cri = ColorRenderingOf(*input);
    const ColorFidelity fidelity = ColorFidelityOf(*input);
    const GamutAndBins gamut = GamutAndBinsOf(fidelity);
    for (const double r : cri.R) ASSERT_TRUE(std::isfinite(r)) << trial;
    for (const double rf : fidelity.sample_Rf) ASSERT_TRUE(std::isfinite(rf)) << trial;
    ASSERT_TRUE(std::isfinite(cri.Ra + fidelity.Rf + gamut.Rg)) << trial;
  }
  EXPECT_GT(judged, 50);
  EXPECT_GT(refused, 50);
}

TEST(RenderingInput, TheLargestAndSmallestNumbersAreJudgedToo) {
  const double ra = ColorRenderingOf(Prepared(IlluminantSpectrum("FL2").value())).Ra;
  for (const double scale : {1e-300, 1e300}) {
    Spectrum light = IlluminantSpectrum("FL2").value();
    for (double& value : light.values) value *= scale;
    EXPECT_NEAR(ColorRenderingOf(Prepared(light)).Ra, ra, 1e-9);
    EXPECT_TRUE(std::isfinite(ColorFidelityOf(Prepared(light)).Rf));
  }
}

// ---- SSI ----

TEST(SpectralSimilarity, ASpectrumIsLikeItselfAndLessLikeOthers) {
  const Spectrum p3200 = IlluminantSpectrum("P3200").value();
  EXPECT_NEAR(SpectralSimilarity(p3200, p3200).value(), 100.0, 1e-9);
  const double to_a = SpectralSimilarity(IlluminantSpectrum("A").value(), p3200).value();
  const double to_daylight = SpectralSimilarity(IlluminantSpectrum("D55").value(), p3200).value();
  const double to_lamp = SpectralSimilarity(IlluminantSpectrum("FL11").value(), p3200).value();
  EXPECT_GT(to_a, to_daylight);
  EXPECT_GT(to_daylight, to_lamp);
}

TEST(SpectralSimilarity, TheStepOfASmoothSpectrumDoesNotMatter) {
  const Spectrum c = IlluminantSpectrum("C").value();
  const Spectrum d55 = IlluminantSpectrum("D55").value();
  EXPECT_NEAR(SpectralSimilarity(c, d55).value(),
              SpectralSimilarity(EveryNanometre(c), d55).value(), 1e-9);
}

TEST(SpectralSimilarity, ASpectrumWithoutPowerIsRefused) {
  Spectrum dark = IlluminantSpectrum("E").value();
  std::ranges::fill(dark.values, 0.0);
  EXPECT_EQ(SpectralSimilarity(dark, IlluminantSpectrum("A").value()).error().code, "bad_spectrum");
  EXPECT_EQ(SpectralSimilarity(IlluminantSpectrum("A").value(), dark).error().code, "bad_spectrum");
}

}  // namespace
}  // namespace lightcal
