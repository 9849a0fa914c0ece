// SPDX-License-Identifier: Apache-2.0
// What the codecs write and accept agrees with the JSON Schemas that are installed with the
// library.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "lightcal/records/camera_profile.h"
#include "lightcal/records/light_codec.h"
#include "lightcal/records/session_codec.h"
#include "run_cli.h"
#include "sample_lights.h"

namespace lightcal {
namespace {

using test::TempDir;

const std::string kSource = LIGHTCAL_SOURCE_DIR;

test::CliResult Validate(const std::string& schema, const std::vector<std::string>& rest) {
  std::vector<std::string> command = {"/usr/bin/python3", kSource + "/tests/tools/validate_json.py",
                                      kSource + "/lib/lightcal/records/schemas", schema};
  command.insert(command.end(), rest.begin(), rest.end());
  return test::RunProgram(command);
}

void ExpectValid(const std::string& schema, const std::vector<std::string>& rest) {
  const auto result = Validate(schema, rest);
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
}

constexpr const char* kEveryKeySession = R"(lightcal = 1
name = "all"
[room]
size_m = [5.0, 4.0, 2.6]
reflectance = 0.4
reflectance_u95 = 0.1
haze_per_m = 0.01
[[light]]
name = "key"
kind = "spot"
fixture = "fresnel"
lamp_class = "white_led"
minutes_on = 20
flicker_hz = 100
flicker_depth = 0.2
position_m = [0, 0, 1.2]
aim = [0, 0, -2]
diameter_m = 0.06
size_m = [0.6, 0.3]
length_m = 1.2
radius_m = 0.013
inner_deg = 20
outer_deg = 35
electrical_W = 9
flux_lm = 806
beam_deg = 36
field_deg = 60
off_axis_sigma_deg = 0.5
distance_sigma_m = 0.01
[[light.at]]
state = { zoom_deg = 40, modifier = "softbox" }
kind = "rect"
fixture = "softbox"
diameter_m = 0.07
size_m = [0.9, 0.6]
length_m = 1.3
radius_m = 0.014
inner_deg = 15
outer_deg = 21
[[light]]
name = "strip"
pwm_duty = 0.5
kind = "tube"
axis = [1, 0, 0]
[[light]]
name = "wash"
kind = "photometric"
distribution = "wash.ies"
[[meter]]
name = "c800"
sigma_relative = 0.03
calibration_relative = 0.02
cosine_f2 = 0.02
spectral_f1 = 0.06
head_radius_m = 0.01
window_s = 0.5
[[meter]]
name = "tens"
repeatability_relative = 0.003
step_lx = 10
[[capture]]
light = "key"
frames = "captures/*.dng"
camera = "camera.json"
nd = "nd3"
use = "card"
rows_s = 0.01
response = "style.csv"
lens_glare = 0.01
reflectance = 0.18
reflectance_sigma_relative = 0.02
distance_m = 0.8
tilt_deg = 10
rect = [0, 0, 60, 40]
exposure_s = [0.01, 0.1]
f_number = 4
iso = 100
anchor_illuminance_lx = 900
meter = "c800"
lamp_class = "white_led"
spectrum = "a.spdx"
[[capture]]
light = "key"
frames = "captures/*.exr"
use = "wall"
reflectance = 0.8
anchor_illuminance_lx = 300
[capture.wall]
square_m = 0.03
squares = [9, 6]
dictionary = "5x5_100"
board_frame = "board.exr"
board_views = "views/*.exr"
off_frames = "off/*.exr"
position_sigma_m = 0.005
vignetting = 3.5
sensor_width_m = 0.0236
masks = [0, 0, 10, 10, 20, 20, 5, 5]
shadows = [40, 10, 9, 9]
paint_srgb = [237, 234, 224]
anchor_rect = [30, 30, 8, 8]
[[capture]]
light = "key"
frames = "captures/lamp*.dng"
use = "source"
distance_m = 2
fov_deg = 40
[[capture]]
light = "wash"
frames = "captures/sky.exr"
use = "dome"
projection = "equisolid"
fov_deg = 180
[[capture]]
light = "key"
frames = "captures/ball.jpg"
use = "ball"
fov_deg = 30
[capture.ball]
diameter_m = 0.12
rect = [400, 300, 200, 200]
camera_position_m = [0, -1, 1]
camera_aim = [0, 1, 0]
camera_roll_deg = 2
[[reading]]
lit = ["key"]
distances_m = { key = 2.0 }
illuminance_lx = 12.0
[[reading]]
light = "key"
meter = "c800"
device = "sekonic:1"
time = 2026-01-02T03:04:05Z
distance_m = 0.5
distance_sigma_m = 0.02
off_axis_deg = 15
illuminance_lx = 192.0
tilt_deg = 30
lamp = "on"
cct_K = 2900
duv = -0.001
xy = [0.44, 0.40]
color_source = "camera"
spectrum = "a.spdx"
sigma_relative = 0.1
sigma_mired = 7
over_range = true
shadow_card = false
[[reading]]
light = "key"
position_m = [0, 0, 0]
normal = [0, 0, 1]
illuminance_lx = 1
under_range = true
quality = "spectral"
calibration_factor = 1.02
[camera]
sensitivities = "sensitivities.json"
[[camera_frames]]
use = "scale"
frames = "card_*.dng"
rect = [0, 0, 60, 40]
exposure_s = [0.01, 0.1]
f_number = 4
iso = 100
illuminance_lx = 900
reflectance = 0.18
reflectance_sigma_relative = 0.02
sigma_relative = 0.03
lamp_class = "white_led"
spectrum = "a.spdx"
[[camera_frames]]
use = "scale"
frames = "wall_*.dng"
luminance_nits = 312
meter = "c800"
[[camera_frames]]
use = "scale"
frames = "sky_*.dng"
illuminance_lx = 900
projection = "equisolid"
fov_deg = 180
[[camera_frames]]
use = "nd"
name = "nd3"
frames = "with_*.dng"
without = "without_*.dng"
[[camera_frames]]
use = "chart"
frames = "chart_*.dng"
chart = "chart.csv"
)";

TEST(Schemas, SessionSchemaAndParserKnowTheSameKeys) {
  const TempDir dir;
  const std::string path = dir.Write("session.toml", kEveryKeySession);
  std::vector<std::string> files = {"--every-key", path};
  std::vector<std::string> texts = {kEveryKeySession};
  for (const std::string none : {"dark", "outdoors"}) {  // a room of its own kind each
    texts.push_back("lightcal = 1\n[room]\n" + none +
                    " = true\n[[light]]\nname = \"key\"\nkind = \"point\"\n");
    files.push_back(dir.Write(none + ".toml", texts.back()));
  }
  ExpectValid("session", files);
  for (const std::string& text : texts) {
    const auto session = ParseSessionToml(text, "session.toml");
    EXPECT_TRUE(session) << session.error().message;
  }
}

TEST(Schemas, ReadingSchemaAndWriterKnowTheSameKeys) {
  const TempDir dir;
  auto session = ParseSessionToml(kEveryKeySession, "session.toml");
  ASSERT_TRUE(session) << session.error().message;
  session->readings[0].reading.shadow_card = true;
  session->readings[1].reading.lamp = LampState::kOff;
  session->readings[1].reading.state =
      ParseFixtureState("dimmer=50,cct_K=4000,zoom_deg=20,modifier=softbox").value();
  std::string journal;
  for (const SessionReading& row : session->readings) journal += ReadingToJson(row.reading) + "\n";
  // Written by hand only.
  journal += "{\"lit\":[\"key\"],\"distances_m\":{\"key\":2.0},\"illuminance_lx\":12}\n";
  ExpectValid("reading", {"--every-key", dir.Write("readings.jsonl", journal)});
}

TEST(Schemas, LightSchemaAndWriterKnowTheSameKeys) {
  const TempDir dir;
  std::string text = LightFileToJson(test::FullLightFile()).value();
  text.replace(0, 1, R"({"warnings": [{"code":"a","subject":"b","message":"c"}],"next_step":"a",
      "next_steps":{"key":"a"},"files":["a"],"through":{},"predictions":[{}],"minutes":[{}],
      "type_in":[{"engine":"a","field":"b","value":"c","unit":"d","note":"e"}],)");
  EXPECT_TRUE(LightFileFromJson(text, "light.json"));
  ExpectValid("light", {"--every-key", dir.Write("light.json", text)});
}

TEST(Schemas, CameraSchemaAndReaderKnowTheSameKeys) {
  const std::string path = kSource + "/tests/fuzz/seeds/camera_json/every_key.json";
  const auto profile = CameraProfileFromJson(test::ReadFile(path), "camera.json");
  ASSERT_TRUE(profile) << profile.error().message;
  ExpectValid("camera", {"--every-key", path});
  const TempDir dir;
  ExpectValid("camera", {dir.Write("camera.json", CameraProfileToJson(*profile).value())});
}

TEST(Schemas, CommittedSessionsAreValidAndLoad) {
  std::vector<std::string> sessions;
  std::vector<std::string> journals;
  for (const auto& entry : std::filesystem::directory_iterator(test::SampleData("sessions"))) {
    if (!entry.is_directory()) continue;
    sessions.push_back((entry.path() / "session.toml").string());
    const std::string journal = JournalPath(entry.path().string());
    if (std::filesystem::exists(journal)) journals.push_back(journal);
    const auto loaded = LoadSession(entry.path().string());
    EXPECT_TRUE(loaded) << entry.path() << ": " << loaded.error().message;
  }
  ASSERT_FALSE(sessions.empty());
  ExpectValid("session", sessions);
  if (!journals.empty()) ExpectValid("reading", journals);
}

// The schemas and the parsers refuse the same rows.
TEST(Schemas, RefuseWhatTheParserRefuses) {
  const TempDir dir;
  const std::vector<std::string> bad_rows = {
      R"({"light":"a"})",
      R"({"light":"a","distance_m":0,"illuminance_lx":1})",
      R"({"light":"a","illuminance_lx":-1})",
      R"({"light":"a","illuminance_lx":NaN})",
      R"({"light":"a","illuminance_lx":"1"})",
      R"({"light":"a","illuminance_lx":1,"lux":1})",
      R"({"light":"a","illuminance_lx":1,"tilt_deg":90})",
      R"({"light":"a","illuminance_lx":1,"sigma_relative":5})",
      R"({"light":"a","illuminance_lx":1,"lamp":"dim"})",
      R"({"light":"a","illuminance_lx":1,"normal":[0,0,1]})",
      R"({"light":"a","illuminance_lx":1,"duv":0})",
      R"({"light":"a","illuminance_lx":1,"illuminance_lx":2})",
      R"({"light":"a","illuminance_lx":1,"xy":[0.3,0.3,0.4]})",
  };
  std::vector<std::string> files;
  for (const std::string& row : bad_rows) {
    EXPECT_FALSE(ReadingFromJson(row, "row")) << row;
    files.push_back(dir.Write("row" + std::to_string(files.size()) + ".jsonl", row + "\n"));
  }
  const auto result = Validate("reading", files);
  EXPECT_EQ(result.exit_code, 1);
  for (std::size_t i = 0; i < files.size(); ++i) {
    EXPECT_NE(result.out.find(files[i]), std::string::npos) << bad_rows[i];
  }
}

}  // namespace
}  // namespace lightcal
