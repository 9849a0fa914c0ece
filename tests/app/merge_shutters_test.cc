// SPDX-License-Identifier: Apache-2.0
// lightcal merge under lamps that flicker.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "merge_brackets.h"

namespace lightcal {
namespace {

using nlohmann::json;
using namespace test::merge;  // the words of these tests
using test::SyntheticCamera;
using ::testing::HasSubstr;
using ::testing::Not;

std::string MessageOf(const json& answer, const std::string& code) {
  for (const json& warning : answer.value("warnings", json::array())) {
    if (warning["code"] == code) return warning["message"];
  }
  return "";
}

class Shutters : public testing::Test {
 protected:
  // Frames a stop apart, true times on the third stop grid.
  json Merge(double shortest_s, Words more = {}) {
    const SyntheticCamera camera = Camera(96, 64);
    const auto series = test::ExposureSeries(shortest_s, 3, 1.0, 8.0, 0.0, 5);
    files_ = ShootAll(folder_, camera, series, Wedge(camera).Scene());
    more.emplace_back("--force");
    return MergeJson(files_, output_, more);
  }
  test::TempDir folder_;
  std::string output_ = folder_.path() + "/lum.exr";
  Words files_;
};

constexpr double kHundredth = 1.0 / 101.59366732596479;  // what a dial calls 1/100: 2^(-20/3) s

TEST_F(Shutters, ShorterThanTheLampsPeriodAreNamedWithSafeOnes) {
  const std::string message = MessageOf(Merge(1.0 / 1024), "flicker_unsafe_shutter");
  EXPECT_THAT(message, HasSubstr("3 of 3 frames"));
  EXPECT_THAT(message, HasSubstr("100 %"));
  EXPECT_THAT(message, HasSubstr("1/1000"));
  EXPECT_THAT(message, HasSubstr("at 100 Hz: 1/100 1/50 1/25"));
  EXPECT_THAT(message, HasSubstr("at 120 Hz: 1/40 1/20 1/10"));
}

// Two periods at 1/50 of 50 Hz mains; 2.4 at 60 Hz.
TEST_F(Shutters, ThoseOfOneMainsPassWhileNobodySaysWhich) {
  EXPECT_FALSE(Warns(Merge(kHundredth), "flicker_unsafe_shutter"));
  EXPECT_FALSE(Warns(Merge(kHundredth, {"--mains", "50"}), "flicker_unsafe_shutter"));
  const std::string message =
      MessageOf(Merge(kHundredth, {"--mains", "60"}), "flicker_unsafe_shutter");
  EXPECT_THAT(message, HasSubstr("at 120 Hz"));
  EXPECT_THAT(message, Not(HasSubstr("at 100 Hz")));
}

TEST_F(Shutters, DaylightDoesNotFlicker) {
  EXPECT_FALSE(Warns(Merge(1.0 / 1024, {"--mains", "none"}), "flicker_unsafe_shutter"));
}

TEST_F(Shutters, ADimmedLedHasItsOwnPeriod) {
  const Words dimmed = {"--mains", "none", "--pwm", "400Hz"};
  EXPECT_FALSE(Warns(Merge(kHundredth, dimmed), "flicker_unsafe_shutter"));
  const Words dark = {"--mains", "none", "--pwm", "400,0.1"};
  EXPECT_THAT(MessageOf(Merge(kHundredth, dark), "flicker_unsafe_shutter"), HasSubstr("at 400 Hz"));
}

TEST_F(Shutters, StrictRefusesAndNonsenseIsWrongUsage) {
  static_cast<void>(Merge(1.0 / 1024));
  const auto exit_code = [&](const Words& more) {
    return test::RunLightcal(MergeWords(files_, folder_.path() + "/none.exr", more)).exit_code;
  };
  EXPECT_EQ(exit_code({"--strict"}), 3);
  EXPECT_EQ(exit_code({"--strict", "--mains", "none"}), 0);
  for (const Words& wrong : std::vector<Words>{
           {"--mains", "55"}, {"--pwm", "fast"}, {"--pwm", "400,2"}, {"--pwm", "-1"}}) {
    EXPECT_EQ(exit_code(wrong), 2) << wrong[1];
  }
}

}  // namespace
}  // namespace lightcal
