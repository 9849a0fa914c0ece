// SPDX-License-Identifier: Apache-2.0
// What a 512 x 512 floor costs with the gate, with all effects, with none, and how far the gate is
// from all effects; beside it the plain point formula, and this machine's memory bandwidth.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "lightcal/light/illuminance_map.h"

#if defined(__x86_64__)
#define LIGHTCAL_EVERY_CPU \
  __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define LIGHTCAL_EVERY_CPU
#endif

namespace {

using namespace lightcal;

constexpr int kSide = 512;

template <class Work>
double Best_ms(int repeats, const Work& work) {
  double best = 1e300;
  for (int i = 0; i < repeats; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    best = std::min(best, took.count());
  }
  return best;
}

// The formula alone: E = I cos/d^2 in every pixel, compiled as the kernels are.
LIGHTCAL_EVERY_CPU
void PlainPoint(double candela, double x, double y, double height, double first, double step,
                float* out) {
  for (int j = 0; j < kSide; ++j) {
    const double dy = first + j * step - y;
    for (int i = 0; i < kSide; ++i) {
      const double dx = first + i * step - x;
      const double d2 = dx * dx + dy * dy + height * height;
      const double cosine = height / std::sqrt(d2);
      out[j * kSide + i] = static_cast<float>(candela * cosine / d2);
    }
  }
}

LIGHTCAL_EVERY_CPU
void Triad(const std::vector<double>& b, const std::vector<double>& c, std::vector<double>& a) {
  const double* pb = b.data();
  const double* pc = c.data();
  double* pa = a.data();
  for (std::size_t i = 0; i < a.size(); ++i) pa[i] = pb[i] + 3.0 * pc[i];
}

struct Stage {
  std::string name;
  PlacedLamp lamp;
  std::optional<RoomBox> room;
  double floor_m;
};

PlacedLamp LampAt(LampSource source, double strength, const Vec3& position, const Vec3& aim) {
  PlacedLamp lamp;
  lamp.source = std::move(source);
  lamp.strength = strength;
  lamp.pose.position_m = position;
  lamp.pose.frame = SourceFrame::Facing(aim * (1.0 / Length(aim)));
  lamp.doubt.variance_ln = 1e-4;
  return lamp;
}

std::vector<Stage> Stages() {
  const Vec3 down{0.0, 0.0, -1.0};
  const SpotCone cone{RadiansFromDegrees(12.0), RadiansFromDegrees(30.0)};
  return {
      {"bare bulb, dark hall", LampAt(PointSource{}, 900.0, {0.2, 0.1, 3.0}, down),
       RoomBox{{40.0, 40.0, 16.0}, 0.02}, 6.0},
      {"sun", LampAt(SunSource{0.00465}, 1e5, {}, {0.5, 0.2, -1.0}), std::nullopt, 6.0},
      {"spot, black studio", LampAt(SpotSource{cone}, 9000.0, {-1.0, 0.0, 4.0}, {0.3, 0.0, -1.0}),
       RoomBox{{12.0, 10.0, 6.0}, 0.05}, 6.0},
      {"panel near a white wall", LampAt(RectSource{0.6, 0.3}, 2000.0, {0.0, 1.5, 2.2}, down),
       RoomBox{{5.0, 4.0, 2.6}, 0.8}, 4.0},
      {"the same, no room", LampAt(RectSource{0.6, 0.3}, 2000.0, {0.0, 1.5, 2.2}, down),
       std::nullopt, 4.0}};
}

PlaneGrid FloorOf(const Stage& scene) {
  const double step = scene.floor_m / kSide;
  const double first = -0.5 * scene.floor_m + 0.5 * step;
  PlaneGrid grid;
  grid.first_m = {first, -first, 0.0};
  grid.across_m = {step, 0.0, 0.0};
  grid.down_m = {0.0, -step, 0.0};
  grid.width = grid.height = kSide;
  return grid;
}

struct Run {
  IlluminanceMap map;
  double ms = 0.0;
};
Run RunOf(const Stage& scene, EffectChoice effects, int threads, int repeats) {
  MapSettings settings;
  settings.room = scene.room;
  settings.finite_source = settings.room_bounce = effects;
  settings.threads = threads;
  const std::vector<PlacedLamp> lamps = {scene.lamp};
  const PlaneGrid grid = FloorOf(scene);
  Run run;
  // Everything a fresh scene needs; the map's memory is used again.
  run.ms = Best_ms(repeats, [&] { IlluminancePredictor(lamps, settings).Over(grid, run.map); });
  return run;
}

double WorstRelative(const IlluminanceMap& map, const IlluminanceMap& truth) {
  double worst = 0.0;
  for (std::size_t i = 0; i < map.lux.size(); ++i) {
    if (!(truth.lux[i] > 0.0F)) continue;
    worst = std::max(worst, std::abs(double{map.lux[i]} / double{truth.lux[i]} - 1.0));
  }
  return worst;
}

}  // namespace

int main() {
  constexpr int kRepeats = 30;
  std::printf("%-26s %9s %9s %11s %9s %12s %12s\n", "512 x 512, 1 %", "gate ms", "1 thread",
              "all ms", "none ms", "gate error", "none error");
  for (const Stage& scene : Stages()) {
    const Run gate = RunOf(scene, EffectChoice::kGate, 0, kRepeats);
    const Run single = RunOf(scene, EffectChoice::kGate, 1, kRepeats);
    const Run all = RunOf(scene, EffectChoice::kAlways, 0, 1);
    const Run none = RunOf(scene, EffectChoice::kNever, 0, kRepeats);
    std::printf("%-26s %9.3f %9.3f %11.3f %9.3f %11.3f%% %11.3f%%\n", scene.name.c_str(), gate.ms,
                single.ms, all.ms, none.ms, 100.0 * WorstRelative(gate.map, all.map),
                100.0 * WorstRelative(none.map, all.map));
  }
  const Stage bulb = Stages().front();
  const PlaneGrid grid = FloorOf(bulb);
  std::vector<float> plain(std::size_t{kSide} * kSide);
  // In turns, so that a busy machine slows both.
  double formula = 1e300;
  double gated = 1e300;
  for (int i = 0; i < kRepeats; ++i) {
    formula = std::min(formula, Best_ms(3, [&] {
                         PlainPoint(900.0, 0.2, 0.1, 3.0, grid.first_m[0], grid.across_m[0],
                                    plain.data());
                       }));
    gated = std::min(gated, RunOf(bulb, EffectChoice::kGate, 1, 3).ms);
  }
  std::printf(
      "\nplain point formula, 1 thread: %.3f ms (%.2f ns a point); the bulb through the gate,"
      " with u95: %.3f ms, %.2f times that\n",
      formula, 1e6 * formula / static_cast<double>(plain.size()), gated, gated / formula);
  constexpr std::size_t kDoubles = std::size_t{1} << 23;
  const std::vector<double> b(kDoubles, 1.0);
  const std::vector<double> c(kDoubles, 2.0);
  std::vector<double> a(kDoubles);
  const double triad = Best_ms(10, [&] { Triad(b, c, a); });
  const double written = 2.0 * sizeof(float) * static_cast<double>(plain.size());
  std::printf(
      "memory: triad %.1f GB/s over 3 x 64 MiB, 1 thread; the bulb writes its two maps at "
      "%.1f GB/s: it is bound by arithmetic\n",
      3.0 * 8.0 * kDoubles / triad / 1e6, written / gated / 1e6);
  return a[kDoubles / 2] > 0.0 ? 0 : 1;
}
