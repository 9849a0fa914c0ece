// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/camera_profile.h"

#include <gmock/gmock.h>

#include <limits>
#include <string>

#include "lightcal/records/session_codec.h"
#include "run_cli.h"

namespace lightcal {
namespace {

std::string EveryKey() {
  return test::ReadFile(std::string(LIGHTCAL_SOURCE_DIR) +
                        "/tests/fuzz/seeds/camera_json/every_key.json");
}

std::string Replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

TEST(CameraProfile, WhatIsWrittenIsReadAgain) {
  const auto profile = CameraProfileFromJson(EveryKey(), "camera.json");
  ASSERT_TRUE(profile) << profile.error().message;
  EXPECT_EQ(profile->scale.readings.front().lamp_class, LampClass::kDaylight);
  EXPECT_DOUBLE_EQ(profile->color->xyz_from_raw[1][2], -0.2);
  EXPECT_EQ(profile->flats.front().focal_length, Metres(0.035));
  EXPECT_DOUBLE_EQ(profile->nd_filters.front().attenuation[2], 1197.0);
  const auto text = CameraProfileToJson(*profile);
  ASSERT_TRUE(text);
  const auto again = CameraProfileFromJson(*text, "camera.json");
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(CameraProfileToJson(*again).value(), *text);
}

TEST(CameraProfile, AProfileAndSensitivitiesAreToldApartByTheirSchema) {
  const auto profile = CameraFileFromJson(EveryKey(), "camera.json");
  ASSERT_TRUE(profile);
  EXPECT_TRUE(profile->profile);
  EXPECT_EQ(profile->sensitivities->channels[1].size(), 3U);
  const auto alone = CameraFileFromJson(
      test::ReadFile(test::SampleData("camera_sensitivities/Nikon_D5100_380_780_5.json")), "file");
  ASSERT_TRUE(alone);
  EXPECT_FALSE(alone->profile);
  EXPECT_TRUE(alone->sensitivities);
  EXPECT_EQ(CameraFileFromJson("{}", "file").error().code, "bad_sensitivities");
}

TEST(CameraProfile, ANumberThatIsNotFiniteIsNotWritten) {
  CameraProfile profile = CameraProfileFromJson(EveryKey(), "camera.json").value();
  profile.noise.front().noise.scale = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(CameraProfileToJson(profile).error().code, "not_finite");
}

struct Bad {
  const char *what, *by, *code, *says;
};

TEST(CameraProfile, RefusesWithFileAndKey) {
  const Bad cases[] = {
      {"lightcal.camera/1", "lightcal.camera/9", "bad_camera", "lightcal.camera/1"},
      {"\"width\": 60", "\"width\": 0", "bad_camera", "width"},
      {"\"width\": 60", "\"wide\": 60", "unknown_key", "width"},
      {"141.2", "0", "bad_camera", "full_scale_constant"},
      {"141.2", "1e400", "bad_camera", "out of range"},
      {"1.67e-05", "-1", "bad_camera", "scale"},
      {"[3, 4, 59, 39]", "[3, 4, 60, 39]", "bad_camera", "hot_pixels"},
      {"[3, 4, 59, 39]", "[3, 4, 59]", "bad_camera", "hot_pixels"},
      {"[793, 812, 1197]", "[0, 812, 1197]", "bad_camera", "attenuation"},
      {"\"blue\": [1, 0.1, 0]", "\"blue\": [1, 0.1]", "bad_camera", "unequal length"},
      {"\"first_nm\": 400", "\"first_nm\": 500", "bad_camera", "400-700"},
      {"\"spot\"", "\"sport\"", "bad_camera", "spot"},
  };
  for (const Bad& bad : cases) {
    const auto profile = CameraProfileFromJson(Replaced(EveryKey(), bad.what, bad.by), "c.json");
    ASSERT_FALSE(profile) << bad.by;
    EXPECT_EQ(profile.error().code, bad.code) << bad.by;
    EXPECT_THAT(profile.error().subject, testing::HasSubstr("c.json"));
    EXPECT_THAT(profile.error().message, testing::HasSubstr(bad.says)) << bad.by;
  }
}

TEST(CameraFrames, SessionsNeedNoLightToCalibrateACamera) {
  const auto session = ParseSessionToml(
      "lightcal = 1\n[[meter]]\nname = \"spot\"\nsigma_relative = 0.02\n"
      "[[camera_frames]]\nuse = \"scale\"\nframes = \"a*\"\nluminance_nits = 3\nmeter = \"spot\"\n",
      "session.toml");
  ASSERT_TRUE(session) << session.error().message;
  EXPECT_DOUBLE_EQ(session->camera_frames.front().sigma_relative, 0.02);
}

}  // namespace
}  // namespace lightcal
