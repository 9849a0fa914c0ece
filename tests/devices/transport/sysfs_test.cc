// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/transport/sysfs.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "run_cli.h"
#include "text_of_bytes.h"

namespace lightcal::devices {
namespace {

using test::Text;

constexpr std::chrono::milliseconds kWait{100};

TEST(Sysfs, AnAttributeIsChosenByItsNameAndReadAnewEachTime) {
  const test::TempDir root;
  root.Write("dev/in_illuminance_raw", "209\n");
  const auto line = OpenSysfs(root.path() + "/dev");
  ASSERT_TRUE(line->Write(AsBytes("in_illuminance_raw"), kWait));
  EXPECT_EQ(Text(*line->Read(64, kWait)), "209\n");
  root.Write("dev/in_illuminance_raw", "210\n");
  EXPECT_EQ(Text(*line->Read(64, kWait)), "210\n");
  EXPECT_EQ(Text(*line->Read(2, kWait)), "21");
}

TEST(Sysfs, AMissingAttributeIsNotAMissingDevice) {
  const test::TempDir root;
  root.Write("dev/name", "als\n");
  const auto line = OpenSysfs(root.path() + "/dev");
  ASSERT_TRUE(line->Write(AsBytes("in_illuminance_input"), kWait));
  EXPECT_EQ(line->Read(64, kWait).error().code, fault::kNoAttribute);
  std::filesystem::remove_all(root.path() + "/dev");
  EXPECT_EQ(line->Read(64, kWait).error().code, fault::kUnplugged);
}

TEST(Sysfs, NamesThatLeaveTheFolderAreNoAttributes) {
  const test::TempDir root;
  root.Write("secret", "1\n");
  root.Write("dev/name", "als\n");
  const auto line = OpenSysfs(root.path() + "/dev");
  for (const char* name : {"../secret", "", ".", "..", "/etc/hostname"}) {
    EXPECT_EQ(line->Write(AsBytes(name), kWait).error().code, fault::kNoAttribute) << name;
  }
  EXPECT_EQ(line->Read(64, kWait).error().code, fault::kIo);
}

TEST(Sysfs, AnAttributeThatIsAFolderIsAnError) {
  const test::TempDir root;
  root.Write("dev/power/state", "on\n");
  const auto line = OpenSysfs(root.path() + "/dev");
  ASSERT_TRUE(line->Write(AsBytes("power"), kWait));
  EXPECT_EQ(line->Read(64, kWait).error().code, fault::kIo);
}

TEST(Sysfs, AnAttributeReadAloneHasNoNewline) {
  const test::TempDir root;
  root.Write("dev/name", "als\n");
  EXPECT_EQ(*ReadSysfsAttribute(root.path() + "/dev", "name"), "als");
  EXPECT_EQ(ReadSysfsAttribute(root.path() + "/none", "name").error().code, fault::kUnplugged);
}

}  // namespace
}  // namespace lightcal::devices
