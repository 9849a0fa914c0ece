// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/files/plain_csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "lightcal_devices/files/import_file.h"
#include "run_cli.h"

namespace lightcal::devices {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

ImportedFile Read(const std::string& text) {
  auto file = ImportBytes(text, "table.csv");
  EXPECT_TRUE(file) << file.error().code << ": " << file.error().message;
  return file ? *file : ImportedFile{};
}
Error Refusal(const std::string& text) {
  const auto file = ImportBytes(text, "table.csv");
  EXPECT_FALSE(file);
  return file ? Error{} : file.error();
}

TEST(PlainCsv, UnitsOfTheColumnNamesAreConverted) {
  const ImportedFile file = Read("distance_cm,illuminance_fc,tilt_deg\n50,17.84,30\n");
  ASSERT_THAT(file.readings, SizeIs(1));
  EXPECT_DOUBLE_EQ(file.readings[0].distance->value(), 0.5);
  EXPECT_NEAR(file.readings[0].illuminance->value(), 192.028, 0.001);  // 17.84 / 0.3048^2
  EXPECT_NEAR(file.readings[0].tilt.value(), 0.523599, 1e-6);
}

TEST(PlainCsv, OwnSampleNamesLightDistanceColorAndTime) {
  const auto file = ImportFile(test::SampleData("lux_tables/own/typed_readings.csv"));
  ASSERT_TRUE(file);
  ASSERT_THAT(file->readings, SizeIs(3));
  EXPECT_EQ(file->readings[1].light, "key");
  EXPECT_DOUBLE_EQ(file->readings[1].distance->value(), 1.0);
  EXPECT_DOUBLE_EQ(file->readings[1].illuminance->value(), 48.3);
  EXPECT_DOUBLE_EQ(file->readings[1].cct->value(), 2900.0);
  EXPECT_EQ(file->readings[1].time, "2026-11-21T14:04:00");
}

TEST(PlainCsv, DecimalCommaIsReadBetweenSemicolons) {
  const auto file = ImportFile(test::SampleData("lux_tables/own/typed_readings_de.csv"));
  ASSERT_TRUE(file);
  ASSERT_THAT(file->readings, SizeIs(3));
  EXPECT_DOUBLE_EQ(file->readings[0].distance->value(), 0.5);
  EXPECT_NEAR(file->readings[0].illuminance->value(), 192.028, 0.001);
  EXPECT_EQ(file->readings[0].lamp, LampState::kOn);
  EXPECT_EQ(file->readings[2].lamp, LampState::kOff);
}

TEST(PlainCsv, EncodingAndLineEndsDoNotMatter) {
  const std::string expected = Read("light,lux\nB\xC3\xBChne,5\n").readings.at(0).light;
  EXPECT_EQ(expected, "B\xC3\xBChne");
  EXPECT_EQ(Read("\xEF\xBB\xBFlight,lux\r\nB\xC3\xBChne,5\r\n").readings.at(0).light, expected);
  EXPECT_EQ(Read("light,lux\rB\xFChne,5\r").readings.at(0).light, expected);  // ISO 8859-1, CR
  const std::string utf16("\xFF\xFEl\0u\0x\0\n\0005\0\n\0", 14);
  EXPECT_DOUBLE_EQ(Read(utf16).readings.at(0).illuminance->value(), 5.0);
}

TEST(PlainCsv, QuotedCellsMayHoldSeparatorsAndLineEnds) {
  const ImportedFile file = Read("light,lux\n\"key, left\nside\",5\n\"say \"\"hi\"\"\",6\n");
  ASSERT_THAT(file.readings, SizeIs(2));
  EXPECT_EQ(file.readings[0].light, "key, left\nside");
  EXPECT_EQ(file.readings[1].light, "say \"hi\"");
}

TEST(PlainCsv, QuantityWithoutUnitIsRefused) {
  const Error error = Refusal("distance,lux\n1,100\n");
  EXPECT_EQ(error.code, "units_ambiguous");
  EXPECT_EQ(error.kind, ErrorKind::kRefused);
  EXPECT_THAT(error.subject, HasSubstr("distance"));
  EXPECT_THAT(error.message, AllOf(HasSubstr("no unit"), HasSubstr("distance_cm")));
}

TEST(PlainCsv, UnknownColumnOfNumbersIsRefusedWithTheNearestName) {
  const Error error = Refusal("distance_m,iluminance_lx,lux\n1,100,100\n");
  EXPECT_EQ(error.code, "units_ambiguous");
  EXPECT_THAT(error.message, HasSubstr("did you mean illuminance_lx?"));
}

TEST(PlainCsv, UncertaintyBesideASpectrumIsNoSecondSpectrum) {
  for (const char* name : {"u_irradiance_W_m2_nm", "irradiance_sd_W_m2_nm", "Lamp u95 mW/m^2/nm"}) {
    SCOPED_TRACE(name);
    const ImportedFile file = Read("wavelength_nm,lamp irradiance_W_m2_nm," + std::string(name) +
                                   "\n400,1,.1\n500,2,.1\n600,2,.1\n700,3,.1\n");
    EXPECT_THAT(file.spectra, SizeIs(1));
    ASSERT_FALSE(file.warnings.empty());
    EXPECT_EQ(file.warnings[0].code, "column_ignored");
  }
}

TEST(PlainCsv, UnknownColumnOfWordsIsLeftOutWithAWarning) {
  const ImportedFile file = Read("note,lux\nnear the window,5\n");
  ASSERT_THAT(file.warnings, SizeIs(1));
  EXPECT_EQ(file.warnings[0].code, "column_ignored");
  EXPECT_THAT(file.readings, SizeIs(1));
}

TEST(PlainCsv, SameQuantityTwiceIsRefused) {
  EXPECT_EQ(Refusal("illuminance_lx,illuminance_fc\n100,9.3\n").code, "units_ambiguous");
}

struct BadRow {
  std::string text;
  std::string subject;
};
class RefusedRow : public testing::TestWithParam<BadRow> {};
INSTANTIATE_TEST_SUITE_P(
    Rows, RefusedRow,
    testing::Values(BadRow{"distance_m,lux\n1,100\n0,200\n", "table.csv:3"},
                    BadRow{"distance_m,lux\n-1,100\n", "table.csv:2"},
                    BadRow{"distance_m,lux\n1,-5\n", "table.csv:2"},
                    BadRow{"distance_m,lux\n1,nan\n", "table.csv:2"},
                    BadRow{"distance_m,lux\n1,inf\n", "table.csv:2"},
                    BadRow{"distance_m,lux\n1,1e999\n", "table.csv:2"},
                    BadRow{"distance_m,lux\n0,5,192\n", "table.csv:2"},    // decimal comma
                    BadRow{"distance_m;lux\n0,5;192.0\n", "table.csv:2"},  // both decimal signs
                    BadRow{"distance_m,lux\n1,\n", "table.csv:2"},         // nothing measured
                    BadRow{"lux,time\n5,03/04/2026 10:00:00\n", "table.csv:2"},  // March or April?
                    BadRow{"lux,lamp\n5,on\n5,dimmed\n", "table.csv:3"},
                    BadRow{"x,y\n0.8,0.7\n", "table.csv:2"}));

TEST_P(RefusedRow, RefusesTheWholeFileAndNamesTheLine) {
  const Error error = Refusal(GetParam().text);
  EXPECT_EQ(error.code, "bad_row") << GetParam().text;
  EXPECT_EQ(error.subject, GetParam().subject);
  EXPECT_EQ(error.kind, ErrorKind::kRefused);
}

TEST(PlainCsv, LineNumbersCountCommentsEmptyLinesAndQuotedLineEnds) {
  EXPECT_EQ(Refusal("# note\n\nlight,lux\n\"a\nb\",5\nc,oops\n").subject, "table.csv:6");
}

Result<ImportedFile> ReadColumns(const std::string& text, const std::vector<std::string>& names) {
  return files::ReadCsvOfColumns(text, "table.csv", {names});
}

TEST(PlainCsv, ARowOfDataWithASlipAboveTheNumbersIsNoTitle) {
  const std::vector<std::string> names = {"distance_m", "illuminance_lx"};
  const auto slip = ReadColumns("distance,E\n0.5,4O0\n0.7,OL\n1,120\n2,30\n", names);
  ASSERT_FALSE(slip);
  EXPECT_EQ(slip.error().code, "bad_row");
  EXPECT_EQ(slip.error().subject, "table.csv:2");
  EXPECT_THAT(slip.error().message, HasSubstr("4O0"));
  const auto thousands = ReadColumns("d;E\n0,1;12.000\n0,5;480\n1;120\n", names);
  ASSERT_TRUE(thousands);
  ASSERT_THAT(thousands->readings, SizeIs(3));
  EXPECT_DOUBLE_EQ(thousands->readings[0].illuminance->value(), 12000.0);
}

TEST(PlainCsv, ATitleThatHoldsANumberIsNamedAndOneOfWordsIsNot) {
  const std::vector<std::string> names = {"distance_m", "illuminance_lx"};
  const auto serial = ReadColumns("Serial,12345\nd,E\n1,120\n", names);
  ASSERT_TRUE(serial);
  ASSERT_THAT(serial->warnings, SizeIs(1));
  EXPECT_EQ(serial->warnings[0].code, "rows_skipped");
  EXPECT_THAT(serial->warnings[0].subject, HasSubstr("line 1"));
  EXPECT_THAT(ReadColumns("Lux meter\nd,E\n1,120\n", names)->warnings, SizeIs(0));
}

TEST(PlainCsv, ALimitIsLightBeyondTheRange) {
  const ImportedFile file = Read("distance_m,lux\n0.5,>400\n1,120\n4,< 10\n");
  ASSERT_THAT(file.readings, SizeIs(3));
  EXPECT_TRUE(file.readings[0].over_range);
  EXPECT_DOUBLE_EQ(file.readings[0].illuminance->value(), 400.0);
  EXPECT_FALSE(file.readings[1].over_range || file.readings[1].under_range);
  EXPECT_TRUE(file.readings[2].under_range);
  for (const char* word : {"OL", "Over"}) {
    const Error error = Refusal("distance_m,lux\n0.5," + std::string(word) + "\n1,120\n");
    EXPECT_EQ(error.code, "bad_row");
    EXPECT_THAT(error.message, HasSubstr(">20000"));
  }
}

TEST(PlainCsv, ASignThatMayPartThousandsIsRefusedUnlessANumberTells) {
  for (const char* open :
       {"distance_m;lux\n1;1.200\n2;300\n4;75\n", "distance_m;lux\n1;1,200\n2;300\n",
        "distance_m\tlux\n1\t1.200\n2\t300\n", "distance_m,lux\n1,\"1,200\"\n2,300\n"}) {
    const Error error = Refusal(open);
    EXPECT_EQ(error.code, "decimals_ambiguous") << open;
    EXPECT_EQ(error.subject, "table.csv:2");
    EXPECT_THAT(error.message, AllOf(HasSubstr("1200"), HasSubstr("1.2 ")));
  }
  const auto first_lux = [](const std::string& text) {
    const ImportedFile file = Read(text);
    return file.readings.empty() ? 0.0 : file.readings[0].illuminance->value();
  };
  EXPECT_EQ(first_lux("distance_m;lux\n1;1.200\n2;0.305\n4;0.075\n"), 1.2);
  EXPECT_EQ(first_lux("distance_m,lux\n1,1.200\n2,300\n"), 1.2);
  EXPECT_EQ(first_lux("distance_m;lux\n0.5;1.5\n1;2\n"), 1.5);
  EXPECT_EQ(first_lux("distance_m;lux\n0.5;2,030\n1;508\n"), 2030.0);
  EXPECT_EQ(first_lux("distance_m\tlux\n1\t12,030.5\n2\t3,008\n"), 12030.5);
  EXPECT_EQ(first_lux("distance_m;lux\n1;12\xC2\xA0"
                      "030,5\n"),
            12030.5);
  EXPECT_EQ(first_lux("distance_m;lux\n1;12'030.5\n"), 12030.5);
  EXPECT_EQ(first_lux("distance_m,lux\n1,\"1.234,5\"\n2,308\n"), 1234.5);
  EXPECT_EQ(first_lux("distance_m;lux\n1;1.234.500\n"), 1234500.0);
  // A kilometre is no distance to a lamp, and a few kelvin no light's.
  EXPECT_EQ(first_lux("distance_m\tlux\n1.000\t8.120\n2.000\t2.035\n"), 8.12);
  EXPECT_EQ(first_lux("distance_mm\tlux\n1,000\t8,120\n2,000\t2,035\n"), 8120.0);
  EXPECT_EQ(first_lux("distance_m\tlux\tcct_K\n1\t8,120\t2,700\n"), 8120.0);
}

TEST(PlainCsv, AColourTemperatureThatNoLampHasIsRefused) {
  EXPECT_EQ(Refusal("distance_m,lux,cct_K\n1,120,29000000\n").code, "bad_row");
  EXPECT_EQ(Refusal("distance_m,lux,cct_K\n1,120,290\n").code, "bad_row");
  EXPECT_FALSE(Read("distance_m,lux,cct_K\n1,120,0\n").readings[0].cct.has_value());
}

}  // namespace
}  // namespace lightcal::devices
