// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/check/engine_answers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "lightcal/presets/check/read_preset.h"
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

// 30 cd: 4 pi 30/683 W. Its file has an IES node, whose own number is the same of every lamp.
TEST(EngineAnswers, BlenderSaysThePowerOfASpotThatItsFileHasAsIes) {
  for (const double candela : {30.0, 728.0}) {
    FittedLight spot = SimpleLight("spot", LightKind::kSpot, candela);
    spot.inner_deg = 10.0;
    spot.outer_deg = 20.0;
    spot.color = {};
    const EngineAnswers answers = EngineAnswersOf(FileOf({spot}));
    const auto figure = std::ranges::find(answers.figures, "Blender", &EngineFigure::engine);
    ASSERT_NE(figure, answers.figures.end());
    EXPECT_EQ(figure->field, "IES · Power of a plain Spot");
    EXPECT_NEAR(std::stod(figure->value) * 683.0 / (4.0 * std::numbers::pi), candela,
                1e-4 * candela);
    EXPECT_THAT(figure->note, ::testing::HasSubstr("0.2604 W"));  // 177.83/683
  }
}

std::string NoteOf(const EngineAnswers& answers, std::string_view engine) {
  const auto figure = std::ranges::find(answers.figures, engine, &EngineFigure::engine);
  return figure == answers.figures.end() ? "" : figure->note;
}

// Axial candela of an area light of P watts: 683 P/pi, before 4.0 683 P/4 (rendered in 3.4).
TEST(EngineAnswers, BlenderSaysThePowerThatAnAreaLightTookBefore4) {
  FittedLight disk = Disk();
  disk.color = {};
  const EngineAnswers answers = EngineAnswersOf(FileOf({disk}));
  const auto figure = std::ranges::find(answers.figures, "Blender", &EngineFigure::engine);
  ASSERT_NE(figure, answers.figures.end());
  EXPECT_NEAR(std::stod(figure->value), std::numbers::pi * 400.0 / 683.0, 1e-4);
  EXPECT_THAT(figure->note, ::testing::HasSubstr("before Blender 4.0 2.343 W"));  // 4 x 400/683
}

TEST(EngineAnswers, ABeamsNumberNamesTheFileThatItGoesWith) {
  IntensityGrid grid{GoniometerType::kC, {0.0}, {}, {}};
  for (int deg = 0; deg <= 180; ++deg) {
    grid.vertical_deg.push_back(deg);
    grid.candela.push_back(1000.0 * std::exp2(-(deg / 18.0) * (deg / 18.0)));
  }
  FittedLight lamp = SimpleLight("beam", LightKind::kPhotometric, 1000.0);
  lamp.distribution = MeasuredDistribution{*IntensityTable::Make(std::move(grid), "beam")};
  const EngineAnswers answers = EngineAnswersOf(FileOf({lamp}));
  EXPECT_THAT(NoteOf(answers, "Unreal Engine"), ::testing::HasSubstr("exported .ies"));
  EXPECT_THAT(NoteOf(answers, "Unreal Engine"), ::testing::HasSubstr("Spot Light, whose cone"));
  EXPECT_THAT(NoteOf(answers, "USD"), ::testing::HasSubstr("exported .ies"));
}

// Godot's shader takes no rim below 1e-4: of such a beam, whose exponent is the smallest, a tenth
// of the light on the axis is missing in it. Read back by the reader's own law.
TEST(EngineAnswers, APeakedBeamHasItsCandelaOnTheAxisInGodot) {
  IntensityGrid grid{GoniometerType::kC, {0.0}, {}, {}};
  for (int deg = 0; deg <= 180; ++deg) {
    grid.vertical_deg.push_back(deg);
    grid.candela.push_back(1000.0 * std::exp(-deg / 6.0));
  }
  FittedLight lamp = SimpleLight("peaked", LightKind::kPhotometric, 1000.0);
  lamp.distribution = MeasuredDistribution{*IntensityTable::Make(std::move(grid), "peaked")};
  const auto preset = FindPresetTarget("godot")->exporter(FileOf({lamp}), "p", {});
  ASSERT_TRUE(preset.has_value());
  const auto nothing_beside = [](const std::string& name) -> Result<std::string> {
    return Failed("not_found", name, "stands not there");
  };
  const PresetFile& scene = preset->files.front();
  const auto lights = LightsOfPreset(scene.name, scene.contents, nothing_beside);
  ASSERT_TRUE(lights.has_value()) << lights.error().message;
  const EngineLight& light = lights->front();
  EXPECT_LT(light.cone_power, 0.4);
  const double lux = LuxAt(light, light.position_m + light.aim * 2.0, light.aim * -1.0);
  EXPECT_NEAR(lux, 250.0, 0.5);
  const EngineAnswers answers = EngineAnswersOf(FileOf({lamp}));
  const auto row = std::ranges::find(answers.parity, "Godot", &ParityRow::engine);
  ASSERT_NE(row, answers.parity.end());
  EXPECT_NEAR(row->engine_lx / row->expected_lx, 1.0, 0.002);
}

// Whoever asks for figures alone gets those of the files, and no file.
TEST(PresetTable, FiguresAloneAreThoseOfTheFiles) {
  const LightFile lights = FileOf({WarmPoint(), Spot(), Disk(), Sun(), WarmDome()});
  PresetOptions figures;
  figures.written = Written::kFigures;
  int derived = 0;
  for (const PresetTarget& target : PresetTargets()) {
    if (target.only_if_named) continue;
    const auto whole = target.exporter(lights, "stem", {});
    const auto alone = target.exporter(lights, "stem", figures);
    ASSERT_TRUE(whole && alone) << target.name;
    ASSERT_EQ(alone->derived.size(), whole->derived.size()) << target.name;
    for (std::size_t i = 0; i < whole->derived.size(); ++i) {
      const DerivedLight& a = alone->derived[i];
      const DerivedLight& b = whole->derived[i];
      EXPECT_EQ(a.type, b.type) << target.name;
      EXPECT_EQ(a.substitution, b.substitution) << target.name;
      ASSERT_EQ(a.fields.size(), b.fields.size()) << target.name;
      for (std::size_t k = 0; k < b.fields.size(); ++k, ++derived) {
        EXPECT_EQ(a.fields[k].name, b.fields[k].name) << target.name;
        EXPECT_EQ(a.fields[k].values, b.fields[k].values) << target.name;
      }
    }
    for (const PresetFile& file : alone->files) {
      EXPECT_TRUE(!file.name.ends_with(".ies") || file.contents.empty()) << file.name;
    }
  }
  EXPECT_GT(derived, 100);
}

TEST(PresetTable, AnEngineOfReportsIsReadBackOrHasAnEmissionLaw) {
  for (const PresetTarget* target : ReportTargets()) {
    EXPECT_TRUE(target->reader != nullptr || target->emission != nullptr) << target->name;
    EXPECT_EQ(target->reader != nullptr, !target->ending.empty()) << target->name;
    EXPECT_FALSE(target->numbers.empty()) << target->name;
    EXPECT_FALSE(target->title.empty()) << target->name;
  }
}

TEST(EngineAnswers, TheCardsOfASpotWithoutAConeSayThatItIsAPoint) {
  FittedLight lamp = Spot();
  lamp.inner_deg.reset();
  lamp.outer_deg.reset();
  const EngineAnswers answers = EngineAnswersOf(FileOf({lamp}));
  ASSERT_FALSE(answers.figures.empty());
  for (const EngineFigure& figure : answers.figures) {
    EXPECT_THAT(figure.note, ::testing::HasSubstr("unknown cone exported as a point"))
        << figure.engine;
  }
}

}  // namespace
}  // namespace lightcal::test
