// SPDX-License-Identifier: Apache-2.0
// The tags of a camera RAW that LibRaw does not keep, collected while it walks the file.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "lightcal/records/frame.h"
#include "lightcal_devices/captures/exposure_tags.h"

class LibRaw;

namespace lightcal::devices {

// Plain data: it crosses from one process to another.
struct RawTags {
  WrittenExposure exposure;
  std::optional<double> subject_distance_m;
  std::array<char, 32> time{};            // as EXIF writes it
  std::array<double, 8> noise_profile{};  // scale and offset of each plane
  int noise_numbers = 0;                  // of these
  bool has_gain_map = false;              // lens shading that a reader is asked to apply
  double black_of_deltas = 0.0;           // what LibRaw put into its black for the deltas below
};

// What the walk through a file collects.
struct RawTagWalk {
  RawTags tags;
  int count = 0;  // tags seen: none means that the file is no TIFF at all
  IsoTags iso{};  // what tags.exposure.iso is of
  // Where the picture's data should lie, strip by strip or tile by tile, of every directory.
  std::vector<double> data_offsets, data_sizes;
  // DNG BlackLevelDeltaH and V: what the black of a column and of a row of the active area is above
  // BlackLevel. LibRaw knows their means alone.
  std::vector<double> black_of_columns, black_of_rows;
  bool has_white_level = false;  // DNG WhiteLevel is written

  [[nodiscard]] bool has_black_deltas() const {
    return !black_of_columns.empty() || !black_of_rows.empty();
  }
  // The file's size below which some of that is missing.
  [[nodiscard]] double EndOfData() const;
};

// Fills `walk` while `raw` opens a file; `walk` must outlive that.
void CollectTags(LibRaw& raw, RawTagWalk& walk);

}  // namespace lightcal::devices
