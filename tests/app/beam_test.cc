// SPDX-License-Identifier: Apache-2.0
// A beam from a lux meter: readings off the axis, driven as a shell would. The lamps are closed
// forms written here.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <regex>
#include <sstream>

#include "run_cli.h"
#include "run_cli_json.h"

namespace lightcal::test {
namespace {

using nlohmann::json;

constexpr double kDegree = std::numbers::pi / 180.0;
using Shape = std::function<double(double degrees)>;  // over its axial value

double Gauss(double degrees, double half) { return std::exp2(-std::pow(degrees / half, 2.0)); }

const char* const kDark = "lightcal = 1\nname = \"t\"\n[room]\ndark = true\n";

// A lamp of 1000 cd at a metre's marks, read on and off its axis; multiplied by `factor`.
std::string SessionOf(const Shape& shape, const std::vector<double>& angles,
                      const std::string& light = "kind = \"spot\"\nfixture = \"luminaire\"\n",
                      double factor = 1.0) {
  std::ostringstream text;
  text << kDark << "[[light]]\nname = \"key\"\n" << light;
  for (const double angle : angles) {
    text << "[[reading]]\nlight = \"key\"\ndistance_m = 2\noff_axis_deg = " << angle
         << "\nsigma_relative = 0.03\nilluminance_lx = " << factor * 250.0 * shape(angle) << "\n";
  }
  return text.str();
}

json FitOf(const std::string& session) {
  const TempDir folder;
  return LightcalJson("fit", {folder.Write("session.toml", session)})["lights"][0];
}

CliResult RefusedFit(const std::string& session) {
  const TempDir folder;
  return RunLightcal({"fit", folder.Write("session.toml", session), "--json"});
}

double Low(const json& value) { return value.value("low95", double(value["value"])); }
double High(const json& value) { return value.value("high95", double(value["value"])); }
bool Holds(const json& value, double truth) { return Low(value) <= truth && truth <= High(value); }

double TableAt(const json& light, double degrees) {
  const auto gamma = light["distribution"]["vertical_deg"].get<std::vector<double>>();
  const auto candela = light["distribution"]["candela"].get<std::vector<double>>();
  for (std::size_t i = 1; i < gamma.size(); ++i) {
    if (degrees > gamma[i]) continue;
    const double t = (degrees - gamma[i - 1]) / (gamma[i] - gamma[i - 1]);
    return candela[i - 1] + t * (candela[i] - candela[i - 1]);
  }
  return 0.0;
}

// What is to be typed next holds the angle that was planned: at the same distance on the axis it
// would be another reading.
TEST(Beam, TheNextReadingToTypeHasItsAngle) {
  const CliResult quick = RunLightcal({"quick", "900lx@1m", "450lx@1m,15deg", "--room", "dark",
                                       "--fixture", "luminaire", "--meter", "3%"});
  ASSERT_EQ(quick.exit_code, 0) << quick.err;
  std::smatch typed;
  ASSERT_TRUE(std::regex_search(quick.out, typed,
                                std::regex("read ([0-9.]+) degrees off the axis[^:]*: add\\s+"
                                           "LUX@[0-9.]+m,([0-9.]+)deg")))
      << quick.out;
  EXPECT_EQ(typed[1], typed[2]);
  const TempDir folder;
  const std::string session =
      folder.Write("session.toml", SessionOf([](double a) { return Gauss(a, 15.0); }, {0, 15}));
  const CliResult run = RunLightcal({"run", session, "-o", folder.path() + "/out"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(
      std::regex_search(run.out, std::regex("--distance [0-9.]+m\\s+--off-axis [0-9.]+deg")))
      << run.out;
}

TEST(Beam, TwoTypedReadingsAnswerABeamAndNameTheNextAngle) {
  const json document = LightcalJson("quick", {"900lx@1m", "450lx@1m,15deg", "--room", "dark",
                                               "--fixture", "luminaire", "--meter", "3%"});
  const json& light = document["lights"][0];
  EXPECT_EQ(light["kind"], "photometric");
  EXPECT_TRUE(Holds(light["beam"]["axial_cd"], 900.0)) << light["beam"];
  EXPECT_TRUE(Holds(light["beam"]["beam_deg"], 30.0)) << light["beam"];
  EXPECT_LT(double(light["beam"]["beam_deg"]["u95"]), 8.0);
  EXPECT_NEAR(TableAt(light, 15.0), 450.0, 45.0);
  const std::string next = document["next_step"];
  EXPECT_NE(next.find("degrees off the axis"), std::string::npos) << next;
  EXPECT_NE(next.find("beam angle ±"), std::string::npos) << next;
}

// What is left of this strength is where the light starts, which no angle tells.
TEST(Beam, WhoseStartIsOpenIsToldByAnotherDistance) {
  const json document = LightcalJson("quick", {"9000lx@2m", "4500lx@2m,10deg", "600lx@2m,20deg",
                                               "--room", "dark", "--fixture", "fresnel"});
  EXPECT_EQ(document["lights"][0]["budget"][0]["name"], "distance_offset");
  const std::string next = document["next_step"];
  EXPECT_EQ(next.find("off the axis"), std::string::npos) << next;
  EXPECT_NE(next.find("m, facing the lamp: ±"), std::string::npos) << next;
}

TEST(Beam, TooFewAnglesAreRefusedWithTheAngleThatIsMissing) {
  const CliResult narrow = RunLightcal(
      {"quick", "900lx@1m", "880lx@1m,4deg", "--room", "dark", "--fixture", "luminaire", "--json"});
  EXPECT_EQ(narrow.exit_code, 3) << narrow.out;
  const json refusal = json::parse(narrow.out)["error"];
  EXPECT_EQ(refusal["code"], "beam_unknown");
  EXPECT_NE(std::string(refusal["message"]).find("degrees off the axis"), std::string::npos)
      << refusal;
  const CliResult aside =
      RefusedFit(SessionOf([](double a) { return Gauss(a, 12.0); }, {15.0, 20.0, 25.0, 35.0}));
  EXPECT_EQ(aside.exit_code, 3) << aside.out;
  EXPECT_NE(aside.out.find("read at 0 degrees"), std::string::npos) << aside.out;
}

// Its peak lies between readings, and beside the axis: at 54.5 degrees, 4.34 times as bright.
TEST(Beam, ABatwingsAngleIsOfItsAxisAndItsPeakIsSeenBetweenReadings) {
  const Shape batwing = [](double degrees) {
    const double cosine = std::cos(std::min(degrees, 55.0) * kDegree);
    return (1.0 + std::exp(-20.0)) / (1.0 + std::exp((degrees - 60.0) / 3.0)) / std::pow(cosine, 3);
  };
  const TempDir folder;
  const std::string session =
      folder.Write("session.toml",
                   SessionOf(batwing, {0, 13.4, 26.9, 40.3, 50.4, 59.1, 67.2, 71.6, 77.9},
                             "kind = \"spot\"\nfixture = \"luminaire\"\noff_axis_sigma_deg = 0\n"));
  const json light = LightcalJson("fit", {session})["lights"][0];
  EXPECT_TRUE(Holds(light["beam"]["axial_cd"], 1000.0)) << light["beam"];
  double half = 60.0;
  while (batwing(half) > 0.5) half += 0.001;
  EXPECT_TRUE(Holds(light["beam"]["beam_deg"], 2.0 * half)) << light["beam"] << half;
  EXPECT_LT(double(light["beam"]["beam_deg"]["u95"]), 4.0);
  // Without a curve that may turn sharply there: 3770.
  EXPECT_GT(TableAt(light, 54.0), 3900.0);
  const CliResult text = RunLightcal({"fit", session, "--force"});
  EXPECT_NE(text.out.find("brightest at 5"), std::string::npos) << text.out;
}

TEST(Beam, AGaussianIsFoundWithItsFluxAndItsAngles) {
  const double half = 14.0;
  const json light =
      FitOf(SessionOf([&](double a) { return Gauss(a, half); }, {0, 5, 9, 13, 17, 21, 26, 40, 60}));
  EXPECT_NEAR(light["beam"]["axial_cd"]["value"], 1000.0, 25.0);
  EXPECT_NEAR(light["beam"]["beam_deg"]["value"], 2.0 * half, 0.8);
  EXPECT_NEAR(light["beam"]["field_deg"]["value"], 2.0 * half * std::sqrt(std::log2(10.0)), 2.0);
  // 2 pi int exp(-ln 2 (g/h)^2) sin g dg, by the midpoint rule.
  double flux = 0.0;
  for (double g = 0.05; g < 90.0; g += 0.1) {
    flux +=
        2.0 * std::numbers::pi * 1000.0 * Gauss(g, half) * std::sin(g * kDegree) * 0.1 * kDegree;
  }
  EXPECT_NEAR(double(light["flux_lm"]["value"]) / flux, 1.0, 0.04);
  EXPECT_TRUE(Holds(light["flux_lm"], flux));
  double shares = 0.0;
  for (const json& family : light["beam"]["families"]) shares += double(family["share"]);
  EXPECT_NEAR(shares, 1.0, 0.02);
}

// Three readings leave draws of the curve skew: their median flux was 1.6 % below the mean curve's.
TEST(Beam, ItsFluxIsThatOfTheCurveThatIsWritten) {
  const TempDir folder;
  const std::string session = folder.Write(
      "lamp/session.toml", SessionOf([](double a) { return Gauss(a, 14.0); }, {0, 8, 16}));
  ASSERT_EQ(RunLightcal({"run", session, "--to", "ies,ldt", "-o", folder.path() + "/o"}).exit_code,
            0);
  const json light = json::parse(std::ifstream(folder.path() + "/o/light.json"))["lights"][0];
  for (const char* ending : {"ies", "ldt"}) {
    const json file = LightcalJson("photometric", {folder.path() + "/o/lamp-key." + ending});
    EXPECT_NEAR(double(file["flux_lm"]) / double(light["flux_lm"]["value"]), 1.0, 1e-3) << ending;
  }
}

TEST(Beam, ABatwingIsNotFlattenedAndAFallingLampIsHeldToFall) {
  const auto batwing = [](double a) {
    return std::pow(std::cos(std::min(a, 50.0) * kDegree), -2.0) /
           (1.0 + std::exp((a - 60.0) / 3.0));
  };
  const json wings = FitOf(SessionOf(batwing, {0, 15, 30, 40, 48, 54, 60, 68, 80}));
  EXPECT_TRUE(Holds(wings["beam"]["axial_cd"], 1000.0)) << wings["beam"];
  EXPECT_GT(TableAt(wings, 50.0), 1.7 * TableAt(wings, 0.0));
  EXPECT_LT(wings["beam"].value("falling_share", 0.0), 0.05);
}

TEST(Beam, ALambertianLampIsCosineAndExportsAsThatTable) {
  const TempDir folder;
  const std::string session = folder.Write(
      "lamp/session.toml",
      SessionOf([](double a) { return std::cos(a * kDegree); }, {0, 15, 30, 45, 55, 65, 75, 82}));
  ASSERT_EQ(
      RunLightcal({"run", session, "--to", "ies,ldt,gltf,blender", "-o", folder.path() + "/o"})
          .exit_code,
      0);
  for (const char* ending : {"ies", "ldt"}) {
    const json file = LightcalJson("photometric", {folder.path() + "/o/lamp-key." + ending});
    EXPECT_NEAR(double(file["flux_lm"]) / (1000.0 * std::numbers::pi), 1.0, 0.03) << ending;
    EXPECT_NEAR(file["beam_deg"], 120.0, 4.0) << ending;
  }
  // What was written is read again, with its beam.
  const json again = LightcalJson(
      "simulate", {folder.path() + "/o/light.json", "--at", "0,0,-2", "--position", "key=0,0,0"});
  EXPECT_TRUE(again.is_object());
}

// Floor under a lamp at 2.4 m whose beam leans two degrees from the aim that the session states.
std::string FloorUnder(const std::string& kind, const std::string& aim, double half, int count) {
  std::ostringstream text;
  text << kDark << "[[light]]\nname = \"key\"\nfixture = \"luminaire\"\nposition_m = [0, 0, 2.4]\n"
       << "kind = \"" << kind << "\"\n"
       << aim;
  const double lean = 2.0 * kDegree;
  for (int i = 0; i < count; ++i) {
    const double r = 0.04 * i;
    const double turn = 2.4 * i;
    const double x = r * std::cos(turn), y = r * std::sin(turn);
    const double distance = std::sqrt(x * x + y * y + 2.4 * 2.4);
    const double along = (x * std::sin(lean) + 2.4 * std::cos(lean)) / distance;
    const double angle = std::acos(std::min(1.0, along)) / kDegree;
    // A meter on the floor, face up; 1 % to and fro.
    const double lux = 3000.0 * Gauss(angle, half) * (2.4 / distance) / (distance * distance) *
                       (1.0 + 0.01 * std::sin(12.9898 * i));
    text << "[[reading]]\nlight = \"key\"\nposition_m = [" << x << ", " << y
         << ", 0]\nnormal = [0, 0, 1]\nsigma_relative = 0.02\nilluminance_lx = " << lux << "\n";
  }
  return text.str();
}

TEST(Beam, TwentySevenHonestReadingsAcrossABeamAreNoLongerAPoint) {
  for (const char* kind : {"spot", "point"}) {
    for (const char* aim : {"aim = [0, 0, -1]\n", ""}) {
      const json light = FitOf(FloorUnder(kind, aim, 11.0, 27));
      ASSERT_TRUE(light.contains("beam")) << kind << aim;
      EXPECT_TRUE(Holds(light["beam"]["axial_cd"], 3000.0)) << light["beam"];
      EXPECT_NEAR(light["beam"]["beam_deg"]["value"], 22.0, 1.5) << kind << aim;
      EXPECT_NEAR(light["aim"][0], std::sin(2.0 * kDegree), 0.012) << kind << aim;
    }
  }
}

TEST(Beam, ABulbWithAnAimStaysABulb) {
  std::ostringstream text;
  text << kDark << "[[light]]\nname = \"key\"\nkind = \"point\"\nfixture = \"bulb\"\n"
       << "position_m = [0, 0, 2]\naim = [0, 0, -1]\n";
  for (int i = 0; i < 8; ++i) {
    const double x = 0.4 * i, r2 = x * x + 4.0;
    text << "[[reading]]\nlight = \"key\"\nposition_m = [" << x
         << ", 0, 0]\nnormal = [0, 0, 1]\nsigma_relative = 0.02\nilluminance_lx = "
         << 400.0 * 2.0 / std::pow(r2, 1.5) * (1.0 + 0.01 * std::sin(7.7 * i)) << "\n";
  }
  const json light = FitOf(text.str());
  EXPECT_EQ(light["kind"], "point");
  EXPECT_FALSE(light.contains("beam"));
  EXPECT_TRUE(Holds(light["intensity_cd"], 400.0)) << light["intensity_cd"];
}

TEST(Beam, TheDataSheetsAnglesArePriors) {
  const auto gauss = [](double a) { return Gauss(a, 15.0); };
  const std::vector<double> angles = {0.0, 10.0};
  const json without = FitOf(SessionOf(gauss, angles));
  const json with = FitOf(SessionOf(
      gauss, angles, "kind = \"spot\"\nfixture = \"luminaire\"\nbeam_deg = 30\nfield_deg = 55\n"));
  EXPECT_TRUE(Holds(with["beam"]["beam_deg"], 30.0));
  EXPECT_LT(double(with["beam"]["beam_deg"]["u95"]), double(without["beam"]["beam_deg"]["u95"]));
  EXPECT_LT(double(with["flux_lm"]["u95"]) / double(with["flux_lm"]["value"]),
            double(without["flux_lm"]["u95"]) / double(without["flux_lm"]["value"]));
}

TEST(Beam, PlanNamesTheAngleThatHelpsMost) {
  const TempDir folder;
  const std::string session =
      folder.Write("session.toml", SessionOf([](double a) { return Gauss(a, 15.0); }, {0.0, 12.0}));
  const json plan = LightcalJson("plan", {session, "--steps", "1"})["lights"][0];
  const json& step = plan["steps"][0];
  ASSERT_TRUE(step.contains("off_axis_deg")) << plan;
  EXPECT_LT(double(step["beam_u95_deg"]), 0.8 * double(plan["beam_u95_deg"])) << plan;
  const CliResult people = RunLightcal({"plan", session, "--steps", "1"});
  EXPECT_NE(people.out.find("degrees off the axis, at 2.00 m"), std::string::npos) << people.out;
  EXPECT_NE(people.out.find("beam angle ±"), std::string::npos) << people.out;
}

TEST(Beam, AnglesComeByTypingByFileAndByJournal) {
  const TempDir folder;
  const std::string session = folder.Write(
      "s/session.toml", std::string(kDark) + "[[light]]\nname = \"key\"\nkind = \"spot\"\n");
  const std::string directory = folder.path() + "/s";
  const CliResult read = RunLightcal({"read", "-s", directory, "--light", "key", "--distance", "1m",
                                      "--off-axis", "15", "--lux", "450"});
  ASSERT_EQ(read.exit_code, 0) << read.err;
  const std::string csv = folder.Write(
      "r.csv", "distance_m,off_axis_deg,illuminance_lx\n1,0,900\n1,-15,450\n1,25,110\n");
  const CliResult imported = RunLightcal({"import", csv, "-s", directory, "--light", "key"});
  ASSERT_EQ(imported.exit_code, 0) << imported.err;
  const std::string journal = ReadFile(directory + "/readings.jsonl");
  EXPECT_NE(journal.find("\"off_axis_deg\":15"), std::string::npos) << journal;
  EXPECT_NE(journal.find("\"off_axis_deg\":-15"), std::string::npos) << journal;
  const json light = LightcalJson("fit", {directory})["lights"][0];
  EXPECT_TRUE(Holds(light["beam"]["beam_deg"], 30.0)) << light["beam"];
}

TEST(Beam, WallsDoNotCountAsSpillWhereACardTellsThem) {
  // Gaussian of 10 degrees; 12 lx of walls everywhere at 2 m, seen behind a card at 40 degrees.
  std::ostringstream text;
  text << "lightcal = 1\nname = \"t\"\n[[light]]\nname = \"key\"\nkind = \"spot\"\n"
       << "fixture = \"luminaire\"\n";
  const auto add = [&](double angle, double lux, bool card) {
    text << "[[reading]]\nlight = \"key\"\ndistance_m = 2\noff_axis_deg = " << angle
         << "\nsigma_relative = 0.03\nilluminance_lx = " << lux << "\n"
         << (card ? "shadow_card = true\n" : "");
  };
  for (const double angle : {0.0, 4.0, 8.0, 12.0, 16.0, 20.0, 40.0, 60.0}) {
    add(angle, 250.0 * Gauss(angle, 10.0) + 3.0, false);
  }
  const json open = FitOf(text.str());
  add(40.0, 3.0, true);
  const json carded = FitOf(text.str());
  double flux = 0.0;
  for (double g = 0.05; g < 90.0; g += 0.1) {
    flux +=
        2.0 * std::numbers::pi * 1000.0 * Gauss(g, 10.0) * std::sin(g * kDegree) * 0.1 * kDegree;
  }
  EXPECT_TRUE(Holds(open["flux_lm"], flux)) << open["flux_lm"] << flux;
  EXPECT_TRUE(Holds(carded["flux_lm"], flux)) << carded["flux_lm"] << flux;
  EXPECT_NEAR(carded["beam"]["beam_deg"]["value"], 20.0, 0.8);
}

}  // namespace
}  // namespace lightcal::test
