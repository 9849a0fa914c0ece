// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/files/csv_columns.h"

#include <gtest/gtest.h>

#include <string>

#include "lightcal_devices/files/delimited_text.h"

namespace lightcal::devices::files {
namespace {

struct NameCase {
  std::string name;
  CsvQuantity quantity;
  double scale;
  std::string series;
};
class ColumnName : public testing::TestWithParam<NameCase> {};

INSTANTIATE_TEST_SUITE_P(
    Scalars, ColumnName,
    testing::Values(NameCase{"distance_m", CsvQuantity::kDistance, 1.0, ""},
                    NameCase{"Distance [cm]", CsvQuantity::kDistance, 0.01, ""},
                    NameCase{" DISTANCE (ft) ", CsvQuantity::kDistance, 0.3048, ""},
                    NameCase{"Illuminance [lx]", CsvQuantity::kIlluminance, 1.0, ""},
                    NameCase{"lux", CsvQuantity::kIlluminance, 1.0, ""},
                    // 1 fc = 1 lm/ft^2, 1 ft = 0.3048 m exactly
                    NameCase{"illuminance_fc", CsvQuantity::kIlluminance, 10.763910416709722, ""},
                    NameCase{"CCT(K)", CsvQuantity::kCct, 1.0, ""},
                    NameCase{"distance", CsvQuantity::kNeedsUnit, 1.0, ""},
                    NameCase{"Wavelength", CsvQuantity::kNeedsUnit, 1.0, ""},
                    NameCase{"value", CsvQuantity::kNeedsUnit, 1.0, ""},
                    NameCase{"nominal_cct_K", CsvQuantity::kUnknown, 1.0, ""},
                    NameCase{"", CsvQuantity::kUnknown, 1.0, ""}));

INSTANTIATE_TEST_SUITE_P(
    Spectra, ColumnName,
    testing::Values(NameCase{"irradiance_W_m2_nm", CsvQuantity::kIrradiance, 1.0, ""},
                    NameCase{"irradiance_mW_m2_nm", CsvQuantity::kIrradiance, 1e-3, ""},
                    NameCase{"key irradiance [uW/cm^2/nm]", CsvQuantity::kIrradiance, 1e-2, "key"},
                    NameCase{"\xC2\xB5W cm-2 nm-1", CsvQuantity::kIrradiance, 1e-2, ""},
                    NameCase{"E (W/(m\xC2\xB2\xC2\xB7nm))", CsvQuantity::kIrradiance, 1.0, "E"},
                    // "warm" ends in m, which must not make milliwatts of W
                    NameCase{"warm_W_m2_nm", CsvQuantity::kIrradiance, 1.0, "warm"},
                    NameCase{"Ee [W/(sqm*nm)]", CsvQuantity::kIrradiance, 1.0, "Ee"},
                    NameCase{"relative", CsvQuantity::kRelative, 1.0, ""},
                    NameCase{"lamp 2 relative", CsvQuantity::kRelative, 1.0, "lamp 2"},
                    // watts per area without "per nm" are no spectral irradiance
                    NameCase{"W_m2", CsvQuantity::kUnknown, 1.0, ""}));

TEST_P(ColumnName, SaysQuantityAndUnit) {
  const CsvColumn column = ColumnFromName(GetParam().name);
  EXPECT_EQ(column.quantity, GetParam().quantity) << GetParam().name;
  EXPECT_NEAR(column.scale, GetParam().scale, 1e-12 * GetParam().scale);
  EXPECT_EQ(column.series, GetParam().series);
  EXPECT_EQ(column.written, GetParam().name);
}

TEST(ColumnName, MisspelledNameHasANearestOne) {
  EXPECT_EQ(NearestColumnName("distnace_m"), "distance_m");
  EXPECT_EQ(NearestColumnName("iluminance_lx"), "illuminance_lx");
}

TEST(LastDigit, IsOneUnitOfTheLastPrintedPlace) {
  EXPECT_DOUBLE_EQ(LastDigit("1,34E+00"), 0.01);
  EXPECT_DOUBLE_EQ(LastDigit("1.08E+02"), 1.0);
  EXPECT_DOUBLE_EQ(LastDigit("3262"), 1.0);
  EXPECT_DOUBLE_EQ(LastDigit("-0.0029"), 1e-4);
}

TEST(IsoTime, ReadsBothOrdersAndRefusesWhatIsNoDate) {
  EXPECT_EQ(IsoTime("2017/01/20_08:38:02", DateOrder::kYearFirst), "2017-01-20T08:38:02");
  EXPECT_EQ(IsoTime("17.07.2024 16:33:11", DateOrder::kDayFirst), "2024-07-17T16:33:11");
  EXPECT_EQ(IsoTime("31/02/2023 08:00:00", DateOrder::kDayFirst), "");
  EXPECT_EQ(IsoTime("01/01/2023 25:00:00", DateOrder::kDayFirst), "");
  EXPECT_EQ(IsoTime("yesterday", DateOrder::kDayFirst), "");
  EXPECT_EQ(IsoTime("99999999999/1/1 1:1:1", DateOrder::kYearFirst), "");
}

TEST(IsoTime, KeepsTheZoneAndTheFractionOfTheSecond) {
  const auto iso = [](std::string_view text) { return IsoTime(text, DateOrder::kYearFirst); };
  EXPECT_EQ(iso("2026-11-21T14:03:00.250Z"), "2026-11-21T14:03:00.250Z");
  EXPECT_EQ(iso("2026-11-28T10:00:00+02:00"), "2026-11-28T10:00:00+02:00");
  EXPECT_EQ(iso("2026-11-28 10:00:00,5 -0530"), "2026-11-28T10:00:00.5-05:30");
  EXPECT_EQ(iso("2026-11-28T10:00+02"), "2026-11-28T10:00:00+02:00");
  EXPECT_EQ(iso("2026-11-28 10:00:00 UTC"), "2026-11-28T10:00:00Z");
  EXPECT_EQ(iso("2026-11-28-10-00-30"), "2026-11-28T10:00:30");
  EXPECT_EQ(IsoTime("15/03/2021 3:44:14 p.m.", DateOrder::kDayFirst), "2021-03-15T03:44:14");
}

}  // namespace
}  // namespace lightcal::devices::files
