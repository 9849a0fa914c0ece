// SPDX-License-Identifier: Apache-2.0
// lightcal photometric, driven as a shell would.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "run_cli.h"
#include "run_cli_json.h"

namespace lightcal::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

std::string Ldt(const std::string& name) { return SampleData("photometric/" + name + ".ldt"); }

const std::string kUniform =
    "IESNA:LM-63-2002\r\n[TEST] 1\r\n[MANUFAC] Ours\r\nTILT=NONE\r\n"
    "1 1000 1 2 1 1 2 0 0 0\r\n1 1 60\r\n0 180\r\n0\r\n100 100\r\n";

TEST(PhotometricCommand, FluxOfTheRealFilesIsTheirLampsWithinAThousandth) {
  const std::pair<const char*, double> lamps[] = {
      {"sample1", 1983.0}, {"sample2", 4600.0}, {"sample5", 611.9}, {"sample10", 7000.0}};
  for (const auto& [name, lumens] : lamps) {
    const json got = LightcalJson("photometric", {Ldt(name)});
    EXPECT_NEAR(got["flux_lm"].get<double>() / lumens, 1.0, 1e-3) << name;
    EXPECT_NEAR(got["lamp_lumens"].get<double>(), lumens, 1e-9);
    EXPECT_EQ(got["format"], "ldt");
    EXPECT_EQ(got["type"], "C");
  }
  const json erco = LightcalJson("photometric", {Ldt("sample5")});
  EXPECT_EQ(erco["symmetry"], "axial");
  EXPECT_EQ(erco["planes"], 1);
  EXPECT_EQ(erco["absolute"], true);
  EXPECT_NEAR(erco["peak_cd"].get<double>(), 471.3, 0.05);
  EXPECT_GT(erco["field_deg"].get<double>(), erco["beam_deg"].get<double>());
}

TEST(PhotometricCommand, UniformLampIsFourPiAndShinesAllRound) {
  const TempDir folder;
  const json got = LightcalJson("photometric", {folder.Write("a.ies", kUniform)});
  EXPECT_NEAR(got["flux_lm"].get<double>(), 400.0 * std::numbers::pi, 1e-9);
  EXPECT_NEAR(got["beam_deg"].get<double>(), 360.0, 1e-9);
  EXPECT_EQ(got["format"], "ies");
}

// Beyond the last angle of a file all is dark, to its beam as to its flux: 0 to 90 degrees.
TEST(PhotometricCommand, AFileThatEndsAtNinetyDegreesShinesIntoHalfTheSphere) {
  const TempDir folder;
  std::string text = kUniform;
  text.replace(text.find("0 180\r\n"), 7, "0 90\r\n");
  for (const std::string& candela : {"100 100", "100 60"}) {
    std::string own = text;
    own.replace(own.rfind("100 100"), 7, candela);
    const json got = LightcalJson("photometric", {folder.Write("half.ies", own)});
    EXPECT_NEAR(got["beam_deg"].get<double>(), 180.0, 1e-6);
    EXPECT_NEAR(got["field_deg"].get<double>(), 180.0, 1e-6);
  }
}

TEST(PhotometricCommand, TheFieldOf2019DoesNotMultiply) {
  const TempDir folder;
  std::string text = kUniform;
  text.replace(0, 16, "IES:LM-63-2019");
  text.replace(text.find("1 1 60"), 6, "1 1.10000 60");
  const std::string file = folder.Write("a.ies", text);
  EXPECT_NEAR(LightcalJson("photometric", {file})["peak_cd"].get<double>(), 100.0, 1e-12);
  const std::string out = folder.path() + "/b.ies";
  ASSERT_EQ(RunLightcal({"photometric", file, "--to", "ies", "-o", out}).exit_code, 0);
  EXPECT_THAT(ReadFile(out), HasSubstr("\r\n1 1 60\r\n"));
}

TEST(PhotometricCommand, ConvertsBothWaysToTheSameDigits) {
  const TempDir folder;
  for (const char* name : {"sample1", "sample2", "sample5", "sample10"}) {
    const auto path = [&](const char* file) { return folder.path() + "/" + name + file; };
    const auto convert = [&](const std::string& from, const char* to, const std::string& out) {
      const CliResult made = RunLightcal({"photometric", from, "--to", to, "-o", out});
      EXPECT_EQ(made.exit_code, 0) << made.err;
    };
    convert(Ldt(name), "ies", path("1.ies"));
    convert(path("1.ies"), "ldt", path("2.ldt"));
    convert(path("2.ldt"), "ies", path("3.ies"));
    EXPECT_EQ(ReadFile(path("1.ies")), ReadFile(path("3.ies"))) << name;
  }
}

TEST(PhotometricCommand, TypeBIsSampledForEulumdatAndSaysSo) {
  const TempDir folder;
  std::string ies = kUniform.substr(0, kUniform.find("1 1000"));
  ies += "1 -1 1 5 5 2 2 0 0 0\r\n1 1 60\r\n-20 -10 0 10 20\r\n-40 -20 0 20 40\r\n";
  for (int h = 0; h < 5; ++h) ies += "10 50 100 50 10\r\n";
  const std::string file = folder.Write("b.ies", ies);
  const std::string out = folder.path() + "/b.ldt";
  const CliResult made = RunLightcal({"photometric", file, "--to", "ldt", "-o", out, "--json"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(json::parse(made.out)["warnings"][0]["code"], "resampled");
  EXPECT_EQ(json::parse(made.out)["type"], "B");
  EXPECT_NEAR(LightcalJson("photometric", {out})["flux_lm"].get<double>() /
                  json::parse(made.out)["flux_lm"].get<double>(),
              1.0, 0.02);
}

TEST(PhotometricCommand, ASetOfLampsIsChosenAndWritten) {
  const TempDir folder;
  const CliResult first = RunLightcal({"photometric", Ldt("sample1")});
  EXPECT_THAT(first.err, HasSubstr("describes 2 sets of lamps"));
  EXPECT_THAT(first.err, HasSubstr("--set 2 takes the second"));
  const std::string out = folder.path() + "/second.ldt";
  const CliResult made =
      RunLightcal({"photometric", Ldt("sample1"), "--set", "2", "--to", "ldt", "-o", out});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(made.err, "");
  EXPECT_NEAR(double(LightcalJson("photometric", {out})["flux_lm"]) / 2643.0, 1.0, 1e-3);
  EXPECT_EQ(RunLightcal({"photometric", Ldt("sample1"), "--set", "3"}).exit_code, 3);
}

// A Gaussian ellipse of 47.1 by 18.8 degrees turned by 45: its own widths, and their planes.
TEST(PhotometricCommand, ATurnedOvalIsMeasuredAlongItsAxes) {
  const TempDir folder;
  std::ostringstream ies;
  ies << "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 181 73 1 2 0 0 0\n1 1 10\n";
  for (int g = 0; g <= 180; ++g) ies << 0.5 * g << "\n";
  for (int c = 0; c <= 72; ++c) ies << 5 * c << "\n";
  for (int c = 0; c <= 72; ++c) {
    for (int g = 0; g <= 180; ++g) {
      const double a = (5.0 * c - 45.0) * std::numbers::pi / 180.0;
      const double u = 0.5 * g * std::cos(a) / 23.55, v = 0.5 * g * std::sin(a) / 9.4;
      ies << 1000.0 * std::exp2(-u * u - v * v) << "\n";
    }
  }
  const std::string file = folder.Write("c.ies", ies.str());
  const json got = LightcalJson("photometric", {file});
  EXPECT_NEAR(double(got["beam_by_plane_deg"][0]), 47.1, 0.1);
  EXPECT_NEAR(double(got["beam_by_plane_deg"][1]), 18.8, 0.1);
  EXPECT_NEAR(double(got["beam_deg"]), 0.5 * (47.1 + 18.8), 0.1);
  EXPECT_NEAR(double(got["beam_planes_c_deg"][0]), 45.0, 0.1);
  EXPECT_NEAR(double(got["beam_planes_c_deg"][1]), 135.0, 0.1);
  EXPECT_THAT(RunLightcal({"photometric", file}).out, HasSubstr("in C 45, 135)"));
}

// ---- one beam, written as each type ----

// cd towards a direction of the lamp's frame (aim -Z, C0 +X, C90 +Y): oblong, turned, off the axis.
double BeamTowards(double x, double y, double z) {
  const double across = (x - 0.05) / 0.14, along = (y + 0.08 * x - 0.03) / 0.34;
  return z < 0.0 ? 1000.0 * std::exp(-0.5 * (across * across + along * along)) : 0.0;
}

// CIE 121 lays the poles of A planes along C0 and those of B planes along C90; LM-63 turns H
// clockwise, so that H leads to C270 and V to C0 in both.
std::string FileOfType(char type) {
  const auto angles = [](double from, double to, double step) {
    std::vector<double> out;
    for (int i = 0; from + i * step <= to; ++i) out.push_back(from + i * step);
    return out;
  };
  const bool is_c = type == '1';
  const auto vertical = is_c ? angles(0, 90, 1) : angles(-90, 90, 1);
  const auto horizontal = is_c ? angles(0, 360, 2.5) : angles(-90, 90, 1);
  std::ostringstream out;
  out << "IESNA:LM-63-2002\r\nTILT=NONE\r\n1 -1 1 " << vertical.size() << " " << horizontal.size()
      << " " << type << " 2 0 0 0\r\n1 1 10\r\n";
  for (const double v : vertical) out << v << "\r\n";
  for (const double h : horizontal) out << h << "\r\n";
  for (const double h_deg : horizontal) {
    for (const double v_deg : vertical) {
      const double h = h_deg * std::numbers::pi / 180.0, v = v_deg * std::numbers::pi / 180.0;
      const double sh = std::sin(h), ch = std::cos(h), sv = std::sin(v), cv = std::cos(v);
      const double candela = type == '3'   ? BeamTowards(sv, -cv * sh, -cv * ch)
                             : type == '2' ? BeamTowards(ch * sv, -sh, -ch * cv)
                                           : BeamTowards(sv * ch, sv * sh, -cv);
      out << candela << "\r\n";
    }
  }
  return out.str();
}

TEST(PhotometricCommand, OneBeamShinesAlikeAsAnyTypeBeforeAndAfterConversion) {
  const double floor[][2] = {{0, 0}, {0.5, 0}, {0, 0.5}, {-0.4, 0.6}, {0.3, -0.9}};
  const TempDir folder;
  double flux_of_c = 0.0;
  for (const char type : {'1', '2', '3'}) {
    const std::string own = folder.Write("own.ies", FileOfType(type));
    for (const std::string& name : {"own.ies", "as.ldt", "as.ies"}) {
      const std::string file = folder.path() + "/" + name;
      if (name != "own.ies") {
        const CliResult made = RunLightcal(
            {"photometric", own, "--to", name.substr(3), "-o", file, "--force", "--quiet"});
        ASSERT_EQ(made.exit_code, 0) << made.err;
      }
      const json got = LightcalJson("photometric", {file});
      if (flux_of_c == 0.0) flux_of_c = got["flux_lm"];
      EXPECT_NEAR(double(got["flux_lm"]) / flux_of_c, 1.0, 2e-3) << type << name;
      EXPECT_NEAR(double(got["peak_at"]["gamma_deg"]), 3.4, 1.0) << type << name;
      const std::string session = folder.Write(
          "session.toml",
          "lightcal = 1\nname = \"a\"\n[room]\ndark = true\n[[light]]\nname = \"k\"\n"
          "kind = \"photometric\"\ndistribution = \"" +
              name + "\"\nposition_m = [0, 0, 2]\naim = [0, 0, -1]\naxis = [1, 0, 0]\n");
      std::vector<std::string> asked = {session, "--normal", "0,0,1"};
      for (const auto& [x, y] : floor) {
        asked.insert(asked.end(), {"--at", std::to_string(x) + "," + std::to_string(y) + ",0"});
      }
      const json points = LightcalJson("simulate", asked)["points"];
      for (std::size_t i = 0; i < std::size(floor); ++i) {
        const double x = floor[i][0], y = floor[i][1], r = std::hypot(x, y, 2.0);
        const double want = BeamTowards(x / r, y / r, -2.0 / r) * 2.0 / (r * r * r);
        EXPECT_NEAR(double(points[i]["illuminance_lx"]["value"]), want, 0.01 * 250.0)
            << type << " " << name << " " << x << " " << y;
      }
    }
  }
}

TEST(PhotometricCommand, DrawsThePolarDiagramAsSvgAndPng) {
  const TempDir folder;
  for (const char* name : {"polar.svg", "polar.png"}) {
    const std::string out = folder.path() + "/" + name;
    const CliResult made = RunLightcal({"photometric", Ldt("sample2"), "--plot", out});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    EXPECT_GT(ReadFile(out).size(), 4000U);
  }
  const std::string svg = ReadFile(folder.path() + "/polar.svg");
  EXPECT_THAT(svg, HasSubstr("C90"));
  EXPECT_THAT(svg, HasSubstr("TRAQ"));
  EXPECT_EQ(RunLightcal({"photometric", Ldt("sample2"), "--plot", "x.gif"}).exit_code, 2);
}

TEST(PhotometricCommand, TiltFilesAreReadBesideTheFileAndNowhereElse) {
  const TempDir folder;
  std::string text = kUniform;
  const auto with_tilt = [&](const std::string& tilt) {
    std::string changed = kUniform;
    changed.replace(changed.find("TILT=NONE"), 9, "TILT=" + tilt);
    return folder.Write("a.ies", changed);
  };
  folder.Write("mh.tlt", "1\n2\n0 90\n1 0.8\n");
  const json got = LightcalJson("photometric", {with_tilt("mh.tlt")});
  EXPECT_EQ(got["tilt"]["factor"], (std::vector<double>{1.0, 0.8}));
  for (const char* evil : {"../../../etc/passwd", "/etc/passwd", "..\\x"}) {
    const CliResult refused = RunLightcal({"photometric", with_tilt(evil), "--json"});
    EXPECT_EQ(refused.exit_code, 3);
    EXPECT_EQ(json::parse(refused.out)["error"]["code"], "unsafe_path");
    EXPECT_EQ(refused.out.find("root:"), std::string::npos);
  }
}

TEST(PhotometricCommand, AGigabyteLineIsRefusedInBoundedMemory) {
  const TempDir folder;
  const std::string path = folder.Write("big.ies", "IESNA:LM-63-2002\r\nTILT=NONE\r\n");
  // Sparse: a line of a gigabyte of zero bytes that costs no disk.
  ASSERT_EQ(::truncate(path.c_str(), 1 << 30), 0);
  rusage before{};
  getrusage(RUSAGE_CHILDREN, &before);
  const CliResult refused = RunLightcal({"photometric", path, "--json"});
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_EQ(json::parse(refused.out)["error"]["code"], "too_large");
  rusage after{};
  getrusage(RUSAGE_CHILDREN, &after);
  EXPECT_LT(after.ru_maxrss, std::max(before.ru_maxrss, 300L * 1024)) << "kB";
}

TEST(PhotometricCommand, LiesAndRubbishAreRefusedByName) {
  const TempDir folder;
  const auto code = [&](const std::string& text) {
    const CliResult result = RunLightcal({"photometric", folder.Write("x", text), "--json"});
    EXPECT_EQ(result.exit_code, 3);
    return json::parse(result.out)["error"]["code"].get<std::string>();
  };
  const std::string head = "IESNA:LM-63-2002\nTILT=NONE\n";
  EXPECT_EQ(code(head + "1 1 1 1000000 1000000 1 2 0 0 0\n1 1 1\n"), "bad_photometric");
  EXPECT_EQ(code(head + "1 1 nan 2 1 1 2 0 0 0\n1 1 1\n0 90\n0\n1 1\n"), "bad_photometric");
  EXPECT_EQ(code(head + "1 1 1 2 1 1 2 0 0 0\n1 1 1\n90 0\n0\n1 1\n"), "bad_table");
  EXPECT_EQ(code("hello\n"), "unknown_format");
  EXPECT_EQ(code(""), "unknown_format");
  EXPECT_EQ(RunLightcal({"photometric", folder.path() + "/none"}).exit_code, 1);
  EXPECT_EQ(RunLightcal({"photometric", Ldt("sample1"), "--to", "ies"}).exit_code, 2);
  EXPECT_EQ(RunLightcal({"photometric", Ldt("sample1"), "--to", "pdf", "-o", "x"}).exit_code, 2);
}

}  // namespace
}  // namespace lightcal::test
