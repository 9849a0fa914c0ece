// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/meter_table.h"

#include <gmock/gmock.h>

#include "lightcal_devices/meters/find_meters.h"
#include "run_cli.h"

namespace lightcal::devices {
namespace {

FoundMeter Found(const std::string& id) {
  FoundMeter meter;
  meter.row = FindDriver("sekonic");
  meter.id = id;
  return meter;
}

TEST(MeterTable, TheUdevRulesFileHoldsTheRuleOfEveryMeter) {
  const std::string rules =
      test::ReadFile(std::string(LIGHTCAL_SOURCE_DIR) + "/devices/70-lightcal.rules");
  ASSERT_FALSE(MeterTable().empty());
  for (const MeterRow& row : MeterTable()) {
    for (const std::string& rule : UdevRules(row)) {
      const auto held = testing::HasSubstr("\n" + rule + "\n");
      if (row.usb_is_any_bridge) {
        EXPECT_THAT(rules, testing::Not(held)) << row.driver;
      } else {
        EXPECT_THAT(rules, held) << row.driver;
      }
    }
  }
  // Nobody gets a stranger's device by installing us: no serial cable, no general bridge.
  for (const char* chip : {"0403", "10c4", "04d8", "\"tty\""}) {
    EXPECT_THAT(rules, testing::Not(testing::HasSubstr(chip)));
  }
}

TEST(MeterTable, EveryDriverIsFoundByItsNameAndMakesAMeter) {
  for (const MeterRow& row : MeterTable()) {
    EXPECT_EQ(FindDriver(row.driver), &row);
    EXPECT_NE(row.make, nullptr);
    EXPECT_FALSE(VerifiedName(row.verified).empty());
  }
  EXPECT_EQ(FindDriver("nobody"), nullptr);
}

TEST(ChooseMeter, TakesAnIdADriversNameOrTheOnlyOne) {
  const std::vector<FoundMeter> one = {Found("sekonic:J1")};
  EXPECT_EQ(ChooseMeter(one, "")->id, "sekonic:J1");
  EXPECT_EQ(ChooseMeter(one, "sekonic")->id, "sekonic:J1");
  const std::vector<FoundMeter> two = {Found("sekonic:J1"), Found("sekonic:J2")};
  EXPECT_EQ(ChooseMeter(two, "sekonic:J2")->id, "sekonic:J2");
}

TEST(ChooseMeter, AsksWhichOfSeveral) {
  const auto chosen = ChooseMeter({Found("sekonic:J1"), Found("sekonic:J2")}, "sekonic");
  EXPECT_EQ(chosen.error().kind, ErrorKind::kUsage);
  EXPECT_THAT(chosen.error().message, testing::HasSubstr("sekonic:J1, sekonic:J2"));
}

TEST(ChooseMeter, AnAbsentMeterIsADeviceErrorAndAMisspeltDriverAWrongCommandLine) {
  EXPECT_EQ(ChooseMeter({}, "").error().code, "no_device");
  EXPECT_EQ(ChooseMeter({}, "sekonic:J9").error().kind, ErrorKind::kFailed);
  const auto misspelt = ChooseMeter({}, "sekonik");
  EXPECT_EQ(misspelt.error().kind, ErrorKind::kUsage);
  EXPECT_THAT(misspelt.error().message, testing::HasSubstr("did you mean sekonic?"));
}

}  // namespace
}  // namespace lightcal::devices
