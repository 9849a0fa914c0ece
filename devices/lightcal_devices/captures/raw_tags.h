// SPDX-License-Identifier: Apache-2.0
// The tags of a camera RAW that LibRaw does not keep, collected while it walks the file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lightcal/records/frame.h"

class LibRaw;

namespace lightcal {

struct RawTags {
  WrittenExposure exposure;
  std::optional<double> subject_distance_m;
  std::string time;                   // as EXIF writes it
  std::vector<double> noise_profile;  // scale and offset of each plane
  bool has_gain_map = false;          // lens shading that a reader is asked to apply
};

// Fills `tags` while `raw` opens a file; `tags` must outlive that.
void CollectTags(LibRaw& raw, RawTags& tags);

}  // namespace lightcal
