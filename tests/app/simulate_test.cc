// SPDX-License-Identifier: Apache-2.0
// lightcal simulate through the program, against sums over the source written here: the kernel
// (n.v)(m.v)/|v|^4 and nothing of lightcal's light room.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "run_cli.h"
#include "run_cli_json.h"
#include "trials.h"

namespace lightcal::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double kPi = std::numbers::pi;
using V = std::array<double, 3>;
V operator+(const V& a, const V& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
V operator-(const V& a, const V& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
V operator*(double s, const V& a) { return {s * a[0], s * a[1], s * a[2]}; }
double Dot3(const V& a, const V& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
V Cross3(const V& a, const V& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
V Unit(const V& a) { return 1.0 / std::sqrt(Dot3(a, a)) * a; }

// A piece of a Lambertian surface of luminance 1 seen from a receiver.
double Piece(const V& from, const V& facing, double area, const V& at, const V& normal) {
  const V v = from - at;
  const double up = Dot3(normal, v);
  const double back = -Dot3(facing, v);
  if (up <= 0.0 || back <= 0.0) return 0.0;
  const double r2 = Dot3(v, v);
  return up * back * area / (r2 * r2);
}

// What a lamp of 1 cd on its axis gives.
using Truth = std::function<double(const V& at, const V& normal)>;

Truth RectTruth(const V& center, const V& aim, const V& width_axis, double w, double h) {
  const V x = Unit(width_axis - Dot3(width_axis, aim) * aim);
  const V y = Cross3(aim, x);
  return [=](const V& at, const V& n) {
    constexpr int kN = 300;
    double sum = 0.0;
    for (int i = 0; i < kN; ++i) {
      for (int j = 0; j < kN; ++j) {
        const V p = center + ((i + 0.5) / kN - 0.5) * w * x + ((j + 0.5) / kN - 0.5) * h * y;
        sum += Piece(p, aim, w * h / (kN * kN), at, n);
      }
    }
    return sum / (w * h);
  };
}
Truth DiskTruth(const V& center, const V& aim, double radius) {
  const V x = Unit(Cross3(aim, {0.3, 0.5, 0.81}));
  const V y = Cross3(aim, x);
  return [=](const V& at, const V& n) {
    constexpr int kR = 200, kT = 400;
    double sum = 0.0;
    for (int i = 0; i < kR; ++i) {
      const double r = radius * (i + 0.5) / kR;
      for (int j = 0; j < kT; ++j) {
        const double t = 2.0 * kPi * (j + 0.5) / kT;
        const V p = center + r * std::cos(t) * x + r * std::sin(t) * y;
        sum += Piece(p, aim, r * radius / kR * 2.0 * kPi / kT, at, n);
      }
    }
    return sum / (kPi * radius * radius);
  };
}
Truth SphereTruth(const V& center, double radius) {
  return [=](const V& at, const V& n) {
    constexpr int kZ = 400, kT = 400;
    double sum = 0.0;
    for (int i = 0; i < kZ; ++i) {
      const double z = -1.0 + 2.0 * (i + 0.5) / kZ;
      const double s = std::sqrt(1.0 - z * z);
      for (int j = 0; j < kT; ++j) {
        const double t = 2.0 * kPi * (j + 0.5) / kT;
        const V d = {s * std::cos(t), s * std::sin(t), z};
        sum += Piece(center + radius * d, d, 4.0 * kPi * radius * radius / (kZ * kT), at, n);
      }
    }
    return sum / (kPi * radius * radius);
  };
}
Truth TubeTruth(const V& center, const V& axis, double length, double radius) {
  const V y = Unit(Cross3(axis, {0.3, 0.5, 0.81}));
  const V z = Cross3(axis, y);
  return [=](const V& at, const V& n) {
    constexpr int kL = 600, kT = 300;
    double sum = 0.0;
    for (int i = 0; i < kL; ++i) {
      for (int j = 0; j < kT; ++j) {
        const double t = 2.0 * kPi * (j + 0.5) / kT;
        const V d = std::cos(t) * y + std::sin(t) * z;
        const V p = center + ((i + 0.5) / kL - 0.5) * length * axis + radius * d;
        sum += Piece(p, d, length / kL * 2.0 * kPi * radius / kT, at, n);
      }
    }
    return sum / (2.0 * radius * length);
  };
}
Truth ShapedPoint(const V& center, const V& aim, const std::function<double(double)>& shape) {
  return [=](const V& at, const V& n) {
    const V v = center - at;
    const double d = std::sqrt(Dot3(v, v));
    const double angle = std::acos(std::clamp(-Dot3(v, aim) / d, -1.0, 1.0));
    return shape(angle) * std::max(0.0, Dot3(v, n)) / (d * d * d);
  };
}

json Light(const std::string& name, const std::string& kind, double cd, const V& position) {
  return {{"name", name},
          {"kind", kind},
          {"intensity_cd", {{"value", cd}, {"u95", 0.02 * cd}}},
          {"position_m", position}};
}
std::string LightFile(const std::vector<json>& lights) {
  return json({{"schema", "lightcal.light/1"}, {"lights", lights}}).dump(1);
}

std::string Text(const V& v) {
  std::ostringstream out;
  out.precision(12);
  out << v[0] << ',' << v[1] << ',' << v[2];
  return out.str();
}

struct Kind {
  json light;
  std::string axis;  // "" = none
  Truth truth;
};

// One lamp of each kind that shines from a place, 2.2 m up, tilted.
std::vector<Kind> Kinds() {
  const V place = {0.3, -0.2, 2.2};
  const V aim = Unit({0.3, 0.2, -1.0});
  const V axis = Unit(Cross3(aim, {0.1, 1.0, 0.2}));
  std::vector<Kind> kinds;
  kinds.push_back({Light("point", "point", 900.0, place), "",
                   ShapedPoint(place, aim, [](double) { return 1.0; })});
  const double ci = std::cos(15.0 * kPi / 180.0);
  const double co = std::cos(40.0 * kPi / 180.0);
  kinds.push_back({Light("spot", "spot", 900.0, place), "", ShapedPoint(place, aim, [=](double a) {
                     const double t = std::clamp((std::cos(a) - co) / (ci - co), 0.0, 1.0);
                     return t * t;
                   })});
  kinds.back().light["cone"] = {{"inner_deg", 15.0}, {"outer_deg", 40.0}};
  kinds.push_back({Light("sphere", "sphere", 900.0, place), "", SphereTruth(place, 0.2)});
  kinds.back().light["diameter_m"] = 0.4;
  kinds.push_back({Light("disk", "disk", 900.0, place), "", DiskTruth(place, aim, 0.5)});
  kinds.back().light["diameter_m"] = 1.0;
  kinds.push_back(
      {Light("rect", "rect", 900.0, place), Text(axis), RectTruth(place, aim, axis, 1.2, 0.6)});
  kinds.back().light["width_m"] = 1.2;
  kinds.back().light["height_m"] = 0.6;
  kinds.push_back(
      {Light("tube", "tube", 900.0, place), Text(axis), TubeTruth(place, axis, 1.2, 0.05)});
  kinds.back().light["length_m"] = 1.2;
  kinds.back().light["radius_m"] = 0.05;
  for (Kind& kind : kinds) kind.light["aim"] = aim;
  return kinds;
}

struct Row {
  double a, b, lux, u95;
};
std::vector<Row> ReadCsv(const std::string& path) {
  std::istringstream in(ReadFile(path));
  std::string line;
  std::getline(in, line);
  EXPECT_NE(line.find("lightcal"), std::string::npos);
  std::getline(in, line);
  std::vector<Row> rows;
  char comma = 0;
  for (Row row{}; in >> row.a >> comma >> row.b >> comma >> row.lux >> comma >> row.u95;) {
    rows.push_back(row);
  }
  return rows;
}

std::vector<Row> Map(const TempDir& folder, std::vector<std::string> arguments) {
  const std::string csv = folder.path() + "/map.csv";
  arguments.insert(arguments.begin(), "simulate");
  arguments.insert(arguments.end(), {"-o", csv, "--quiet"});
  const CliResult result = RunLightcal(arguments);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return ReadCsv(csv);
}

double Value(const json& point) { return point["illuminance_lx"]["value"]; }

TEST(SimulateCommand, EveryKindGivesWhatASumOverItsSurfaceGives) {
  std::mt19937_64 random(78);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const TempDir folder;
  for (const Kind& kind : Kinds()) {
    const std::string file =
        folder.Write(kind.light["name"].get<std::string>() + ".json", LightFile({kind.light}));
    for (int i = 0; i < 6; ++i) {
      const V at = {1.8 * uniform(random), 1.8 * uniform(random), 0.3 * uniform(random)};
      const V normal = Unit({0.4 * uniform(random), 0.4 * uniform(random), 1.0});
      const double truth = 900.0 * kind.truth(at, normal);
      for (const auto& [tolerance, most] : {std::pair{"0.0001%", 3e-4}, std::pair{"2%", 2e-2}}) {
        std::vector<std::string> arguments = {file, "--at=" + Text(at), "--normal=" + Text(normal),
                                              "--tol", tolerance};
        // By hand, or as a fit leaves it.
        if (!kind.axis.empty()) arguments.insert(arguments.end(), {"--axis=" + kind.axis});
        if (!kind.axis.empty() && i % 2 == 1) {
          json fitted = kind.light;
          fitted["axis"] = json::parse("[" + kind.axis + "]");
          arguments.pop_back();
          arguments[0] = folder.Write("fitted.json", LightFile({fitted}));
        }
        const json answer = LightcalJson("simulate", arguments);
        EXPECT_NEAR(Value(answer["points"][0]), truth, most * truth + 1e-9)
            << kind.light["name"] << " at " << Text(at) << " facing " << Text(normal);
      }
    }
  }
}

TEST(SimulateCommand, SunSkyAndOffsetFollowTheirLaws) {
  const TempDir folder;
  json sun = {{"name", "sun"}, {"kind", "directional"}, {"aim", {0.6, 0.0, -0.8}}};
  sun["illuminance_lx"] = {{"value", 1e5}, {"u95", 3e3}};
  json sky = {{"name", "sky"}, {"kind", "dome"}};
  sky["illuminance_lx"] = {{"value", 1.2e4}, {"u95", 600.0}};
  const std::string file = folder.Write("outdoors.json", LightFile({sun, sky}));
  const json up = LightcalJson("simulate", {file, "--at", "3,4,0"})["points"][0];
  EXPECT_NEAR(Value(up), 0.8e5 + 1.2e4, 1.0);
  EXPECT_NEAR(up["illuminance_lx"]["u95"].get<double>(), 0.8 * 3e3 + 600.0, 1.0);
  const json wall =
      LightcalJson("simulate", {file, "--at", "3,4,0", "--normal=-1,0,0"})["points"][0];
  // A sky that nobody saw, over a ground of .25.
  EXPECT_NEAR(Value(wall), 0.6e5 + 1.2e4 * (0.5 + 0.25 * 0.5), 1.0);
  EXPECT_NEAR(Value(LightcalJson("simulate", {file, "--lights", "sun", "--at", "0,0,0", "--normal",
                                              "lamp"})["points"][0]),
              1e5, 1.0);

  // E = I cos/(d + d0)^2 for a bulb, and its uncertainty from the fit's covariance.
  json bulb = Light("bulb", "point", 500.0, {0.0, 0.0, 2.0});
  bulb["distance_offset_m"] = {{"value", 0.1}, {"u95", 0.02}};
  const double v = 1e-4;
  const double w = 4e-4;
  const double c = -1e-4;
  bulb["covariance_lnI_d0_E0"] = {v, c, 0, c, w, 0, 0, 0, 0};
  const std::string lamp = folder.Write("bulb.json", LightFile({bulb}));
  const json at = LightcalJson("simulate", {lamp, "--at", "1.5,0,0"})["points"][0];
  const double r = 2.5 + 0.1;
  const double lux = 500.0 * 0.8 / (r * r);
  EXPECT_NEAR(Value(at), lux, 1e-9 * lux);
  const double g = -2.0 / r;
  const double of_fit = v + 2.0 * g * c + g * g * w;
  // Clear air and a lamp of 6 cm without stated size, rectangular.
  const double haze = 2e-4 * 2.5;
  const double size = 0.03 * 0.03 / (2.5 * 2.5);
  const double u95 = 1.959964 * lux * std::sqrt(of_fit + (haze * haze + size * size) / 3.0);
  EXPECT_NEAR(at["illuminance_lx"]["u95"].get<double>(), u95, 2e-3 * u95);
}

// Distances from the glass of a globe of .2 m: the offset says so, and its centre shines.
TEST(SimulateCommand, AGlobeShinesFromItsCentreWhereverDistancesCountedFrom) {
  const TempDir folder;
  json globe = Light("globe", "sphere", 500.0, {0.0, 0.0, 2.0});
  globe["diameter_m"] = 0.2;
  globe["distance_offset_m"] = {{"value", 0.1}, {"u95", 0.02}};
  globe["effects"] = {
      {{"name", "sphere_surface"}, {"state", "fitted"}, {"bound", 0.2}, {"cost_ns", 0.5}}};
  const std::string file = folder.Write("globe.json", LightFile({globe}));
  const json at =
      LightcalJson("simulate", {file, "--at", "0,0,1", "--normal", "lamp"})["points"][0];
  EXPECT_NEAR(Value(at), 500.0, 1e-6);
}

// A lobe of cos^3 whose meter 3 m below reads 100 lx; its file prints `printed` times 800 cd.
double LobeCd(double gamma_deg) {
  return gamma_deg < 90 ? 800.0 * std::pow(std::cos(gamma_deg * kPi / 180), 3) : 0.0;
}
void WriteLobeSession(const TempDir& session, double printed) {
  std::ostringstream ies;
  ies << "IESNA:LM-63-2002\r\nTILT=NONE\r\n1 -1 1 19 1 1 2 0 0 0\r\n1 1 60\r\n";
  for (int i = 0; i < 19; ++i) ies << 5 * i << (i < 18 ? " " : "\r\n0\r\n");
  for (int i = 0; i < 19; ++i) ies << printed * LobeCd(5.0 * i) << (i < 18 ? " " : "\r\n");
  session.Write("lamp.ies", ies.str());
  session.Write("session.toml",
                "lightcal = 1\n[room]\ndark = true\n"
                "[[light]]\nname = \"key\"\nkind = \"photometric\"\n"
                "distribution = \"lamp.ies\"\nposition_m = [0, 0, 3]\naim = [0, 0, -1]\n"
                "[[reading]]\nlight = \"key\"\nposition_m = [0, 0, 0]\nnormal = [0, 0, 1]\n"
                "illuminance_lx = 100.0\n");
}
double LuxOfLobe(const TempDir& session, double gamma_deg) {
  const V at = {3.0 * std::tan(gamma_deg * kPi / 180), 0.0, 0.0};
  return Value(LightcalJson("simulate", {session.path(), "--at=" + Text(at)})["points"][0]);
}

// The file's 1600 cd are no prior of a lamp that reads 900: what it shines is the reading's.
TEST(SimulateCommand, AMeasuredTableShinesAsItsFileSays) {
  const TempDir session;
  WriteLobeSession(session, 2.0);
  for (const double gamma : {0.0, 20.0, 45.0, 70.0}) {
    const double truth = 100.0 * LobeCd(gamma) / 800.0 * std::pow(std::cos(gamma * kPi / 180), 3);
    EXPECT_NEAR(LuxOfLobe(session, gamma), truth, 2e-3 * truth) << gamma;
  }
}

// Between the file's 800 cd and the reading's 900; its light then starts some mm off.
TEST(SimulateCommand, ATableThatNearlyAgreesIsHeardBesideTheReading) {
  const TempDir session;
  WriteLobeSession(session, 1.0);
  const double axis = LuxOfLobe(session, 0.0);
  const double d0 =
      LightcalJson("fit", {session.path()})["lights"][0]["distance_offset_m"]["value"];
  EXPECT_GT(axis, 800.0 / 9.0);
  EXPECT_LT(axis, 100.0);
  for (const double gamma : {20.0, 45.0, 70.0}) {
    const double cosine = std::cos(gamma * kPi / 180);
    const double farther = (3.0 / cosine + d0) / (3.0 + d0);
    const double truth = axis * LobeCd(gamma) / 800.0 * cosine / (farther * farther);
    EXPECT_NEAR(LuxOfLobe(session, gamma), truth, 2e-3 * truth) << gamma;
  }
}

// First bounce by 40 x 40 pieces a wall, the lamp a point, as any textbook has it.
double WallsByPieces(const V& lamp, double cd, const V& room, double rho, const V& at,
                     const V& normal) {
  constexpr int kN = 60;
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {0.0, 1.0}) {
      const int u = (axis + 1) % 3;
      const int v = (axis + 2) % 3;
      V facing{};
      facing[axis] = side > 0.5 ? -1.0 : 1.0;
      for (int i = 0; i < kN; ++i) {
        for (int j = 0; j < kN; ++j) {
          V p{};
          p[axis] = (axis == 2 ? side : side - 0.5) * room[axis];
          p[u] = ((i + 0.5) / kN - (u == 2 ? 0.0 : 0.5)) * room[u];
          p[v] = ((j + 0.5) / kN - (v == 2 ? 0.0 : 0.5)) * room[v];
          const V to = lamp - p;
          const double d = std::sqrt(Dot3(to, to));
          const double lux = cd * Dot3(to, facing) / (d * d * d);
          sum += rho / kPi * lux * Piece(p, facing, room[u] * room[v] / (kN * kN), at, normal);
        }
      }
    }
  }
  const double area = 2.0 * (room[0] * room[1] + room[1] * room[2] + room[2] * room[0]);
  return sum + rho * rho * 4.0 * kPi * cd / (area * (1.0 - rho));
}

// Dark walls: what comes back more than once is too little for its place to matter. Of bright ones
// tests/app/rooms_corners.py.
TEST(SimulateCommand, WallsGiveWhatASumOverThemGives) {
  const TempDir folder;
  const V lamp = {0.8, -0.5, 1.9};
  const std::string file = folder.Write("l.json", LightFile({Light("b", "point", 700.0, lamp)}));
  const V room = {5.0, 4.0, 2.6};
  std::mt19937_64 random(79);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int i = 0; i < 8; ++i) {
    const V at = {2.2 * uniform(random), 1.7 * uniform(random), 0.4 + 0.3 * uniform(random)};
    const V normal = Unit({0.5 * uniform(random), 0.5 * uniform(random), 1.0});
    const json point = LightcalJson(
        "simulate", {file, "--room", "5,4,2.6", "--reflectance", "0.03", "--at=" + Text(at),
                     "--normal=" + Text(normal), "--effects=all"})["points"][0];
    const double truth = WallsByPieces(lamp, 700.0, room, 0.03, at, normal);
    EXPECT_NEAR(point["lights"][0]["bounce_lx"].get<double>(), truth, 0.03 * truth) << Text(at);
  }
}

// In the beam's middle a meter sees what the fit says of it, beside it the lamp's light there and
// the walls: 8 degrees off a cone of 12 it was told the middle's 250 lx for 84.
TEST(SimulateCommand, BesideASpotsAxisAMeterInTheRoomSeesLess) {
  const TempDir folder;
  const std::string file = folder.Write(
      "session.toml",
      "lightcal = 1\n[[light]]\nname = \"key\"\nkind = \"spot\"\ninner_deg = 2\nouter_deg = 12\n"
      "position_m = [0, 0, 3]\naim = [0, 0, -1]\n"
      "[[reading]]\nlight = \"key\"\ndistance_m = 1\nilluminance_lx = 1000\n"
      "[[reading]]\nlight = \"key\"\ndistance_m = 2\nilluminance_lx = 255\n");
  const json points =
      LightcalJson("simulate", {file, "--at", "0,0,1", "0.28,0,1", "0.37,0,1"})["points"];
  for (const json& point : points) {
    const json& lamp = point["lights"][0];
    const double direct = lamp["direct_lx"];
    EXPECT_GT(double(lamp["in_room_lx"]["value"]), direct);
    EXPECT_NEAR(double(lamp["in_room_lx"]["value"]), direct, 1.0) << point["position_m"];
  }
}

// What the walls throw back is as unsure as all the light of the lamp: its strength's u95, and,
// where it may shine more to one side than to where it was read from, that.
TEST(SimulateCommand, WallsAreAsUnsureAsTheLampsWholeLight) {
  const TempDir folder;
  const auto u95_of_walls = [&](const json& light) {
    const std::string file = folder.Write("l.json", LightFile({light}));
    const json walls = LightcalJson("simulate", {file, "--room", "5,4,2.6", "--at=0,0,1",
                                                 "--normal=0,0,-1"})["points"][0]["lights"][0];
    EXPECT_EQ(walls["direct_lx"], 0.0);
    return walls["illuminance_lx"]["u95"].get<double>() / walls["bounce_lx"].get<double>();
  };
  json lamp = Light("b", "point", 700.0, {0.0, 0.0, 1.5});
  lamp["intensity_cd"]["u95"] = 7.0;
  const double surest = u95_of_walls(lamp);
  lamp["intensity_cd"]["u95"] = 140.0;
  const double unsure = u95_of_walls(lamp);
  EXPECT_NEAR(unsure * unsure - surest * surest, 0.2 * 0.2 - 0.01 * 0.01, 1e-4);
  lamp["uneven"] = {{"gradient_sd", {0.3, 0.3, 0.3}}, {"middle", {0.0, 0.0, -0.9}}};
  const double uneven = u95_of_walls(lamp);
  EXPECT_NEAR(uneven * uneven - unsure * unsure, std::pow(1.959964 * 0.3 * 0.9, 2), 1e-4);
}

TEST(SimulateCommand, TheGateStaysWithinItsTolerance) {
  const TempDir folder;
  for (const Kind& kind : Kinds()) {
    const std::string file = folder.Write("lamp.json", LightFile({kind.light}));
    std::vector<std::string> common = {
        file,     "--plane", "floor",         "--grid", std::to_string(AcrossOf(80)),
        "--room", "5,4,2.6", "--reflectance", "0.5"};
    if (!kind.axis.empty()) common.push_back("--axis=" + kind.axis);
    const auto with = [&](std::vector<std::string> more) {
      more.insert(more.begin(), common.begin(), common.end());
      return Map(folder, more);
    };
    const std::vector<Row> all = with({"--effects", "all"});
    for (const auto& [text, tolerance] :
         {std::pair{"5%", 0.05}, std::pair{"1%", 0.01}, std::pair{"0.1%", 0.001}}) {
      const std::vector<Row> gated = with({"--tol", text});
      ASSERT_EQ(gated.size(), all.size());
      double worst = 0.0;
      for (std::size_t i = 0; i < all.size(); ++i) {
        worst = std::max(worst, std::abs(gated[i].lux / all[i].lux - 1.0));
      }
      EXPECT_LE(worst, tolerance + 2e-6) << kind.light["name"] << " at " << text;
    }
  }
}

TEST(SimulateCommand, AMeterBehindTheLampStillFacesIt) {
  const TempDir folder;
  json panel = Kinds()[3].light;  // shines from one side
  const V at = {panel["position_m"][0], panel["position_m"][1], panel["position_m"][2]};
  const V aim = {panel["aim"][0], panel["aim"][1], panel["aim"][2]};
  const V behind = at - Unit(aim);
  const json told =
      LightcalJson("simulate", {folder.Write("panel.json", LightFile({panel})),
                                "--at=" + std::to_string(behind[0]) + "," +
                                    std::to_string(behind[1]) + "," + std::to_string(behind[2]),
                                "--normal", "lamp"});
  const json& normal = told["points"][0]["normal"];
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(double(normal[i]), Unit(aim)[i], 1e-5);
}

// Unsure by a factor, as the lamp is: E low = E exp(-asinh(u/E)) = sqrt(E^2 + u^2) - u, high = low
// + 2 u; and from none where u is not below E.
TEST(SimulateCommand, APointsJsonHasTheEndsOfItsInterval) {
  const TempDir folder;
  const auto at_2_m = [&](double u95_cd) {
    json light = Light("b", "point", 100.0, {0, 0, 2});
    light["intensity_cd"]["u95"] = u95_cd;
    const std::string file = folder.Write("l.json", LightFile({light}));
    return LightcalJson("simulate", {file, "--at", "0,0,0"})["points"][0];
  };
  for (const double share : {0.02, 0.4, 0.9}) {
    const json point = at_2_m(100.0 * share);
    for (const json& lux : {point["illuminance_lx"], point["lights"][0]["illuminance_lx"]}) {
      const double e = lux["value"], u = lux["u95"];
      EXPECT_NEAR(e, 25.0, 1e-6);
      EXPECT_NEAR(u, 25.0 * share, 0.02 * 25.0 * share);
      EXPECT_NEAR(lux["low95"].get<double>(), std::hypot(e, u) - u, 1e-9);
      EXPECT_NEAR(lux["high95"].get<double>(), std::hypot(e, u) + u, 1e-9);
    }
  }
  const json wide = at_2_m(150.0)["illuminance_lx"];
  EXPECT_EQ(wide["low95"], 0.0);
  EXPECT_NEAR(wide["high95"].get<double>(), 25.0 + wide["u95"].get<double>(), 1e-9);
}

TEST(SimulateCommand, SeveralLightsAddUp) {
  const TempDir folder;
  const std::vector<Kind> kinds = Kinds();
  const json spot = kinds[1].light;
  const json disk = kinds[3].light;
  const std::vector<std::string> plane = {"--plane",      "floor",     "--grid",
                                          "50x40",        "--size",    "5x4m",
                                          "--center=0,0", "--effects", "-room_bounce"};
  const auto map = [&](const std::vector<json>& lights) {
    std::vector<std::string> arguments = {folder.Write("lights.json", LightFile(lights))};
    arguments.insert(arguments.end(), plane.begin(), plane.end());
    return Map(folder, arguments);
  };
  const auto one = map({spot});
  const auto other = map({disk});
  const auto both = map({spot, disk});  // six digits a number
  ASSERT_EQ(both.size(), 2000U);
  for (std::size_t i = 0; i < both.size(); ++i) {
    EXPECT_NEAR(both[i].lux, one[i].lux + other[i].lux, 1e-5 * both[i].lux);
    EXPECT_NEAR(both[i].u95, one[i].u95 + other[i].u95, 1e-5 * both[i].u95);
  }
}

TEST(SimulateCommand, APointIsThePixelThatLiesThere) {
  const TempDir folder;
  for (const Kind& kind : Kinds()) {
    const std::string file = folder.Write("lamp.json", LightFile({kind.light}));
    for (const char* plane : {"floor", "x=-2", "y=1.5"}) {
      std::vector<std::string> arguments = {file,     "--plane", plane,   "--grid", "9x7",
                                            "--size", "3x2m",    "--tol", "1e-7"};
      if (!kind.axis.empty()) arguments.push_back("--axis=" + kind.axis);
      const std::vector<Row> rows = Map(folder, arguments);
      ASSERT_EQ(rows.size(), 63U);
      for (const std::size_t k : {std::size_t{0}, std::size_t{31}, std::size_t{50}}) {
        const Row& row = rows[k];
        V at = {row.a, row.b, 0.0};
        std::string normal = "0,0,1";
        if (plane[0] == 'x') at = {-2.0, row.a, row.b}, normal = "1,0,0";
        if (plane[0] == 'y') at = {row.a, 1.5, row.b}, normal = "0,-1,0";
        std::vector<std::string> one = {file, "--at=" + Text(at), "--normal=" + normal, "--tol",
                                        "1e-7"};
        if (!kind.axis.empty()) one.push_back("--axis=" + kind.axis);
        const json point = LightcalJson("simulate", one)["points"][0];
        EXPECT_NEAR(Value(point), row.lux, 2e-5 * row.lux + 1e-9)
            << kind.light["name"] << " " << plane << " " << k;
      }
    }
  }
}

// A reflector was read on its axis: of its rear nothing is known, of a bulb's not much.
TEST(SimulateCommand, OffItsAxisALampIsAsUnsureAsItsFixture) {
  const TempDir session;
  const auto relative = [&](const std::string& fixture, const char* at) {
    const std::string file = session.Write(
        "s.toml",
        "lightcal = 1\n[room]\ndark = true\n[[light]]\nname = \"key\"\nkind = \"point\"\nfixture = "
        "\"" +
            fixture +
            "\"\nposition_m = [0, 0, 2]\naim = [0, 0, -1]\n[[reading]]\nlight = \"key\"\n"
            "distance_m = 1\nilluminance_lx = 1000\n[[reading]]\nlight = \"key\"\ndistance_m = 2\n"
            "illuminance_lx = 240\n");
    const json lux = LightcalJson(
        "simulate", {file, "--at", at, "--normal", "lamp"})["points"][0]["illuminance_lx"];
    return double(lux["u95"]) / double(lux["value"]);
  };
  EXPECT_LT(relative("reflector", "0,0,0"), 0.13);
  EXPECT_GT(relative("reflector", "0,0,3"), 1.0);
  EXPECT_LT(relative("bulb", "0,0,0"), 0.13);
  EXPECT_GT(relative("bulb", "0,0,3"), 0.5) << "a base takes up to half";
  EXPECT_LT(relative("bulb", "0,0,3"), 1.0);
}

// However few points a map has, each has its own u95: between corners 4 m apart it is no straight
// line.
TEST(SimulateCommand, APointIsAsSureInAnyMap) {
  const TempDir session;
  session.Write(
      "s/session.toml",
      "lightcal = 1\n[room]\noutdoors = true\n[[light]]\nname = \"key\"\nkind = \"point\"\n"
      "position_m = [0, 0, 2]\n[[meter]]\nname = \"m\"\nsigma_relative = 0.03\n"
      "[[reading]]\nlight = \"key\"\nmeter = \"m\"\ndistance_m = 1\nilluminance_lx = 500\n"
      "[[reading]]\nlight = \"key\"\nmeter = \"m\"\ndistance_m = 2\nilluminance_lx = 125\n");
  const std::string file = session.path() + "/light.json";
  ASSERT_EQ(RunLightcal({"fit", session.path() + "/s", "-o", file}).exit_code, 0);
  const json point = LightcalJson("simulate", {file, "--at", "0,0,0"})["points"][0];
  const double u95 = point["illuminance_lx"]["u95"];
  for (const char* grid : {"1", "3", "5", "9", "33"}) {
    const std::vector<Row> rows =
        Map(session, {file, "--plane", "floor", "--size", "8m", "--grid", grid});
    const auto middle =
        std::ranges::find_if(rows, [](const Row& row) { return std::hypot(row.a, row.b) < 1e-9; });
    ASSERT_NE(middle, rows.end());
    EXPECT_NEAR(middle->u95, u95, 0.03 * u95) << grid;
  }
}

TEST(SimulateCommand, TheSameBytesOnOneProcessorAndOnAll) {
  const TempDir folder;
  std::vector<json> lights;
  for (const Kind& kind : Kinds()) lights.push_back(kind.light);
  const std::string file = folder.Write("lights.json", LightFile(lights));
  const auto bytes = [&](const std::string& name, const std::vector<std::string>& wrapper) {
    const std::string exr = folder.path() + "/" + name;
    const CliResult result =
        RunLightcal({"simulate", file, "--plane", "floor", "--grid", std::to_string(AcrossOf(150)),
                     "--room", "5,4,2.6", "-o", exr},
                    "", {}, wrapper);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return ReadFile(exr);
  };
  const std::string all = bytes("all.exr", {});
  EXPECT_GT(all.size(), 1000U);
  EXPECT_EQ(all, bytes("one.exr", {"taskset", "-c", "0"}));
}

TEST(SimulateCommand, ItSaysWhichEffectsRanAndWhatEachCost) {
  const TempDir folder;
  const std::string bulb =
      folder.Write("bulb.json", LightFile({Light("bulb", "point", 500.0, {0.0, 0.0, 2.5})}));
  const json dark = LightcalJson("simulate", {bulb, "--plane", "floor", "--size", "4m", "--room",
                                              "30,30,12", "--reflectance", "0.03"});
  for (const json& effect : dark["effects"]) EXPECT_EQ(effect["state"], "off") << effect;
  EXPECT_LT(dark["effects"][1]["bound_left_off"].get<double>(), 0.005);
  EXPECT_GT(dark["effects"][0]["cost_ns"].get<double>(), 0.0);

  json panel = Light("panel", "rect", 900.0, {0.0, 1.4, 2.0});
  panel["width_m"] = 1.2;
  panel["height_m"] = 0.6;
  panel["aim"] = {0.0, 0.0, -1.0};
  const std::string white = folder.Write("panel.json", LightFile({panel}));
  const json room = LightcalJson("simulate", {white, "--plane", "floor", "--grid", "256", "--room",
                                              "4,3.4,2.6", "--reflectance", "0.8"});
  EXPECT_EQ(room["effects"][0]["state"], "on");
  EXPECT_EQ(room["effects"][1]["state"], "on");
  EXPECT_LT(room["effects"][1]["evaluations"].get<int>(), 256 * 218 / 8);
  const CliResult table =
      RunLightcal({"simulate", white, "--at", "0,0,0", "--room", "4,3.4,2.6", "--timing"});
  EXPECT_EQ(table.exit_code, 0);
  for (const char* word : {"finite_source", "room_bounce", "panel", "measured"}) {
    EXPECT_NE(table.out.find(word), std::string::npos) << word;
  }
}

TEST(SimulateCommand, PicturesNameTheirLinesLampsAndScale) {
  const TempDir folder;
  const std::string file = folder.Write(
      "desk.json", LightFile({Light("bulb", "point", 500.0, {0.5, 0.0, 1.5}), Kinds()[1].light}));
  const std::string svg = folder.path() + "/map.svg";
  const std::string png = folder.path() + "/map.png";
  const CliResult result = RunLightcal({"simulate", file, "--plane", "floor", "--grid", "128",
                                        "--title", "Desk", "-o", svg, "-o", png});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string text = ReadFile(svg);
  for (const char* word : {"Desk", "x (m)", "y (m)", "lux", "isolux", "bulb", "spot"}) {
    EXPECT_NE(text.find(word), std::string::npos) << word;
  }
  EXPECT_EQ(ReadFile(png).substr(1, 3), "PNG");
  // Again over its own files; not over somebody else's.
  EXPECT_EQ(
      RunLightcal({"simulate", file, "--plane", "floor", "--grid", "16", "-o", png}).exit_code, 0);
  const std::string theirs = folder.Write("theirs.csv", "1,2\n");
  EXPECT_EQ(RunLightcal({"simulate", file, "--plane", "floor", "-o", theirs}).exit_code, 1);
  EXPECT_EQ(ReadFile(theirs), "1,2\n");
}

TEST(SimulateCommand, ItRefusesWhatItCannotKnow) {
  const TempDir folder;
  json unplaced = Light("key", "point", 500.0, {});
  unplaced.erase("position_m");
  const std::string file = folder.Write("key.json", LightFile({unplaced}));
  const CliResult refused = RunLightcal({"simulate", file, "--at", "0,0,0", "--json"});
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_EQ(json::parse(refused.out)["error"]["code"], "position_unknown");
  EXPECT_NE(refused.out.find("--position key="), std::string::npos);
  const json placed =
      LightcalJson("simulate", {file, "--position", "0,0,2.5m", "--at", "0,0,0"})["points"][0];
  EXPECT_NEAR(Value(placed), 80.0, 1e-9);
  const auto code = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"simulate", file, "--position", "0,0,2"});
    return RunLightcal(more).exit_code;
  };
  EXPECT_EQ(code({}), 2);
  EXPECT_EQ(code({"--at", "1,2"}), 2);
  EXPECT_EQ(code({"--plane", "q=2"}), 2);
  EXPECT_EQ(code({"--plane", "floor", "--grid", "0"}), 2);
  EXPECT_EQ(code({"--plane", "floor", "--size", "0x3"}), 2);
  EXPECT_EQ(code({"--at", "0,0,0", "--effects", "+meter_tilt"}), 2);
  EXPECT_EQ(code({"--plane", "floor", "-o", "map.gif"}), 2);
  EXPECT_EQ(code({"--at", "0,0,0", "-o", "map.png"}), 2);
  EXPECT_EQ(code({"--at", "0,0,0", "--lights", "kee"}), 3);
  EXPECT_EQ(code({"--at", "0,0,0", "--room", "5,4"}), 2);
  EXPECT_EQ(code({"--at", "0,0,0", "--tol", "2"}), 2);
  // A room throws nothing back to where it does not reach.
  EXPECT_EQ(code({"--at", "2.5,2,0", "--room", "5,4,2.6"}), 0);
  EXPECT_EQ(code({"--at", "2.6,2,0", "--room", "5,4,2.6"}), 3);
  EXPECT_EQ(code({"--at", "0,0,-0.5", "--room", "5,4,2.6"}), 3);
  EXPECT_EQ(code({"--at", "0,0,0", "--room", "5,4,1.5"}), 3) << "the lamp hangs above the ceiling";
  // A spot without a cone is simulated, and that is said; --strict refuses it.
  json spot = Light("spot", "spot", 500.0, {0.0, 0.0, 2.0});
  spot["aim"] = {0.0, 0.0, -1.0};
  const std::string conic = folder.Write("spot.json", LightFile({spot}));
  const json warned = LightcalJson("simulate", {conic, "--at", "0,0,0"});
  EXPECT_EQ(warned["warnings"][0]["code"], "cone_unknown");
  EXPECT_EQ(RunLightcal({"simulate", conic, "--at", "0,0,0", "--strict"}).exit_code, 3);
  EXPECT_EQ(RunLightcal({"simulate", folder.path() + "/none.json", "--at", "0,0,0"}).exit_code, 1);
}

TEST(SimulateCommand, ASessionBringsItsRoomAndItsLampsPlaces) {
  const TempDir session;
  session.Write(
      "session.toml",
      "lightcal = 1\nname = \"Desk\"\n[room]\nsize_m = [5, 4, 2.6]\nreflectance = 0.5\n"
      "[[light]]\nname = \"key\"\nkind = \"point\"\nfixture = \"bulb\"\nposition_m = [0, 0, 2]\n"
      "[[reading]]\nlight = \"key\"\nposition_m = [0, 0, 0]\nnormal = [0, 0, 1]\n"
      "illuminance_lx = 100.0\n");
  const json answer = LightcalJson(
      "simulate", {session.path(), "--at", "0,0,0", "--plane", "floor", "--grid", "64"});
  // What was read there is predicted there: the walls that the fit took out come back. The fit has
  // them from traced rooms, a map from the box itself: 46 and 38 lx.
  EXPECT_NEAR(Value(answer["points"][0]), 100.0, 8.0);
  EXPECT_GT(answer["points"][0]["lights"][0]["bounce_lx"].get<double>(), 5.0);
  EXPECT_NEAR(answer["plane"]["left_m"].get<double>(), -2.5, 1e-12);
  EXPECT_NEAR(answer["plane"]["top_m"].get<double>(), 2.0, 1e-12);
  EXPECT_EQ(answer["plane"]["grid"], json({64, 51}));
}

}  // namespace
}  // namespace lightcal::test
