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
  int count = 0;                      // tags seen: none means that the file is no TIFF at all
  // Where the picture's data should lie, strip by strip or tile by tile, of every directory.
  std::vector<double> data_offsets, data_sizes;

  // The file's size below which some of that is missing.
  [[nodiscard]] double EndOfData() const;
};

// Fills `tags` while `raw` opens a file; `tags` must outlive that.
void CollectTags(LibRaw& raw, RawTags& tags);

}  // namespace lightcal
