// SPDX-License-Identifier: Apache-2.0
// The study on calibrations whose cost and error are known by construction.
#include "lightcal/tradeoff/study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <stdexcept>

namespace lightcal::tradeoff {
namespace {

// A made-up session: each knob's level has a price and an error; times jitter by 2 %.
struct Invented {
  double sd = 0.02;           // of ln strength
  double none_error = 0.03;   // effects = none
  double auto_error = 2e-4;   // effects = auto
  double pixel_error = 4e-4;  // a quarter of the pixels
  double check_error = 0.0;   // of the independent reference
  double draws_error = 0.0;   // of the interval, relative, by 1000 draws
  double check_draws_error = 0.0;
  std::mt19937_64 random{1};

  Outcome operator()(const AccuracyProfile& p) {
    std::normal_distribution<double> jitter(1.0, 0.02);
    Outcome out;
    LightFigures light;
    light.name = "key";
    light.sd_ln = sd;
    light.ln_strength = 6.0;
    if (p.effects == "none") light.ln_strength += none_error;
    if (p.effects == "auto") light.ln_strength += auto_error;
    if (p.pictures.pixel_stride == 4) light.ln_strength -= pixel_error;
    if (p.estimator.bounce_patches == 64) light.ln_strength += check_error;
    if (p.estimator.interval_samples == 1000) light.sd_ln *= 1.0 + draws_error;
    if (p.estimator.interval_samples == 50000) light.sd_ln *= 1.0 + check_draws_error;
    light.mired = 300.0 + (p.cct_method == CctMethod::kMcCamy ? 2.0 : 0.0);
    light.sd_mired = 3.0;
    out.lights = {light};
    const double pictures = 0.080 / (p.pictures.pixel_stride * p.pictures.pixel_stride) + 0.010;
    const double fit = p.effects == "all" ? 0.030 : p.effects == "auto" ? 0.010 : 0.001;
    const double solve = p.estimator.solver == SolverChoice::kFull ? 0.010 : 0.002;
    out.seconds = {0.001 * jitter(random), 0.0005, pictures * jitter(random),
                   (fit + solve) * jitter(random), 0.002 * jitter(random)};
    return out;
  }
};

Runner RunnerOf(Invented& session) {
  return [&session](const AccuracyProfile& p) -> Result<Outcome> { return session(p); };
}

const SweepRow& RowOf(const Study& study, std::string_view knob, std::string_view level) {
  for (const SweepRow& row : study.rows) {
    const Knob& k = Knobs()[row.knob];
    if (k.name == knob && k.levels[row.setting.levels[row.knob]] == level) return row;
  }
  throw std::runtime_error("no such row");
}

TEST(Study, LabelsByTheSessionsOwnUncertainty) {
  Invented session;
  const auto study = StudyTradeoff(RunnerOf(session), {}, {});
  ASSERT_TRUE(study) << study.error().message;
  std::size_t rows = 0;  // every level of every knob but the usual one
  for (const Knob& knob : Knobs()) rows += knob.levels.size() - 1;
  EXPECT_EQ(study->rows.size(), rows);
  const SweepRow& none = RowOf(*study, "effects", "none");
  EXPECT_EQ(none.setting.verdict, Verdict::kCosts);
  EXPECT_NEAR(none.setting.error.relative, 0.03, 1e-12);
  EXPECT_NEAR(none.setting.error.over_u, 1.5, 1e-9);
  EXPECT_EQ(none.setting.error.quantity, "strength");
  EXPECT_EQ(none.setting.error.light, "key");
  EXPECT_EQ(RowOf(*study, "pixels", "quarter").setting.verdict, Verdict::kFree);
  const SweepRow& mccamy = RowOf(*study, "cct_method", "mccamy");
  EXPECT_EQ(mccamy.setting.verdict, Verdict::kCosts);  // 2 mired of u = 3
  EXPECT_NEAR(mccamy.setting.error.relative, 0.02, 1e-12);
  EXPECT_EQ(mccamy.setting.error.quantity, "colour temperature");
  EXPECT_FALSE(RowOf(*study, "frames", "half").in_play);
  EXPECT_TRUE(RowOf(*study, "effects", "all").in_play);
  EXPECT_LT(RowOf(*study, "effects", "all").times_faster, 1.0);
}

TEST(Study, RecommendsTheCheapestThatMeetsTheTolerance) {
  Invented session;
  const auto study = StudyTradeoff(RunnerOf(session), {}, {});
  ASSERT_TRUE(study);
  const AccuracyProfile& best = study->recommended.measured.profile;
  EXPECT_EQ(best.pictures.pixel_stride, 4);
  EXPECT_EQ(best.effects, "auto");  // none would be 3 % off
  EXPECT_NE(best.cct_method, CctMethod::kMcCamy);
  EXPECT_LE(study->recommended.error.relative, study->allowed_relative);
  EXPECT_NEAR(study->allowed_relative, 0.02 / 3.0, 1e-9);
  EXPECT_TRUE(study->meter_limits);
}

// Whatever saves less than a tenth of the run is left as it is.
TEST(Study, NothingIsRecommendedForASmallSaving) {
  Invented session;
  const Runner run = [&](const AccuracyProfile& p) -> Result<Outcome> {
    Outcome out = session(p);
    const double saved = p.pictures.pixel_stride == 4 ? 0.08 : 0.0;
    out.seconds = {0.0, 0.0, 0.1 * (1.0 - saved), 0.0, 0.0};
    return out;
  };
  Question question;
  question.knobs = {"pixels", "solver"};
  const auto little = StudyTradeoff(run, question, {});
  ASSERT_TRUE(little) << little.error().message;
  EXPECT_TRUE(RowOf(*little, "pixels", "quarter").in_play);
  EXPECT_EQ(NameOf(little->recommended.levels), "as usual");
  EXPECT_EQ(little->saved_share, 0.0);
  EXPECT_EQ(KnobsNotInPlay(*little), std::vector<std::string_view>{"solver"});
}

TEST(Study, TheShareSavedIsMeasuredBesideTheUsualSetting) {
  Invented session;
  const auto study = StudyTradeoff(RunnerOf(session), {}, {});
  ASSERT_TRUE(study);
  // Of 103.5 ms: a quarter of the pixels 75, a solver that is none 8 at most.
  EXPECT_GT(study->saved_share, 0.70);
  EXPECT_LT(study->saved_share, 0.85);
}

// On a busy machine, where the quartiles of every setting's runs overlap, medians still part.
TEST(Study, RunsThatScatterDoNotMakeADearSettingPassForCheap) {
  Invented session;
  session.pixel_error = 2e-3;  // within u/3, and further off than as usual
  std::mt19937_64 random(5);
  std::normal_distribution<double> scatter(1.0, 0.5);
  const Runner run = [&](const AccuracyProfile& p) -> Result<Outcome> {
    Outcome out = session(p);
    const double pictures = p.pictures.pixel_stride == 4 ? 0.0065 : 0.010;
    out.seconds = {0.0, 0.0, pictures * std::max(0.1, scatter(random)), 0.0, 0.0};
    return out;
  };
  Question question;
  question.knobs = {"pixels"};
  const auto study = StudyTradeoff(run, question, {});
  ASSERT_TRUE(study);
  const SweepRow& quarter = RowOf(*study, "pixels", "quarter");
  ASSERT_TRUE(TimesOverlap(quarter.setting.measured.times, study->usual.measured.times));
  EXPECT_EQ(study->recommended.measured.profile.pictures.pixel_stride, 4);
}

TEST(Study, AWideToleranceOfAPoorMeterTakesMore) {
  Invented session;
  session.sd = 0.2;
  Question question;
  question.tolerance_relative = 0.05;
  const auto study = StudyTradeoff(RunnerOf(session), question, {});
  ASSERT_TRUE(study);
  EXPECT_EQ(study->recommended.measured.profile.effects, "none");
  EXPECT_FALSE(study->meter_limits);
}

TEST(Study, ABudgetBuysTheMostAccurateWithinIt) {
  Invented session;
  Question question;
  question.budget_s = 0.040;
  const auto study = StudyTradeoff(RunnerOf(session), question, {});
  ASSERT_TRUE(study) << study.error().message;
  EXPECT_LE(study->recommended.measured.times.total, 0.040);
  EXPECT_LE(study->recommended.error.relative, 0.001);
  question.budget_s = 0.001;
  const auto refused = StudyTradeoff(RunnerOf(session), question, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "no_setting");
}

// An interval that only every effect and draws together tell: all others are half as wide.
TEST(Study, TheStrictestIsTakenWhereNoOtherHolds) {
  Invented session;
  const Runner run = [&](const AccuracyProfile& p) -> Result<Outcome> {
    Outcome out = session(p);
    const bool told = p.effects == "all" && p.estimator.interval_samples >= 50000;
    if (!told) out.lights.front().sd_ln *= 0.5;
    return out;
  };
  const auto study = StudyTradeoff(run, {}, {});
  ASSERT_TRUE(study) << study.error().message;
  EXPECT_EQ(study->recommended.measured.profile.effects, "all");
  EXPECT_EQ(study->recommended.measured.profile.estimator.interval_samples, 100000);
  EXPECT_EQ(study->saved_share, 0.0);
  Question question;
  question.knobs = {"pixels"};
  const auto refused = StudyTradeoff(run, question, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "no_setting");
  EXPECT_NE(refused.error().message.find("95 % interval 50 % too narrow"), std::string::npos)
      << refused.error().message;
}

TEST(Study, ReferencesThatDisagreeAreNone) {
  Invented session;
  session.check_error = 2e-4;  // more than a hundredth of 1 %
  const auto study = StudyTradeoff(RunnerOf(session), {}, {});
  ASSERT_FALSE(study);
  EXPECT_EQ(study.error().code, "no_reference");
  Question wider;
  wider.tolerance_relative = 0.03;
  EXPECT_TRUE(StudyTradeoff(RunnerOf(session), wider, {}));
}

TEST(Study, AnIntervalIsHeldAgainstItsOwnWidth) {
  Invented session;
  session.draws_error = 0.05;
  const auto study = StudyTradeoff(RunnerOf(session), {}, {});
  ASSERT_TRUE(study) << study.error().message;
  const Setting& few = RowOf(*study, "intervals", "1000 draws").setting;
  EXPECT_NEAR(few.error.relative, 2e-4, 1e-12) << "of the value, as usual";
  EXPECT_NEAR(few.u_change, 0.05, 1e-9);
  EXPECT_NEAR(few.error.over_u, 0.05, 1e-9);
  EXPECT_EQ(few.verdict, Verdict::kFree);
  session.draws_error = -0.4;
  const auto narrow = StudyTradeoff(RunnerOf(session), {}, {});
  ASSERT_TRUE(narrow);
  const SweepRow& row = RowOf(*narrow, "intervals", "1000 draws");
  EXPECT_EQ(row.setting.verdict, Verdict::kCosts);
  EXPECT_NEAR(row.setting.u_change, -0.4, 1e-9);
  EXPECT_TRUE(row.in_play);
}

TEST(Study, DrawsThatDisagreeAboutAnIntervalAreNoReference) {
  Invented session;
  session.check_draws_error = 0.015;
  EXPECT_TRUE(StudyTradeoff(RunnerOf(session), {}, {}));
  session.check_draws_error = 0.025;
  const auto study = StudyTradeoff(RunnerOf(session), {}, {});
  ASSERT_FALSE(study);
  EXPECT_EQ(study.error().code, "no_reference");
  EXPECT_NE(study.error().message.find("95 % interval at widths 2.5 %"), std::string::npos)
      << study.error().message;
}

TEST(Study, ARefusalNamesWhatLimits) {
  Invented session;
  const Runner run = [&](const AccuracyProfile& p) -> Result<Outcome> {
    Outcome out = session(p);
    out.lights.front().limit = "readings (90 % of the variance)";
    return out;
  };
  Question question;
  question.budget_s = 0.001;
  const auto refused = StudyTradeoff(run, question, {});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("the time goes into pictures"), std::string::npos)
      << refused.error().message;
  EXPECT_NE(refused.error().message.find("key comes mostly from readings (90 %"), std::string::npos)
      << refused.error().message;
}

TEST(Study, OnlyTheKnobsAskedForMove) {
  Invented session;
  Question question;
  question.knobs = {"pixels", "solver"};
  const auto study = StudyTradeoff(RunnerOf(session), question, {});
  ASSERT_TRUE(study);
  EXPECT_EQ(study->rows.size(), 7U);
  question.knobs = {"pixles"};
  const auto wrong = StudyTradeoff(RunnerOf(session), question, {});
  ASSERT_FALSE(wrong);
  EXPECT_NE(wrong.error().message.find("pixels"), std::string::npos);
}

// The steps of spectra that no reading has: no answer changes, nor a stage of .5 % of the time.
TEST(Study, WhatCannotMatterIsRunOnce) {
  Invented session;
  std::map<double, int> runs_by_step;
  int of_quarter_pixels = 0;
  const Runner run = [&](const AccuracyProfile& p) -> Result<Outcome> {
    ++runs_by_step[p.spectral_step_nm];
    of_quarter_pixels += p.pictures.pixel_stride == 4 ? 1 : 0;
    return session(p);
  };
  Question question;
  question.knobs = {"pixels", "spectral_step"};
  const auto study = StudyTradeoff(run, question, {});
  ASSERT_TRUE(study);
  EXPECT_GE(of_quarter_pixels, question.alone.least_runs);
  const double usual = study->usual.measured.profile.spectral_step_nm;
  int steps = 0;
  for (const auto& [step_nm, runs] : runs_by_step) {
    if (step_nm == usual) continue;
    EXPECT_EQ(runs, 1) << step_nm;
    ++steps;
  }
  EXPECT_GE(steps, 2);
  for (const SweepRow& row : study->rows) {
    if (Knobs()[row.knob].name != "spectral_step") continue;
    EXPECT_FALSE(row.in_play);
    EXPECT_EQ(row.saves_s, 0.0);
    EXPECT_GT(row.setting.measured.times.total, 0.0);
  }
}

TEST(Study, StopsWhenAsked) {
  Invented session;
  int runs = 0;
  Watch watch;
  watch.stopped = [&] { return ++runs > 40; };
  const auto study = StudyTradeoff(RunnerOf(session), {}, watch);
  ASSERT_FALSE(study);
  EXPECT_EQ(study.error().code, "interrupted");
}

TEST(Study, TheParetoSetRisesInTimeAndFallsInError) {
  Invented session;
  const auto study = StudyTradeoff(RunnerOf(session), {}, {});
  ASSERT_TRUE(study);
  std::vector<const Setting*> all = {&study->usual};
  for (const SweepRow& row : study->rows) all.push_back(&row.setting);
  for (const Setting& one : study->combinations) all.push_back(&one);
  const auto pareto = ParetoOf(*study);
  ASSERT_GE(pareto.size(), 2U);
  for (std::size_t i = 1; i < pareto.size(); ++i) {
    const Setting &before = *all[pareto[i - 1]], &after = *all[pareto[i]];
    EXPECT_LE(before.measured.times.total, after.measured.times.total);
    EXPECT_GT(before.error.relative, after.error.relative);
  }
  for (const Setting* one : all) {
    const bool beaten = std::ranges::any_of(pareto, [&](std::size_t i) {
      return all[i]->measured.times.total <= one->measured.times.total &&
             all[i]->error.relative <= one->error.relative;
    });
    EXPECT_TRUE(beaten) << NameOf(one->levels);
  }
}

}  // namespace
}  // namespace lightcal::tradeoff
