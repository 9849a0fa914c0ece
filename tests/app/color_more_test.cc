// SPDX-License-Identifier: Apache-2.0
// What color says besides the colour itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "color_answer.h"
#include "lightcal/colorimetry/cct.h"
#include "lightcal/colorimetry/illuminants.h"
#include "lightcal/core/numbers_text.h"
#include "run_cli.h"
#include "run_cli_json.h"

namespace lightcal {
namespace {

using nlohmann::json;
using test::Color;
using test::RunLightcal;

bool Warns(const json& answer, const std::string& code) {
  if (!answer.contains("warnings")) return false;
  for (const json& warning : answer["warnings"]) {
    if (warning["code"] == code) return true;
  }
  return false;
}

// Every `step`-th row of the illuminant's table.
std::string TableOf(const std::string& illuminant, int first, int step) {
  const Spectrum s = *IlluminantSpectrum(illuminant);
  std::string text = "wavelength_nm,relative\n";
  for (std::size_t i = 0; i < s.values.size(); ++i) {
    const int nm = static_cast<int>(s.wavelengths_nm[i]);
    if (nm < first || (nm - first) % step != 0) continue;
    text += std::to_string(nm) + "," + ShortestText(s.values[i]) + "\n";
  }
  return text;
}

TEST(ColorXyz, GivesTheChromaticityOfItsXy) {
  const json a = Color({"--xyz", "95.047", "100", "108.883"});
  EXPECT_NEAR(a["xy"][0].get<double>(), 0.31273, 1e-5);
  EXPECT_NEAR(a["cct_K"].get<double>(), 6504.0, 2.0);
  EXPECT_EQ(a["XYZ"][1], 100.0);
  EXPECT_EQ(RunLightcal({"color", "--xyz", "1", "0", "1"}).exit_code, 3);
  EXPECT_EQ(RunLightcal({"color", "--xyz", "1", "1"}).exit_code, 2);
  EXPECT_EQ(RunLightcal({"color", "--xyz", "1", "1", "1", "--xy", "0.3", "0.3"}).exit_code, 2);
}

TEST(ColorSigma, OnePercentOfNoiseCostsWhatTheReferenceMeasured) {  // 6.0 mired at 4000 K
  const json a = Color({"--cct", "4000", "--sigma", "1%"});
  EXPECT_NEAR(a["uncertainty"]["u_mired"].get<double>(), 6.0, 0.1);
  EXPECT_NEAR(a["uncertainty"]["u_cct_K"].get<double>(), 6.0 * 16.0, 2.5);
  EXPECT_GT(a["uncertainty"]["u_duv"].get<double>(), 0.0015);
  EXPECT_LT(a["uncertainty"]["u_duv"].get<double>(), 0.0023);
  const json half = Color({"--cct", "4000", "--sigma", "0.005"});
  EXPECT_NEAR(half["uncertainty"]["u_duv"].get<double>() / a["uncertainty"]["u_duv"].get<double>(),
              0.5, 1e-9);
}

TEST(ColorSigma, TooMuchNoiseLeavesNoTemperature) {
  const json a = Color({"--xyz", "10", "10", "8", "--sigma", "5%"});
  EXPECT_FALSE(a.contains("cct_K"));
  EXPECT_FALSE(a["cct_valid"].get<bool>());
  EXPECT_EQ(a["cct_status"], "too_noisy");
  EXPECT_FALSE(a["uncertainty"].contains("u_cct_K"));
  EXPECT_TRUE(Warns(a, "too_noisy"));
  EXPECT_EQ(RunLightcal({"color", "--xyz", "10", "10", "8", "--sigma", "5%", "--strict"}).exit_code,
            3);
  EXPECT_EQ(RunLightcal({"color", "--xy", "0.3", "0.3", "--sigma", "much"}).exit_code, 2);
  EXPECT_EQ(RunLightcal({"color", "--xy", "0.3", "0.3", "--sigma", "-1%"}).exit_code, 2);
  EXPECT_EQ(RunLightcal({"color", "--xy", "0.3", "0.3", "--sigma", "100%"}).exit_code, 2);
}

TEST(ColorSpectralError, OfSmoothLightBoundsWhatTheStepAndTheRangeCost) {
  const test::TempDir dir;
  const double truth = Color({"--spectrum", "illuminant:P6504"})["cct_K"];
  for (const int first : {380, 400}) {
    const json a = Color({"--spectrum", dir.Write("planck.csv", TableOf("P6504", first, 5))});
    const json& error = a["spectral_error"];
    EXPECT_EQ(error["step_nm"], 5.0);
    EXPECT_EQ(error["from_nm"], first);
    EXPECT_LE(std::abs(a["cct_K"].get<double>() - truth), error["cct_K"].get<double>());
    EXPECT_LT(error["cct_K"].get<double>(), 120.0);
    EXPECT_TRUE(error.contains("duv"));
    EXPECT_TRUE(error.contains("illuminance_relative"));
  }
}

TEST(ColorSpectralError, OfSpikyPointSamplesIsNotBounded) {
  const test::TempDir dir;
  const std::string file = dir.Write("lamp.csv", TableOf("FL11", 380, 10));
  const json a = Color({"--spectrum", file});
  EXPECT_EQ(a["spectral_error"]["code"], "undersampled");
  EXPECT_FALSE(a["spectral_error"].contains("cct_K"));
  EXPECT_TRUE(Warns(a, "undersampled"));
  const json band = Color({"--spectrum", file, "--sampling", "band"});
  EXPECT_FALSE(band["spectral_error"].contains("code"));
  EXPECT_GT(band["spectral_error"]["cct_K"].get<double>(), 100.0);
}

// CIE's 5 nm table of F12 linear to 1 nm is what the IES calculator was given: Rf 77.667, Rg
// 102.414.
TEST(ColorTm30, OfF12LinearToOneNanometreHasTheDigitsOfTheIesCalculator) {
  const Spectrum f12 = *IlluminantSpectrum("FL12");
  std::string table = "wavelength_nm,relative\n";
  for (int nm = 380; nm <= 780; ++nm) {
    const std::size_t i = std::min<std::size_t>((nm - 380) / 5, f12.values.size() - 2);
    const double t = (nm - f12.wavelengths_nm[i]) / 5.0;
    const double value = f12.values[i] + t * (f12.values[i + 1] - f12.values[i]);
    table += std::to_string(nm) + "," + ShortestText(value) + "\n";
  }
  const test::TempDir dir;
  const json a = Color({"--spectrum", dir.Write("f12.csv", table)});
  EXPECT_NEAR(a["tm30"]["rf"].get<double>(), 77.667, 0.0005);
  EXPECT_NEAR(a["tm30"]["rg"].get<double>(), 102.414, 0.0005);
  EXPECT_NEAR(a["cct_K"].get<double>(), 3002.5, 0.1);
  const json& bin = a["tm30"]["bins"][0];
  EXPECT_NEAR(bin["rf"].get<double>(), 78.222, 0.0015);
  EXPECT_NEAR(bin["rcs"].get<double>(), -0.0851, 1e-4);
  EXPECT_NEAR(bin["rhs_rad"].get<double>(), -0.04646, 1e-4);
  EXPECT_NEAR(Color({"--spectrum", "illuminant:FL12"})["tm30"]["rf"].get<double>(), 77.5489, 0.01);
}

// The file states 500 lx of a Planckian radiator of 2856 K, whose DER is that of illuminant A.
TEST(ColorMelanopic, OfAnIrradianceIsAnIlluminanceToo) {
  const json a =
      Color({"--spectrum", test::SampleData("spectra/own/argyll_ambient_2856K_500lx.sp")});
  const double der = a["melanopic"]["der"];
  EXPECT_NEAR(der, 0.4957, 1e-3);
  EXPECT_NEAR(a["melanopic"]["edi_lx"].get<double>(), der * a["illuminance_lx"].get<double>(),
              1e-9);
  const json relative = Color({"--spectrum", "illuminant:LED-B3"});
  EXPECT_NEAR(relative["melanopic"]["der"].get<double>(), 0.632, 1e-3);
  EXPECT_FALSE(relative["melanopic"].contains("edi_lx"));
  EXPECT_FALSE(Color({"--cct", "3200"}).contains("melanopic"));
}

TEST(ColorModels, OfLedsAreSpectraByName) {
  EXPECT_NEAR(Color({"--spectrum", "led:4000"})["cct_K"].get<double>(), 4000.0, 0.01);
  const json green = Color({"--spectrum", "gaussian:530:1"});  // nearly one wavelength
  EXPECT_NEAR(green["xy"][0].get<double>(), 0.1547, 2e-3);
  EXPECT_NEAR(green["xy"][1].get<double>(), 0.8059, 2e-3);
  EXPECT_EQ(RunLightcal({"color", "--spectrum", "led:warm"}).exit_code, 2);
  EXPECT_EQ(RunLightcal({"color", "--spectrum", "gaussian:200:20"}).exit_code, 3);
}

TEST(ColorWhite, AnAdaptedWhiteIsEqualInEveryChannel) {
  const json a = Color({"--cct", "3200", "--white", "3200K"});
  for (const char* space : {"srgb_linear", "acescg", "rec2020", "display_p3"}) {
    for (const json& channel : a["rgb"][space]) EXPECT_NEAR(channel.get<double>(), 1.0, 1e-9);
  }
  EXPECT_EQ(RunLightcal({"color", "--cct", "3200", "--white", "snow"}).exit_code, 2);
  EXPECT_EQ(RunLightcal({"color", "--cct", "3200", "--white", "0.3,0"}).exit_code, 3);
}

TEST(ColorGamut, APolicyKeepsNothingNegativeAndIsNamed) {
  const json kept = Color({"--cct", "1500"});
  EXPECT_LT(kept["rgb"]["srgb_linear"][2].get<double>(), 0.0);
  EXPECT_EQ(kept["rgb_gamut"]["policy"], "keep");
  EXPECT_EQ(kept["rgb_gamut"]["outside"], json::array({"srgb_linear"}));
  for (const char* policy : {"clip", "desaturate"}) {
    const json a = Color({"--cct", "1500", "--gamut", policy});
    EXPECT_NEAR(a["rgb"]["srgb_linear"][2].get<double>(), 0.0, 1e-12);
    EXPECT_GE(a["rgb"]["srgb_linear"][2].get<double>(), 0.0);
    EXPECT_EQ(a["rgb_gamut"]["policy"], policy);
  }
  EXPECT_FALSE(Color({"--cct", "3200"}).contains("rgb_gamut"));
  EXPECT_EQ(RunLightcal({"color", "--cct", "1500", "--gamut", "magic"}).exit_code, 2);
}

TEST(ColorEngines, ReadOutWhatGodotRenders) {  // measured in Godot: (1, .4159, .0984)
  const json engines = Color({"--cct", "2700", "--engines"})["engines"];
  EXPECT_NEAR(engines["godot_rgb"][1].get<double>(), 0.4159, 1e-4);
  EXPECT_NEAR(engines["krystek_setting_K"].get<double>(), 2700.0, 3.0);
  EXPECT_TRUE(engines["approximation"].get<bool>());
  const json adobe = Color({"--cct", "3102", "--duv", "0.002", "--adobe"})["adobe"];
  EXPECT_NEAR(adobe["temperature_K"].get<double>(), 3102.0, 3.0);
  EXPECT_NEAR(adobe["tint"].get<double>(), -6.0, 0.1);
  EXPECT_FALSE(Color({"--cct", "3102"}).contains("adobe"));
}

TEST(ColorPlot, IsAnSvgFileThatReplacesOnlyItsOwn) {
  const test::TempDir dir;
  const std::string file = dir.path() + "/plot.svg";
  for (int i = 0; i < 2; ++i) Color({"--cct", "3200", "--sigma", "1%", "--plot", file});
  std::ifstream stream(file);
  const std::string svg{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_TRUE(svg.starts_with("<svg"));
  EXPECT_NE(svg.find("class=\"ellipse\""), std::string::npos);
  const std::string foreign = dir.Write("foreign.svg", "<svg/>");
  EXPECT_EQ(RunLightcal({"color", "--cct", "3200", "--plot", foreign}).exit_code, 1);
  EXPECT_EQ(RunLightcal({"color", "--cct", "3200", "--plot", foreign, "--force"}).exit_code, 0);
}

TEST(ColorBatch, EveryRowEqualsTheColourAlone) {
  std::string rows;
  for (int i = 0; i < 5000; ++i) {
    rows += ShortestText(0.25 + 0.00005 * i) + "," + ShortestText(0.30 + 0.00002 * i) + "\n";
  }
  const test::CliResult run = RunLightcal({"color", "--batch", "-"}, rows);
  ASSERT_EQ(run.exit_code, 0);
  std::size_t from = 0;
  for (int i = 0; i < 5000; ++i) {
    const std::size_t end = run.out.find('\n', from);
    ASSERT_NE(end, std::string::npos) << i;
    const std::string line = run.out.substr(from, end - from);
    from = end + 1;
    const CctResult one = CctFromXy({*ParseNumber(ShortestText(0.25 + 0.00005 * i)),
                                     *ParseNumber(ShortestText(0.30 + 0.00002 * i))});
    const std::size_t last = line.rfind(',');
    const std::size_t before = line.rfind(',', last - 1);
    EXPECT_NEAR(std::stod(line.substr(last + 1)), one.duv, 1e-12) << line;
    if (!one.valid()) {
      EXPECT_EQ(before + 1, last) << line;
      continue;
    }
    EXPECT_NEAR(std::stod(line.substr(before + 1)) / one.temperature.value(), 1.0, 1e-10) << line;
  }
  EXPECT_EQ(from, run.out.size());
}

TEST(ColorBatch, ABadRowIsNamedByItsOwnLineHoweverFarDown) {
  std::string rows;
  for (int i = 0; i < 3000; ++i) rows += "0.3,0.3\n";
  const test::CliResult color = RunLightcal({"color", "--batch", "-"}, rows + "0.3,0\n0.3,abc\n");
  EXPECT_EQ(color.exit_code, 3);
  EXPECT_NE(color.err.find(":3001"), std::string::npos) << color.err;
  const test::CliResult text = RunLightcal({"color", "--batch", "-"}, rows + "0.3,abc\n0.3,0\n");
  EXPECT_EQ(text.exit_code, 3);
  EXPECT_NE(text.err.find(":3001"), std::string::npos) << text.err;
}

// One lamp written from blue to red, from red to blue, shuffled, and in other units of length.
TEST(ColorFiles, TheOrderAndUnitOfWavelengthsSayNothingOfTheLamp) {
  const test::TempDir folder;
  struct Unit {
    const char* header;
    double per_nm, values;
  };
  const Unit units[] = {{"wavelength_nm,irradiance_W_m2_nm", 1.0, 1.0},
                        {"wavelength (um),irradiance (W/m2/um)", 1e-3, 1e3},
                        {"wavelength (\xC2\xB5m),irradiance (W/m2/nm)", 1e-3, 1.0},
                        {"wavelength (\xC3\x85),irradiance (W/m2/nm)", 10.0, 1.0},
                        {"wavelength (A),irradiance (W/m2/nm)", 10.0, 1.0},
                        {"Wavelength [m],irradiance (W/m2/nm)", 1e-9, 1.0}};
  constexpr int kSamples = 81;  // 380 to 780 nm
  const auto text = [&](const Unit& unit, int stride) {
    std::ostringstream out;
    out.precision(12);
    out << unit.header << "\n";
    for (int i = 0, k = stride == 1 ? 0 : kSamples - 1; i < kSamples; ++i) {
      const double nm = 380.0 + 5.0 * k;
      out << nm * unit.per_nm << "," << unit.values * (0.01 + 1e-5 * (nm - 500.0)) << "\n";
      k = (k + stride) % kSamples;
    }
    return out.str();
  };
  const json want = Color({"--spectrum", folder.Write("a.csv", text(units[0], 1)), "--json"});
  for (const Unit& unit : units) {
    for (const int stride : {kSamples - 1, 1, 17}) {
      const json got = Color({"--spectrum", folder.Write("b.csv", text(unit, stride)), "--json"});
      EXPECT_NEAR(double(got["cct_K"]), double(want["cct_K"]), 1e-6) << unit.header << stride;
      EXPECT_NEAR(double(got["illuminance_lx"]), double(want["illuminance_lx"]), 1e-8);
    }
  }
  // All in order but one: that one is mistyped.
  std::string typed = text(units[0], 1);
  typed.replace(typed.find("\n430,"), 5, "\n340,");
  const test::CliResult stray =
      RunLightcal({"color", "--spectrum", folder.Write("typed.csv", typed)});
  EXPECT_EQ(stray.exit_code, 3);
  EXPECT_NE(stray.err.find("340 nm follows"), std::string::npos) << stray.err;
  const std::string twice = folder.Write("twice.csv", text(units[0], kSamples - 1) + "430,0.5\n");
  const test::CliResult refused = RunLightcal({"color", "--spectrum", twice});
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_NE(refused.err.find("two values at 430 nm"), std::string::npos) << refused.err;
}

// What it advises, it understands.
TEST(ColorFiles, ATableWithoutAHeaderIsToldWhatHelpsHere) {
  const test::TempDir folder;
  const std::string rows = "380,0.1\n480,0.2\n580,0.3\n680,0.3\n780,0.2\n";
  const test::CliResult bare = RunLightcal({"color", "--spectrum", folder.Write("a.csv", rows)});
  EXPECT_EQ(bare.exit_code, 3);
  EXPECT_EQ(bare.err.find("--columns"), std::string::npos) << bare.err;
  const std::string line = "wavelength_nm,irradiance_W_m2_nm";
  EXPECT_NE(bare.err.find(line), std::string::npos) << bare.err;
  const std::string named = folder.Write("b.csv", line + "\n" + rows);
  EXPECT_EQ(RunLightcal({"color", "--spectrum", named}).exit_code, 0);
}

TEST(ColorPictures, BothAreWrittenOrNeither) {
  const test::TempDir folder;
  const std::string graphic = folder.path() + "/graphic.svg";
  const std::string plot = folder.Write("plot.svg", "a picture of my own");
  const std::vector<std::string> ask = {
      "color", "--spectrum", "illuminant:FL11", "--vector-graphic", graphic, "--plot", plot};
  EXPECT_EQ(RunLightcal(ask).exit_code, 1);
  EXPECT_EQ(test::ReadFile(graphic), "");
  EXPECT_EQ(test::ReadFile(plot), "a picture of my own");
}

}  // namespace
}  // namespace lightcal
