// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/check/engine_answers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "lightcal/presets/preset_table.h"
#include "sample_lights.h"

namespace lightcal::test {
namespace {

// 1000 lx under an even sky of 2700 K: L = 1000/pi = 318.31 cd/m2, whose Rec. 709 colour of largest
// component 1 has the luminance .5168; 1/.5168 = 1.935.
FittedLight WarmDome() {
  FittedLight light = Sun();
  light.name = "sky";
  light.kind = LightKind::kDome;
  light.illuminance_lx = Uncertain{1000.0, 20.0, {}, {}};
  light.color.cct_K = Uncertain{2700.0, 35.0, {}, {}};
  light.color.duv.reset();
  light.color.xy.reset();
  return light;
}

FittedLight Disk() {
  FittedLight light = SimpleLight("disk", LightKind::kDisk, 400.0);
  light.diameter_m = 0.05;  // fitted as a point, which it nearly is at 1 m
  return light;
}

TEST(EngineAnswers, AGodotDomeNamesItsMultiplierBesideItsNits) {
  const EngineAnswers answers = EngineAnswersOf(FileOf({WarmDome()}));
  const auto figure = std::ranges::find(answers.figures, "Godot", &EngineFigure::engine);
  ASSERT_NE(figure, answers.figures.end());
  EXPECT_EQ(figure->field, "Environment · Background intensity");
  EXPECT_EQ(figure->value, "318.31");
  EXPECT_THAT(figure->note, ::testing::HasSubstr("Background energy multiplier 1.935"));
}

TEST(EngineAnswers, EveryEngineMakesOfADomeTheLuxThatWereRead) {
  const EngineAnswers answers = EngineAnswersOf(FileOf({WarmDome()}));
  EXPECT_GE(answers.parity.size(), 6U);
  for (const ParityRow& row : answers.parity) {
    EXPECT_NEAR(row.engine_lx, 1000.0, 1.0) << row.engine;
  }
}

TEST(EngineAnswers, EveryEngineOfReportsAnswersForALampOfEveryForm) {
  for (const FittedLight& lamp : {WarmPoint(), Spot(), Disk(), Sun()}) {
    const EngineAnswers answers = EngineAnswersOf(FileOf({lamp}));
    std::set<std::string> engines;
    for (const ParityRow& row : answers.parity) {
      engines.insert(row.engine);
      EXPECT_NEAR(row.engine_lx / row.expected_lx, 1.0, 0.002) << lamp.name << " in " << row.engine;
    }
    EXPECT_EQ(engines.size(), ReportTargets().size()) << lamp.name;
    // "Any engine" before them.
    EXPECT_EQ(answers.figures.size(), ReportTargets().size() + 1) << lamp.name;
  }
}

TEST(PresetTable, AnEngineOfReportsIsReadBackOrHasAnEmissionLaw) {
  for (const PresetTarget* target : ReportTargets()) {
    EXPECT_TRUE(target->reader != nullptr || target->emission != nullptr) << target->name;
    EXPECT_EQ(target->reader != nullptr, !target->ending.empty()) << target->name;
    EXPECT_FALSE(target->numbers.empty()) << target->name;
    EXPECT_FALSE(target->title.empty()) << target->name;
  }
}

}  // namespace
}  // namespace lightcal::test
