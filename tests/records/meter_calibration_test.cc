// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/meter_calibration.h"

#include <gmock/gmock.h>

namespace lightcal {
namespace {

using testing::HasSubstr;

constexpr const char* kTwo = R"(lightcal = 1
[[calibration]]
device = "sekonic:J0123"
factor = 1.013
date = 2026-03-01
sigma_relative = 0.02
[[calibration]]
device = "hid_als:1-1.4"
factor = 0.5
)";

TEST(MeterCalibration, ReadsEachMeterWithItsFactorAndDate) {
  const auto read = MeterCalibrationsFromToml(kTwo, "meters.toml");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->size(), 2U);
  EXPECT_EQ(read->front().device, "sekonic:J0123");
  EXPECT_EQ(read->front().factor, 1.013);
  EXPECT_EQ(read->front().date, "2026-03-01");
  EXPECT_EQ(read->front().sigma_relative, 0.02);
  EXPECT_EQ(read->back().factor, 0.5);
  EXPECT_FALSE(read->back().sigma_relative);
}

TEST(MeterCalibration, AFileWithoutMetersIsEmpty) {
  EXPECT_TRUE(MeterCalibrationsFromToml("lightcal = 1\n", "meters.toml")->empty());
}

struct BadFile {
  const char* name;
  const char* text;
  const char* says;
};
void PrintTo(const BadFile& bad, std::ostream* os) { *os << bad.name; }
class BadMeters : public testing::TestWithParam<BadFile> {};
TEST_P(BadMeters, IsRefusedByName) {
  const auto read = MeterCalibrationsFromToml(GetParam().text, "meters.toml");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().kind, ErrorKind::kRefused);
  EXPECT_THAT(read.error().subject, HasSubstr("meters.toml"));
  EXPECT_THAT(read.error().subject + read.error().message, HasSubstr(GetParam().says));
}
INSTANTIATE_TEST_SUITE_P(
    MeterCalibration, BadMeters,
    testing::Values(
        BadFile{"NoVersion", "", "lightcal"}, BadFile{"Version2", "lightcal = 2\n", "version"},
        BadFile{"NoToml", "lightcal = \n", "TOML"},
        BadFile{"NoFactor", "lightcal = 1\n[[calibration]]\ndevice = \"a:1\"\n", "factor"},
        BadFile{"ZeroFactor", "lightcal = 1\n[[calibration]]\ndevice = \"a:1\"\nfactor = 0\n",
                "true lux"},
        BadFile{"NoSerial", "lightcal = 1\n[[calibration]]\ndevice = \"a\"\nfactor = 1\n",
                "serial number"},
        BadFile{"Misspelt", "lightcal = 1\n[[calibration]]\ndevice = \"a:1\"\nfaktor = 1\n",
                "factor"},
        BadFile{"Twice",
                "lightcal = 1\n[[calibration]]\ndevice = \"a:1\"\nfactor = 1\n"
                "[[calibration]]\ndevice = \"a:1\"\nfactor = 2\n",
                "twice"}),
    [](const auto& bad) { return std::string(bad.param.name); });

}  // namespace
}  // namespace lightcal
