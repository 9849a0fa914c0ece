// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/captures/bracket_plan.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightcal::devices {
namespace {

double TimeOf(const char* label) {
  const auto time = TimeOfChoice(label);
  return time ? time->time.value() : 0.0;
}

TEST(ShutterChoice, StandsForTheTimeOnTheThirdStopGrid) {
  EXPECT_DOUBLE_EQ(TimeOf("1/60"), std::exp2(-6));
  EXPECT_DOUBLE_EQ(TimeOf("0.0166s"), std::exp2(-6));  // libgphoto2 of a camera at 1/60
  EXPECT_DOUBLE_EQ(TimeOf("1/8000"), std::exp2(-13));
  EXPECT_DOUBLE_EQ(TimeOf("30"), std::exp2(5));
  EXPECT_DOUBLE_EQ(TimeOf("30.0000s"), std::exp2(5));
  EXPECT_DOUBLE_EQ(TimeOf("0,5"), 0.5);
  EXPECT_DOUBLE_EQ(TimeOf("13/10"), std::exp2(1.0 / 3.0));
  EXPECT_DOUBLE_EQ(TimeOf("2 s"), 2.0);
  EXPECT_DOUBLE_EQ(TimeOf("1.3\""), std::exp2(1.0 / 3.0));
  // 1/800 in tenths of a millisecond: one third stop within the rounding.
  EXPECT_DOUBLE_EQ(TimeOf("0.0012s"), std::exp2(-29.0 / 3.0));
  // 1/8000 so: four third stops within it, taken as written.
  EXPECT_DOUBLE_EQ(TimeOf("0.0001s"), 0.0001);
  EXPECT_DOUBLE_EQ(TimeOfChoice("0.0001s")->rounding.value(), 0.00005);
  EXPECT_DOUBLE_EQ(TimeOf("1/48"), 1.0 / 48);  // on no dial: meant as written
}

TEST(ShutterChoice, WhatIsNoTimeIsAbsent) {
  for (const char* label : {"Bulb", "bulb", "Auto", "", "Time", "x 200", "1/0", "0/1", "-1", "nan",
                            "1e9", "4294967295", "1/", "/60", "1/60/2"}) {
    EXPECT_FALSE(TimeOfChoice(label)) << label;
  }
}

TEST(CameraChoice, ReadsFNumbersAndSpeeds) {
  EXPECT_EQ(FNumberOfChoice("f/5.6"), 5.6);
  EXPECT_EQ(FNumberOfChoice("5.6"), 5.6);
  EXPECT_EQ(FNumberOfChoice("F8"), std::nullopt);
  EXPECT_EQ(FNumberOfChoice("Auto"), std::nullopt);
  EXPECT_EQ(IsoOfChoice("100"), 100.0);
  EXPECT_EQ(IsoOfChoice("ISO 100"), 100.0);
  EXPECT_EQ(IsoOfChoice("Auto ISO"), std::nullopt);
}

// Menus of a Canon EOS, a Nikon and a Sony, as libgphoto2 words them.
TEST(RawFormat, IsTheOneThatMakesRawAlone) {
  EXPECT_EQ(RawFormat({"Large Fine JPEG", "RAW + Large Fine JPEG", "cRAW", "RAW", "mRAW"}), "RAW");
  EXPECT_EQ(RawFormat({"JPEG Basic", "JPEG Fine", "NEF (Raw)", "NEF+Basic"}), "NEF (Raw)");
  EXPECT_EQ(RawFormat({"Standard", "Fine", "RAW", "RAW+JPEG"}), "RAW");
  EXPECT_EQ(RawFormat({"Fine", "RAW+JPEG (Fine)"}), "RAW+JPEG (Fine)");
  EXPECT_EQ(RawFormat({"Fine", "Normal"}), std::nullopt);
}

TEST(Bracket, IsHalfARangeAndAStep) {
  for (const char* text :
       {"±4EV/1EV", "+-4EV/1EV", "+/-4EV/1EV", "4EV/1EV", "4/1", "4 ev / 1 ev"}) {
    const auto range = ParseBracket(text);
    ASSERT_TRUE(range) << text << ": " << range.error().message;
    EXPECT_EQ(range->half_range_ev, 4.0);
    EXPECT_EQ(range->step_ev, 1.0);
  }
  EXPECT_DOUBLE_EQ(ParseBracket("2EV/1/3EV")->step_ev, 1.0 / 3.0);
  for (const char* text :
       {"", "4", "4EV", "4EV/0EV", "0/1", "4/-1", "30/1", "10/0.1", "a/b", "1/2"}) {
    const auto range = ParseBracket(text);
    ASSERT_FALSE(range) << text;
    EXPECT_EQ(range.error().kind, ErrorKind::kUsage);
  }
}

const std::vector<std::string> kDial = {
    "Bulb",  "30",    "15",    "8",     "4",      "2",      "1",     "1/2",
    "1/4",   "1/5",   "1/6",   "1/8",   "1/10",   "1/13",   "1/15",  "1/20",
    "1/25",  "1/30",  "1/40",  "1/50",  "1/60",   "1/80",   "1/100", "1/125",
    "1/160", "1/200", "1/250", "1/500", "1/1000", "1/2000", "1/4000"};

std::vector<std::string> Labels(const BracketPlan& plan) {
  std::vector<std::string> labels;
  for (const PlannedFrame& frame : plan.frames) labels.push_back(frame.shutter);
  return labels;
}

TEST(BracketPlan, TakesTheNearestChoiceOfEachStep) {
  const auto plan = PlanBracket(kDial, Seconds(std::exp2(-6)), *ParseBracket("4EV/2EV"));
  ASSERT_TRUE(plan);
  EXPECT_EQ(Labels(*plan), (std::vector<std::string>{"1/1000", "1/250", "1/60", "1/15", "1/4"}));
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_DOUBLE_EQ(plan->frames[i].ev, 2.0 * static_cast<double>(i) - 4.0);
  EXPECT_TRUE(plan->warnings.empty());
}

// On 50 Hz mains whole periods of 10 ms; none is that short below 1/125.
TEST(BracketPlan, PrefersWholePeriodsOfTheLamp) {
  BracketRange range = *ParseBracket("3EV/3EV");
  range.lamps = {{.frequency_hz = 100.0}};
  const auto plan = PlanBracket(kDial, Seconds(std::exp2(-6)), range);
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->frames[1].shutter, "1/50");
  EXPECT_LE(plan->frames[1].flicker, kFlickerSafe);
  EXPECT_GT(plan->frames[0].flicker, kFlickerSafe);
  ASSERT_EQ(plan->warnings.size(), 1U);
  EXPECT_EQ(plan->warnings[0].code, "flicker_unsafe_shutter");
}

TEST(BracketPlan, SaysWhichStepsTheCameraHasNoTimeFor) {
  const auto plan = PlanBracket(kDial, Seconds(1.0 / 2048), *ParseBracket("3EV/1EV"));
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->frames.front().shutter, "1/4000");
  ASSERT_EQ(plan->warnings.size(), 1U);
  EXPECT_EQ(plan->warnings[0].code, "bracket_clipped");
  const auto none = PlanBracket({"Bulb", "1/60"}, Seconds(1.0 / 64), *ParseBracket("3EV/1EV"));
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, "no_bracket");
}

TEST(BracketPlan, UsesNoChoiceTwice) {
  const auto plan =
      PlanBracket({"1/60", "1/30", "1/15"}, Seconds(1.0 / 32), *ParseBracket("1EV/1/3EV"));
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->frames.size(), 3U);
}

}  // namespace
}  // namespace lightcal::devices
