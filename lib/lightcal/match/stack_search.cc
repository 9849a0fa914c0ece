// SPDX-License-Identifier: Apache-2.0
#include "lightcal/match/stack_search.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <compare>
#include <limits>
#include <numeric>
#include <span>
#include <thread>

#include "lightcal/core/parallel.h"
#include "lightcal/core/statistics.h"

namespace lightcal::match {
namespace {

// Up to two gels by their numbers; equal ones are one gel doubled.
struct Stack {
  std::array<std::size_t, 2> gel{};
  std::size_t count = 0;
  [[nodiscard]] std::span<const std::size_t> gels() const { return {gel.data(), count}; }
};

std::vector<Stack> AllStacks(std::size_t gels, int most) {
  std::vector<Stack> all(1);
  if (most >= 1) {
    for (std::size_t i = 0; i < gels; ++i) all.push_back({{i, 0}, 1});
  }
  if (most >= 2) {
    for (std::size_t i = 0; i < gels; ++i) {
      for (std::size_t j = i; j < gels; ++j) all.push_back({{i, j}, 2});
    }
  }
  return all;
}

double DeltaUv(const MatchScene& scene, const NodeValues& transmittance) {
  const Xyz xyz = scene.lamp_xyz.Behind(transmittance);
  if (!(xyz.Y > 0.0)) return std::numeric_limits<double>::infinity();
  const Uv1976 uv = Uv1976FromXy(XyFromXyz(xyz));
  return std::hypot(uv.u - scene.target_uv.u, uv.v - scene.target_uv.v);
}

// The median over the cameras; a lower bound above `give_up` once more than half of them are.
double MedianDifference(const MatchScene& scene, const NodeValues& transmittance, double give_up,
                        std::vector<double>& differences) {
  const std::size_t count = scene.cameras.size();
  std::size_t above = 0;
  differences.clear();
  for (const LightView& camera : scene.cameras) {
    differences.push_back(camera.Difference(transmittance, give_up));
    if (differences.back() > give_up && ++above > count / 2) {
      return std::numeric_limits<double>::infinity();
    }
  }
  if (above > 0) {
    for (std::size_t c = 0; c < count; ++c) {
      if (differences[c] > give_up) differences[c] = scene.cameras[c].Difference(transmittance);
    }
  }
  return Median(differences);
}

double Deciding(const MatchScene& scene, const NodeValues& transmittance, double give_up,
                std::vector<double>& scratch) {
  if (scene.cameras.empty()) return scene.observer.Difference(transmittance, give_up);
  if (scene.cameras.size() == 1) return scene.cameras[0].Difference(transmittance, give_up);
  return MedianDifference(scene, transmittance, give_up, scratch);
}

struct Candidate {
  double difference;
  std::size_t stack;
  auto operator<=>(const Candidate&) const = default;
};

}  // namespace

double DecidingDifference(const MatchScene& scene, const NodeValues& transmittance) {
  std::vector<double> scratch;
  return Deciding(scene, transmittance, std::numeric_limits<double>::infinity(), scratch);
}

StackSearch FindNearestStacks(const MatchScene& scene, std::size_t count) {
  const std::vector<Stack> stacks = AllStacks(scene.gels.size(), scene.request.most_gels);
  // Nearest in u'v' first: they are soon found, and the others as soon left.
  std::vector<double> delta_uv(stacks.size());
  for (std::size_t i = 0; i < stacks.size(); ++i) {
    delta_uv[i] = DeltaUv(scene, scene.Transmittance(stacks[i].gels()));
  }
  std::vector<std::size_t> order(stacks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
    return delta_uv[a] < delta_uv[b] || (delta_uv[a] == delta_uv[b] && a < b);
  });
  const std::size_t threads = std::max(1U, std::thread::hardware_concurrency());
  std::vector<std::vector<Candidate>> found(threads);
  // Of any thread: `count` stacks are nearer than this.
  std::atomic<double> shared = std::numeric_limits<double>::infinity();
  constexpr std::size_t kTold = 64;  // stacks at once
  const Progress searching = PartOf(scene.request.progress, 0.0, kSearchShare);
  CountedProgress counted(searching, static_cast<int>(order.size()));
  ParallelFor(static_cast<int>(threads), [&](int thread) {
    std::vector<Candidate>& best = found[static_cast<std::size_t>(thread)];  // a heap, worst first
    std::vector<double> scratch;
    std::size_t looked_at = 0;
    for (std::size_t i = static_cast<std::size_t>(thread); i < order.size(); i += threads) {
      if (++looked_at % kTold == 0) counted.Done(static_cast<int>(kTold));
      const NodeValues through = scene.Transmittance(stacks[order[i]].gels());
      const double give_up = shared.load(std::memory_order_relaxed);
      const Candidate one{Deciding(scene, through, give_up, scratch), order[i]};
      if (!std::isfinite(one.difference) || one.difference > give_up) continue;
      best.push_back(one);
      std::ranges::push_heap(best);
      if (best.size() <= count) continue;
      std::ranges::pop_heap(best);
      best.pop_back();
      double known = shared.load();
      const double own = best.front().difference;
      while (own < known && !shared.compare_exchange_weak(known, own)) {
      }
    }
  });
  std::vector<Candidate> all;
  for (const auto& each : found) all.insert(all.end(), each.begin(), each.end());
  std::ranges::sort(all);
  if (all.size() > count) all.resize(count);
  StackSearch search;
  search.stacks = stacks.size();
  for (const Candidate& one : all) {
    const auto gels = stacks[one.stack].gels();
    search.best.push_back({{gels.begin(), gels.end()}, one.difference});
  }
  const auto nearest = stacks[order.front()].gels();
  search.nearest_uv.assign(nearest.begin(), nearest.end());
  search.least_delta_uv = delta_uv[order.front()];
  return search;
}

}  // namespace lightcal::match
