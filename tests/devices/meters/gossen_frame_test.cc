// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "lightcal_devices/meters/gossen/frame.h"

namespace lightcal::devices::gossen {
namespace {

using testing::HasSubstr;

struct MeasurementCase {
  const char* line;
  double illuminance_lx;
};
class GossenMeasurement : public testing::TestWithParam<MeasurementCase> {};
TEST_P(GossenMeasurement, IsItsMantissaTimesAPowerOfTen) {
  const auto shown = DecodeMeasurement(GetParam().line);
  ASSERT_TRUE(shown) << shown.error().message;
  EXPECT_DOUBLE_EQ(LuxFromDisplay(*shown), GetParam().illuminance_lx);
}
// The first three as the maker's interface description prints them.
INSTANTIATE_TEST_SUITE_P(
    GossenFrame, GossenMeasurement,
    testing::Values(MeasurementCase{"1234E-01 LX", 123.4}, MeasurementCase{"123E00 LX", 123.0},
                    MeasurementCase{"MEASURE:PHOTO? 123E00 LX", 123.0},
                    MeasurementCase{"  1234 E-02 LX", 12.34},
                    MeasurementCase{"1999 E +02 LX", 199900.0}, MeasurementCase{"0E-01 LX", 0.0},
                    MeasurementCase{"12345E-03 FC", 12.345 / (0.3048 * 0.3048)}));

TEST(GossenFrame, ADigitIsWorthItsPowerOfTen) {
  EXPECT_EQ(DecodeMeasurement("1234E-01 LX")->counts, 1234);
  EXPECT_EQ(DecodeMeasurement("1234E-01 LX")->decimals, 1);
  EXPECT_EQ(DecodeMeasurement("1999E02 LX")->decimals, -2);
}

TEST(GossenFrame, ALuminanceHeadIsNoLuxMeter) {
  for (const char* line : {"1234E-01 CD_M2", "12E00 FL"}) {
    const auto shown = DecodeMeasurement(line);
    ASSERT_FALSE(shown);
    EXPECT_EQ(shown.error().code, "luminance_head");
    EXPECT_THAT(shown.error().message, HasSubstr("luminance attachment"));
  }
}

class NoMeasurement : public testing::TestWithParam<const char*> {};
TEST_P(NoMeasurement, IsABadReply) {
  const auto shown = DecodeMeasurement(GetParam());
  ASSERT_FALSE(shown) << GetParam();
  EXPECT_EQ(shown.error().code, "bad_reply");
}
INSTANTIATE_TEST_SUITE_P(GossenFrame, NoMeasurement,
                         testing::Values("", "LX", "1234", "1234 LX", "1234E LX", "1234E-0",
                                         "1234E-01", "1234E-01 L", "123456E-01 LX", "1234E-10 LX",
                                         "1234E123 LX", "-1234E-01 LX", "12.34E-01 LX",
                                         "1234E-01 KLX", "1234E-01 LX?", "\x02\xff"));

TEST(GossenFrame, NoTruncationIsTakenForAMeasurement) {
  const std::string line = "MEASURE:PHOTO? 1234E-01 LX";
  for (std::size_t length = 0; length < line.size(); ++length) {
    EXPECT_FALSE(DecodeMeasurement(line.substr(0, length))) << length;
  }
}

TEST(GossenFrame, TheIdentityIsReadWithAndWithoutItsEcho) {
  for (const char* line : {"GOSSEN,M 502, 20387,01,V 1.00", "*IDN GOSSEN,M 502, 20387,01,V 1.00"}) {
    const auto identity = DecodeIdentity(line);
    ASSERT_TRUE(identity) << identity.error().message;
    EXPECT_EQ(identity->type, "M 502");
    EXPECT_EQ(identity->serial, "20387");
    EXPECT_EQ(identity->firmware, "V 1.00");
  }
  for (const char* line : {"", "GOSSEN", "GOSSEN,M 502, 20387,01", "METRAWATT,M 502,1,01,V 1.00",
                           "GOSSEN,M 502, 20387,01,V 1.00,x"}) {
    EXPECT_EQ(DecodeIdentity(line).error().code, "bad_reply") << line;
  }
}

struct ErrorCase {
  const char* line;
  int number;
  const char* code;
};
class GossenError : public testing::TestWithParam<ErrorCase> {};
TEST_P(GossenError, IsKnownByItsNumber) {
  const auto number = DecodeError(GetParam().line);
  ASSERT_TRUE(number);
  EXPECT_EQ(*number, GetParam().number);
  const Error error = ErrorOf(*number, "gossen:20387");
  EXPECT_EQ(error.code, GetParam().code);
  EXPECT_THAT(error.message, HasSubstr("error " + std::to_string(GetParam().number)));
}
INSTANTIATE_TEST_SUITE_P(GossenFrame, GossenError,
                         testing::Values(ErrorCase{"ERROR = 1", 1, "serial_error"},
                                         ErrorCase{"ERROR = 3", 3, "serial_error"},
                                         ErrorCase{"ERROR = 19", 19, "over_range"},
                                         ErrorCase{"ERROR = 203", 203, "over_range"},
                                         ErrorCase{"ERROR = 18", 18, "hardware_error"},
                                         ErrorCase{"ERROR = 202", 202, "wrong_head"},
                                         ErrorCase{"ERROR=101", 101, "refused_command"},
                                         ErrorCase{"ERROR", 0, "refused_command"}));

TEST(GossenFrame, AMeasurementIsNoError) { EXPECT_FALSE(DecodeError("1234E-01 LX")); }

}  // namespace
}  // namespace lightcal::devices::gossen
