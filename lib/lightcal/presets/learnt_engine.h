// SPDX-License-Identifier: Apache-2.0
// What a renderer that nobody here has makes of each kind of light: found from its own pictures of
// exported rigs, and undone when presets are exported for it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/photometry/light_kind.h"
#include "lightcal/presets/engine_cone.h"
#include "lightcal/records/json_codec.h"

namespace lightcal {

// In documents, in the order of EngineConeLaw.
inline constexpr std::array<std::string_view, 6> kConeLawWords = {
    "squared", "smooth", "smooth_times_cosine", "smooth_in_angle", "linear_in_angle", "power"};

// What a renderer makes of the two half angles of a cone: its own law between its own multiples of
// them.
struct LearntCone {
  EngineConeLaw written = EngineConeLaw::kSmoothInAngle;  // the law that the file's angles are for
  EngineConeLaw law = EngineConeLaw::kSmoothInAngle;      // the renderer's
  double outer_times = 1.0;                               // its outer angle over the file's
  double inner_times = 1.0;                               // 0: it has no inner angle
  bool hard = false;                                      // its inner angle is its outer one

  // What comes of these angles in it; beyond 90 degrees they are 90.
  [[nodiscard]] EngineCone Of(const EngineCone& file) const;
  // The angles to write so that it comes nearest to this beam; errors are those that are left.
  [[nodiscard]] EngineCone ToWrite(const BeamProfile& beam) const;
};

// How a renderer hangs a panorama: turned_panorama.h's way (0 = as it is), then turned.
struct LearntTurn {
  std::size_t way = 0;
  double turn_deg = 0.0;  // from its front to its right

  [[nodiscard]] bool IsNone() const { return way == 0 && turn_deg == 0.0; }
};

struct LearntKind {
  LightKind kind = LightKind::kPoint;
  double factor = 1.0;        // of what it should show, times area^area_power; above 0
  double u95_relative = 0.0;  // of factor
  std::string cause;          // render_cause.h's word; "none" = as it should be
  // -1: it divides by the lamp's area [m2] where it should not (UsdLux's normalize); 1: it
  // multiplies.
  int area_power = 0;
  std::optional<LearntCone> cone{};  // of spots; absent: as written, or not learnt
  std::optional<LearntTurn> turn{};  // of domes with a picture
};

struct LearntEngine {
  // False: what a sample of its pictures stands for was not known, so that factors are ratios to
  // that of the first kind.
  bool absolute = true;
  // False: it leaves the camera's exposure out, so that its samples are cd/m2.
  bool exposure_applied = true;
  std::vector<LearntKind> kinds;

  // 1 of a kind that was not learnt. area_m2: of the light's surface, 0 = it has none.
  [[nodiscard]] double FactorOf(LightKind kind, double area_m2) const;
  [[nodiscard]] bool Knows(LightKind kind) const;
  // Of files whose cones are written for that law; null = nothing was learnt.
  [[nodiscard]] const LearntCone* ConeWrittenFor(EngineConeLaw law) const;
  [[nodiscard]] std::optional<LearntTurn> TurnOfDomes() const;
};

// What EngineText writes, without its head: absolute, exposure_applied, kinds.
[[nodiscard]] records::Node EngineNode(const LearntEngine& engine);
// "lightcal.engine/1". Fails: not_finite.   Refused: bad_engine (names what is wrong).
[[nodiscard]] Result<std::string> EngineText(const LearntEngine& engine, std::string_view generator,
                                             const std::string& subject);
[[nodiscard]] Result<LearntEngine> EngineFrom(const std::string& text, const std::string& path);

// Surface of a light as UsdLux counts it [m2]: sphere 4 pi r^2, disk pi r^2, rect w h, tube
// 2 pi r l.   Source: OpenUSD pxr/usd/usdLux/schema.usda, inputs:normalize.
[[nodiscard]] double SurfaceOf(LightKind kind, std::optional<double> diameter_m,
                               std::optional<double> width_m, std::optional<double> height_m,
                               std::optional<double> length_m, std::optional<double> radius_m);

}  // namespace lightcal
