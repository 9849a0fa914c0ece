// SPDX-License-Identifier: Apache-2.0
// capture.json, and how a session takes it in.
#include "lightcal/records/tethered_shoot.h"

#include <gtest/gtest.h>

#include "lightcal/records/session_codec.h"
#include "run_cli.h"

namespace lightcal {
namespace {

TetheredShoot Example() {
  TetheredShoot shoot;
  shoot.complete = true;
  shoot.light = "key";
  shoot.device = "gphoto2:usb:001,004";
  shoot.camera = "lightcal FakeCam";
  shoot.time = "2026-11-21T12:00:00Z";
  shoot.shutter_setting = "shutterspeed";
  shoot.f_number = 4.0;
  shoot.iso = 100.0;
  shoot.settings = {{"imageformat", "RAW"}, {"iso", "100"}};
  shoot.restore = {{"iso", "Auto"}};
  shoot.frames = {{"1/60", 1.0 / 64, 0.0, "frame_01.DNG", Seconds(1.0 / 64), 4.0, 100.0},
                  {"0.0333s", 1.0 / 32, 0.00005, "", {}, {}, {}}};
  shoot.capture.emplace();
  shoot.capture->light = "key";
  shoot.capture->frames = "captures/key-1/frame_*";
  shoot.capture->reflectance = 0.18;
  shoot.capture->distance = Metres(0.8);
  shoot.capture->rect = {1, 2, 30, 40};
  return shoot;
}

std::string With(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

TEST(CaptureJson, ReadsBackAsItWasWritten) {
  const std::string text = TetheredShootToJson(Example());
  const auto back = TetheredShootFromJson(text, "capture.json");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(TetheredShootToJson(*back), text);
  EXPECT_EQ(back->frames[0].file, "frame_01.DNG");
  EXPECT_EQ(back->restore[0].value, "Auto");
  EXPECT_EQ(back->capture->distance, Metres(0.8));
}

TEST(CaptureJson, AgreesWithItsSchema) {
  const test::TempDir folder;
  TetheredShoot shoot = Example();
  shoot.pictures = 2;
  shoot.delete_from_card = true;
  const std::string all = folder.Write("a.json", TetheredShootToJson(shoot));
  shoot.complete = false;
  shoot.capture.reset();
  const std::string begun = folder.Write("b.json", TetheredShootToJson(shoot));
  const std::string source = LIGHTCAL_SOURCE_DIR;
  const auto result = test::RunProgram(
      {"/usr/bin/python3", source + "/tests/tools/validate_json.py",
       source + "/lib/lightcal/records/schemas", "capture", "--every-key", all, begun});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
}

TEST(CaptureJson, RefusesWhatItWouldNotHaveWritten) {
  const std::string text = TetheredShootToJson(Example());
  const auto code = [](const std::string& changed) {
    const auto read = TetheredShootFromJson(changed, "capture.json");
    return read ? std::string("taken") : read.error().code;
  };
  EXPECT_EQ(code("{"), "bad_capture");
  EXPECT_EQ(code("[]"), "bad_capture");
  EXPECT_EQ(code(With(text, "lightcal.capture/1", "lightcal.capture/2")), "bad_capture");
  EXPECT_EQ(code(With(text, "frame_01.DNG", "../frame_01.DNG")), "bad_capture");
  EXPECT_EQ(code(With(text, "\"complete\"", "\"perhaps\"")), "bad_capture");
  EXPECT_EQ(code(With(text, "\"reflectance\"", "\"reflectanse\"")), "unknown_key");
  EXPECT_EQ(code(With(text, "0.18", "0")), "bad_capture");
}

class ShotSession : public testing::Test {
 protected:
  Result<LoadedSession> Load(const TetheredShoot& shoot, const std::string& more = "") {
    folder_.Write("s/session.toml",
                  "lightcal = 1\n[[light]]\nname = \"key\"\nkind = \"point\"\n" + more);
    folder_.Write("s/captures/key-1/capture.json", TetheredShootToJson(shoot));
    return LoadSession(folder_.path() + "/s");
  }
  test::TempDir folder_;
};

TEST_F(ShotSession, HoldsACompleteBracketAsAFurtherCapture) {
  const auto loaded = Load(Example());
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_EQ(loaded->session.captures.size(), 1U);
  EXPECT_EQ(loaded->session.captures[0].frames, "captures/key-1/frame_*");
  EXPECT_EQ(loaded->session.captures[0].where, "captures/key-1/capture.json");
  EXPECT_EQ(loaded->session.input_files.size(), 2U);
  EXPECT_TRUE(loaded->warnings.empty());
}

TEST_F(ShotSession, TakesThePersonsWordBeforeTheShotOne) {
  const auto loaded = Load(Example(),
                           "[[capture]]\nlight = \"key\"\nframes = \"captures/key-1/*.DNG\"\n"
                           "use = \"card\"\nreflectance = 0.9\ndistance_m = 1.0\n");
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_EQ(loaded->session.captures.size(), 1U);
  EXPECT_EQ(loaded->session.captures[0].reflectance, 0.9);
}

TEST_F(ShotSession, NamesTheBrokenOffAndTheUndescribed) {
  TetheredShoot shoot = Example();
  shoot.complete = false;
  auto loaded = Load(shoot);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_TRUE(loaded->session.captures.empty());
  ASSERT_EQ(loaded->warnings.size(), 1U);
  EXPECT_EQ(loaded->warnings[0].code, "unfinished_capture");
  EXPECT_NE(loaded->warnings[0].message.find("1 of 2 frames"), std::string::npos);
  shoot.complete = true;
  shoot.capture.reset();
  loaded = Load(shoot);
  ASSERT_EQ(loaded->warnings.size(), 1U);
  EXPECT_EQ(loaded->warnings[0].code, "capture_not_described");
}

TEST_F(ShotSession, RefusesABracketOfALightThatIsNotThere) {
  TetheredShoot shoot = Example();
  shoot.capture->light = "fill";
  const auto loaded = Load(shoot);
  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.error().code, "unknown_light");
  EXPECT_EQ(loaded.error().subject, "captures/key-1/capture.json");
}

}  // namespace
}  // namespace lightcal
