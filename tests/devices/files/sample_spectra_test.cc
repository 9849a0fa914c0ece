// SPDX-License-Identifier: Apache-2.0
// Every file of sample_data/spectra against what its own instrument says of it: another program's
// photometry of the same samples. A file added there is a test added here.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "lightcal/colorimetry/cct.h"
#include "lightcal_devices/files/import_file.h"
#include "run_cli.h"

namespace lightcal::devices {
namespace {

using ::testing::DoubleNear;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::vector<std::string> SpectrumFiles() {
  std::vector<std::string> names;
  const std::filesystem::path root = test::SampleData("spectra");
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    const std::string file = entry.path().filename().string();
    const bool text_about_it = file.starts_with("LICENSE") || file.starts_with("README");
    if (!entry.is_regular_file() || text_about_it) continue;
    names.push_back(std::filesystem::relative(entry.path(), root).string());
  }
  std::ranges::sort(names);
  return names;
}

std::string TestName(const testing::TestParamInfo<std::string>& info) {
  std::string name;
  for (const char c : info.param) name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
}

ImportedFile Import(const std::string& name) {
  auto file = ImportFile(test::SampleData("spectra/" + name));
  EXPECT_TRUE(file) << file.error().code << ": " << file.error().message;
  return file ? *file : ImportedFile{};
}

std::vector<std::string> CodesOf(const Warnings& warnings) {
  std::vector<std::string> codes;
  for (const Warning& warning : warnings) codes.push_back(warning.code);
  return codes;
}

class SampleSpectrum : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, SampleSpectrum, testing::ValuesIn(SpectrumFiles()), TestName);

TEST(SampleSpectra, AreAllTheFilesWeWereGiven) { EXPECT_GE(SpectrumFiles().size(), 16U); }

TEST_P(SampleSpectrum, AddsUpToItsHeadersLuxAndHasOneReadingEach) {
  const ImportedFile file = Import(GetParam());
  EXPECT_THAT(CodesOf(file.warnings), Each("color_disagrees"));
  EXPECT_FALSE(file.spectra.empty());
  EXPECT_THAT(file.readings, SizeIs(file.spectra.size()));
  for (const Reading& reading : file.readings) {
    EXPECT_EQ(reading.color_source, ColorSource::kSpectrometer);
    EXPECT_TRUE(reading.xy);
  }
}

// 0.1 %, 3 K and 1e-4, each beside half of the header's last digit.
TEST_P(SampleSpectrum, GivesTheIlluminanceAndColorItsHeaderReports) {
  const ImportedFile file = Import(GetParam());
  for (std::size_t i = 0; i < file.spectra.size(); ++i) {
    const ImportedSpectrum& one = file.spectra[i];
    SCOPED_TRACE(one.name);
    const auto xyz = XyzFromSpectrum(one.spectrum);
    ASSERT_TRUE(xyz);
    const ReportedColor& reported = one.reported;
    if (reported.illuminance_lx) {
      const double tolerance =
          1e-3 * *reported.illuminance_lx + 0.5 * reported.illuminance_last_digit_lx;
      EXPECT_THAT(xyz->Y, DoubleNear(*reported.illuminance_lx, tolerance));
    }
    if (reported.xy) {
      EXPECT_THAT(XyFromXyz(*xyz).x, DoubleNear(reported.xy->x, 2e-4));
      EXPECT_THAT(XyFromXyz(*xyz).y, DoubleNear(reported.xy->y, 2e-4));
    }
    const Reading& reading =
        file.readings[i];  // its cct is absent where the header contradicts itself
    const CctResult cct = CctFromXy(XyFromXyz(*xyz));
    if (reading.cct) {
      EXPECT_THAT(cct.temperature.value(), DoubleNear(reading.cct->value(), 3.0));
    }
    if (reading.duv) {
      EXPECT_THAT(cct.duv, DoubleNear(*reading.duv, std::max(1e-4, 0.5 * reported.duv_last_digit)));
    }
  }
}

// Four narrow-band columns print a CCT and Duv that their own printed x, y do not have: at 600 nm
// x = 0.6395, y = 0.3588 lie 0.0006 from the Planckian locus, not 0.044.
TEST(Jeti, CctThatContradictsTheHeadersOwnXyIsReportedAndNotUsed) {
  const ImportedFile file = Import("jeti/spectral_Jeti_50pct.csv");
  std::vector<std::string> contradicted;
  for (std::size_t i = 0; i < file.spectra.size(); ++i) {
    const ReportedColor& reported = file.spectra[i].reported;
    if (!reported.cct_K) continue;
    const CctResult printed_xy = CctFromXy(*reported.xy);
    const bool contradicts = std::abs(printed_xy.duv - *reported.duv) > 0.002;
    EXPECT_EQ(contradicts, !file.readings[i].cct) << file.spectra[i].name;
    if (contradicts) contradicted.push_back(file.spectra[i].name);
  }
  EXPECT_THAT(contradicted, ElementsAre("410nm", "590nm", "600nm", "690nm"));
  EXPECT_THAT(CodesOf(file.warnings), ElementsAre("color_disagrees", "color_disagrees",
                                                  "color_disagrees", "color_disagrees"));
}

TEST(Uprtek, HeaderFieldsBecomeTheReading) {
  const ImportedFile file = Import("colour_science/uprtek_ESPD2021_0104_231446.xls");
  EXPECT_EQ(file.format, "uprtek_xls");
  ASSERT_THAT(file.readings, SizeIs(1));
  const Reading& reading = file.readings.front();
  EXPECT_DOUBLE_EQ(reading.illuminance->value(), 695.154907);
  EXPECT_DOUBLE_EQ(reading.cct->value(), 5198.0);
  EXPECT_DOUBLE_EQ(*reading.duv, -0.00062);
  EXPECT_EQ(reading.time, "2021-01-04T23:14:46");
  EXPECT_EQ(reading.device, "uprtek:CV600 19J00789");
  EXPECT_DOUBLE_EQ(*file.spectra.front().reported.cri_Ra, 92.956993);
  // 380nm 0.030267 mW m^-2 nm^-1
  EXPECT_DOUBLE_EQ(file.spectra.front().spectrum.values.front(), 0.030267e-3);
}

TEST(Sekonic, OneNanometreBlockIsReadNotTheFiveNanometreOne) {
  const ImportedFile file = Import("colour_science/sekonic_RANDOM_001_02deg_3262K.csv");
  EXPECT_EQ(file.format, "sekonic_csv");
  ASSERT_THAT(file.spectra, SizeIs(1));
  const ImportedSpectrum& one = file.spectra.front();
  EXPECT_THAT(one.spectrum.values, SizeIs(401));
  EXPECT_EQ(one.spectrum.wavelengths_nm[1], 381.0);
  EXPECT_EQ(one.name, "RANDOM_001_02\xC2\xB0_3262K");
  EXPECT_DOUBLE_EQ(one.reported.illuminance_lx.value(), 30.1);
  EXPECT_DOUBLE_EQ(one.reported.illuminance_last_digit_lx, 0.1);
  EXPECT_DOUBLE_EQ(one.reported.duv.value(), -0.0029);
  EXPECT_EQ(file.readings.front().time, "");  // 15/03/2021 is the day of saving, not of reading
}

TEST(Jeti, EveryFilledColumnIsAMeasurementNamedByItsInputRow) {
  const ImportedFile file = Import("jeti/spectral_Jeti_50pct.csv");
  EXPECT_EQ(file.format, "jeti_csv");
  ASSERT_THAT(file.spectra, SizeIs(41));  // 84 more are empty
  EXPECT_EQ(file.spectra.front().name, "380nm");
  EXPECT_EQ(file.spectra.back().name, "780nm");
  EXPECT_DOUBLE_EQ(file.spectra.front().reported.illuminance_lx.value(), 1.34);  // 1,34E+00
  EXPECT_DOUBLE_EQ(file.spectra.front().reported.illuminance_last_digit_lx, 0.01);
  EXPECT_EQ(file.readings.front().time, "2024-07-17T16:33:11");
  // x of CIE 1931, the first of the eight observers printed
  EXPECT_DOUBLE_EQ(file.spectra.front().reported.xy->x, 0.4161);
}

TEST(Jeti, CctOfZeroIsNoCct) {
  const ImportedFile file = Import("jeti/spectral_Jeti_50pct.csv");
  const ImportedSpectrum& at_400_nm = file.spectra.at(2);
  EXPECT_EQ(at_400_nm.name, "400nm");
  EXPECT_FALSE(at_400_nm.reported.cct_K);
  EXPECT_FALSE(at_400_nm.reported.duv);
  EXPECT_FALSE(file.readings.at(2).cct);
}

TEST(Tm27, RelativeSpectrumKeepsItsIrregularWavelengthsAndHasNoLux) {
  const ImportedFile file = Import("colour_science/Fluorescent.spdx");
  EXPECT_EQ(file.format, "tm27_spdx");
  ASSERT_THAT(file.spectra, SizeIs(1));
  const ImportedSpectrum& one = file.spectra.front();
  EXPECT_EQ(one.name, "Rare earth fluorescent lamp");
  EXPECT_EQ(one.spectrum.quantity, SpectralQuantity::kRelative);
  EXPECT_EQ(one.spectrum.wavelengths_nm[1], 403.1);
  EXPECT_EQ(one.spectrum.wavelengths_nm.back(), 850.1);
  EXPECT_FALSE(file.readings.front().illuminance);
}

// ArgyllCMS 2.3.1's own specplot -s says of this file: Abs. Y = 500.067400, x,y = 0.447530
// 0.407425, CCT = 2856.105021.
TEST(Argyll, AmbientSpectrumAgreesWithSpecplot) {
  const ImportedFile file = Import("own/argyll_ambient_2856K_500lx.sp");
  EXPECT_EQ(file.format, "argyll_sp");
  ASSERT_THAT(file.spectra, SizeIs(1));
  EXPECT_EQ(file.spectra.front().spectrum.quantity, SpectralQuantity::kIrradiance);
  EXPECT_THAT(file.spectra.front().spectrum.values, SizeIs(106));
  EXPECT_THAT(file.readings.front().illuminance->value(), DoubleNear(500.067, 0.1));
  const auto xyz = XyzFromSpectrum(file.spectra.front().spectrum);
  ASSERT_TRUE(xyz);
  EXPECT_THAT(XyFromXyz(*xyz).x, DoubleNear(0.447530, 1e-4));
  EXPECT_THAT(XyFromXyz(*xyz).y, DoubleNear(0.407425, 1e-4));
  EXPECT_THAT(CctFromXy(XyFromXyz(*xyz)).temperature.value(), DoubleNear(2856.105, 3.0));
}

TEST(PlainCsvSpectra, AreFoundByNameOrByNumberFromOne) {
  const ImportedFile file = Import("own/planck_2856K_6500K.csv");
  ASSERT_THAT(file.spectra, SizeIs(2));
  EXPECT_EQ(FindSpectrum(file, "warm").value(), 0U);
  EXPECT_EQ(FindSpectrum(file, "2").value(), 1U);
  for (const char* unknown : {"0", "3", "1.5", "lukewarm", ""}) {
    const auto found = FindSpectrum(file, unknown);
    ASSERT_FALSE(found) << unknown;
    EXPECT_EQ(found.error().code, "unknown_column");
    EXPECT_THAT(found.error().message, EndsWith("warm, cold"));
  }
  EXPECT_THAT(file.readings[0].illuminance->value(), DoubleNear(500.0, 0.05));  // mW m-2 nm-1
  EXPECT_THAT(file.readings[1].illuminance->value(), DoubleNear(250.0, 0.05));  // uW cm-2 nm-1
}

TEST(ActlumusLog, SevenDaysAreReadFromTheZip) {
  const auto file =
      ImportFile(test::SampleData("meter_logs/actlumus_205_Log_1020_20230904.txt.zip"));
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->format, "actlumus");
  EXPECT_THAT(file->warnings, IsEmpty());
  ASSERT_THAT(file->readings, SizeIs(61016));  // lines of the file after its 32 of header
  EXPECT_DOUBLE_EQ(file->readings.front().illuminance->value(), 1.57);
  EXPECT_EQ(file->readings.front().time, "2023-08-28T08:47:54");  // 28/08/2023 08:47:54
  EXPECT_EQ(file->readings.front().device, "actlumus:1020");
  EXPECT_FALSE(file->readings.front().distance);
}

}  // namespace
}  // namespace lightcal::devices
