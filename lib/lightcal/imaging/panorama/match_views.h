// SPDX-License-Identifier: Apache-2.0
// Which views show the same things, and how their cameras were turned against each other.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "lightcal/imaging/panorama/lens_bearing.h"
#include "lightcal/records/picture_feature.h"

namespace lightcal {

// Rows: right, forward and up of a camera, in some axes.
using CameraAxes = std::array<Vec3, 3>;

// Two views a < b and which feature of a is which of b.
struct ViewPair {
  std::size_t a = 0, b = 0;
  std::vector<std::pair<std::size_t, std::size_t>> matches;
};

// Features that are each other's nearest by descriptor, and nearer by a fifth than the next. Of
// many views each is held against the ten that share most of its strongest features.
[[nodiscard]] std::vector<ViewPair> MatchViews(
    std::span<const std::vector<PictureFeature>> features);

struct ViewOptics {
  PictureView view;
  double focal_px = 1.0;
  ViewLens lens;
};

// The matches of a pair that one rotation explains within `tolerance_px` of the picture's middle,
// and that rotation: rows such that bearing_a = rows bearing_b.
struct TurnedPair {
  ViewPair pair;
  CameraAxes a_from_b{};
};
// RANSAC over pairs of matches, the start of its draws fixed; then least squares (Kabsch).
[[nodiscard]] TurnedPair TurnOfPair(const ViewPair& pair,
                                    std::span<const std::vector<PictureFeature>> features,
                                    const ViewOptics& optics, double tolerance_px);
// Whether so many of the matches agree that chance does not explain it: n > 6 + 0.22 m.
// Source: Brown & Lowe, IJCV 74 (2007), their 5.9.
[[nodiscard]] bool BelongTogether(std::size_t agreeing, std::size_t matches);

}  // namespace lightcal
