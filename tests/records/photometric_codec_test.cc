// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/photometric_codec.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>
#include <optional>
#include <sstream>

namespace lightcal {
namespace {

constexpr double kPi = std::numbers::pi;

std::string Sample(const std::string& name) {
  std::ifstream stream(std::string(LIGHTCAL_SOURCE_DIR) + "/sample_data/photometric/" + name,
                       std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

PhotometricFile Read(std::string_view text, const TiltText& tilt = {}) {
  auto read = PhotometricFromText(text, "lamp", tilt);
  EXPECT_TRUE(read) << (read ? "" : read.error().message);
  return std::move(read->file);
}

double CandelaAt(const PhotometricFile& file, double c, double gamma) {
  return file.table.At(RadiansFromDegrees(c), RadiansFromDegrees(gamma)).value();
}

// A lamp of 100 cd everywhere, with the pieces that editions differ in.
struct Ies {
  std::string version = "IESNA:LM-63-2002\n";
  std::string keywords = "[TEST] 1\n[MANUFAC] Ours\n";
  std::string tilt = "TILT=NONE\n";
  std::string lamps = "1 -1 1 2 1 1 2";
  std::string size = " 0 0 0\n";
  std::string factors = "1 1 60\n";
  std::string angles = "0 180\n0\n";
  std::string candela = "100 100\n";
  [[nodiscard]] std::string Text() const {
    return version + keywords + tilt + lamps + size + factors + angles + candela;
  }
};

// ---- EULUMDAT: real files ----

struct RealLdt {
  const char* name;
  double flux_lm, peak_cd;
  TableSymmetry symmetry;
  bool absolute;
};
class RealEulumdat : public testing::TestWithParam<RealLdt> {};

// Lumens and peaks as shared/data/06_ldt states them: lamp lumens times the output ratio; of
// sample1, whose two sets of lamps are one LED module at two currents, those of the first.
INSTANTIATE_TEST_SUITE_P(
    SampleData, RealEulumdat,
    testing::Values(RealLdt{"sample1.ldt", 1983.0, 702.5, TableSymmetry::kQuadrant, false},
                    RealLdt{"sample2.ldt", 4600.0, 4520.3, TableSymmetry::kBilateral, false},
                    RealLdt{"sample5.ldt", 611.9, 471.3, TableSymmetry::kAxial, true},
                    RealLdt{"sample10.ldt", 7000.0, 1715.7, TableSymmetry::kQuadrant, false}));

TEST_P(RealEulumdat, FluxIsThatOfTheLampsWithinAThousandth) {
  const RealLdt& want = GetParam();
  const PhotometricFile file = Read(Sample(want.name));
  ASSERT_TRUE(file.header.output_ratio);
  EXPECT_NEAR(*file.header.output_ratio, 1.0, 1e-12);
  EXPECT_NEAR(file.header.lamp_flux->value(), want.flux_lm, 1e-9);
  EXPECT_NEAR(file.table.Flux().value() / want.flux_lm, 1.0, 1e-3);
  EXPECT_NEAR(file.table.peak().intensity.value(), want.peak_cd, 0.05);
  EXPECT_EQ(file.table.symmetry(), want.symmetry);
  EXPECT_EQ(file.header.absolute, want.absolute);
}

TEST_P(RealEulumdat, ThroughIesAndBackKeepsEveryPrintedDigit) {
  const PhotometricFile file = Read(Sample(GetParam().name));
  const PhotometricFile ies = Read(IesText(file));
  const PhotometricFile back = Read(*EulumdatText(ies));
  EXPECT_EQ(back.table.grid().vertical_deg, file.table.grid().vertical_deg);
  EXPECT_EQ(back.table.grid().horizontal_deg, file.table.grid().horizontal_deg);
  for (std::size_t i = 0; i < file.table.grid().candela.size(); ++i) {
    const double want = file.table.grid().candela[i];
    EXPECT_NEAR(back.table.grid().candela[i], want, 1e-7 * want);
  }
  EXPECT_EQ(IesText(back), IesText(ies));
}

TEST(Eulumdat, ReadsTheHeaderOfARealFile) {
  const PhotometricFile file = Read(Sample("sample5.ldt"));
  EXPECT_EQ(file.header.manufacturer, "ERCO GmbH");
  EXPECT_EQ(file.header.luminaire, "Iku Surface-mounted downlight");
  EXPECT_EQ(file.header.lamps.front().type, "LED 4.8W neutral white");
  EXPECT_NEAR(file.header.power.value(), 6.9, 1e-12);
  EXPECT_EQ(file.header.opening.shape, OpeningShape::kRound);
  EXPECT_NEAR(file.header.opening.along_c0.value(), 0.076, 1e-12);
}

// A lamp whose planes are all different, written by hand: Isym, Mc, C angles, planes.
std::string Ldt(int symmetry, const std::vector<double>& c, int planes,
                const std::string& ratio = "100", const std::string& factor = "1") {
  std::ostringstream out;
  out << "Ours\n1\n" << symmetry << "\n" << c.size() << "\n0\n3\n90\nr\nn\nc\nf\nd\n";
  out << "100\n50\n20\n80\n40\n0\n0\n0\n0\n50\n" << ratio << "\n" << factor << "\n0\n1\n";
  out << "2\nLED\n2000\n3000K\n90\n20\n";
  for (int i = 0; i < 10; ++i) out << "0\n";
  for (const double angle : c) out << angle << "\n";
  out << "0\n90\n180\n";
  for (int p = 0; p < planes; ++p) out << "10\n" << 10 + p << "\n10\n";
  return out.str();
}

TEST(Eulumdat, EverySymmetryPutsItsPlanesWhereTheyBelong) {
  const std::vector<double> c = {0, 45, 90, 135, 180, 225, 270, 315};
  // Candela are per 1000 lm of 2000: twice what stands there.
  const PhotometricFile none = Read(Ldt(0, c, 8));
  for (int p = 0; p < 8; ++p) EXPECT_NEAR(CandelaAt(none, 45.0 * p, 90), 20.0 + 2 * p, 1e-9);
  const PhotometricFile axial = Read(Ldt(1, c, 1));
  EXPECT_NEAR(CandelaAt(axial, 77, 90), 20.0, 1e-9);
  const PhotometricFile half = Read(Ldt(2, c, 5));
  EXPECT_NEAR(CandelaAt(half, 135, 90), 26.0, 1e-9);
  EXPECT_NEAR(CandelaAt(half, 225, 90), 26.0, 1e-9);
  // From C270 over C0 to C90: planes 0, 1, 2 are C270, C315, C0.
  const PhotometricFile half90 = Read(Ldt(3, c, 5));
  EXPECT_NEAR(CandelaAt(half90, 270, 90), 20.0, 1e-9);
  EXPECT_NEAR(CandelaAt(half90, 315, 90), 22.0, 1e-9);
  EXPECT_NEAR(CandelaAt(half90, 225, 90), 22.0, 1e-9);
  EXPECT_NEAR(CandelaAt(half90, 0, 90), 24.0, 1e-9);
  EXPECT_NEAR(CandelaAt(half90, 180, 90), 24.0, 1e-9);
  EXPECT_NEAR(CandelaAt(half90, 45, 90), 26.0, 1e-9);
  EXPECT_NEAR(CandelaAt(half90, 90, 90), 28.0, 1e-9);
  const PhotometricFile quadrant = Read(Ldt(4, c, 3));
  EXPECT_NEAR(CandelaAt(quadrant, 45, 90), 22.0, 1e-9);
  EXPECT_NEAR(CandelaAt(quadrant, 225, 90), 22.0, 1e-9);
}

TEST(Eulumdat, WrittenFilesReadBackTheSameInEverySymmetry) {
  const std::vector<double> c = {0, 45, 90, 135, 180, 225, 270, 315};
  const int planes[] = {8, 1, 5, 5, 3};
  for (int symmetry = 0; symmetry < 5; ++symmetry) {
    const PhotometricFile file = Read(Ldt(symmetry, c, planes[symmetry]));
    const PhotometricFile back = Read(*EulumdatText(file));
    EXPECT_EQ(back.table.grid().horizontal_deg, file.table.grid().horizontal_deg) << symmetry;
    EXPECT_EQ(back.table.grid().candela, file.table.grid().candela) << symmetry;
    EXPECT_EQ(back.header.lamps.front().count, 2);
  }
}

TEST(Eulumdat, TakesDecimalCommasMarksConversionFactorsAndAbsoluteCounts) {
  std::string text = Ldt(1, {0}, 1, "100", "0,5");
  EXPECT_NEAR(CandelaAt(Read(text), 0, 0), 10.0, 1e-12);
  text = Ldt(1, {0}, 1);
  EXPECT_NEAR(CandelaAt(Read("\xEF\xBB\xBF" + text), 0, 0), 20.0, 1e-12);
  text.replace(text.find("\n2\nLED"), 6, "\n-2\nLED");
  const PhotometricFile absolute = Read(text);
  EXPECT_TRUE(absolute.header.absolute);
  EXPECT_NEAR(CandelaAt(absolute, 0, 0), 20.0, 1e-12);
  EXPECT_NE(EulumdatText(absolute)->find("\r\n-2\r\nLED"), std::string::npos);
}

TEST(Ies, WarnsWhenMoreComesOutThanItsLampsGive) {
  const auto codes = [](const std::string& lumens) {
    const auto read = PhotometricFromText("IESNA:LM-63-2002\nTILT=NONE\n1 " + lumens +
                                              " 1 2 1 1 2 0 0 0\n1 1 60\n0 180\n0\n100 100\n",
                                          "x.ies");
    EXPECT_TRUE(read);
    std::vector<std::string> out;
    for (const Warning& warning : read->warnings) out.push_back(warning.code);
    return out;
  };
  // 400 pi = 1257 lm.
  EXPECT_EQ(codes("500"), std::vector<std::string>{"flux_disagrees"});
  EXPECT_EQ(codes("1250"), std::vector<std::string>{});
  EXPECT_EQ(codes("3000"), std::vector<std::string>{}) << "a dark luminaire may be";
  EXPECT_EQ(codes("-1"), std::vector<std::string>{}) << "absolute";
}

TEST(Eulumdat, WarnsWhenTheLumensAreNotThoseOfTheIntensities) {
  const auto read = PhotometricFromText(Ldt(1, {0}, 1, "35"), "x.ldt");
  ASSERT_TRUE(read);
  ASSERT_EQ(read->warnings.size(), 1U);
  EXPECT_EQ(read->warnings[0].code, "flux_disagrees");
}

// One LED module at 17.6 or at 24.9 W: either is in the luminaire, never both.
TEST(Eulumdat, SetsOfLampsAreAlternatives) {
  const std::string text = Sample("sample1.ldt");
  const auto read = [&](std::optional<int> set) {
    return PhotometricFromText(text, "lamp.ldt", {}, set);
  };
  const auto first = read({});
  ASSERT_TRUE(first);
  ASSERT_EQ(first->warnings.size(), 1U);
  EXPECT_EQ(first->warnings[0].code, "lamp_sets");
  EXPECT_NE(first->warnings[0].message.find("1983 lm, 17.6 W; 1 x LED Module, 2643 lm, 24.9 W"),
            std::string::npos)
      << first->warnings[0].message;
  EXPECT_DOUBLE_EQ(first->file.header.power.value(), 17.6);
  const auto second = read(2);
  ASSERT_TRUE(second);
  EXPECT_TRUE(second->warnings.empty());
  EXPECT_DOUBLE_EQ(second->file.header.lamp_flux->value(), 2643.0);
  EXPECT_NEAR(second->file.table.Flux() / first->file.table.Flux(), 2643.0 / 1983.0, 1e-12);
  EXPECT_DOUBLE_EQ(Read(IesText(second->file)).header.lamp_flux->value(), 2643.0);
  EXPECT_DOUBLE_EQ(Read(*EulumdatText(second->file)).header.lamp_flux->value(), 2643.0);
  EXPECT_EQ(read(3).error().code, "no_lamp_set");
  EXPECT_EQ(PhotometricFromText(Ies{}.Text(), "x.ies", {}, 2).error().code, "no_lamp_set");
}

TEST(Eulumdat, Latin1NamesComeThrough) {
  std::string text = Ldt(1, {0}, 1);
  text.replace(0, 4, "Z\xFCrich");
  const PhotometricFile file = Read(text);
  EXPECT_EQ(file.header.manufacturer, "Z\xC3\xBCrich");
  EXPECT_EQ(EulumdatText(file)->substr(0, 6), "Z\xFCrich");
  EXPECT_NE(IesText(file).find("[MANUFAC] Z?rich"), std::string::npos);
}

// ---- IES ----

TEST(Ies, UniformLampCarriesFourPi) {
  const PhotometricFile file = Read(Ies{}.Text());
  EXPECT_NEAR(file.table.Flux().value(), 400.0 * kPi, 1e-9);
  EXPECT_TRUE(file.header.absolute);
  EXPECT_FALSE(file.header.lamp_flux);
  EXPECT_EQ(file.header.manufacturer, "Ours");
}

TEST(Ies, EveryEditionAppliesItsOwnFactors) {
  const auto candela = [](const std::string& version, const std::string& factors) {
    Ies ies;
    ies.version = version;
    ies.factors = factors + " 60\n";
    ies.lamps = "1 1000 2 2 1 1 2";
    return CandelaAt(Read(ies.Text()), 0, 40);
  };
  EXPECT_NEAR(candela("", "0.9 0.5"), 90.0, 1e-9);  // 1986 has no version line
  EXPECT_NEAR(candela("IESNA91\n", "0.9 0.5"), 90.0, 1e-9);
  EXPECT_NEAR(candela("IESNA:LM-63-1995\n", "0.9 1"), 180.0, 1e-9);
  EXPECT_NEAR(candela("IESNA:LM-63-2002\n", "0.9 1"), 180.0, 1e-9);
  EXPECT_NEAR(candela("IES:LM-63-2019\n", "0.9 1"), 180.0, 1e-9);
}

TEST(Ies, TheGenerationFieldOf2019IsNoFactor) {
  const std::pair<const char*, const char*> words[] = {
      {"1.10000", "accredited laboratory"},
      {"1.00001", "undefined"},
      {"1.00010", "simulation"},
      {"1.00000", "laboratory"},
      {"1.11100", "accredited laboratory, interpolated, scaled"}};
  for (const auto& [number, word] : words) {
    Ies ies;
    ies.version = "IES:LM-63-2019\n";
    ies.factors = std::string("1 ") + number + " 60\n";
    const PhotometricFile file = Read(ies.Text());
    EXPECT_EQ(file.header.generation, word);
    EXPECT_DOUBLE_EQ(CandelaAt(file, 0, 90), 100.0) << number;
    // And it is gone from what we write, where some loaders would multiply by it.
    EXPECT_NE(IesText(file).find("\r\n1 1 60\r\n"), std::string::npos);
  }
  Ies reserved;
  reserved.factors = "1 1.1 60\n";
  const auto read = PhotometricFromText(reserved.Text(), "x.ies");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->warnings.at(0).code, "reserved_field");
  EXPECT_DOUBLE_EQ(CandelaAt(read->file, 0, 90), 100.0);
}

TEST(Ies, FeetMetresAndOpeningsByTheirSigns) {
  const auto opening = [](const std::string& lamps, const std::string& size) {
    Ies ies;
    ies.lamps = lamps;
    ies.size = " " + size + "\n";
    return Read(ies.Text()).header.opening;
  };
  const std::string feet = "1 -1 1 2 1 1 1";
  const std::string metres = "1 -1 1 2 1 1 2";
  EXPECT_EQ(opening(metres, "0 0 0").shape, OpeningShape::kPoint);
  const LuminousOpening rect = opening(feet, "2 4 0");
  EXPECT_EQ(rect.shape, OpeningShape::kRect);
  EXPECT_NEAR(rect.along_c90.value(), 0.6096, 1e-12);
  EXPECT_NEAR(rect.along_c0.value(), 1.2192, 1e-12);
  EXPECT_EQ(opening(metres, "-.3 -.3 0").shape, OpeningShape::kRound);
  EXPECT_EQ(opening(metres, "-.3 -.3 -.3").shape, OpeningShape::kSphere);
  const LuminousOpening old = opening(metres, "-.3 0 .1");
  EXPECT_EQ(old.shape, OpeningShape::kRound);
  EXPECT_NEAR(old.along_c0.value(), 0.3, 1e-12);
}

TEST(Ies, TiltIsReadFromTheFileOrBesideItAndChangesNoIntensity) {
  Ies ies;
  ies.tilt = "TILT=INCLUDE\n1\n3\n0 45 90\n1 .95 .9\n";
  PhotometricFile file = Read(ies.Text());
  ASSERT_TRUE(file.header.tilt);
  EXPECT_EQ(file.header.tilt->factor, (std::vector<double>{1, 0.95, 0.9}));
  EXPECT_DOUBLE_EQ(CandelaAt(file, 0, 90), 100.0);
  ies.tilt = "TILT=mh400.tlt\n";
  file = Read(ies.Text(), [](const std::string& name) -> Result<std::string> {
    EXPECT_EQ(name, "mh400.tlt");
    return std::string("2\n2\n0 90\n1 .8\n");
  });
  ASSERT_TRUE(file.header.tilt);
  EXPECT_EQ(file.header.tilt->geometry, 2);
  const auto missing = PhotometricFromText(ies.Text(), "x.ies");
  ASSERT_TRUE(missing);
  EXPECT_EQ(missing->warnings.at(0).code, "tilt_missing");
  EXPECT_NE(IesText(file).find("TILT=NONE"), std::string::npos);
}

TEST(Ies, LineEndsCommasAndBlanksDoNotMatter) {
  const std::string plain = Ies{}.Text();
  const auto with = [&](const std::string& end) {
    std::string text;
    for (const char c : plain) text += c == '\n' ? end : std::string(1, c);
    return CandelaAt(Read(text), 0, 60);
  };
  for (const char* end : {"\n", "\r\n", "\r", " \n", "\n\n"}) EXPECT_DOUBLE_EQ(with(end), 100.0);
  Ies commas;
  commas.lamps = "1,-1,1,2,1,1,2";
  commas.candela = "100,100\n\x1a";
  EXPECT_DOUBLE_EQ(CandelaAt(Read(commas.Text()), 0, 60), 100.0);
}

// LM-63 parts numbers by commas: a decimal comma makes two numbers of one.
TEST(Ies, DecimalCommasAreReadAsSuchOrRefused) {
  Ies ies;
  ies.angles = "0 45,5 90\n0\n";
  ies.lamps = "1 -1 1,0 3 1 1 2";
  ies.candela = "100,25 70,5 1,5\n";
  const auto read = PhotometricFromText(ies.Text(), "x.ies");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->warnings.size(), 1U);
  EXPECT_EQ(read->warnings[0].code, "decimal_commas");
  EXPECT_EQ(read->file.table.grid().vertical_deg, (std::vector<double>{0, 45.5, 90}));
  EXPECT_EQ(read->file.table.grid().candela, (std::vector<double>{100.25, 70.5, 1.5}));
  // Surplus numbers that no decimal commas explain.
  Ies surplus;
  surplus.candela = "100,50 70,5 3\n";
  const auto refused = PhotometricFromText(surplus.Text(), "x.ies");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "bad_photometric");
  EXPECT_NE(refused.error().message.find("commas"), std::string::npos);
  // Commas that part, and words behind the last number.
  Ies parted;
  parted.candela = "100,50\nEND\n";
  const auto fine = PhotometricFromText(parted.Text(), "x.ies");
  ASSERT_TRUE(fine) << fine.error().message;
  EXPECT_EQ(fine->file.table.grid().candela, (std::vector<double>{100, 50}));
}

TEST(Ies, TypesAAndBKeepTheirTypeAndDirections) {
  Ies ies;
  ies.angles = "-10 0 30\n-20 0 40\n";
  ies.candela = "1 2 3\n4 50 6\n7 8 9\n";
  for (const char type : {'2', '3'}) {
    ies.lamps = std::string("1 -1 1 3 3 ") + type + " 2";
    const PhotometricFile file = Read(ies.Text());
    const PhotometricFile back = Read(IesText(file));
    EXPECT_EQ(back.table.grid().type, file.table.grid().type);
    EXPECT_EQ(back.table.grid().candela, file.table.grid().candela);
    // (H, V) = (0, 0): nadir; V towards C0, H towards C270.
    EXPECT_NEAR(CandelaAt(file, 0, 0), 50.0, 1e-9);
    EXPECT_NEAR(CandelaAt(file, 0, 30), 6.0, 1e-9);
    EXPECT_NEAR(CandelaAt(file, 270, 40), 8.0, 1e-9);
    EXPECT_FALSE(EulumdatText(file));
  }
}

TEST(Ies, ThroughEulumdatAndBackIsTheSameToThePrintedDigits) {
  Ies ies;
  ies.keywords =
      "[TEST] ITL 123\n[TESTLAB] A lab\n[ISSUEDATE] 1-JAN-2020\n[MANUFAC] Ours\n"
      "[LUMCAT] X-1\n[LUMINAIRE] A lamp\n[MORE] with a long name\n[LAMP] LED\n";
  ies.lamps = "2 1234.5 1 4 5 1 2";
  ies.size = " 0.3 1.2 0.05\n";
  ies.angles = "0 22.5 45 90\n0 22.5 45 67.5 90\n";
  ies.candela =
      "1234.567 1000.001 77.7 0.01\n1234.567 3.14159 0.5 0\n1234.567 2 3 4\n"
      "1234.567 0.3333333 5 6\n1234.567 98765.432 7 8\n";
  const PhotometricFile file = Read(ies.Text());
  const std::string text = IesText(file);
  const std::string ldt = *EulumdatText(file);
  EXPECT_EQ(IesText(Read(ldt)), text);
  EXPECT_EQ(*EulumdatText(Read(text)), ldt);
  for (const char* digits : {"1234.567 1000.001 77.7 0.01\r\n", "98765.432", "0.3333333", "3.14159",
                             "2 1234.5 1 4 5 1 2 0.3 1.2 0.05\r\n", "A lamp with a long name"}) {
    EXPECT_NE(text.find(digits), std::string::npos) << digits;
  }
}

TEST(Ies, WhatWeWriteObeysTheStrictestReaders) {
  PhotometricFile file = Read(Sample("sample1.ldt"));
  file.header.luminaire = "A lamp with a TILT lever, tilt=90";
  const std::string text = IesText(file);
  EXPECT_TRUE(text.starts_with("IESNA:LM-63-2002\r\n[TEST] "));
  EXPECT_EQ(text.find("TILT"), text.rfind("TILT"));
  for (std::size_t i = 0; i < text.size(); ++i) {
    ASSERT_LT(static_cast<unsigned char>(text[i]), 0x7F);
    if (text[i] == '\n') {
      ASSERT_EQ(text[i - 1], '\r');
    }
    if (text[i] == '\r') {
      ASSERT_NE(text[i - 1], ' ');
    }
  }
  std::istringstream lines(text.substr(text.find("TILT=")));
  std::string line;
  std::getline(lines, line);
  std::getline(lines, line);
  EXPECT_EQ(line.find("1 1983 1 73 37 1 2 "), 0U) << line;
  std::getline(lines, line);
  EXPECT_EQ(line, "1 1 17.6\r");
  while (std::getline(lines, line)) EXPECT_LE(line.size(), 132U);
}

TEST(Ies, LongNamesStayWithinTheLineAndWritingIsAFixedPoint) {
  PhotometricFile file = Read(Ies{}.Text());
  for (const std::size_t length : {240U, 243U, 256U, 5000U}) {
    file.header.luminaire = std::string(length, 'x') + " \xC3\xBC";
    const std::string text = IesText(file);
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 255U);
    EXPECT_EQ(IesText(Read(text)), text) << length;
  }
}

TEST(Ies, LumensAreThoseOfTheTableWhereNoneAreKnown) {
  const std::string text = IesText(Read(Ies{}.Text()));
  EXPECT_NE(text.find("\r\n1 1256.6371 1 2 1 1 2 0 0 0\r\n"), std::string::npos) << text;
  const PhotometricFile ldt = Read(*EulumdatText(Read(Ies{}.Text())));
  EXPECT_TRUE(ldt.header.absolute);
  EXPECT_NEAR(CandelaAt(ldt, 0, 50), 100.0, 1e-7);
}

}  // namespace
}  // namespace lightcal
