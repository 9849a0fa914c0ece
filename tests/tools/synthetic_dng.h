// SPDX-License-Identifier: Apache-2.0
// SYNTHETIC: writes what synthetic_camera exposed as DNG files, each labelled synthetic in its
// camera name, software and description. Includes no header of lightcal.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "synthetic_camera.h"

namespace lightcal::test {

struct SyntheticDngOptions {
  bool lossless_jpeg = false;  // ITU-T T.81 process 14, as cameras and Adobe write it
  bool noise_profile = true;   // DNG NoiseProfile of the camera's true noise
  // AsShotNeutral: the chromaticity the camera took for white.
  double white_x = 0.31272, white_y = 0.32903;
  bool warm_matrix = false;         // also a ColorMatrix for illuminant A, not quite that of D65
  double subject_distance_m = 0.0;  // 0 = no such tag
  double focal_length_mm = 35.0;    // 0 = no such tag
  std::string time = "2026:11:21 12:00:00";
};

// The file's bytes.
[[nodiscard]] std::string EncodeDng(const SyntheticCamera& camera,
                                    const SyntheticExposure& exposure,
                                    const std::vector<std::uint16_t>& picture,
                                    const SyntheticDngOptions& options = {});

// Exposes and writes <directory>/<stem>_<i>.dng, i from 0; returns the paths.
std::vector<std::string> WriteDngBracket(const std::string& directory, const std::string& stem,
                                         const SyntheticCamera& camera,
                                         const std::vector<SyntheticExposure>& series,
                                         const SyntheticScene& scene,
                                         const SyntheticDngOptions& options = {});

}  // namespace lightcal::test
