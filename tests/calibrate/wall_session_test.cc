// SPDX-License-Identifier: Apache-2.0
// A lit wall's way through the built program: the board printed, the pictures read, files written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "plain_exr.h"
#include "run_cli.h"
#include "run_cli_json.h"
#include "synthetic_wall.h"

namespace lightcal::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

bool Holds(const json& interval, double value) {
  return double(interval["low95"]) <= value && value <= double(interval["high95"]);
}

TEST(LitWall, TheShippedPicturesBecomeADistributionWithItsUncertainty) {
  const TempDir out;
  const json document = LightcalJson("run", {SampleData("sessions/lit_wall"), "-o", out.path()});
  const json& light = document["lights"].at(0);
  EXPECT_EQ(light["kind"], "photometric");
  const json& gammas = light["distribution"]["vertical_deg"];
  EXPECT_GT(double(gammas.back()), 20.0);
  const ConeTruth truth = TruthWithin(SpotInAGlow, {0, 1, 0}, double(gammas.back()));
  EXPECT_NEAR(double(light["intensity_cd"]["value"]) / truth.peak_cd, 1.0, 0.03);
  EXPECT_NEAR(double(light["flux_lm"]["value"]) / truth.flux_lm, 1.0, 0.01);
  EXPECT_TRUE(Holds(light["intensity_cd"], truth.peak_cd));
  EXPECT_TRUE(Holds(light["flux_lm"], truth.flux_lm));
  const bool named = std::ranges::any_of(
      document["warnings"], [](const json& warning) { return warning["code"] == "not_measured"; });
  EXPECT_TRUE(named) << "nobody saw directions beyond the cone";
  for (const char* name : {"light.json", "report.html", "lit_wall.preset.json"}) {
    EXPECT_TRUE(fs::exists(fs::path(out.path()) / name)) << name;
  }
  EXPECT_NE(ReadFile(out.path() + "/report.html").find("Intensity by direction"),
            std::string::npos);
  EXPECT_LT(double(light["fit"]["rms_relative"]), 0.02);
  EXPECT_EQ(document["provenance"]["inputs"].size(), 5U) << "session, wall, three views";
}

class WallSession : public testing::Test {
 protected:
  // What the session says, with one line replaced, is refused as.
  std::string RefusalOf(const std::string& line, const std::string& by) {
    const std::string session = SampleData("sessions/lit_wall");
    std::string toml = ReadFile(session + "/session.toml");
    const auto at = toml.find(line);
    EXPECT_NE(at, std::string::npos) << line;
    toml.replace(at, line.size(), by);
    for (const std::string& folder : {std::string("captures/"), std::string("views/")}) {
      const auto begin = toml.find("\"" + folder);
      if (begin != std::string::npos) toml.insert(begin + 1, session + "/");
    }
    const CliResult result =
        RunLightcal({"fit", folder_.Write("session.toml", toml), "--allow-outside", "-o",
                     folder_.path() + "/light.json", "--json"});
    EXPECT_EQ(result.exit_code, 3) << result.out << result.err;
    EXPECT_FALSE(fs::exists(folder_.path() + "/light.json"));
    const json answer = json::parse(result.out, nullptr, false);
    if (answer.contains("error")) subject_ = answer["error"]["subject"];
    return answer.contains("error") ? std::string(answer["error"]["code"]) : result.out;
  }

  TempDir folder_;
  std::string subject_;  // of the last refusal
};

TEST_F(WallSession, WhatCannotBeMeasuredIsRefusedByName) {
  EXPECT_EQ(RefusalOf("position_m = [0.5, -1.0, 0.35]\n", ""), "position_unknown");
  EXPECT_EQ(RefusalOf("[0.5, -1.0, 0.35]", "[0.5, 1.0, 0.35]"), "not_in_front");
  EXPECT_EQ(RefusalOf("\"photometric\"", "\"spot\""), "wall_needs_photometric");
  EXPECT_EQ(RefusalOf("square_m = 0.03 ", "dictionary = \"6x6_250\"\nsquare_m = 0.03 "),
            "board_not_found");
  EXPECT_NE(subject_.find("ChArUco board in "), std::string::npos) << subject_;
  EXPECT_NE(subject_.find(".exr"), std::string::npos) << subject_;
  EXPECT_EQ(RefusalOf("aim = [0, 1, 0]", "aim = [1, 0, 0]"), "axis_not_covered");
}

// A spot on a wall of a room that throws light back, up to 4 % of the peak and more to the right,
// and in the light of a lamp that was left on.
class WallInARoom : public testing::Test {
 protected:
  static double RoomLux(double x, double z) { return 25.0 + 10.0 * (x - 0.5) - 4.0 * (z - 0.35); }
  static constexpr double kAmbient = 9.0;

  void SetUp() override {
    LightcalJson("plan", {"--board", folder_.path() + "/board.svg"});
    wall_.board = RectanglesOfSvg(ReadFile(folder_.path() + "/board.svg"));
    wall_.width = 800;
    wall_.height = 600;
    wall_.focal_px = 640.0;
    wall_.intensity = Shaded;
    wall_.other_lx = [](double x, double z) { return RoomLux(x, z) + kAmbient; };
    Photograph("wall.exr");
    const Point3 stands = wall_.camera, looks = wall_.looks_at;
    wall_.camera = {-0.4, -0.5, 0.4};
    wall_.looks_at = {0.13, 0.0, 0.09};
    Photograph("views/board.exr");
    wall_.camera = stands;
    wall_.looks_at = looks;
  }
  // A card near the lamp shades what lies about (.30, -.25) of the wall off the lamp's foot.
  static double Shaded(const Point3& d) {
    return std::hypot(d[0] / d[1] - 0.30, d[2] / d[1] + 0.25) < 0.06 ? 0.0 : SpotInAGlow(d);
  }
  void Photograph(const std::string& name) {
    std::vector<float> nits = PhotographWall(wall_);
    folder_.Write(name, EncodeExr(wall_.width, wall_.height, nits, {FloatOf("whiteLuminance", 1)}));
  }
  std::string ShadowPixels() const {
    const auto box = PixelsAround(wall_, 0.80, 0.10, 0.06);
    return std::to_string(box[0]) + ", " + std::to_string(box[1]) + ", " + std::to_string(box[2]) +
           ", " + std::to_string(box[3]);
  }
  json Measure(const std::string& of_wall, const std::string& of_lamp = "") {
    const std::string session =
        folder_.Write("session.toml",
                      "lightcal = 1\n[[light]]\nname = \"spot\"\nkind = \"photometric\"\n"
                      "position_m = [0.5, -1.0, 0.35]\naim = [0, 1, 0]\n" +
                          of_lamp +
                          "[[capture]]\n"
                          "light = \"spot\"\nuse = \"wall\"\nframes = \"wall.exr\"\n"
                          "reflectance = 0.8\nlens_glare = 0.0\n[capture.wall]\n"
                          "square_m = 0.03\nboard_views = \"views/*.exr\"\n"
                          "vignetting = 3.6\n" +
                          of_wall);
    return LightcalJson("fit", {session, "-o", folder_.path() + "/light.json", "--force"});
  }
  // 1 sigma of the flux, or the peak, that a cause leaves open.
  static double PartOf(const json& light, const char* cause, const char* of = "flux_sd_relative") {
    for (const json& part : light["distribution"]["budget"]) {
      if (part["name"] == cause) return double(part[of]);
    }
    return 0.0;
  }
  static double PeakPartOf(const json& light, const char* cause) {
    return PartOf(light, cause, "peak_sd_relative");
  }
  static double FoundOverTrue(const json& light, const char* what) {
    const double seen_deg = light["distribution"]["vertical_deg"].back();
    const ConeTruth truth = TruthWithin(SpotInAGlow, {0, 1, 0}, seen_deg);
    const double of = what == std::string("flux_lm") ? truth.flux_lm : truth.peak_cd;
    EXPECT_TRUE(Holds(light[what], of)) << what << " " << light[what] << ", truth " << of;
    return double(light[what]["value"]) / of;
  }

  TempDir folder_;
  SyntheticWall wall_;
};

TEST_F(WallInARoom, WhatTheRoomThrowsBackIsInTheIntervalAndACardsShadowMeasuresIt) {
  const json without = Measure("masks = [" + ShadowPixels() + "]\n");
  const json& guessed = without["lights"].at(0);
  EXPECT_NEAR(FoundOverTrue(guessed, "intensity_cd"), 1.0, 0.05);
  EXPECT_NEAR(FoundOverTrue(guessed, "flux_lm"), 1.0, 0.15);
  ASSERT_FALSE(guessed["effects"].empty());
  EXPECT_EQ(guessed["effects"][0]["name"], "room_bounce");
  EXPECT_GT(double(guessed["effects"][0]["bound"]), 34.0 / 934.0);

  const json with = Measure("shadows = [" + ShadowPixels() + "]\n");
  const json& light = with["lights"].at(0);
  EXPECT_NEAR(FoundOverTrue(light, "intensity_cd"), 1.0, 0.02);
  EXPECT_NEAR(FoundOverTrue(light, "flux_lm"), 1.0, 0.03);
  EXPECT_LT(PartOf(light, "other_light"), PartOf(guessed, "other_light"));
  // The room's 25 lx and the other lamp's 9 at the middle, 38 in the shadow; the slope is not told.
  EXPECT_NEAR(double(light["effects"][0]["contribution"]) * 934.0, 36.0, 2.5);
}

double WidthOf(const json& value) {
  return (double(value["high95"]) - double(value["low95"])) / double(value["value"]);
}

TEST_F(WallInARoom, WhatTheLampDoesInTimeIsInTheInterval) {
  const std::string wall = "masks = [" + ShadowPixels() + "]\n";
  const json unsaid = Measure(wall)["lights"].at(0);
  const json cold = Measure(wall, "minutes_on = 1\n")["lights"].at(0);
  const json said =
      Measure(wall, "minutes_on = 120\nflicker_depth = 0.0\nlamp_class = \"white_led\"\n")["lights"]
          .at(0);
  // A fifth exp(-t / 15 min), of a half hour and a minute; a ripple of one half at 100 Hz under
  // 1/60 s.
  EXPECT_NEAR(PeakPartOf(unsaid, "warm_up"), 0.5 * 0.2 * std::exp(-2.0), 1e-4);
  EXPECT_NEAR(PeakPartOf(cold, "warm_up"), 0.5 * 0.2 * std::exp(-1.0 / 15.0), 1e-4);
  EXPECT_NEAR(PeakPartOf(unsaid, "rolling_shutter"), 0.25 / (3.14159265 * 100.0 / 60.0), 1e-4);
  EXPECT_NEAR(PeakPartOf(unsaid, "mains"), 0.5 * 0.0354397 * std::sqrt(0.3), 1e-4);
  EXPECT_GT(WidthOf(cold["intensity_cd"]), 1.2 * WidthOf(unsaid["intensity_cd"]));
  EXPECT_LT(WidthOf(said["intensity_cd"]), 0.9 * WidthOf(unsaid["intensity_cd"]));
  for (const char* cause : {"rolling_shutter", "mains"}) EXPECT_EQ(PeakPartOf(said, cause), 0.0);
  EXPECT_LT(PeakPartOf(said, "warm_up"), 1e-3);
  EXPECT_EQ(unsaid["intensity_cd"]["value"], cold["intensity_cd"]["value"]);
  EXPECT_NE(unsaid["budget"][0]["halve"], "");
}

TEST_F(WallInARoom, APictureWithTheLampOffTakesOtherLampsAway) {
  wall_.intensity = [](const Point3&) { return 0.0; };
  wall_.other_lx = [](double, double) { return kAmbient; };
  Photograph("off/wall.exr");
  const json off = Measure("off_frames = \"off/*.exr\"\nshadows = [" + ShadowPixels() + "]\n",
                           "size_m = [0.3, 0.3]\n");
  const json& light = off["lights"].at(0);
  EXPECT_NEAR(double(light["effects"][0]["contribution"]) * 925.0, 27.0, 2.5);
  FoundOverTrue(light, "intensity_cd");
  EXPECT_NEAR(FoundOverTrue(light, "flux_lm"), 1.0, 0.03);
  // 2 <rho^2>/d^2, to second order, of a square of 30 cm 1 m away.
  EXPECT_NEAR(PartOf(light, "finite_source"), 0.03, 1e-3);
  EXPECT_EQ(off["provenance"]["inputs"].size(), 4U) << "session, wall, lamp off, view";
}

// Length of the first run of dark pixels in the picture's rows, over rows where there is one.
int FirstDarkRun(const std::string& pgm) {
  std::size_t at = 0;
  int numbers[3] = {};
  at = pgm.find_first_of(" \n", 0);
  for (int& number : numbers) {
    at = pgm.find_first_of("0123456789", at);
    number = std::atoi(pgm.c_str() + at);
    at = pgm.find_first_of(" \n", at);
  }
  const std::string pixels = pgm.substr(at + 1);
  const auto width = static_cast<std::size_t>(numbers[0]);
  const std::size_t row = 250 * width;  // 25 mm from above: the board's first row of squares
  const auto dark = [&](std::size_t x) {
    return static_cast<unsigned char>(pixels[row + x]) < 128;
  };
  std::size_t x = 0;
  while (x < width && !dark(x)) ++x;
  const std::size_t begin = x;
  while (x < width && dark(x)) ++x;
  return static_cast<int>(x - begin);
}

TEST(Plan, TheBoardIsPrintedInTrueSize) {
  const TempDir folder;
  const std::string pdf = folder.path() + "/board.pdf";
  const json answer = LightcalJson("plan", {"--board", pdf});
  EXPECT_EQ(double(answer["board"]["square_m"]), 0.03);
  const CliResult page =
      RunProgram({"pdftoppm", "-r", "254", "-gray", "-singlefile", pdf, folder.path() + "/page"});
  ASSERT_EQ(page.exit_code, 0) << page.err;
  // 254 pixels an inch are 10 a millimetre.
  EXPECT_NEAR(FirstDarkRun(ReadFile(folder.path() + "/page.pgm")), 300, 1);
  const CliResult info = RunProgram({"pdfinfo", pdf});
  EXPECT_THAT(info.out, HasSubstr("841.89 x 595.276 pts (A4)"));
  EXPECT_EQ(RunLightcal({"plan", "--board", pdf}).exit_code, 0) << "ours is replaced";
}

TEST(Plan, WhatIsPrintedIsWhatThePicturesOfTheSampleShow) {
  const TempDir folder;
  const std::string svg = folder.path() + "/board.svg";
  ASSERT_EQ(RunLightcal({"plan", "--board", svg}).exit_code, 0);
  const auto rectangles = RectanglesOfSvg(ReadFile(svg));
  EXPECT_GT(rectangles.size(), 54U);
  double right = 0.0, top = 0.0;
  for (const PrintedRectangle& r : rectangles) {
    right = std::max(right, r.x + r.width);
    top = std::max(top, r.z + r.height);
  }
  EXPECT_NEAR(right, 0.27, 1e-9);
  EXPECT_NEAR(top, 0.18, 1e-9);
}

TEST(Plan, WhatDoesNotFitIsWrongUsage) {
  const TempDir folder;
  const std::string board = folder.path() + "/board.svg";
  EXPECT_EQ(RunLightcal({"plan", "--board", board, "--square", "50mm"}).exit_code, 2);
  EXPECT_EQ(RunLightcal({"plan", "--board", board, "--paper", "b5"}).exit_code, 2);
  EXPECT_EQ(RunLightcal({"plan", "--board", board, "--squares", "9"}).exit_code, 2);
  EXPECT_EQ(RunLightcal({"plan", "--board", folder.path() + "/board.txt"}).exit_code, 2);
  EXPECT_EQ(RunLightcal({"plan", "--board", board, "--squares", "12x9"}).exit_code, 3);
}

}  // namespace
}  // namespace lightcal::test
