// SPDX-License-Identifier: Apache-2.0
// Each way a session.toml or a journal line can be wrong: the code, the place and the remedy.
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "lightcal/records/session_codec.h"

namespace lightcal {
namespace {

using testing::HasSubstr;

struct BadSession {
  const char* name;
  std::string text;
  const char* code;
  int line;          // 0 = the file as a whole
  const char* says;  // part of the message
};

void PrintTo(const BadSession& bad, std::ostream* out) { *out << bad.name; }

// Lines 1 to 4; what follows begins at line 5.
const std::string kLight = "lightcal = 1\n[[light]]\nname = \"key\"\nkind = \"point\"\n";
const std::string kReading = kLight + "[[reading]]\nlight = \"key\"\n";  // 7
const std::string kWholeReading = kReading + "illuminance_lx = 9\n";     // 8
const std::string kCapture =
    kLight + "[[capture]]\nlight = \"key\"\nframes = \"captures/*.dng\"\n";  // 8
const std::string kCardAlone =
    "[[capture]]\nlight = \"key\"\nframes = \"captures/*.dng\"\nuse = \"card\"\n"
    "reflectance = 0.18\ndistance_m = 0.8\n";
const std::string kCard = kLight + kCardAlone;                       // 11
const std::string kMeter = kLight + "[[meter]]\nname = \"c800\"\n";  // 7

std::vector<BadSession> BadSessions() {
  return {
      {"Empty", "", "bad_session", 0, "lightcal = 1"},
      {"NoVersion", "[[light]]\nname = \"a\"\nkind = \"point\"\n", "bad_session", 0,
       "lightcal = 1"},
      {"NewerVersion", "lightcal = 2\n", "bad_session", 1, "version 1"},
      {"VersionAsText", "lightcal = \"1\"\n", "bad_session", 1, "whole number"},
      {"NoLight", "lightcal = 1\n", "no_light", 0, "[[light]]"},
      {"Syntax", kLight + "aim = [0, 0\n", "bad_session", 5, "not valid TOML"},
      {"KeyTwice", kLight + "kind = \"spot\"\n", "bad_session", 5, "not valid TOML"},
      {"UnknownKeyAtTop", "nmae = \"x\"\n" + kLight, "unknown_key", 1, "\"name\""},
      {"UnknownTable", kLight + "[[lights]]\nname = \"b\"\n", "unknown_key", 5, "\"light\""},
      {"UnknownKeyInLight", kLight + "diametre_m = 1\n", "unknown_key", 5, "\"diameter_m\""},
      {"InnerAlone", "lightcal = 1\n[[light]]\nname = \"a\"\nkind = \"spot\"\ninner_deg = 20\n",
       "bad_session", 5, "outer_deg"},
      {"UnknownKeyInMeter", kMeter + "sigma = 0.1\n", "unknown_key", 7, "sigma_relative"},
      {"UnknownKeyInRoom", kLight + "[room]\nsize_m = [1, 1, 1]\nreflectence = 0.1\n",
       "unknown_key", 7, "\"reflectance\""},
      {"UnknownKeyInReading", kWholeReading + "distnace_m = 1\n", "unknown_key", 8,
       "\"distance_m\""},
      {"UnknownKeyBeforeWhatItMakesMissing", kReading + "iluminance_lx = 4\n", "unknown_key", 7,
       "\"illuminance_lx\""},
      {"LightIsATable", "lightcal = 1\n[light]\nname = \"a\"\n", "bad_session", 2, "an array"},
      {"LightIsNotATable", "lightcal = 1\nlight = [1]\n", "bad_session", 2, "a table"},
      {"NoName", "lightcal = 1\n[[light]]\nkind = \"point\"\n", "bad_session", 2,
       "name is missing"},
      {"NoKind", "lightcal = 1\n[[light]]\nname = \"a\"\n", "bad_session", 2, "kind is missing"},
      {"EmptyName", "lightcal = 1\n[[light]]\nname = \"\"\nkind = \"point\"\n", "bad_session", 3,
       "must not be empty"},
      {"NameWithSlash", "lightcal = 1\n[[light]]\nname = \"../a\"\nkind = \"point\"\n",
       "bad_session", 3, "slash"},
      {"NameWithControl", "lightcal = 1\n[[light]]\nname = \"a\\u0000b\"\nkind = \"point\"\n",
       "bad_session", 3, "control character"},
      {"UnknownKind", "lightcal = 1\n[[light]]\nname = \"a\"\nkind = \"spto\"\n", "bad_session", 4,
       "\"spot\""},
      {"LightTwice", kLight + "[[light]]\nname = \"key\"\nkind = \"spot\"\n", "duplicate_name", 6,
       "\"key\""},
      {"MeterTwice", kMeter + "[[meter]]\nname = \"c800\"\n", "duplicate_name", 8, "\"c800\""},
      {"ReservedMeter", kLight + "[[meter]]\nname = \"data_sheet\"\n", "bad_session", 6,
       "reserved"},
      {"ZeroAim", kLight + "aim = [0, 0, 0]\n", "bad_session", 5, "no direction"},
      {"ShortAim", kLight + "aim = [0, 1]\n", "bad_session", 5, "3 numbers, not 2"},
      {"NaNInAim", kLight + "aim = [0, nan, 1]\n", "bad_session", 5, "finite"},
      {"ZeroDiameter", kLight + "diameter_m = 0\n", "bad_session", 5, "above 0"},
      {"NegativeWatts", kLight + "electrical_W = -9\n", "bad_session", 5, "above 0"},
      {"InfiniteFlux", kLight + "flux_lm = inf\n", "bad_session", 5, "flux_lm = inf"},
      {"WideCone", kLight + "outer_deg = 200\n", "bad_session", 5, "half angle"},
      {"FieldBelowBeam", kLight + "beam_deg = 60\nfield_deg = 36\n", "bad_session", 6, "swap"},
      {"RoomWithoutSize", kLight + "[room]\nreflectance = 0.5\n", "bad_session", 5,
       "size_m is missing"},
      {"FlatRoom", kLight + "[room]\nsize_m = [5, 4, 0]\n", "bad_session", 6, "above 0"},
      {"MirrorRoom", kLight + "[room]\nsize_m = [5, 4, 3]\nreflectance = 1\n", "bad_session", 7,
       "reflectance"},
      {"SigmaAsPercent", kMeter + "sigma_relative = 5\n", "bad_session", 7, "0.05 means 5 %"},
      {"ZeroSigma", kMeter + "sigma_relative = 0\n", "bad_session", 7, "between 0 and 1"},
      {"ReadingWithoutLight", kLight + "[[reading]]\nilluminance_lx = 1\n", "bad_session", 5,
       "light is missing"},
      {"UnknownLight", kLight + "[[reading]]\nlight = \"kye\"\nilluminance_lx = 1\n",
       "unknown_light", 6, "\"key\""},
      {"UnknownMeter", kMeter + "[[reading]]\nlight = \"key\"\nmeter = \"c80\"\ncct_K = 1e3\n",
       "unknown_meter", 9, "\"c800\""},
      {"ZeroDistance", kWholeReading + "distance_m = 0\n", "bad_session", 8,
       "[[reading]] 1: distance_m = 0: must be above 0"},
      {"NegativeDistance", kWholeReading + "distance_m = -0.5\n", "bad_session", 8, "-0.5"},
      {"NaNDistance", kWholeReading + "distance_m = nan\n", "bad_session", 8, "distance_m = nan"},
      {"InfiniteDistance", kWholeReading + "distance_m = -inf\n", "bad_session", 8, "-inf"},
      {"DistanceAsText", kWholeReading + "distance_m = \"50cm\"\n", "bad_session", 8,
       "must be a number, not text"},
      {"NegativeIlluminance", kReading + "illuminance_lx = -1\n", "bad_session", 7,
       "as the meter displayed it"},
      {"NothingMeasured", kReading + "distance_m = 1\n", "bad_session", 6, "nothing was measured"},
      {"TurnedAway", kWholeReading + "tilt_deg = 90\n", "bad_session", 8, "does not see the lamp"},
      {"UnknownLampState", kWholeReading + "lamp = \"offf\"\n", "bad_session", 8, "\"off\""},
      {"FlagAsNumber", kWholeReading + "shadow_card = 1\n", "bad_session", 8, "true or false"},
      {"ShadowOfADarkLamp", kWholeReading + "shadow_card = true\nlamp = \"off\"\n", "bad_session",
       8, "lamp = \"off\""},
      {"ColdCct", kReading + "cct_K = 0\n", "bad_session", 7, "above 0"},
      {"DuvAlone", kWholeReading + "duv = 0.01\n", "bad_session", 8, "cct_K"},
      {"ImpossibleXy", kReading + "xy = [0.7, 0.4]\n", "bad_session", 7, "no CIE 1931"},
      {"XyBeyondAMetersError", kReading + "xy = [0.74, 0.27]\n", "bad_session", 7, "1.005"},
      {"BlackXy", kReading + "xy = [0.3, 0]\n", "bad_session", 7, "y > 0"},
      {"OverRangeOfNothing", kReading + "cct_K = 3000\nover_range = true\n", "bad_session", 8,
       "illuminance_lx"},
      {"PositionAndDistance",
       kWholeReading + "distance_m = 1\nposition_m = [0, 0, 0]\nnormal = [0, 0, 1]\n",
       "bad_session", 8, "not both"},
      {"PositionAlone", kWholeReading + "position_m = [0, 0, 0]\n", "bad_session", 8,
       "belong together"},
      {"TiltBesideNormal",
       kWholeReading + "position_m = [0, 0, 0]\nnormal = [0, 0, 1]\ntilt_deg = 5\n", "bad_session",
       10, "normal says already"},
      {"ZeroNormal", kWholeReading + "position_m = [0, 0, 0]\nnormal = [0, 0, 0]\n", "bad_session",
       9, "no direction"},
      {"TiltOfTheLampsOwnPicture",
       kCapture + "use = \"source\"\ndistance_m = 1\nfov_deg = 40\ntilt_deg = 5\n", "bad_session",
       11, "tilt_deg tells nothing where use = \"source\""},
      {"GlareOfADome", kCapture + "use = \"dome\"\nlens_glare = 0.02\n", "bad_session", 9,
       "lens_glare tells nothing"},
      {"ExposureOfADome", kCapture + "use = \"dome\"\nexposure_s = [0.1]\n", "bad_session", 9,
       "exposure_s tells nothing"},
      {"CameraOfADome", kCapture + "use = \"dome\"\ncamera = \"no_such.json\"\n", "bad_session", 9,
       "camera tells nothing"},
      {"SpeedOfABall",
       kCapture + "use = \"ball\"\nfov_deg = 40\niso = 100\n[capture.ball]\ndiameter_m = 0.1\n" +
           "rect = [1, 1, 9, 9]\ncamera_position_m = [0, 0, 1]\ncamera_aim = [0, 1, 0]\n",
       "bad_session", 10, "iso tells nothing"},
      {"WallWithoutBoard", kCapture + "use = \"wall\"\nreflectance = 0.8\n", "bad_session", 5,
       "wall"},
      {"BoardWithoutWall", kCard + "[capture.wall]\nsquare_m = 0.03\n", "bad_session", 11,
       "use = \"wall\""},
      {"BoardOfNoSize",
       kCapture + "use = \"wall\"\nreflectance = 0.8\n[capture.wall]\nsquare_m = 0\n",
       "bad_session", 11, "above 0"},
      {"MaskOfThreeNumbers",
       kCapture + "use = \"wall\"\nreflectance = 0.8\n[capture.wall]\nsquare_m = 0.03\n" +
           "masks = [1, 2, 3]\n",
       "bad_session", 12, "again and again"},
      {"WallOfNoPaint",
       kCapture + "use = \"wall\"\nreflectance = 0.8\n[capture.wall]\nsquare_m = 0.03\n" +
           "paint_srgb = [237, 234, 256]\n",
       "bad_session", 12, "1 to 255"},
      {"SourceWithoutFieldOfView", kCapture + "use = \"source\"\ndistance_m = 1\n", "bad_session",
       5, "fov_deg"},
      {"BallWithoutItsTable", kCapture + "use = \"ball\"\nfov_deg = 30\n", "bad_session", 5,
       "ball"},
      {"BallSeenFromNowhere",
       kCapture + "use = \"ball\"\nfov_deg = 30\n[capture.ball]\ndiameter_m = 0.1\n" +
           "rect = [1, 2, 3, 4]\ncamera_position_m = [0, 0, 0]\ncamera_aim = [0, 0, 0]\n",
       "bad_session", 14, "no direction"},
      {"DomeOfAStrangeProjection", kCapture + "use = \"dome\"\nprojection = \"fish\"\n",
       "bad_session", 9, "equisolid"},
      {"CaptureOfNothing", kCapture + "use = \"cart\"\n", "bad_session", 8, "card"},
      {"CardWithoutReflectance", kCapture + "use = \"card\"\ndistance_m = 1\n", "bad_session", 5,
       "reflectance"},
      {"CardWithoutDistance", kCapture + "use = \"card\"\nreflectance = 0.18\n", "bad_session", 5,
       "distance_m"},
      {"CardBrighterThanWhite", kCapture + "use = \"card\"\nreflectance = 18\n", "bad_session", 9,
       "up to 1"},
      {"CardOfNoSize", kCard + "rect = [1, 2, 3]\n", "bad_session", 11, "width, height"},
      {"CardLeftOfThePicture", kCard + "rect = [-1, 2, 3, 4]\n", "bad_session", 11, "width"},
      {"CaptureOfNoTime", kCard + "exposure_s = [0.1, 0]\n", "bad_session", 11, "above 0"},
      {"CaptureOfAStrangeLight",
       kLight + "[[capture]]\nlight = \"kay\"\nframes = \"*.dng\"\nuse = \"card\"\n" +
           "reflectance = 0.18\ndistance_m = 1\n",
       "unknown_light", 6, "\"key\""},
      {"CaptureOfAnotherKindOfLamp",
       kLight + "lamp_class = \"white_led\"\n[[capture]]\nlight = \"key\"\nframes = \"*.dng\"\n" +
           "use = \"card\"\nreflectance = 0.18\ndistance_m = 1\nlamp_class = \"tungsten\"\n",
       "lamp_class_conflict", 12, "\"white_led\""},
      {"CaptureByAStrangeMeter", kCard + "anchor_illuminance_lx = 9\nmeter = \"c80\"\n",
       "unknown_meter", 12, "c80"},
      {"MeterOfNoAnchor", kMeter + kCardAlone + "meter = \"c800\"\n", "bad_session", 13,
       "anchor_illuminance_lx"},
      {"SpectrumOfNoCamera", kCard + "spectrum = \"lamp.sp\"\n", "bad_session", 11, "camera"},
      {"CaptureMisspelt", kCard + "anchor_lx = 9\n", "unknown_key", 11, "anchor_illuminance_lx"},
  };
}

class SessionRefusals : public testing::TestWithParam<BadSession> {};

TEST_P(SessionRefusals, NameCodePlaceAndRemedy) {
  const BadSession& bad = GetParam();
  const auto session = ParseSessionToml(bad.text, "session.toml");
  ASSERT_FALSE(session);
  const Error& error = session.error();
  EXPECT_EQ(error.kind, ErrorKind::kRefused);
  EXPECT_EQ(error.code, bad.code) << error.message;
  const std::string line = std::to_string(bad.line);
  if (bad.line > 0) {
    EXPECT_EQ(error.subject, "session.toml:" + line) << error.message;
  } else {
    EXPECT_THAT(error.subject, HasSubstr("session.toml"));
  }
  EXPECT_THAT(error.message, HasSubstr(bad.says));
}

INSTANTIATE_TEST_SUITE_P(Toml, SessionRefusals, testing::ValuesIn(BadSessions()),
                         [](const auto& each) { return std::string(each.param.name); });

TEST(SessionRefusals, GoodPiecesOfTheTableAreGood) {
  EXPECT_TRUE(ParseSessionToml(kLight, "s"));
  EXPECT_TRUE(ParseSessionToml(kWholeReading, "s"));
  EXPECT_TRUE(ParseSessionToml(kMeter, "s"));
}

struct BadLine {
  const char* name;
  const char* text;
  const char* says;
};

void PrintTo(const BadLine& bad, std::ostream* out) { *out << bad.name; }

constexpr BadLine kBadLines[] = {
    {"NotJson", "light=key", "not JSON"},
    {"NotAnObject", "[1, 2]", "one JSON object"},
    {"NaN", R"({"light":"a","illuminance_lx":NaN})", "not JSON"},
    {"Null", R"({"light":"a","illuminance_lx":null})", "must be a number, not null"},
    {"TooLarge", R"({"light":"a","illuminance_lx":1e999})", "out of range"},
    {"KeyTwice", R"({"light":"a","light":"b","illuminance_lx":1})", "given twice"},
    {"UnknownKey", R"({"light":"a","ilumminance_lx":1})", "\"illuminance_lx\""},
    {"ZeroDistance", R"({"light":"a","distance_m":0,"illuminance_lx":1})", "above 0"},
    {"NegativeDistance", R"({"light":"a","distance_m":-1,"illuminance_lx":1})", "above 0"},
    {"NegativeLux", R"({"light":"a","distance_m":1,"illuminance_lx":-1})", "not be negative"},
    {"TrailingText", R"({"light":"a","illuminance_lx":1} x)", "not JSON"},
    {"NotUtf8", "{\"light\":\"\xff\",\"illuminance_lx\":1}", "not JSON"},
};

class JournalLineRefusals : public testing::TestWithParam<BadLine> {};

TEST_P(JournalLineRefusals, NamePlaceAndReason) {
  const auto reading = ReadingFromJson(GetParam().text, "readings.jsonl:7");
  ASSERT_FALSE(reading);
  EXPECT_EQ(reading.error().kind, ErrorKind::kRefused);
  EXPECT_EQ(reading.error().subject, "readings.jsonl:7");
  EXPECT_THAT(reading.error().message, HasSubstr(GetParam().says));
}

INSTANTIATE_TEST_SUITE_P(Json, JournalLineRefusals, testing::ValuesIn(kBadLines),
                         [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace lightcal
