// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "color_answer.h"
#include "lightcal/colorimetry/cct.h"
#include "lightcal/colorimetry/illuminants.h"
#include "lightcal/colorimetry/ssi.h"
#include "lightcal_devices/files/import_file.h"
#include "run_cli.h"
#include "run_cli_json.h"

namespace lightcal {
namespace {

using nlohmann::json;
using test::Color;
using test::RunLightcal;

void ExpectRefused(std::vector<std::string> arguments, const std::string& code) {
  arguments.insert(arguments.begin(), "color");
  arguments.emplace_back("--json");
  const test::CliResult run = RunLightcal(arguments);
  EXPECT_EQ(run.exit_code, 3) << run.out;
  EXPECT_EQ(json::parse(run.out)["error"]["code"], code);
}

// ---- Typed colours ----

TEST(ColorCommand, ChromaticityOfIlluminantAGivesItsTemperature) {
  const json a = Color({"--xy", "0.44758", "0.40745"});
  EXPECT_NEAR(a["cct_K"].get<double>(), 2855.5271, 1e-3);
  EXPECT_NEAR(a["duv"].get<double>(), 3.3648e-6, 1e-9);
  EXPECT_TRUE(a["cct_valid"].get<bool>());
  EXPECT_NEAR(a["uv1960"][0].get<double>(), 0.255970627, 1e-8);
  EXPECT_NEAR(a["uv1976"][1].get<double>(), 1.5 * 0.349530471, 1e-8);
  const auto rgb = a["rgb"]["srgb_linear"];
  const double luminance = 0.21263900587 * rgb[0].get<double>() +
                           0.71516867877 * rgb[1].get<double>() +
                           0.07219231536 * rgb[2].get<double>();
  EXPECT_NEAR(luminance, 1.0, 1e-9);
  EXPECT_EQ(a["rgb"]["acescg"].size(), 3u);
  EXPECT_EQ(a["rgb"]["rec2020"].size(), 3u);
}

TEST(ColorCommand, ValuesMayBePartedByCommasOrBlanks) {
  EXPECT_EQ(Color({"--xy", "0.44757,0.40745"}), Color({"--xy", "0.44757", "0.40745"}));
  EXPECT_EQ(Color({"--xyz", "95.04,100,108.88"}), Color({"--xyz", "95.04", "100", "108.88"}));
}

TEST(ColorCommand, TemperatureAndDuvReturnThemselves) {
  const json a = Color({"--cct", "3200K", "--duv", "-0.003"});
  EXPECT_NEAR(a["cct_K"].get<double>(), 3200.0, 1e-4);
  EXPECT_NEAR(a["duv"].get<double>(), -0.003, 1e-10);
}

TEST(ColorCommand, DaylightLiesOnItsOwnLocus) {
  const json a = Color({"--cct", "6504", "--locus", "daylight"});
  EXPECT_NEAR(a["xy"][0].get<double>(), 0.31271, 1e-5);
  EXPECT_NEAR(a["duv"].get<double>(), 0.0032, 2e-4);
  ExpectRefused({"--cct", "3200", "--locus", "daylight"}, "out_of_range");
}

TEST(ColorCommand, WithoutAMeaningfulTemperatureNoneIsGiven) {
  for (const auto& xy : std::vector<std::vector<std::string>>{
           {"0.15", "0.06"}, {"0.2", "0.7"}, {"0.69", "0.3"}, {"0.22", "0.2"}}) {
    const json a = Color({"--xy", xy[0], xy[1]});
    EXPECT_FALSE(a["cct_valid"].get<bool>());
    EXPECT_FALSE(a.contains("cct_K"));
    EXPECT_TRUE(a["duv"].is_number());
  }
  EXPECT_EQ(Color({"--xy", "0.15", "0.06"})["cct_status"], "beyond_infinity");
}

TEST(ColorCommand, WhatIsNoChromaticityIsRefused) {
  ExpectRefused({"--xy", "0", "0"}, "bad_chromaticity");
  ExpectRefused({"--xy", "-0.1", "0.5"}, "bad_chromaticity");
  ExpectRefused({"--xy", "0.7", "0.4"}, "bad_chromaticity");
  ExpectRefused({"--xy", "0.3", "-0.3"}, "bad_chromaticity");
  ExpectRefused({"--xy", "0.3", "0"}, "bad_chromaticity");
  ExpectRefused({"--xy", "nan", "0.3"}, "bad_number");
  ExpectRefused({"--xy", "0.3", "inf"}, "bad_number");
  ExpectRefused({"--xy", "0.9", "0.9"}, "bad_chromaticity");
  ExpectRefused({"--xyz", "-1", "1", "1"}, "bad_chromaticity");
  ExpectRefused({"--xyz", "1", "1", "-0.001"}, "bad_chromaticity");
  ExpectRefused({"--xyz", "1e308", "1e308", "1e308"}, "out_of_range");
  ExpectRefused({"--cct", "nan"}, "bad_number");
  ExpectRefused({"--cct", "0"}, "out_of_range");
  ExpectRefused({"--cct", "3000", "--duv", "5"}, "bad_chromaticity");
}

TEST(ColorCommand, AWrongCommandLineIsExitTwo) {
  for (const auto& arguments : std::vector<std::vector<std::string>>{
           {"color"},
           {"color", "--xy", "0.3", "0.3", "--cct", "3000"},
           {"color", "--xy", "0.3", "abc"},
           {"color", "--xy", "0.3"},
           {"color", "--cct", "warm"},
           {"color", "--cct", "5000", "--locus", "daylight", "--duv", "0.01"},
           {"color", "--cct", "5000", "--locus", "moon"},
           {"color", "--xy", "0.3", "0.3", "--duv", "0.01"},
           {"color", "--xy", "0.3", "0.3", "--column", "1"}}) {
    EXPECT_EQ(RunLightcal(arguments).exit_code, 2) << arguments.back();
  }
  EXPECT_NE(RunLightcal({"color", "--xy", "0.3"}).err.find("--xy: takes 2 values"),
            std::string::npos);
}

TEST(ColorCommand, PeopleSeeATableWithUnits) {
  const test::CliResult run = RunLightcal({"color", "--xy", "0.4476", "0.4074"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_NE(run.out.find("2854.8"), std::string::npos);
  EXPECT_NE(run.out.find("linear sRGB"), std::string::npos);
  EXPECT_EQ(run.out.find('{'), std::string::npos);
}

TEST(ColorCommand, NoTableShowsANegativeZero) {
  const test::CliResult run = RunLightcal({"color", "--cct", "3200"});
  EXPECT_NE(run.out.find("0.000000"), std::string::npos);
  EXPECT_EQ(run.out.find("-0.000000"), std::string::npos) << run.out;
}

// ---- Spectra: every file in sample_data/spectra against its instrument ----

// Duv by the closed formula of Ohno's CORM 2011 talk, which holds above 1800 K.
double CormDuv(Xy xy) {
  constexpr double k[] = {-1.77348e-1,  1.115559,   -1.5008606, 9.750013e-1,
                          -3.307009e-1, 5.60614e-2, -3.7146e-3};
  const Uv1960 uv = Uv1960FromXy(xy);
  const double raw = std::atan((uv.v - 0.24) / (uv.u - 0.292));
  const double a = raw >= 0.0 ? raw : raw + std::numbers::pi;
  double locus = 0.0;
  for (int i = 6; i >= 0; --i) locus = locus * a + k[i];
  return std::hypot(uv.u - 0.292, uv.v - 0.24) - locus;
}

// The values a rounded number may stand for.
struct Interval {
  double low, high;
  [[nodiscard]] double middle() const { return (low + high) / 2; }
};
Interval AroundRounded(double value, double last_digit) {
  return {value - last_digit / 2, value + last_digit / 2};
}

// What the header says of the illuminance. A JETI file says it twice, as Ev with three digits and
// as Y with one decimal (two below 10); the instrument's value lies in both intervals. Column 720nm
// says 1,08 and 1,07: its value is 1.075.
Interval ClaimedIlluminance(const ReportedColor& reported, bool jeti) {
  Interval claim = AroundRounded(*reported.illuminance_lx, reported.illuminance_last_digit_lx);
  if (jeti) {
    const double y = reported.xyz.value().Y;
    const Interval second = AroundRounded(y, y < 10.0 ? 0.01 : 0.1);
    claim = {std::max(claim.low, second.low), std::min(claim.high, second.high)};
  }
  return claim;
}

void ExpectIlluminance(const json& answer, const ReportedColor& reported, bool jeti) {
  if (!reported.illuminance_lx) return;
  const Interval claim = ClaimedIlluminance(reported, jeti);
  ASSERT_GE(claim.high, claim.low - 1e-12);
  EXPECT_NEAR(answer["illuminance_lx"].get<double>(), claim.middle(),
              std::max(1e-3 * claim.middle(), claim.high - claim.middle()));
}

void ExpectCctAndDuv(const json& answer, const ReportedColor& reported) {
  if (!reported.cct_K) return;
  ASSERT_TRUE(answer.contains("cct_K"));
  EXPECT_NEAR(answer["cct_K"].get<double>(), *reported.cct_K, 3.0);
  ASSERT_TRUE(reported.duv.has_value());
  EXPECT_NEAR(answer["duv"].get<double>(), *reported.duv,
              std::max(1e-4, 0.5 * reported.duv_last_digit + 1e-9));
}

// A JETI header computes CCT and Duv by a closed formula that does not hold below 1800 K or far
// beyond the locus. There its chromaticity is still right, and its Duv is that formula's, not the
// distance.
void ExpectFormulaOutOfRange(const json& answer, const ReportedColor& reported) {
  ASSERT_TRUE(reported.xy.has_value() && reported.duv.has_value());
  EXPECT_NEAR(answer["xy"][0].get<double>(), reported.xy->x, 5e-5);
  EXPECT_NEAR(answer["xy"][1].get<double>(), reported.xy->y, 5e-5);
  const Xy xy{answer["xy"][0].get<double>(), answer["xy"][1].get<double>()};
  EXPECT_NEAR(CormDuv(xy), *reported.duv, 6e-4);
  EXPECT_GT(std::abs(answer["duv"].get<double>() - *reported.duv), 3e-3);
}

bool FormulaHolds(const json& answer) {
  return answer["cct_valid"].get<bool>() && answer["cct_K"].get<double>() > 1800.0;
}

void ExpectColorRendering(const json& answer, const ReportedColor& reported) {
  if (!reported.cri_Ra) return;
  ASSERT_TRUE(answer.contains("cri"));
  EXPECT_NEAR(answer["cri"]["Ra"].get<double>(), *reported.cri_Ra, 0.5);
  for (std::size_t i = 0; i < reported.cri_R.size(); ++i) {
    if (reported.cri_R[i]) {
      EXPECT_NEAR(answer["cri"]["R"][i].get<double>(), *reported.cri_R[i], 3.0) << "R" << i + 1;
    }
  }
}

// The UPRtek CV600 computes the first edition of TM-30, whose Rf lies up to 5.5 below CIE 224's;
// the Sekonic prints whole numbers of the present one.
void ExpectFidelityAndGamut(const json& answer, const ReportedColor& reported, bool first_edition) {
  if (!reported.tm30_rf) return;
  ASSERT_TRUE(answer.contains("tm30"));
  const json& found = first_edition ? answer["tm30_2015"] : answer["tm30"];
  EXPECT_NEAR(found["rf"].get<double>(), *reported.tm30_rf, first_edition ? 0.1 : 0.5);
  ASSERT_TRUE(reported.tm30_rg.has_value());
  EXPECT_NEAR(found["rg"].get<double>(), *reported.tm30_rg, 0.5);
}

void ExpectAsReported(const json& answer, const ReportedColor& reported, bool jeti) {
  ExpectIlluminance(answer, reported, jeti);
  if (!jeti || FormulaHolds(answer)) ExpectColorRendering(answer, reported);
  if (jeti && reported.cct_K && !FormulaHolds(answer)) {
    ExpectFormulaOutOfRange(answer, reported);
  } else {
    ExpectCctAndDuv(answer, reported);
  }
}

std::vector<std::string> SpectrumFiles() {
  std::vector<std::string> files;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(test::SampleData("spectra"))) {
    const std::string name = entry.path().filename().string();
    if (entry.is_regular_file() && !name.starts_with("LICENSE") && !name.starts_with("README")) {
      files.push_back(entry.path().string());
    }
  }
  std::ranges::sort(files);
  return files;
}

class SpectrumFile : public testing::TestWithParam<std::string> {};

TEST_P(SpectrumFile, AgreesWithItsInstrument) {
  const auto file = devices::ImportFile(GetParam());
  ASSERT_TRUE(file.has_value()) << file.error().message;
  ASSERT_FALSE(file->spectra.empty());
  const json all = Color({"--spectrum", GetParam()});
  const bool many = file->spectra.size() > 1;
  ASSERT_EQ(all.contains("spectra"), many);
  if (many) {
    ASSERT_EQ(all["spectra"].size(), file->spectra.size());
  }
  for (std::size_t i = 0; i < file->spectra.size(); ++i) {
    const ImportedSpectrum& imported = file->spectra[i];
    SCOPED_TRACE(imported.name);
    const json& answer = many ? all["spectra"][i] : all;
    EXPECT_EQ(answer.value("name", ""), imported.name);
    EXPECT_EQ(answer["XYZ"].size(), 3u);
    EXPECT_EQ(answer.contains("illuminance_lx"),
              imported.spectrum.quantity == SpectralQuantity::kIrradiance);
    ExpectAsReported(answer, imported.reported, file->format == "jeti_csv");
    ExpectFidelityAndGamut(answer, imported.reported, file->format == "uprtek_xls");
  }
}

INSTANTIATE_TEST_SUITE_P(EveryFile, SpectrumFile, testing::ValuesIn(SpectrumFiles()),
                         [](const auto& file) {
                           std::string name = std::filesystem::path(file.param).filename().string();
                           std::ranges::replace_if(
                               name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
                           return std::to_string(file.index) + "_" + name;
                         });

const std::string kJeti = test::SampleData("spectra/jeti/spectral_Jeti_50pct.csv");

// The headers that are compared above exist: the test cannot pass on files that claim nothing.
TEST(ColorCommand, MostJetiColumnsBelowADuvOfFiveHundredthsAreCompared) {
  int compared = 0, out_of_range = 0;
  const json all = Color({"--spectrum", kJeti});
  for (const json& answer : all["spectra"]) {
    if (!answer["reported"].contains("cct_K")) continue;
    (FormulaHolds(answer) ? compared : out_of_range) += 1;
  }
  EXPECT_EQ(compared, 13);
  EXPECT_EQ(out_of_range, 4);
}

TEST(ColorCommand, ColourRenderingIsComparedWithTwelveFilesOfTwoMakers) {
  int rendering = 0, fidelity = 0;
  for (const std::string& path : SpectrumFiles()) {
    const auto file = devices::ImportFile(path);
    ASSERT_TRUE(file.has_value());
    for (const ImportedSpectrum& imported : file->spectra) {
      rendering += file->format != "jeti_csv" && imported.reported.cri_R[14] ? 1 : 0;
      fidelity += imported.reported.tm30_rf && imported.reported.tm30_rg ? 1 : 0;
    }
  }
  EXPECT_EQ(rendering, 12);
  EXPECT_EQ(fidelity, 12);
}

// The Sekonic prints SSI as whole numbers: SSIt 76 (to P3200), SSId 59 (to D55).
TEST(ColorCommand, SpectralSimilarityIsTheSekonics) {
  const json a = Color({"--spectrum", test::SampleData("spectra/colour_science/"
                                                       "sekonic_RANDOM_001_02deg_3262K.csv")});
  EXPECT_EQ(std::round(a["ssi"]["P3200"].get<double>()), 76.0);
  EXPECT_EQ(std::round(a["ssi"]["D55"].get<double>()), 59.0);
  EXPECT_GT(a["ssi"]["matching"].get<double>(), 76.0);
}

// The UPRtek prints SSI to illuminant A unrounded (0 where it computed none).
TEST(ColorCommand, SpectralSimilarityToIlluminantAIsTheUprteks) {
  int compared = 0;
  for (const std::string& path : SpectrumFiles()) {
    std::smatch printed;
    const std::string text = test::ReadFile(path);
    if (!std::regex_search(text, printed, std::regex("SSI-A\t([0-9.]+)"))) continue;
    const double ssi = std::stod(printed[1]);
    if (ssi == 0.0) continue;
    const auto file = devices::ImportFile(path);
    ASSERT_TRUE(file.has_value());
    EXPECT_NEAR(SpectralSimilarity(file->spectra[0].spectrum, *IlluminantSpectrum("A")).value(),
                ssi, 0.05)
        << path;
    ++compared;
  }
  EXPECT_EQ(compared, 10);
}

TEST(ColorCommand, AnIlluminantIsNamedInsteadOfAFile) {
  const json a = Color({"--spectrum", "illuminant:FL11"});
  EXPECT_EQ(a["name"], "FL11");
  EXPECT_NEAR(a["cri"]["Ra"].get<double>(), 82.86, 0.1);
  EXPECT_NEAR(a["cie2017_rf"].get<double>(), 80.04, 0.01);
  EXPECT_EQ(a["tm30"]["rf"], a["cie2017_rf"]);
  EXPECT_EQ(a["tm30"]["bins"].size(), 16u);
  EXPECT_EQ(a["cri"]["R"].size(), 15u);
  EXPECT_GT(a["ler_lm_per_W"].get<double>(), 300.0);
  EXPECT_FALSE(a.contains("reported"));
  EXPECT_FALSE(a.contains("illuminance_lx"));
  ExpectRefused({"--spectrum", "illuminant:FL13"}, "unknown_illuminant");
}

TEST(ColorCommand, ANarrowSpectrumHasAColourButNoRendering) {
  const test::TempDir dir;
  std::string text = "wavelength_nm,relative\n";
  for (int nm = 420; nm <= 680; nm += 5) text += std::to_string(nm) + ",1\n";
  const json a = Color({"--spectrum", dir.Write("narrow.csv", text), "--sampling", "band"});
  EXPECT_TRUE(a.contains("cct_K"));
  for (const char* key : {"cri", "cie2017_rf", "tm30", "ssi"}) EXPECT_FALSE(a.contains(key)) << key;
  EXPECT_EQ(a["warnings"].back()["code"], "truncated_spectrum");
}

TEST(ColorCommand, ALightWithoutATemperatureHasNoRendering) {
  const json a = Color({"--spectrum", kJeti, "--column", "450nm"});
  EXPECT_FALSE(a["cct_valid"].get<bool>());
  EXPECT_FALSE(a.contains("cri"));
  EXPECT_FALSE(a["ssi"].contains("matching"));
  EXPECT_TRUE(a["ssi"].contains("P3200"));
}

TEST(ColorCommand, TheVectorGraphicIsWrittenOnceAndReplacedFreely) {
  const test::TempDir dir;
  const std::string file = dir.path() + "/lamp.svg";
  const std::vector<std::string> command = {"color", "--spectrum", "illuminant:FL4",
                                            "--vector-graphic", file};
  EXPECT_EQ(RunLightcal(command).exit_code, 0);
  const std::string first = test::ReadFile(file);
  EXPECT_NE(first.find("Colour vector graphic of FL4"), std::string::npos);
  EXPECT_EQ(RunLightcal(command).exit_code, 0);
  EXPECT_EQ(test::ReadFile(file), first);
  const std::string other = dir.Write("mine.svg", "<svg/>");
  EXPECT_EQ(
      RunLightcal({"color", "--spectrum", "illuminant:FL4", "--vector-graphic", other}).exit_code,
      1);
  EXPECT_EQ(test::ReadFile(other), "<svg/>");
  EXPECT_EQ(RunLightcal({"color", "--xy", "0.3", "0.3", "--vector-graphic", file}).exit_code, 2);
  EXPECT_EQ(RunLightcal({"color", "--spectrum", kJeti, "--vector-graphic", file}).exit_code, 2);
  ExpectRefused({"--spectrum", kJeti, "--column", "450nm", "--vector-graphic", file},
                "no_color_rendering");
}

TEST(ColorCommand, AColumnIsChosenByNameOrByNumber) {
  const json by_name = Color({"--spectrum", kJeti, "--column", "390nm"});
  EXPECT_EQ(by_name["name"], "390nm");
  EXPECT_EQ(by_name, Color({"--spectrum", kJeti, "--column", "2"}));
  EXPECT_FALSE(by_name.contains("warnings"));  // none of the other columns'
  ExpectRefused({"--spectrum", kJeti, "--column", "999"}, "unknown_column");
}

TEST(ColorCommand, AReportedTemperatureOfZeroIsAbsent) {
  EXPECT_FALSE(Color({"--spectrum", kJeti, "--column", "400nm"})["reported"].contains("cct_K"));
}

TEST(ColorCommand, ATruncatedSpectrumIsSaidToBeSo) {
  const std::string file = test::SampleData("spectra/colour_science/Fluorescent.spdx");
  const json a = Color({"--spectrum", file});
  EXPECT_EQ(a["warnings"][0]["code"], "spectrum_truncated");
  EXPECT_FALSE(a.contains("illuminance_lx"));  // a relative spectrum has no lux
  ExpectRefused({"--spectrum", file, "--strict"}, "spectrum_truncated");
}

TEST(ColorCommand, AMissingFileIsExitOne) {
  EXPECT_EQ(RunLightcal({"color", "--spectrum", "no/such/file"}).exit_code, 1);
  EXPECT_EQ(RunLightcal({"color", "--batch", "no/such/file"}).exit_code, 1);
}

// ---- Batch ----

std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(ColorBatch, EachLineIsAnsweredByALine) {
  const test::TempDir dir;
  const std::string file = dir.Write("in.csv", "0.44758,0.40745\r\n\n0.15,0.06\n0.3127,0.3290");
  const test::CliResult run = RunLightcal({"color", "--batch", file});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto lines = Lines(run.out);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_TRUE(lines[0].starts_with("0.44758,0.40745,2855.52")) << lines[0];
  EXPECT_TRUE(lines[1].starts_with("0.15,0.06,,-0.0329")) << lines[1];
  EXPECT_TRUE(lines[2].starts_with("0.3127,0.3290,6504.34")) << lines[2];
}

TEST(ColorBatch, TheReferenceGridComesBackThroughItsNamedColumns) {
  const std::string file = test::SampleData("vectors/cct_duv_100.csv");
  const test::CliResult run = RunLightcal({"color", "--batch", file});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto lines = Lines(run.out);
  const auto truth = Lines(test::ReadFile(file));
  ASSERT_EQ(lines.size(), truth.size());
  EXPECT_EQ(lines[0], "x,y,cct_K,duv");
  for (std::size_t i = 1; i < lines.size(); ++i) {
    double x = 0, y = 0, cct = 0, duv = 0, u = 0, v = 0, true_cct = 0, true_duv = 0;
    ASSERT_EQ(std::sscanf(lines[i].c_str(), "%lf,%lf,%lf,%lf", &x, &y, &cct, &duv), 4) << lines[i];
    ASSERT_EQ(std::sscanf(truth[i].c_str(), "%lf,%lf,%lf,%lf,%lf,%lf", &x, &y, &u, &v, &true_cct,
                          &true_duv),
              6);
    EXPECT_NEAR(cct, true_cct, true_cct <= 25000 ? 0.01 : 1e-6 * true_cct);
    EXPECT_NEAR(duv, true_duv, 1e-10);
  }
}

TEST(ColorBatch, StandardInputIsReadAsAStream) {
  const test::CliResult run = RunLightcal({"color", "--batch", "-"}, "0.31,0.32\n0.3,0.3\n");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(Lines(run.out).size(), 2u);
}

TEST(ColorBatch, ABadRowOfAFileWritesNothingAndNamesItsLine) {
  const test::TempDir dir;
  const std::vector<std::pair<std::string, std::string>> bad = {
      {"0.31,0.32\n0.3,nan\n", "bad_row"},
      {"0.31,0.32\n0.3,\n", "bad_row"},
      {"0.31,0.32\n0.3,0.3,0.4\n", "bad_row"},
      {"0.31,0.32\n0.3,-0.3\n", "bad_chromaticity"},
      {"0.31,0.32\n0.3 0.3\n", "bad_row"},
      {"", "no_rows"},
      {"x,y\n", "no_rows"}};
  for (const auto& [text, code] : bad) {
    const std::string file = dir.Write("bad.csv", text);
    const test::CliResult run = RunLightcal({"color", "--batch", file});
    EXPECT_EQ(run.exit_code, 3) << text;
    EXPECT_EQ(run.out, "") << text;
    if (code != "no_rows") {
      EXPECT_NE(run.err.find("bad.csv:2"), std::string::npos) << run.err;
    }
    ExpectRefused({"--batch", file}, code);
  }
}

TEST(ColorBatch, JsonIsOneDocument) {
  const test::TempDir dir;
  const json a = Color({"--batch", dir.Write("in.csv", "0.3127,0.3290\n0.15,0.06\n")});
  ASSERT_EQ(a["rows"].size(), 2u);
  EXPECT_NEAR(a["rows"][0]["cct_K"].get<double>(), 6504.34, 0.01);
  EXPECT_FALSE(a["rows"][1].contains("cct_K"));
}

}  // namespace
}  // namespace lightcal
