// SPDX-License-Identifier: Apache-2.0
#include "lightcal/tradeoff/combine.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lightcal::tradeoff {
namespace {

constexpr std::size_t kBeam = 4096;

double WorstOf(const std::vector<double>& differences, const std::vector<double>& limits) {
  double worst = 0.0;
  for (std::size_t i = 0; i < differences.size(); ++i) {
    worst = std::max(worst, std::abs(differences[i]) / limits[i]);
  }
  return worst;
}

Foretold With(const Foretold& from, std::size_t knob, const Change& change,
              const std::vector<double>& limits) {
  Foretold out = from;
  out.levels[knob] = change.level;
  out.seconds += change.seconds;
  for (std::size_t i = 0; i < out.differences.size(); ++i) {
    out.differences[i] += change.differences[i];
  }
  out.worst = WorstOf(out.differences, limits);
  return out;
}

bool IsCheaper(const Foretold& a, const Foretold& b) { return a.seconds < b.seconds; }
bool IsCloser(const Foretold& a, const Foretold& b) {
  return std::pair(a.worst, a.seconds) < std::pair(b.worst, b.seconds);
}

// Half of the places go to the cheapest that are allowed, half to the most accurate: a knob still
// to come may take an error back.
void Thin(std::vector<Foretold>& beam) {
  if (beam.size() <= kBeam) return;
  const auto half = static_cast<std::ptrdiff_t>(kBeam / 2);
  std::ranges::sort(beam, [](const Foretold& a, const Foretold& b) {
    return std::pair(std::max(a.worst, 1.0), a.seconds) <
           std::pair(std::max(b.worst, 1.0), b.seconds);
  });
  std::sort(beam.begin() + half, beam.end(), IsCloser);
  beam.resize(kBeam);
}

}  // namespace

std::vector<Foretold> BestCombinations(const CombineInput& input, std::size_t count) {
  std::vector<Foretold> beam = {
      {input.usual, input.seconds, input.differences, WorstOf(input.differences, input.limits)}};
  for (std::size_t knob = 0; knob < input.changes.size(); ++knob) {
    const std::size_t before = beam.size();
    for (std::size_t i = 0; i < before; ++i) {
      for (const Change& change : input.changes[knob]) {
        beam.push_back(With(beam[i], knob, change, input.limits));
      }
    }
    Thin(beam);
  }
  const auto allowed = [&](const Foretold& one) {
    return input.budget > 0.0 ? one.seconds <= input.budget : one.worst <= 1.0;
  };
  const auto beyond = std::stable_partition(beam.begin(), beam.end(), allowed);
  std::sort(beam.begin(), beyond, input.budget > 0.0 ? IsCloser : IsCheaper);
  std::sort(beyond, beam.end(), input.budget > 0.0 ? IsCheaper : IsCloser);
  beam.resize(std::min(beam.size(), count));
  return beam;
}

}  // namespace lightcal::tradeoff
