// SPDX-License-Identifier: Apache-2.0
// How far settings stay from a truth that is known: a twin read again and again.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "lightcal/tradeoff/outcome.h"
#include "lightcal/tradeoff/study.h"
#include "lightcal/tradeoff/timing.h"

namespace lightcal::tradeoff {

// A calibration of the twin's `replica`-th readings by a profile. The same replica gives every
// profile the same noise.
using ReplicaRunner =
    std::function<Result<std::vector<LightFigures>>(const AccuracyProfile&, int replica)>;

struct Named {
  std::string name;
  AccuracyProfile profile;
};

// Errors of ln strength against the truth, relative, of the light whose rms is the largest.
struct TruthRow {
  std::string name;
  std::string light;
  int replicas = 0;   // that gave an answer
  int refused = 0;    // that gave none
  double mean = 0.0;  // signed: what more readings would not lower
  double rms = 0.0;
  int intervals = 0, held = 0;  // 95 % intervals of all lights, and how many hold the truth

  [[nodiscard]] double held_share() const {
    return intervals > 0 ? static_cast<double>(held) / intervals : 0.0;
  }
};

struct ReplicaRules {
  int replicas = 200;
  int least = 25;         // however long they take
  double seconds = 12.0;  // beyond these
};

// One row a profile, of the lights of `truth` alone; all see the same replicas.  Fails:
// interrupted.
[[nodiscard]] Result<std::vector<TruthRow>> CompareWithTruth(const ReplicaRunner& run,
                                                             const std::vector<LightFigures>& truth,
                                                             std::span<const Named> profiles,
                                                             const ReplicaRules& rules,
                                                             const Watch& watch);

// Whether a setting is as good as the strictest against the truth: its rms error exceeds that one's
// by no more than the tolerance and a third of it, added in squares, and its intervals hold the
// truth as often as 95 % says, or as the strictest's do, to two standard errors of the count.
[[nodiscard]] bool HoldsTruth(const TruthRow& own, const TruthRow& strictest, double tolerance);

// Recommends anew, by the truth alone: of the settings that `rows` name (NameOf) and that hold it,
// the cheapest, as RecommendIfItSaves. Where none does, `study` stays as it is.
[[nodiscard]] Result<void> RecommendByTruth(const Runner& run, const Question& question,
                                            const Watch& watch, const TruthRow& strictest,
                                            std::span<const TruthRow> rows, Study& study);

}  // namespace lightcal::tradeoff
