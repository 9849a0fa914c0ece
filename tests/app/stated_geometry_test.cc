// SPDX-License-Identifier: Apache-2.0
// What a session says of where lamp and meter stood and of what else shone, heard by every kind of
// lamp: the lamps are closed forms written here.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "run_cli.h"
#include "run_cli_json.h"

namespace lightcal::test {
namespace {

using nlohmann::json;

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;

const char* const kDark = "[room]\ndark = true\n";
const char* const kOutdoors = "[room]\noutdoors = true\n";

struct Read {
  std::string where;  // keys of the reading
  double lux = 0.0;
};

std::string SessionOf(const std::string& room, const std::string& light,
                      const std::vector<Read>& readings) {
  std::ostringstream text;
  text.precision(12);
  text << "lightcal = 1\n"
       << room << "[[light]]\nname = \"lamp\"\n"
       << light << "[[meter]]\nname = \"m\"\nsigma_relative = 0.03\n";
  for (const Read& one : readings) {
    text << "[[reading]]\nlight = \"lamp\"\nmeter = \"m\"\n"
         << one.where << "illuminance_lx = " << one.lux << "\n";
  }
  return text.str();
}

json FitOf(const std::string& session) {
  const TempDir folder;
  return LightcalJson("fit", {folder.Write("session.toml", session)})["lights"][0];
}

double Low(const json& value) {
  return value.value("low95", double(value["value"]) - double(value["u95"]));
}
double High(const json& value) {
  return value.value("high95", double(value["value"]) + double(value["u95"]));
}
double HalfWidth(const json& value) {
  return (High(value) - Low(value)) / 2.0 / double(value["value"]);
}
bool Holds(const json& value, double truth) { return Low(value) <= truth && truth <= High(value); }

std::vector<std::string> FilesIn(const std::string& folder, const std::string& extension) {
  std::vector<std::string> out;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    if (file.path().extension() == extension) out.push_back(file.path().string());
  }
  return out;
}

std::string At(double x, double y, double z, const std::string& normal) {
  std::ostringstream text;
  text << "position_m = [" << x << ", " << y << ", " << z << "]\nnormal = " << normal << "\n";
  return text.str();
}

std::string AtDistance(double metres, const std::string& more = "") {
  return "distance_m = " + std::to_string(metres) + "\n" + more;
}

// Lux on a meter that looks up, of a lamp of `candela` that shines alike all round.
double Upward(double candela, double dx, double dy, double dz) {
  const double r2 = dx * dx + dy * dy + dz * dz;
  return candela * dz / std::pow(r2, 1.5);
}

// ---- where lamp and meter stand ----

// A sphere has no side that it is turned to: it needs no aim.
TEST(StatedGeometry, ASphereOfKnownPlaceNeedsNoAim) {
  const char* const lamp = "kind = \"sphere\"\ndiameter_m = 0.1\nposition_m = [0, 0, 2]\n";
  std::vector<Read> readings;
  for (const auto& [x, y, z] : {std::array{0.0, 0.0, 0.0}, std::array{0.0, 0.0, 1.0},
                                std::array{1.0, 0.0, 0.0}, std::array{0.0, -1.0, 0.0}}) {
    readings.push_back({At(x, y, z, "[0, 0, 1]"), Upward(500.0, x, y, 2.0 - z)});
  }
  for (const std::string aim : {"", "aim = [0, 0, -1]\n", "aim = [1, 0, 0]\n"}) {
    const json found = FitOf(SessionOf(kDark, lamp + aim, readings));
    EXPECT_NEAR(double(found["intensity_cd"]["value"]), 500.0, 10.0) << aim;
    EXPECT_TRUE(Holds(found["intensity_cd"], 500.0)) << aim;
  }
}

// A sun 60 degrees from the zenith puts half of itself on a meter that lies flat.
TEST(StatedGeometry, ANormalTurnsAMeterFromTheSun) {
  const char* const sun = "kind = \"directional\"\naim = [-0.8660254, 0, -0.5]\n";
  const std::string session = SessionOf(kOutdoors, sun, {{At(0, 0, 0, "[0, 0, 1]"), 50000.0}});
  const TempDir folder;
  const std::string file = folder.Write("session.toml", session);
  const json lux = LightcalJson("fit", {file})["lights"][0]["illuminance_lx"];
  EXPECT_NEAR(double(lux["value"]), 100000.0, 10.0);
  const json shown = LightcalJson("simulate", {file, "--at", "0,0,0", "--normal", "0,0,1"});
  EXPECT_NEAR(double(shown["points"][0]["illuminance_lx"]["value"]), 50000.0, 10.0) << shown;
  const TempDir unaimed;
  const CliResult refused = RunLightcal(
      {"fit", unaimed.Write("session.toml", SessionOf(kOutdoors, "kind = \"directional\"\n",
                                                      {{At(0, 0, 0, "[0, 0, 1]"), 50000.0}}))});
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_NE(refused.err.find("aim"), std::string::npos) << refused.err;
}

// ---- what else shines ----

double OtherLight(double metres) { return 3.0 + 2.0 * metres; }

// Other light that differs from place to place: what was read there with the lamp off is taken from
// each reading, which leaves what a card would.
TEST(StatedGeometry, LampOffAtEachPlaceIsAsGoodAsACardThere) {
  const char* const bulb = "kind = \"point\"\nfixture = \"bulb\"\n";
  std::vector<Read> lit, off, card;
  for (const double d : {0.5, 1.0, 2.0, 3.0}) {
    lit.push_back({AtDistance(d), 100.0 / (d * d) + OtherLight(d)});
    off.push_back({AtDistance(d, "lamp = \"off\"\n"), OtherLight(d)});
    card.push_back({AtDistance(d, "shadow_card = true\n"), OtherLight(d)});
  }
  const auto with = [&](const std::vector<std::vector<Read>>& more) {
    std::vector<Read> all = lit;
    for (const auto& rows : more) all.insert(all.end(), rows.begin(), rows.end());
    return FitOf(SessionOf(kDark, bulb, all))["intensity_cd"];
  };
  const json by_off = with({off}), by_card = with({card}), by_both = with({card, off});
  for (const json& one : {by_off, by_card, by_both}) {
    EXPECT_NEAR(double(one["value"]), 100.0, 0.5);
    EXPECT_NEAR(HalfWidth(one), HalfWidth(by_card), 0.02 * HalfWidth(by_card));
  }
}

// The corners of a square under a lamp lie at one distance from it, and what else shines there
// differs: a card's reading is taken from the reading at its own place.
TEST(StatedGeometry, ACardBelongsToItsOwnPlace) {
  const char* const bulb = "kind = \"point\"\nfixture = \"bulb\"\nposition_m = [0, 0, 2]\n";
  std::vector<Read> readings;
  const std::vector<std::array<double, 4>> places = {
      {0, 0, 0, 5.0}, {1, 0, 0, 9.0}, {-1, 0, 0, 3.0}, {0, 0, 1, 6.0}};
  for (const auto& [x, y, z, other] : places) {
    const std::string where = At(x, y, z, "[0, 0, 1]");
    readings.push_back({where, Upward(100.0, x, y, 2.0 - z) + other});
    readings.push_back({where + "shadow_card = true\n", other});
  }
  const json found = FitOf(SessionOf(kOutdoors, bulb, readings))["intensity_cd"];
  EXPECT_NEAR(double(found["value"]), 100.0, 1.0);
  EXPECT_LT(HalfWidth(found), 0.12);
}

// Air that takes e^(-s d) of the light: stated, it is in the model.
TEST(StatedGeometry, StatedHazeIsModelled) {
  const std::string air = "[room]\ndark = true\nhaze_per_m = 0.05\n";
  std::vector<Read> readings;
  for (const double d : {2.0, 4.0, 8.0}) {
    readings.push_back({AtDistance(d), 1e4 / (d * d) * std::exp(-0.05 * d)});
  }
  const json three =
      FitOf(SessionOf(air, "kind = \"point\"\nfixture = \"bulb\"\n", readings))["intensity_cd"];
  EXPECT_NEAR(double(three["value"]), 1e4, 100.0);
  EXPECT_LT(HalfWidth(three), 0.1);
  const json beam = FitOf(SessionOf(
      air, "kind = \"spot\"\nfixture = \"luminaire\"\n",
      {{AtDistance(8.0), 1e4 / 64.0 * std::exp(-0.4)},
       {AtDistance(8.0, "off_axis_deg = 15\n"), 5e3 / 64.0 * std::exp(-0.4)},
       {AtDistance(8.0, "off_axis_deg = 30\n"), 6e2 / 64.0 * std::exp(-0.4)}}))["intensity_cd"];
  EXPECT_TRUE(Holds(beam, 1e4)) << beam;
}

// ---- states ----

// A state that was read elsewhere than the reference: at an angle, or at another place.
TEST(StatedGeometry, AStateIsHeardWhereItWasRead) {
  const auto dimmed = [](const std::string& where, double level) {
    return where + "state = { dimmer = " + std::to_string(level) + " }\n";
  };
  const std::string by_angle = SessionOf(
      kDark, "kind = \"rect\"\nsize_m = [0.1, 0.1]\n",
      {{dimmed(AtDistance(1), 100), 1000.0},
       {dimmed(AtDistance(2), 100), 250.0},
       {dimmed(AtDistance(4), 100), 62.5},
       {dimmed(AtDistance(2, "off_axis_deg = 60\n"), 50), 500.0 * std::cos(60 * kDegree) / 4.0}});
  const std::string up = "[0, 0, 1]";
  const std::string by_place =
      SessionOf(kDark, "kind = \"point\"\nfixture = \"luminaire\"\nposition_m = [0, 0, 2]\n",
                {{dimmed(At(0, 0, 0, up), 100), Upward(1000.0, 0, 0, 2)},
                 {dimmed(At(0, 0, 1, up), 100), Upward(1000.0, 0, 0, 1)},
                 {dimmed(At(1, 1, 0, up), 50), Upward(500.0, 1, 1, 2)}});
  for (const std::string& session : {by_angle, by_place}) {
    const json found = FitOf(session);
    ASSERT_EQ(found["states"].size(), 2U) << found;
    const json& half = found["states"][1]["intensity_cd"];
    EXPECT_NEAR(double(half["value"]), 500.0, 5.0) << half;
    EXPECT_TRUE(Holds(half, 500.0)) << half;
  }
}

// ---- shapes that are stated in part, or not seen to their end ----

// Flux of a cone that falls as the square of the cosine's way from its inner to its outer edge.
double FluxOfCone(double candela, double inner_deg, double outer_deg) {
  const double ci = std::cos(inner_deg * kDegree), co = std::cos(outer_deg * kDegree);
  return 2.0 * kPi * candela * ((1.0 - ci) + (ci - co) / 3.0);
}
double PartOfCone(double degrees, double inner_deg, double outer_deg) {
  const double ci = std::cos(inner_deg * kDegree), co = std::cos(outer_deg * kDegree);
  const double t = std::clamp((std::cos(degrees * kDegree) - co) / (ci - co), 0.0, 1.0);
  return t * t;
}

std::vector<Read> AcrossCone(double inner_deg, double outer_deg,
                             const std::vector<double>& angles) {
  std::vector<Read> out;
  for (const double d : {1.0, 2.0, 4.0}) out.push_back({AtDistance(d), 1000.0 / (d * d)});
  for (const double a : angles) {
    out.push_back({AtDistance(2.0, "off_axis_deg = " + std::to_string(a) + "\n"),
                   250.0 * PartOfCone(a, inner_deg, outer_deg)});
  }
  return out;
}

// outer_deg alone leaves open how far the middle is even: the flux holds both ends, and readings
// off the axis tell it.
TEST(StatedGeometry, AnInnerAngleThatNobodySaysIsOpen) {
  for (const double inner : {0.5, 10.0, 20.0, 34.0}) {
    const std::string lamp = "kind = \"spot\"\nouter_deg = 35\n";
    const double truth = FluxOfCone(1000.0, inner, 35.0);
    const json axial = FitOf(SessionOf(kDark, lamp, AcrossCone(inner, 35.0, {})));
    EXPECT_TRUE(Holds(axial["flux_lm"], truth)) << inner << axial["flux_lm"];
    EXPECT_NEAR(double(axial["intensity_cd"]["value"]), 1000.0, 10.0);
    const json across =
        FitOf(SessionOf(kDark, lamp, AcrossCone(inner, 35.0, {10.0, 20.0, 25.0, 30.0, -25.0})));
    EXPECT_TRUE(Holds(across["flux_lm"], truth)) << inner << across["flux_lm"];
    EXPECT_LT(HalfWidth(across["flux_lm"]), 0.25) << inner;
    const json printed = FitOf(SessionOf(kDark, lamp + "flux_lm = " + std::to_string(truth) + "\n",
                                         AcrossCone(inner, 35.0, {})));
    EXPECT_TRUE(Holds(printed["flux_lm"], truth)) << inner << printed["flux_lm"];
    EXPECT_LT(HalfWidth(printed["flux_lm"]), HalfWidth(axial["flux_lm"])) << inner;
  }
}

TEST(StatedGeometry, AFieldAngleAloneIsSaidToTellNothing) {
  const std::string angle = "kind = \"spot\"\nfield_deg = 70\n";
  const TempDir dir;
  const auto said = [&](const std::string& lamp) {
    dir.Write("session.toml", SessionOf(kDark, lamp, {{AtDistance(2.0), 250.0}}));
    return RunLightcal({"fit", dir.path(), "--force"}).err;
  };
  EXPECT_THAT(said(angle), testing::HasSubstr("field_deg"));
  EXPECT_THAT(said(angle + "beam_deg = 40\n"), testing::Not(testing::HasSubstr("field_deg")));
}

// As bright at the widest angle that was read as in the middle: where the beam ends nobody knows.
TEST(StatedGeometry, ABeamWhoseEdgeWasNotReadIsOpen) {
  const std::vector<Read> readings = AcrossCone(33.0, 36.0, {10.0, 20.0, 30.0, -30.0});
  const TempDir folder;
  const CliResult open = RunLightcal(
      {"fit", folder.Write("session.toml", SessionOf(kDark, "kind = \"spot\"\n", readings)),
       "--json"});
  EXPECT_EQ(open.exit_code, 3) << open.out;
  EXPECT_EQ(json::parse(open.out)["error"]["code"], "beam_unknown");
  const json told = FitOf(SessionOf(kDark, "kind = \"spot\"\nbeam_deg = 69.5\n", readings));
  EXPECT_TRUE(Holds(told["flux_lm"], FluxOfCone(1000.0, 33.0, 36.0))) << told["flux_lm"];
}

// What the box prints of a beam whose shape was read is held against the flux of that shape.
TEST(StatedGeometry, APrintedFluxIsHeldAgainstTheBeamThatWasRead) {
  const std::vector<Read> readings = AcrossCone(20.0, 35.0, {10.0, 20.0, 25.0, 30.0, -25.0, 35.0});
  const TempDir folder;
  const auto said = [&](double lumens) {
    const std::string lamp = "kind = \"spot\"\nflux_lm = " + std::to_string(lumens) + "\n";
    return RunLightcal(
        {"fit", folder.Write("session.toml", SessionOf(kDark, lamp, readings)), "--force"});
  };
  const double truth = FluxOfCone(1000.0, 20.0, 35.0);
  EXPECT_EQ(said(truth).err.find("data sheet"), std::string::npos) << said(truth).err;
  EXPECT_NE(said(3.0 * truth).err.find("data sheet"), std::string::npos);
}

// On the edge of a cone the angle decides what was read: that is said, not blamed on other light.
TEST(StatedGeometry, AReadingOnAConesEdgeAloneTellsNothing) {
  const CliResult edge = RunLightcal({"quick", "300lx@1m,15deg", "--kind", "spot", "--inner", "10",
                                      "--outer", "20", "--room", "dark"});
  EXPECT_EQ(edge.exit_code, 3) << edge.out;
  EXPECT_NE(edge.err.find("on the axis too"), std::string::npos) << edge.err;
}

// A file's C0 lies along the axis that the session states, in the fit and in what is simulated.
TEST(StatedGeometry, APhotometricLampIsTurnedAboutItsAim) {
  const TempDir folder;
  // 300 cd to +-C0, 100 cd to +-C90, at 45 degrees from the aim; 200 cd along it.
  folder.Write("lamp.ies",
               "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 5 1 2 0 0 0\n1 1 10\n0 45 90\n"
               "0 90 180 270 360\n200 300 0\n200 100 0\n200 300 0\n200 100 0\n200 300 0\n");
  const std::string lamp =
      "kind = \"photometric\"\ndistribution = \"lamp.ies\"\nposition_m = [0, 0, 2]\n"
      "aim = [0, 0, -1]\naxis = [0, 1, 0]\n";
  const double slant = 1.0 / (8.0 * std::sqrt(2.0));  // E/I 2 m aside of a lamp 2 m up
  const std::string session =
      folder.Write("session.toml", SessionOf(kDark, lamp,
                                             {{At(0, 2, 0, "[0, 0, 1]"), 300.0 * slant},
                                              {At(2, 0, 0, "[0, 0, 1]"), 100.0 * slant},
                                              {At(0, 0, 0, "[0, 0, 1]"), 200.0 / 4.0}}));
  const json light = LightcalJson("fit", {session})["lights"][0];
  EXPECT_NEAR(double(light["of_file"]["value"]), 1.0, 0.01) << light["of_file"];
  const json shown =
      LightcalJson("simulate", {session, "--at", "0,2,0", "--at", "2,0,0", "--normal", "0,0,1"});
  EXPECT_NEAR(double(shown["points"][0]["illuminance_lx"]["value"]), 300.0 * slant, 0.5);
  EXPECT_NEAR(double(shown["points"][1]["illuminance_lx"]["value"]), 100.0 * slant, 0.5);
  const std::string out = folder.path() + "/out";
  ASSERT_EQ(RunLightcal({"run", session, "-o", out, "--to", "ies", "--quiet"}).exit_code, 0);
  const auto files = FilesIn(out, ".ies");
  ASSERT_EQ(files.size(), 1U);
  const json checked = LightcalJson("check", {files[0], "--session", session});
  EXPECT_LT(double(checked["rms_relative"]), 0.01) << checked;
}

// A softbox's distance may be counted from its mount or from its front.
TEST(StatedGeometry, ASoftboxIsReadFromItsFrontOrItsMount) {
  const double face = 2000.0 * 0.9 * 0.6;  // cd of 2000 cd/m^2
  const auto lux = [&](double d) {         // exact, of the face seen square from d
    const double a = 0.45, b = 0.3;
    const double x = a / std::hypot(a, d), y = b / std::hypot(b, d);
    return 2000.0 * 2.0 *
           (x * std::atan(b / std::hypot(a, d)) + y * std::atan(a / std::hypot(b, d)));
  };
  for (const double mount : {0.0, 0.3}) {
    std::ostringstream typed;
    typed << lux(1.0) << "lx@" << 1.0 + mount << "m";
    const json found = LightcalJson("quick", {typed.str(), "--fixture", "softbox", "--size",
                                              "90x60cm", "--room", "dark"})["lights"][0];
    EXPECT_TRUE(Holds(found["intensity_cd"], face)) << mount << found["intensity_cd"];
  }
}

// A meter turned 30 degrees from a tube sees a corner of it sink below its own plane: that costs
// what it cuts off, not all of the light.
TEST(StatedGeometry, ATiltedMeterNearATubeStillCounts) {
  const char* const tube = "kind = \"tube\"\nlength_m = 1.2\nradius_m = 0.013\n";
  // By pieces of a thin tube of 100 cd across, turned in the tube's own plane.
  const auto lux = [](double d) {
    constexpr int kPieces = 20000;
    const double tilt = 30.0 * kDegree;
    double sum = 0.0;
    for (int i = 0; i < kPieces; ++i) {
      const double x = ((i + 0.5) / kPieces - 0.5) * 1.2;
      const double r = std::hypot(x, d);
      const double onto = (d * std::cos(tilt) + x * std::sin(tilt)) / r;
      sum += 100.0 / kPieces * (d / r) / (r * r) * std::max(0.0, onto);
    }
    return sum;
  };
  std::vector<Read> readings;
  for (const double d : {0.3, 1.0, 2.0}) {
    readings.push_back({AtDistance(d, "tilt_deg = 30\n"), lux(d)});
  }
  const json found = FitOf(SessionOf(kDark, tube, readings))["intensity_cd"];
  EXPECT_TRUE(Holds(found, 100.0)) << found;
  EXPECT_LT(HalfWidth(found), 0.2) << found;
}

}  // namespace
}  // namespace lightcal::test
