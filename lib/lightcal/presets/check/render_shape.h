// SPDX-License-Identifier: Apache-2.0
// What pictures of cards off the axis, or facing several ways, tell beyond one: another cone law, a
// panorama that stands the wrong way round.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "lightcal/presets/check/render_cause.h"
#include "lightcal/presets/check/rig_file.h"

namespace lightcal {

// |ln| between pictures of one scene that is right.
inline constexpr double kAlikePictures = 0.03;

// A rig and what JudgeRender saw of it.
struct SeenRig {
  const CheckedRig* rig = nullptr;
  const RenderVerdict* verdict = nullptr;
};

// By how much known mistakes in a spot's cone change the light where the cards of this rig stand:
// its angles in another engine's law (engine_cone.h), doubled, halved, without the inner one. Empty
// on the axis, and for anything but one spot.
[[nodiscard]] std::vector<RenderCause> ConeMistakes(const CheckedRig& rig);

// How a panorama hangs in the pictures: turned_panorama.h's way, turned, and a factor they share.
struct HungPanorama {
  std::size_t way = 0;
  double turn_deg = 0.0;
  double factor = 1.0;
};
// Absent: fewer than three pictures where it does not hang as it should, or none explains them.
[[nodiscard]] std::optional<HungPanorama> FindHungPanorama(std::span<const SeenRig> seen);

// The cause that explains all the pictures, then others that do as well; at least one. Pictures of
// one scene: what they share (exposure, a factor) is told from what they do not.
[[nodiscard]] std::vector<RenderCause> JudgeTogether(std::span<const SeenRig> seen);

}  // namespace lightcal
