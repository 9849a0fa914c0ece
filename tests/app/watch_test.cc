// SPDX-License-Identifier: Apache-2.0
// lightcal watch: what it says of a series of readings, on a terminal and off it.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>

#include "guide/watch_series.h"
#include "guide/watch_view.h"
#include "run_cli.h"
#include "terminal_dialogue.h"
#include "usb_stand_in.h"

namespace lightcal::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

Reading ReadingOf(double lux) {
  Reading reading;
  reading.illuminance = Lux(lux);
  return reading;
}

// Ten readings a second for twenty seconds.
app::Steadiness SteadinessOf(double depth, double ripple_hz, double drift_per_minute) {
  app::WatchSeries series;
  for (int i = 0; i < 200; ++i) {
    const double seconds = 0.1 * i;
    const double drift = drift_per_minute * (seconds - 9.95) / 60.0;
    const double ripple = depth * std::sin(2.0 * std::numbers::pi * ripple_hz * seconds);
    series.Add(ReadingOf(400.0 * (1.0 + drift + ripple)), seconds);
  }
  return series.Steady();
}

TEST(WatchSeries, ARippleHasItsDepthAndIsNoDrift) {
  constexpr double kDepth = 0.05;
  const app::Steadiness steady = SteadinessOf(kDepth, 0.5, 0.0);
  EXPECT_NEAR(steady.mean_lx, 400.0, 1e-9);
  EXPECT_NEAR(*steady.modulation, kDepth, 1e-9);
  EXPECT_NEAR(*steady.scatter_relative, kDepth / std::numbers::sqrt2, 2e-4);
  EXPECT_FALSE(steady.drift_per_minute_relative);
  EXPECT_NEAR(*steady.rate_hz, 10.0, 1e-6);
  EXPECT_THAT(app::PaceText(steady), HasSubstr("slower than 5.0 Hz, not the mains'"));
}

TEST(WatchSeries, ADriftIsToldFromTheRippleOnIt) {
  // Fifty whole periods of sin: their own slope changes the ends by 3 depth/(50 pi).
  constexpr double kDepth = 0.002;
  const app::Steadiness steady = SteadinessOf(kDepth, 2.5, 0.5);
  EXPECT_NEAR(*steady.modulation, kDepth, 3.0 * kDepth / (50.0 * std::numbers::pi) + 1e-6);
  EXPECT_NEAR(*steady.drift_per_minute_relative, 0.5, 1e-3);
}

TEST(WatchSeries, ATapeHasNoPaceAndSaysNone) {
  app::WatchSeries series;
  for (const double lux : {100.0, 110.0, 100.0, 110.0}) series.Add(ReadingOf(lux), std::nullopt);
  const app::Steadiness steady = series.Steady();
  EXPECT_FALSE(steady.rate_hz);
  EXPECT_FALSE(steady.drift_per_minute_relative);
  EXPECT_EQ(app::PaceText(steady), "");
}

TEST(WatchSeries, OldReadingsAreForgottenAndCounted) {
  app::WatchSeries series;
  for (int i = 0; i < 1000; ++i) series.Add(ReadingOf(i < 700 ? 5.0 : 9.0), 1.0 * i);
  EXPECT_EQ(series.count(), 1000);
  EXPECT_EQ(series.readings().size(), app::WatchSeries::kWindow);
  EXPECT_EQ(series.Steady().least_lx, 9.0);
}

TEST(WatchView, ASparklineRisesFromLeastToMost) {
  const std::vector<double> rise = {1, 2, 3, 4, 5, 6, 7, 8};
  EXPECT_EQ(app::Sparkline(rise), "▁▂▃▄▅▆▇█");
  const std::vector<double> steady = {400.0, 400.01, 400.0};
  EXPECT_EQ(app::Sparkline(steady), "▅▅▅") << "noise of 0.003 % is no mountain";
  EXPECT_EQ(app::Sparkline({}), "");
}

TEST(Watch, OffATerminalEachReadingIsALineAndTheEndASummary) {
  const CliResult result =
      RunLightcal({"watch", "--device", "line:!while true; do echo 100,3000; echo 110,3010; done",
                   "--count", "40"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("1: 100.00 lx  3000 K\n"));
  EXPECT_THAT(result.out, HasSubstr("40: 110.00 lx  3010 K\n"));
  EXPECT_THAT(result.out, HasSubstr("▁█▁█"));
  EXPECT_THAT(result.out, Not(HasSubstr("\x1b")));
}

TEST(Watch, JsonIsOneDocumentWithTheModulation) {
  const CliResult result =
      RunLightcal({"watch", "--json", "--device", "line:!while true; do echo 100; echo 110; done",
                   "--count", "40"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json answer = json::parse(result.out);
  EXPECT_EQ(answer["readings"], 40);
  EXPECT_EQ(answer["illuminance_lx"]["mean"], 105.0);
  EXPECT_NEAR(double(answer["modulation"]), 10.0 / 210.0, 1e-9);
  EXPECT_GT(double(answer["rate_hz"]), 1.0);
}

TEST(Watch, TheLampsIntensityIsFittedWithTheSessionsReadings) {
  const TempDir home;
  home.Write("s/session.toml",
             "lightcal = 1\n[room]\ndark = true\n[[light]]\nname = \"key\"\nkind = \"point\"\n"
             "[[reading]]\nlight = \"key\"\ndistance_m = 0.5\nilluminance_lx = 400\n"
             "[[reading]]\nlight = \"key\"\ndistance_m = 2\nilluminance_lx = 25\n");
  const CliResult result =
      RunLightcal({"watch", "--json", "-s", home.path() + "/s", "--light", "key", "--distance",
                   "1m", "--device", "line:!yes 100", "--count", "5"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NEAR(double(json::parse(result.out)["intensity_cd"]["value"]), 100.0, 1.0);
  EXPECT_FALSE(std::filesystem::exists(home.path() + "/s/readings.jsonl")) << "it only looks";
}

TEST(Watch, ATapeIsPlayedToItsEnd) {
  const CliResult result =
      RunLightcal({"watch", "--json", "--replay", SampleData("tapes/line_192lx.tape")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json answer = json::parse(result.out);
  EXPECT_EQ(answer["readings"], 1);
  EXPECT_EQ(answer["illuminance_lx"]["last"], 192.0);
  EXPECT_EQ(answer["cct_K"], 5600.0);
}

TEST(Watch, OnATerminalOneBlockIsDrawnOverItselfUntilCtrlC) {
  const TempDir home;
  TerminalDialogue watch({"watch", "--device", "line:!yes 192"}, home.path());
  ASSERT_TRUE(watch.WaitFor("192.00 lx")) << watch.transcript();
  ASSERT_TRUE(watch.WaitFor("\x1b[3A")) << watch.transcript();
  watch.Press('\x03');
  EXPECT_EQ(watch.Finish(), 0) << watch.transcript();
  EXPECT_THAT(watch.transcript(), HasSubstr("flicker < 0.01 %"));
}

TEST(Watch, ForATimeAndWrongWords) {
  EXPECT_EQ(RunLightcal({"watch", "--device", "line:!yes 192", "--for", "300ms"}).exit_code, 0);
  EXPECT_EQ(RunLightcal({"watch", "--device", "line:!yes 192", "--for", "0s"}).exit_code, 2);
  EXPECT_EQ(RunLightcal({"watch", "--device", "line:!yes 192", "--distance", "1m"}).exit_code, 2);
  const NoUsb machine;
  EXPECT_EQ(RunLightcal({"watch"}).exit_code, 1);
}

}  // namespace
}  // namespace lightcal::test
