// SPDX-License-Identifier: Apache-2.0
// Pictures that are not camera RAW: OpenEXR and Radiance HDR read here, TIFF, PNG, JPEG through
// OpenImageIO; and OpenEXR written. The libraries behind that cost 0.2 s to load, so they stand in
// a module that is opened at the first call (see lib/DECISIONS.md).
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/core/view2d.h"
#include "lightcal/records/frame.h"

namespace lightcal::devices {

class OpenFiles;  // mapped_file.h: here and below, opens the file where given

// Tags only. Fails: not_found, unreadable, no_picture_module (the program is badly installed).
// Refused: unknown_format, bad_picture (truncated or corrupt), too_large.
[[nodiscard]] Result<FrameInfo> ReadPictureInfo(const std::string& path,
                                                OpenFiles* files = nullptr);

// The whole picture: float for kLinear, uint16 codes (8 bit ones as 0..255) for kEncoded. An EXR of
// luminance and subsampled chroma comes as RGB. Alpha and other channels that are no colour are
// left out. Fails besides: no_scratch_space.
// Refused besides: bad_samples (NaN, infinity or a value beyond 1e30, named with place and count).
[[nodiscard]] Result<Frame> ReadPicture(const std::string& path,
                                        SampleStore store = SampleStore::kMemory,
                                        OpenFiles* files = nullptr);

// An OpenEXR file of 32 bit floats, scanlines, written by OpenEXR.
struct ExrPicture {
  View2d<const float> samples;             // finite
  std::vector<std::string> channel_names;  // one a channel of samples: {"Y"}, {"R", "G", "B"}
  std::optional<RgbPrimaries> chromaticities;
  std::optional<Nits> white_luminance;  // 1 nit where the samples are luminance in nits
  bool environment_latlong = false;     // written as envmap = latlong
  // Provenance, written as text attributes "lightcal:<name>".
  std::vector<std::pair<std::string, std::string>> attributes;
  bool compressed = true;  // ZIP; a 24 MP picture is written ten times faster without
};
// Writes to exactly this path, replacing it. The app gives a temporary name and renames.
// Fails: unwritable, no_picture_module. Refused: bad_samples.
[[nodiscard]] Result<void> WriteExr(const std::string& path, const ExrPicture& picture);

}  // namespace lightcal::devices
