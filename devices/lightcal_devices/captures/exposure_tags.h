// SPDX-License-Identifier: Apache-2.0
// Exposure as a file's tags write it -> exposure as it was. Pure.
#pragma once

#include <optional>
#include <string>

#include "lightcal/core/result.h"
#include "lightcal/records/frame.h"

namespace lightcal::devices {

// The sensitivity tags of Exif 2.3 as numbers; absent = no such tag.
struct IsoTags {
  std::optional<double> photographic;     // 65535: beyond its 16 bits, the others say it
  std::optional<double> type;             // SensitivityType: which of them that is
  std::optional<double> standard_output;  // SOS
  std::optional<double> recommended;      // REI
  std::optional<double> iso_speed;
};
inline constexpr double kIsoIsElsewhere = 65535.0;
[[nodiscard]] std::optional<double> IsoOfTags(const IsoTags& tags);

// Exposure time and f-number from Tv and Av where they are on the grid of third or half stops, else
// from the label's place on it, else as written; absent where a tag is missing, zero or nonsense.
// Two tags up to a sixth of a stop apart are one value in half and third stops. Farther apart
// (exposure_tags_disagree, appended to `warnings` about `subject`) an exposure time is absent,
// since the frames' ratios lean on it; an f-number, which frames share, is the middle of the two,
// and the absolute scale is wider by their distance (PictureScale).
[[nodiscard]] FrameExposure ExposureFromTags(const WrittenExposure& written,
                                             const std::string& subject, Warnings& warnings);

// "2026:11:21 12:00:00" -> "2026-11-21T12:00:00"; "" for anything else, all zeros included.
[[nodiscard]] std::string IsoTimeFromExif(const std::string& exif);

}  // namespace lightcal::devices
