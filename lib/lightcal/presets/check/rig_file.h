// SPDX-License-Identifier: Apache-2.0
// What check needs of a <stem>.preset.json: the cards, the camera, the exposure, the lamps' colour.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/core/vec3.h"
#include "lightcal/presets/light_color.h"
#include "lightcal/presets/turned_panorama.h"
#include "lightcal/records/document.h"

namespace lightcal {

struct CheckedCard {
  std::string name;
  double reflectance = 0.0;
  double expected_lx = 0.0;
  std::array<Vec3, 4> inner_m;  // corners of its middle half, where it is measured
};

struct CheckedLamp {
  std::string name, kind;
  std::array<double, 3> color{1.0, 1.0, 1.0};  // linear Rec. 709, largest component 1
  double color_luminance = 1.0;
  double color_u95_uv = 0.0;                // of what was read of it, in u'v'
  double inner_deg = 0.0, outer_deg = 0.0;  // outer 0 = no cone
  double surface_m2 = 0.0;                  // 0 = has none, or nobody stated it
};

// What a white card gets of a panorama as it is (way 0, no turn) and mistaken: turned_panorama.h.
struct CheckedPanorama {
  std::array<double, 3> others_rgb_lx{};
  TurnedIrradiance rgb_lx{};
};

// Z up, metres. scale: pixel = luminance * scale.
struct CheckedRig {
  double scale = 1.0;
  double separation_m = 1.0;
  std::array<CheckedCard, 2> cards;  // white, grey
  Vec3 camera_m{}, target_m{}, up{};
  double vertical_fov_rad = 0.5;
  std::vector<CheckedLamp> lamps;
  std::size_t lamp = 0;               // the one whose reading the cards stand at
  std::vector<double> lamp_shares{};  // of the cards' light; empty: one lamp, or an older file
  double off_axis_deg = 0.0, round_deg = 0.0;
  std::optional<CheckedPanorama> panorama{};
  ColorTarget pipeline{};  // what the engines of its export got their colours in
};

// The space and white of the pipeline that a preset.json was exported for, as any of its lights
// says them; plain Rec. 709 where it says nothing else.
[[nodiscard]] ColorTarget PipelineIn(const records::Node& light);

// Refused: bad_rig (names what is missing), no_rig (a bare preset).
[[nodiscard]] Result<CheckedRig> RigFromPreset(const std::string& text, const std::string& path);

}  // namespace lightcal
