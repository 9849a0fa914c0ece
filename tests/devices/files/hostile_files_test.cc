// SPDX-License-Identifier: Apache-2.0
// Damaged and crafted input: each has one definite code, and none is read as a measurement.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/files/import_file.h"
#include "run_cli.h"

namespace lightcal::devices {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::SizeIs;

std::string CodeOf(const std::string& bytes) {
  const auto file = ImportBytes(bytes, "hostile");
  return file ? "read as " + file->format : file.error().code;
}
std::string Sample(const std::string& name) {
  return test::ReadFile(test::SampleData("spectra/" + name));
}
std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

constexpr const char* kUprtek = "uprtek_cv600/mbp_std.xls";
constexpr const char* kSekonic = "colour_science/sekonic_RANDOM_001_02deg_3262K.csv";
constexpr const char* kJeti = "jeti/spectral_Jeti_50pct.csv";
constexpr const char* kSpdx = "colour_science/Fluorescent.spdx";
constexpr const char* kArgyll = "own/argyll_ambient_2856K_500lx.sp";
constexpr const char* kCsv = "own/planck_2856K_6500K.csv";

TEST(HostileFile, ThatDoesNotExistIsNotFound) {
  const auto file = ImportFile("/nowhere/at/all.csv");
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().code, "not_found");
  EXPECT_EQ(file.error().kind, ErrorKind::kFailed);
}

TEST(HostileFile, ThatIsADirectoryIsUnreadable) {
  const test::TempDir directory;
  const auto file = ImportFile(directory.path());
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().code, "unreadable");
}

TEST(HostileFile, ThatNeverEndsIsTooLarge) {
  const auto file = ImportFile("/dev/zero");
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().code, "too_large");
}

TEST(HostileFile, WithNothingInItHasNoRows) {
  for (const char* nothing : {"", "\n\n", "\xEF\xBB\xBF", " \t\r\n"}) {
    EXPECT_EQ(CodeOf(nothing), "no_rows");
  }
  EXPECT_EQ(CodeOf("wavelength_nm,relative\n"), "no_rows");
  EXPECT_EQ(CodeOf("# comment\ndistance_m,lux\n# 1,2\n"), "no_rows");
}

TEST(HostileFile, WhoseCommentOpensAQuoteThatSwallowsItsHeaderHasNoRows) {
  EXPECT_EQ(CodeOf("# typed by hand, \"no lamp\nlight,distance_cm,illuminance_lx\nkey,100,48\n"),
            "no_rows");
}

TEST(HostileFile, WithNulBytesIsNoText) {
  EXPECT_EQ(CodeOf(std::string(1000, '\0')), "not_text");
  std::string damaged = Sample(kUprtek);
  damaged[damaged.size() / 2] = '\0';
  EXPECT_EQ(CodeOf(damaged), "not_text");
}

TEST(HostileFile, OfAnotherKindIsUnknownAndTheMessageListsWhatIsUnderstood) {
  const auto file = ImportBytes("Dear Sir,\nplease find attached\n", "letter.txt");
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().code, "unknown_format");
  for (const char* format : {"Sekonic", "UPRtek", "JETI", "TM-27", "Argyll", "ActLumus",
                             "distance_m", "irradiance_mW_m2_nm"}) {
    EXPECT_THAT(file.error().message, HasSubstr(format));
  }
}

TEST(HostileFile, OfOneMillionCharactersInALineIsRefusedNotChokedOn) {
  EXPECT_EQ(CodeOf(std::string(1'000'000, 'a')), "unknown_format");
  EXPECT_EQ(CodeOf("lux\n" + std::string(1'000'000, '9') + "\n"), "bad_row");
  EXPECT_EQ(CodeOf("lux,light\n1,\"" + std::string(1'000'000, ',')), "read as csv");
  EXPECT_EQ(CodeOf("lux\n1" + std::string(1'000'000, ',') + "\n"), "bad_row");
}

// Cut anywhere, a spectrum either refuses or still holds a whole, shorter spectrum; it never
// invents.
TEST(HostileFile, CutShortIsRefusedWithADefiniteCode) {
  for (const char* name : {kUprtek, kSekonic, kJeti, kSpdx, kArgyll, kCsv}) {
    const std::string whole = Sample(name);
    for (int part = 1; part < 40; ++part) {
      const auto file = ImportBytes(whole.substr(0, whole.size() * part / 40), "cut");
      if (file) {
        EXPECT_FALSE(file->spectra.empty()) << name << " " << part;
      } else {
        EXPECT_THAT(file.error().code, AnyOf("bad_spectrum", "no_rows", "unknown_format"))
            << name << " " << part;
      }
    }
  }
}

TEST(HostileFile, CutWithinTheBlueEndDisagreesWithItsOwnHeader) {
  const std::string whole = Sample(kUprtek);
  const auto file = ImportBytes(whole.substr(0, whole.find("560nm")), "cut.xls");
  ASSERT_TRUE(file);
  ASSERT_THAT(file->warnings, SizeIs(2));
  EXPECT_EQ(file->warnings[0].code, "spectrum_disagrees");
  EXPECT_EQ(file->warnings[1].code, "color_disagrees");
  EXPECT_DOUBLE_EQ(file->readings[0].cct->value(),
                   6734.0);  // the instrument saw the whole spectrum
}

struct Damage {
  std::string name;
  const char* sample;
  std::string from;
  std::string to;
};
class DamagedSpectrum : public testing::TestWithParam<Damage> {};
INSTANTIATE_TEST_SUITE_P(
    Each, DamagedSpectrum,
    testing::Values(Damage{"UprtekNaN", kUprtek, "400nm\t", "400nm\tnan"},
                    Damage{"UprtekInf", kUprtek, "400nm\t", "400nm\tinf\t"},
                    Damage{"UprtekDecimalComma", kUprtek, "400nm\t0.", "400nm\t0,"},
                    Damage{"UprtekDuplicate", kUprtek, "401nm\t", "400nm\t"},
                    Damage{"UprtekDecreasing", kUprtek, "401nm\t", "399nm\t"},
                    Damage{"SekonicNaN", kSekonic, "Spectral Data 400[nm],0.0000119",
                           "Spectral Data 400[nm],nan"},
                    Damage{"SekonicDecreasing", kSekonic, "Spectral Data 381[nm]",
                           "Spectral Data 379[nm]"},
                    Damage{"JetiDecimalPoint", kJeti, "\r\n385;2,90E-04", "\r\n385;2.90E-04"},
                    Damage{"JetiDecreasing", kJeti, "\r\n385;2,90E-04", "\r\n383;2,90E-04"},
                    Damage{"JetiMissing", kJeti, "\r\n385;2,90E-04", "\r\n385;"},
                    Damage{"SpdxNaN", kSpdx, ">0.069<", ">NaN<"},
                    Damage{"SpdxComma", kSpdx, ">0.069<", ">0,069<"},
                    Damage{"SpdxDuplicate", kSpdx, "\"405.5\"", "\"403.1\""},
                    Damage{"SpdxReflectance", kSpdx, ">relative<", ">reflectance<"},
                    Damage{"SpdxNotWellFormed", kSpdx, "</Header>", ""},
                    Damage{"ArgyllReflective", kArgyll, "\"AMBIENT\"", "\"REFLECTIVE\""},
                    Damage{"ArgyllManyBands", kArgyll, "BANDS \"106\"", "BANDS \"1e18\""},
                    Damage{"ArgyllMoreBandsThanValues", kArgyll, "BANDS \"106\"", "BANDS \"107\""},
                    Damage{"ArgyllNormZero", kArgyll, "NORM \"1.000000\"", "NORM \"0\""},
                    Damage{"ArgyllBackwards", kArgyll, "END_NM \"730", "END_NM \"330"},
                    Damage{"CsvDuplicate", kCsv, "\n381,", "\n380,"},
                    Damage{"CsvDecreasing", kCsv, "\n390,", "\n300,"},
                    Damage{"CsvNaN", kCsv, "\n381,0", "\n381,nan,0"}),
    [](const auto& damage) { return damage.param.name; });

TEST_P(DamagedSpectrum, IsRefused) {
  const std::string code =
      CodeOf(Replaced(Sample(GetParam().sample), GetParam().from, GetParam().to));
  EXPECT_THAT(code, AnyOf("bad_spectrum", "bad_row"));
}

TEST(DarkSpectrum, AloneIsRefusedAndAmongOthersWarned) {
  EXPECT_EQ(CodeOf("wavelength_nm,relative\n400,0\n500,0\n"), "bad_spectrum");
  const auto file =
      ImportBytes("wavelength_nm,a relative,b relative\n400,0,1\n500,0,1\n600,0,2\n", "two.csv");
  ASSERT_TRUE(file);
  ASSERT_THAT(file->warnings, SizeIs(1));
  EXPECT_EQ(file->warnings[0].code, "dark_spectrum");
  EXPECT_FALSE(file->readings[0].xy);
  EXPECT_TRUE(file->readings[1].xy);
}

TEST(Tm27, IrradianceGivesLuxAndOtherQuantitiesGiveColorWithAWarning) {
  const std::string relative = Sample(kSpdx);
  const auto absolute = ImportBytes(Replaced(relative, ">relative<", ">irradiance<"), "e.spdx");
  ASSERT_TRUE(absolute);
  const auto xyz = XyzFromSpectrum(absolute->spectra.at(0).spectrum);
  ASSERT_TRUE(xyz);
  EXPECT_DOUBLE_EQ(absolute->readings.at(0).illuminance.value().value(), xyz->Y);
  const auto radiance = ImportBytes(Replaced(relative, ">relative<", ">radiance<"), "l.spdx");
  ASSERT_TRUE(radiance);
  ASSERT_THAT(radiance->warnings, SizeIs(1));
  EXPECT_EQ(radiance->warnings[0].code, "relative_spectrum");
  EXPECT_FALSE(radiance->readings.at(0).illuminance);
}

TEST(Tm27, NamespacePrefixDoesNotHideTheData) {
  std::string prefixed = Sample(kSpdx);
  for (const char* element :
       {"IESTM2714", "SpectralDistribution", "SpectralQuantity", "SpectralData"}) {
    for (const char* bracket : {"<", "</"}) {
      const std::string plain = std::string(bracket) + element;
      const std::string with_prefix = std::string(bracket) + "t:" + element;
      for (std::size_t at = 0; (at = prefixed.find(plain, at)) != std::string::npos;
           at += with_prefix.size()) {
        prefixed.replace(at, plain.size(), with_prefix);
      }
    }
  }
  prefixed = Replaced(prefixed, "xmlns=", "xmlns:t=");
  const auto file = ImportBytes(prefixed, "prefixed.spdx");
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->spectra.at(0).spectrum.values,
            ImportBytes(Sample(kSpdx), "plain.spdx")->spectra.at(0).spectrum.values);
}

TEST(Argyll, ValuesAreDividedByTheNormAndEmissionIsRelative) {
  const auto plain = ImportBytes(Sample(kArgyll), "a.sp");
  const auto halved = ImportBytes(Replaced(Sample(kArgyll), "NORM \"1.0", "NORM \"2.0"), "a.sp");
  ASSERT_TRUE(plain);
  ASSERT_TRUE(halved);
  EXPECT_NEAR(halved->readings[0].illuminance->value(),
              0.5 * plain->readings[0].illuminance->value(), 1e-9);
  const auto emission = ImportBytes(Replaced(Sample(kArgyll), "AMBIENT", "EMISSION"), "a.sp");
  ASSERT_TRUE(emission);
  EXPECT_EQ(emission->spectra[0].spectrum.quantity, SpectralQuantity::kRelative);
  ASSERT_THAT(emission->warnings, SizeIs(1));
  EXPECT_EQ(emission->warnings[0].code, "relative_spectrum");
}

TEST(Sekonic, FlashReadingIsAnExposureSoOnlyItsColorIsUsed) {
  const auto file =
      ImportBytes(Replaced(Sample(kSekonic), "Mode,Ambient", "Mode,Cordless Flash"), "f.csv");
  ASSERT_TRUE(file);
  EXPECT_EQ(file->spectra[0].spectrum.quantity, SpectralQuantity::kRelative);
  ASSERT_THAT(file->warnings, SizeIs(1));
  EXPECT_EQ(file->warnings[0].code, "relative_spectrum");
}

TEST(ActlumusLog, TornLastRowIsLeftOutWithOneWarning) {
  const std::string log =
      "#ActLogModel=2.0.0\r\nDEVICE_ID : 7\r\nDATE/TIME;MS;LIGHT\r\n"
      "28/08/2023 08:47:54;0;1.57\r\n31/02/2023 08:48:04;0;3.72\r\n28/08/2023 08:4";
  const auto file = ImportBytes(log, "log.txt");
  ASSERT_TRUE(file);
  EXPECT_THAT(file->readings, SizeIs(1));
  ASSERT_THAT(file->warnings, SizeIs(1));
  EXPECT_EQ(file->warnings[0].code, "bad_row");
  EXPECT_EQ(file->warnings[0].subject, "log.txt:5");
  EXPECT_THAT(file->warnings[0].message, HasSubstr("2 rows"));
  EXPECT_EQ(CodeOf(log.substr(0, 50)), "no_rows");
}

TEST(Zip, DamagedArchiveIsRefused) {
  const std::string zip =
      test::ReadFile(test::SampleData("meter_logs/actlumus_205_Log_1020_20230904.txt.zip"));
  EXPECT_EQ(CodeOf(zip.substr(0, 100)), "bad_archive");
  EXPECT_EQ(CodeOf(zip.substr(0, zip.size() / 2)), "bad_archive");
  std::string damaged = zip;
  for (std::size_t i = 1000; i < 3000; ++i) damaged[i] = static_cast<char>(i);
  EXPECT_EQ(CodeOf(damaged), "bad_archive");
}

}  // namespace
}  // namespace lightcal::devices
