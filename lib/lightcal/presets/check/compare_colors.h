// SPDX-License-Identifier: Apache-2.0
// The colours of a preset's lights against those the lamps were read to have.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal/presets/check/engine_light.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal {

struct ComparedColor {
  std::string light;
  Xy xy;  // as it was read
  // Between the two in the CIE 1976 u'v' plane; allowed: u95 of what was read, and the rounding of
  // files and engines.
  double apart_uv = 0.0, allowed_uv = 0.0;

  [[nodiscard]] bool Off() const { return apart_uv > allowed_uv; }
};

// u95 in u'v' of a colour whose CCT and Duv are so unsure.
[[nodiscard]] double ColorU95(const std::optional<Uncertain>& cct_K,
                              const std::optional<Uncertain>& duv);

// One row a light of the file that has a colour and stands for a lamp whose colour was read.
// `white`: what the file's pipeline shows as white, where that is not D65. What Rec. 709 cannot
// hold is clipped, in wider spaces by less: a colour is as near as the nearest between the lamp's
// own and what is left of it there.
[[nodiscard]] std::vector<ComparedColor> CompareColors(const LightFile& lamps,
                                                       const std::vector<EngineLight>& lights,
                                                       std::optional<Xy> white);

}  // namespace lightcal
