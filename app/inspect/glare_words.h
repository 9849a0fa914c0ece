// SPDX-License-Identifier: Apache-2.0
// What people type about glare, and what they are told of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "lightcal/calibrate/inspect_picture.h"
#include "lightcal/core/result.h"
#include "lightcal/imaging/scene/picture_glare.h"
#include "lightcal/records/document.h"
#include "output_files.h"

namespace lightcal::app {

struct GlareWords {
  bool wanted = false;
  std::string threshold, radius, peak;
  bool no_peak = false, peaks_too = false, no_dim = false;
  std::vector<int> task;
  std::string vertical, scale_u95, sigma;
  std::vector<std::string> outputs;
  bool force = false;
};

void AddGlareOptions(CLI::App& parser, GlareWords& words);
// Before the picture is read. Wrong usage: a value that cannot be read, one of these without
// --glare, an output that is neither .png, .svg nor .csv.
[[nodiscard]] Result<GlareSettings> GlareSettingsOf(const GlareWords& words);

struct GlareAnswer {
  PictureGlare glare;
  bool ev_stated = false;  // Ev was typed
  double scale_u95 = 0.0;
  std::string scale_source;  // "stated" "picture" "assumed"; "unknown": nobody states the unit
};
// Refused: no_absolute_scale (nobody says what 1.0 is), no_projection, and as MeasureGlare.
[[nodiscard]] Result<GlareAnswer> MeasureGlareOf(const GlareWords& words, GlareSettings settings,
                                                 const InspectedPicture& inspected,
                                                 const std::optional<PixelSolidAngles>& angles);

[[nodiscard]] records::Node GlareNode(const GlareAnswer& answer);
[[nodiscard]] std::string GlareTable(const GlareAnswer& answer);
// The picture in grey, its sources in colours and numbered.
[[nodiscard]] std::string GlareSvg(const InspectedPicture& inspected, const GlareAnswer& answer);
[[nodiscard]] Result<void> WriteGlare(const GlareWords& words, const InspectedPicture& inspected,
                                      const GlareAnswer& answer);

}  // namespace lightcal::app
