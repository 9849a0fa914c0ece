// SPDX-License-Identifier: Apache-2.0
// Rows X01 to X06: what engines and files cannot hold.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "hard_case.h"
#include "lightcal/photometry/half_range.h"

namespace lightcal::test::hard {
namespace {

using testing::HasSubstr;
using testing::Not;

Answer Expose(const std::string& shutter, const std::string& light) {
  return Ask(
      {"exposure", "--aperture", "f/16", "--shutter", shutter, "--iso", "100", "--light", light});
}
double PreExposed(const Answer& answer) {
  return answer.document["lights"][0]["pre_exposed"].get<double>();
}

TEST(HardCaseX, X01TheSunOverflowsHalfFloatsUntilOneMoreStop) {
  const Answer ev14 = Expose("1/64", "2e9nits");
  ExpectWarned(ev14, "fp16_overflow");
  EXPECT_NEAR(PreExposed(ev14), 101725.0, 1.0);
  const Answer ev15 = Expose("1/128", "2e9nits");
  ExpectAnswered(ev15);
  EXPECT_FALSE(Warns(ev15, "fp16_overflow"));
  EXPECT_NEAR(PreExposed(ev15), 50863.0, 1.0);
  EXPECT_EQ(ClassifyHalf(std::numeric_limits<double>::infinity()), HalfRange::kOverflow);
  // A lamp as strong: every preset holds finite numbers.
  KeySession session;
  ExpectAnswered(session.At(1, 2e9).At(2, 5e8).Run());
}

TEST(HardCaseX, X02WhatLosesDigitsInAHalfFloatIsWarned) {
  const Answer faint = Expose("1/64", "1e-3nits");
  ExpectWarned(faint, "fp16_subnormal");
  EXPECT_GT(PreExposed(faint), 0.0);
  EXPECT_EQ(ClassifyHalf(6.0e-5), HalfRange::kSubnormal);
  EXPECT_EQ(ClassifyHalf(6.2e-5), HalfRange::kFits);
  ExpectAnswered(Expose("1/64", "0nits"));
  KeySession session;
  ExpectAnswered(session.At(1, 1e-9).At(2, 2.5e-10).Run());
}

TEST(HardCaseX, X03ARangeTooShortIsWarnedWithItsResidual) {
  KeySession session;
  ExpectAnswered(session.At(0.5, 400).At(1, 100).At(2, 25).Run());
  const auto shortened = [&](const char* range) {
    const TempDir presets;
    return Ask({"export", session.path() + "/out/light.json", "--to", "godot", "--range", range,
                "-o", presets.path()});
  };
  // The engine's squared window takes 1 % at a range of 3.76 times the farthest reading, 7.5 m.
  const Answer close = shortened("3m");
  ExpectWarned(close, "falloff_residual");
  bool named = false;
  for (const json& warning : close.document["warnings"]) {
    named = named || warning["message"].get<std::string>().find(" %") != std::string::npos;
  }
  EXPECT_TRUE(named);
  EXPECT_FALSE(Warns(shortened("20m"), "falloff_residual"));
}

TEST(HardCaseX, X04GodotGetsTheInverseSquare) {
  KeySession point;
  ExpectAnswered(point.At(0.5, 400).At(1, 100).Run());
  EXPECT_THAT(point.PresetText(".tscn"), HasSubstr("omni_attenuation = 2"));
  KeySession spot("spot", "inner_deg = 20\nouter_deg = 35");
  ExpectAnswered(spot.At(2, 400).Run());
  EXPECT_THAT(spot.PresetText(".tscn"), HasSubstr("spot_attenuation = 2"));
}

TEST(HardCaseX, X05EnginesInWattsGiveTheLuxBack) {
  KeySession session("point", kDarkBulb);
  const Answer fitted = session.At(0.5, 400).At(1, 100).At(2, 25).Run();
  ExpectAnswered(fitted);
  // Blender has watts, Filament lumens, glTF candela: each file read back casts the readings.
  for (const char* ending :
       {".gltf", ".blender.py", ".three.js", ".filament.json", ".preset.json", ".ies"}) {
    std::string file;
    for (const auto& entry : std::filesystem::directory_iterator(session.path() + "/out")) {
      if (entry.path().string().ends_with(ending)) file = entry.path().string();
    }
    const Answer checked = Ask({"check", file, "--session", session.path()});
    ExpectAnswered(checked);
    ASSERT_EQ(checked.document["readings"].size(), 3U) << ending;
    for (const json& reading : checked.document["readings"]) {
      EXPECT_NEAR(reading["error"].get<double>(), 0.0, 1e-6) << ending;
    }
  }
  // Godot's point light: lumens by 4 pi, times what its colour loses in brightness.
  const std::string scene = session.PresetText(".tscn");
  EXPECT_THAT(scene, HasSubstr("light_intensity_lumens"));
}

TEST(HardCaseX, X06NumbersAreWrittenForEveryReader) {
  // -0 typed, a locale with decimal commas, numbers at the ends of double.
  for (const double lux : {1e-200, 1e-9, 1e9, 1e12}) {
    KeySession session;
    const Answer answer = session.At(1, lux).Run({"--to", "gltf,usd,godot,blender,json"});
    ExpectAnswered(answer);
  }
  for (const char* typed :
       {"1e-300lx@1m", "1e20lx@1m", "1e30lx@1m", "1e300lx@1e10m", "-0.0lx@1m", "0lx@1m"}) {
    const TempDir out;
    const Answer answer =
        Ask({"quick", typed, "--to", "gltf,ies,ldt,godot,json", "-o", out.path()});
    EXPECT_TRUE(answer.exit_code == 0 || answer.exit_code == 3) << typed;
    ExpectFiniteFiles(out.path());
    for (const auto& entry : std::filesystem::directory_iterator(out.path())) {
      const std::string text = ReadFile(entry.path().string());
      EXPECT_THAT(text, Not(HasSubstr("-0.0,"))) << entry.path();
      EXPECT_THAT(text, Not(HasSubstr("-0,"))) << entry.path();
    }
  }
  for (const char* comma : {"192,5lx@0.5m", "192lx@0,5m"}) {
    EXPECT_EQ(Ask({"quick", comma}).exit_code, 2) << comma;
  }
  const CliResult here = RunLightcal({"quick", "192.5lx@0.5m", "--json"}, "");
  const CliResult comma = RunLightcal({"quick", "192.5lx@0.5m", "--json"}, "",
                                      {"LC_ALL=de_DE.UTF-8", "LANG=de_DE.UTF-8"});
  EXPECT_EQ(here.out, comma.out);
}

}  // namespace
}  // namespace lightcal::test::hard
