// SPDX-License-Identifier: Apache-2.0
// Light that changes between two frames in part of the picture: which regions show one exposure
// ratio, and which another.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "lightcal/imaging/bracket/sampled.h"

namespace lightcal {

// A picture is told apart by so many regions.
inline constexpr int kRegionsAcross = 16, kRegionsDown = 8;
inline constexpr std::size_t kRegions = std::size_t{kRegionsAcross} * kRegionsDown;

// Of sample i of a picture's rows.
[[nodiscard]] std::size_t RegionOf(const SampledSignals& signals, std::size_t i);

// Regions that show one ratio b/a.
struct RatioPart {
  double ln_ratio = 0.0;
  double weight = 0.0;  // of its regions, each 1 where its ratio is known well
  std::vector<bool> regions;
};

// What two frames show. `parts`: none where too few regions tell a ratio; one where the light
// stayed, or only edges and people moved; else two, the denser first.
//   v_r   the median of b/a over a region's samples between 5 and 50 % of the clip, which ratio and
//         selection leave unbiased (sampled.h), of s_r: its own noise, .3 %, and a black level that
//         is off by 2e-4 of the clip
// A part is what lies within 4 s_r of the densest v. What is left beside the first is a light's
// change where it is a tenth of the first and more and most of it lies together.
struct PairParts {
  std::size_t a = 0, b = 0;
  double ln_label = 0.0;  // ratio of the labels
  bool neighbours = false;
  std::vector<RatioPart> parts;
  bool rivals = false;     // the second part is a quarter of the first and most of what is left
  std::size_t stayed = 0;  // index of parts, set by ChooseStill
  double apart = 0.0;      // ln ratio that is nearly as likely, less that of `stayed`
};
void FindParts(const SampledSignals& signals, PairParts& pair);

// Of rivals those stayed whose ratios, over all neighbours, are nearest to the labels (kLabelSd of
// each), and that are larger; others are nearly as likely down to a twentieth. `pairs` in the order
// of their first frames.
void ChooseStill(std::span<PairParts> pairs);

}  // namespace lightcal
