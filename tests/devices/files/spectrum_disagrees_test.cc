// SPDX-License-Identifier: Apache-2.0
// A spectrum whose sum is off its header's lux: the warning names the unit that would make it fit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/files/import_file.h"
#include "lightcal_devices/files/spectrum_readings.h"
#include "run_cli.h"

namespace lightcal::devices {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// A UPRtek file (values taken for mW m-2 nm-1) of a lamp of 2925.36 lx whose header says
// `header_lx` instead.
ImportedFile WithHeaderLux(double header_lx) {
  std::string bytes = test::ReadFile(test::SampleData("spectra/uprtek_cv600/Casper Glow High.xls"));
  const std::string true_lux = "2925.355469";
  bytes.replace(bytes.find(true_lux), true_lux.size(), ShortestText(header_lx));
  auto file = ImportBytes(bytes, "lamp.xls");
  EXPECT_TRUE(file);
  return file ? *file : ImportedFile{};
}

struct UnitCase {
  double W_m2_nm;
  std::string name;
};
class WrongUnit : public testing::TestWithParam<UnitCase> {};
INSTANTIATE_TEST_SUITE_P(Units, WrongUnit,
                         testing::Values(UnitCase{1.0, "W m-2 nm-1"}, UnitCase{1e-6, "uW m-2 nm-1"},
                                         UnitCase{1e4, "W cm-2 nm-1"},
                                         UnitCase{1e-2, "uW cm-2 nm-1"},
                                         UnitCase{0.2, "W m-2 per 5 nm"},
                                         UnitCase{2e-4, "mW m-2 per 5 nm"},
                                         UnitCase{0.1, "W m-2 per 10 nm"}));

TEST_P(WrongUnit, IsNamedByTheWarning) {
  const ImportedFile file = WithHeaderLux(2925.355469 * GetParam().W_m2_nm / 1e-3);
  ASSERT_THAT(file.warnings, SizeIs(1));
  EXPECT_EQ(file.warnings.front().code, "spectrum_disagrees");
  EXPECT_EQ(file.warnings.front().subject, "lamp.xls");
  EXPECT_THAT(file.warnings.front().message,
              AllOf(HasSubstr("2925.4 lx"), HasSubstr("if the values were " + GetParam().name)));
}

TEST(SpectrumDisagrees, OnlyBeyondOnePercent) {
  EXPECT_THAT(WithHeaderLux(2925.355469 * 1.0095).warnings, IsEmpty());
  EXPECT_THAT(WithHeaderLux(2925.355469 * 0.9905).warnings, IsEmpty());
  EXPECT_THAT(WithHeaderLux(2925.355469 * 1.011).warnings, SizeIs(1));
}

TEST(SpectrumDisagrees, SaysSoWhenNoUnitFits) {
  const ImportedFile file = WithHeaderLux(2925.355469 * 1.37);
  ASSERT_THAT(file.warnings, SizeIs(1));
  EXPECT_THAT(file.warnings.front().message, HasSubstr("no unit of irradiance makes it fit"));
}

TEST(SpectrumDisagrees, KeepsTheInstrumentsOwnLuxInTheReading) {
  const ImportedFile file = WithHeaderLux(2.925);
  EXPECT_DOUBLE_EQ(file.readings.front().illuminance->value(), 2.925);
}

// 1.04 lx may be printed as "1": half a lux either way is the header's own rounding.
TEST(SpectrumDisagrees, RespectsHalfOfTheLastPrintedDigit) {
  files::FoundSpectrum found;
  found.imported.spectrum.quantity = SpectralQuantity::kIrradiance;
  found.imported.reported.illuminance_lx = 1.0;
  found.imported.reported.illuminance_last_digit_lx = 1.0;
  EXPECT_FALSE(files::IlluminanceDisagreement(found, 1.04));
  EXPECT_TRUE(files::IlluminanceDisagreement(found, 1.51));
  found.imported.reported.illuminance_last_digit_lx = 0.01;
  EXPECT_TRUE(files::IlluminanceDisagreement(found, 1.04));
}

TEST(SpectrumDisagrees, SaysNothingOfARelativeSpectrum) {
  files::FoundSpectrum found;
  found.imported.spectrum.quantity = SpectralQuantity::kRelative;
  found.imported.reported.illuminance_lx = 1.0;
  EXPECT_FALSE(files::IlluminanceDisagreement(found, 100.0));
}

}  // namespace
}  // namespace lightcal::devices
