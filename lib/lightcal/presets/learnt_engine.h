// SPDX-License-Identifier: Apache-2.0
// What a renderer that nobody here has makes of each kind of light: found from its own pictures of
// exported rigs, and undone when presets are exported for it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/photometry/light_kind.h"

namespace lightcal {

struct LearntKind {
  LightKind kind = LightKind::kPoint;
  double factor = 1.0;        // of what it should show; above 0
  double u95_relative = 0.0;  // of factor
  std::string cause;          // render_cause.h's word; "none" = as it should be
};

struct LearntEngine {
  // False: what a sample of its pictures stands for was not known, so that factors are ratios to
  // that of the first kind.
  bool absolute = true;
  std::vector<LearntKind> kinds;

  // 1 of a kind that was not learnt.
  [[nodiscard]] double FactorOf(LightKind kind) const;
  [[nodiscard]] bool Knows(LightKind kind) const;
};

// "lightcal.engine/1". Fails: not_finite.   Refused: bad_engine (names what is wrong).
[[nodiscard]] Result<std::string> EngineText(const LearntEngine& engine, std::string_view generator,
                                             const std::string& subject);
[[nodiscard]] Result<LearntEngine> EngineFrom(const std::string& text, const std::string& path);

}  // namespace lightcal
