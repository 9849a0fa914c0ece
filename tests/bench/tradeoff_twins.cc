// SPDX-License-Identifier: Apache-2.0
// Does what `tradeoff` recommends hold? Synthetic twins: lux sessions as those of the suite, and a
// few tiny brackets. Of each, five knobs: the study, then every combination of them measured.
//   lightcal_tradeoff_twins [LUX_SESSIONS [BRACKETS [SEED [ONLY]]]]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "lightcal/calibrate/session_twin.h"
#include "lightcal/core/processor_time.h"
#include "lightcal/tradeoff/study.h"
#include "lightcal_devices/disk_sources.h"
#include "lux_twin.h"
#include "run_cli.h"
#include "synthetic_dng.h"
#include "twin_judge.h"

namespace lightcal::test {
namespace {

constexpr double kTolerance = 0.02;
constexpr double kBarCost = 1.5;       // times the cheapest
constexpr std::size_t kFinalists = 8;  // of the brute force, measured again beside the study's
constexpr tradeoff::TimingRules kScan{.least_runs = 2, .most_runs = 2, .seconds = 0.1};
constexpr tradeoff::TimingRules kFinal{.least_runs = 11, .most_runs = 11, .seconds = 0.1};

struct Twin {
  std::string session;  // path
  std::vector<std::string> knobs;
  double intensity_cd = 0.0;
  bool in_room = false;
};

Twin LuxTwinIn(const TempDir& folder, const std::vector<TracedRoom>& rooms,
               std::mt19937_64& random) {
  const LuxTwin twin = RandomLuxTwin(rooms, random);
  return {folder.Write("twin.toml", twin.toml),
          {"effects", "source_model", "bounce_patches", "solver", "rejection"},
          twin.intensity_cd,
          twin.in_room};
}

// A grey card before black cloth, 160 x 120 pixels, three to five frames.
Twin BracketTwinIn(const TempDir& folder, std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const double intensity_cd = std::pow(10.0, 2.2 + 0.8 * share(random));
  const double distance_m = 0.6 + share(random);
  const double lux = intensity_cd / (distance_m * distance_m);
  SyntheticCamera camera;
  camera.width = 160;
  camera.height = 120;
  camera.prnu_relative = 0.005;
  const auto scene = [&](int x, int y) {
    const bool card = x >= 40 && x < 120 && y >= 30 && y < 90;
    const double reflectance = card ? 0.18 : 0.03;
    return XyzOf(reflectance * lux / std::acos(-1.0), 0.4369, 0.4041);
  };
  const int frames = 3 + static_cast<int>(3.0 * share(random));
  // The middle frame puts the card at a third of what saturates.
  const SyntheticExposure second{.true_time_s = 1.0,
                                 .label_time_s = 1.0,
                                 .true_f_number = 4.0,
                                 .label_f_number = 4.0,
                                 .iso = 100.0,
                                 .filter = {1.0, 1.0, 1.0},
                                 .apex_tags = false,
                                 .seed = 1};
  const double middle_s = SaturatingNits(camera, second) / (3.0 * 0.18 * lux / std::acos(-1.0));
  auto series =
      ExposureSeries(middle_s * std::pow(2.0, -(frames - 1) / 2), frames, 1.0, 4.0, 0.01, random());
  WriteDngBracket(folder.path(), "card", camera, series, scene);
  const std::string toml =
      "lightcal = 1\nname = \"bracket twin\"\n[[light]]\nname = \"key\"\nkind = \"point\"\n"
      "[[capture]]\nlight = \"key\"\nframes = \"card*.dng\"\nuse = \"card\"\nreflectance = 0.18\n"
      "rect = [48, 36, 64, 48]\ndistance_m = " +
      std::to_string(distance_m) + "\n";
  return {folder.Write("twin.toml", toml),
          {"frames", "pixels", "exposure_ratios", "frame_checks", "solver"},
          intensity_cd,
          false};
}

struct Combination {
  std::vector<std::size_t> levels;
  AccuracyProfile profile;
};

// Every combination of the twin's knobs, at most the four coarsest levels of each.
std::vector<Combination> EveryCombination(const Twin& twin) {
  std::vector<Combination> all(1);
  all[0].profile.tolerance_relative = kTolerance;
  for (const tradeoff::Knob& knob : tradeoff::Knobs()) {
    const bool moved = std::ranges::find(twin.knobs, knob.name) != twin.knobs.end();
    const std::size_t levels = knob.levels.size();
    const std::size_t first = !moved ? knob.usual : levels > 4 ? levels - 4 : 0;
    const std::size_t last = moved ? levels - 1 : knob.usual;
    std::vector<Combination> more;
    for (std::size_t level = first; level <= last; ++level) {
      for (Combination one : all) {
        one.levels.push_back(level);
        knob.set(one.profile, level);
        more.push_back(std::move(one));
      }
    }
    all = std::move(more);
  }
  return all;
}

// Against the lamps themselves: how many 95 % intervals hold them, and errors of ln I.
struct Truths {
  int held = 0;
  std::vector<double> errors;

  void Add(const tradeoff::LightFigures& got, double intensity_cd) {
    const double off = got.ln_strength - std::log(intensity_cd);
    held += std::abs(off) <= 1.96 * got.sd_ln ? 1 : 0;
    errors.push_back(std::abs(off));
  }
};

struct Tally {
  int twins = 0, refused = 0, meets = 0, cheap = 0;
  Truths dark, dark_strict, room, room_strict;
  std::vector<double> cost;  // recommended over cheapest
};

double Percent(int part, int whole) { return whole > 0 ? 100.0 * part / whole : 0.0; }

// Of the settings that hold, those with the least sum of stage medians, by a quick scan.
std::vector<Combination> Finalists(const tradeoff::Runner& run, const Twin& twin,
                                   const tradeoff::LightFigures& strict) {
  std::vector<Combination> all = EveryCombination(twin);
  // The first may not refuse.
  std::vector<AccuracyProfile> profiles = {StrictestByHand(kTolerance)};
  for (const Combination& one : all) profiles.push_back(one.profile);
  const auto scanned = tradeoff::MeasureInTurn(run, profiles, kScan, {});
  if (!scanned) return {};
  std::vector<std::pair<double, std::size_t>> good;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const tradeoff::Measured& one = (*scanned)[i + 1];
    if (one.refused || !Holds(strict, one.lights.front(), kTolerance)) continue;
    good.emplace_back(one.times.total, i);
  }
  std::ranges::sort(good);
  std::vector<Combination> best;
  for (std::size_t i = 0; i < std::min(kFinalists, good.size()); ++i) {
    best.push_back(std::move(all[good[i].second]));
  }
  return best;
}

void Judge(const Twin& twin, int number, Tally& tally) {
  const tradeoff::Runner run = SessionRunner(twin.session, devices::DiskSources);
  ++tally.twins;
  tradeoff::Question question;
  question.tolerance_relative = kTolerance;
  question.knobs = twin.knobs;
  question.alone = question.together = question.sure = kFewRuns;
  const auto study = tradeoff::StudyTradeoff(run, question, {});
  const auto strict = run(StrictestByHand(kTolerance));
  if (!study || !strict) {
    ++tally.refused;
    const Error& error = study ? strict.error() : study.error();
    std::printf("%3d refused: %s: %s\n", number, error.code.c_str(), error.message.c_str());
    return;
  }
  const tradeoff::LightFigures truth = strict->lights.front();
  const AccuracyProfile& recommended = study->recommended.measured.profile;
  const auto again = run(recommended);
  const bool meets = again && Holds(truth, again->lights.front(), kTolerance);
  std::vector<Combination> last = Finalists(run, twin, truth);
  last.insert(last.begin(), {study->recommended.levels, recommended});
  std::vector<AccuracyProfile> profiles;
  for (const Combination& one : last) profiles.push_back(one.profile);
  const auto measured = tradeoff::MeasureInTurn(run, profiles, kFinal, {});
  std::size_t cheapest = 0;
  double cost = 1.0;
  for (std::size_t i = 1; measured && i < last.size(); ++i) {
    if ((*measured)[i].refused) continue;
    const double times = (*measured)[0].times.total / (*measured)[i].times.total;
    if (times > cost) {
      cost = times;
      cheapest = i;
    }
  }
  tally.cost.push_back(cost);
  tally.meets += meets ? 1 : 0;
  tally.cheap += measured && cost <= kBarCost ? 1 : 0;
  if (again) {
    (twin.in_room ? tally.room : tally.dark).Add(again->lights.front(), twin.intensity_cd);
    (twin.in_room ? tally.room_strict : tally.dark_strict).Add(truth, twin.intensity_cd);
  }
  if (!meets || cost > kBarCost) {
    std::printf("%3d %s, %.2f x the cheapest: %s; the cheapest: %s\n", number,
                meets ? "holds" : "MISSES", cost,
                tradeoff::NameOf(study->recommended.levels).c_str(),
                tradeoff::NameOf(last[cheapest].levels).c_str());
  }
  std::fflush(stdout);
}

void PrintTruths(const char* what, const Truths& recommended, const Truths& strict) {
  const auto median = [](std::vector<double> errors) {
    std::ranges::nth_element(errors, errors.begin() + static_cast<long>(errors.size() / 2));
    return 100.0 * errors[errors.size() / 2];
  };
  if (recommended.errors.empty()) return;
  std::printf(
      "  %s: the recommended setting is off the lamp by %.2f %% in the median, the strictest by "
      "%.2f %%; their 95 %% intervals hold it in %d and %d of %zu\n",
      what, median(recommended.errors), median(strict.errors), recommended.held, strict.held,
      strict.errors.size());
}

void Print(const char* what, const Tally& tally) {
  const int studied = tally.twins - tally.refused;
  if (studied == 0) return;
  std::vector<double> cost = tally.cost;
  std::ranges::sort(cost);
  const auto at = [&](double share) {
    return cost[static_cast<std::size_t>(share * static_cast<double>(studied - 1) + 0.5)];
  };
  std::printf(
      "%s: %d twins, %d refused; the recommendation meets the tolerance in %d of %d "
      "(%.1f %%), is within %.1f x of the cheapest in %d (%.1f %%): median %.2f x, p95 "
      "%.2f x, worst %.2f x\n",
      what, tally.twins, tally.refused, tally.meets, studied, Percent(tally.meets, studied),
      kBarCost, tally.cheap, Percent(tally.cheap, studied), at(0.5), at(0.95), cost.back());
  PrintTruths("in the dark", tally.dark, tally.dark_strict);
  PrintTruths("in traced rooms", tally.room, tally.room_strict);
}

}  // namespace
}  // namespace lightcal::test

int main(int count, char** words) {
  using namespace lightcal::test;  // NOLINT(google-build-using-namespace): a tool of the tests
  const auto word = [&](int i, int usual) { return i < count ? std::atoi(words[i]) : usual; };
  const int lux_sessions = word(1, 180), brackets = word(2, 20);
  const int only = word(4, -1);  // this twin alone
  std::mt19937_64 random(static_cast<std::uint64_t>(word(3, 20261122)));
  const auto rooms = ReadTracedRooms(SampleData("../tests/tools/traced_rooms/traced_rooms.csv"));
  Tally lux, bracket;
  for (int i = 0; i < lux_sessions; ++i) {
    const TempDir folder;
    const Twin twin = LuxTwinIn(folder, rooms, random);
    if (only < 0 || only == i) Judge(twin, i, lux);
    if (i % 30 == 29) Print("so far", lux);
  }
  for (int i = 0; i < brackets; ++i) {
    const TempDir folder;
    const Twin twin = BracketTwinIn(folder, random);
    if (only < 0 || only == lux_sessions + i) Judge(twin, lux_sessions + i, bracket);
  }
  Print("lux sessions", lux);
  Print("brackets", bracket);
  std::printf("%.0f s of processor time\n", lightcal::ProcessorSeconds());
  return EXIT_SUCCESS;
}
