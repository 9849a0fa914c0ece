// SPDX-License-Identifier: Apache-2.0
// The pictures of a wall capture: the lit wall in cd/m^2, and the board in any unit.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lightcal/calibrate/evidence.h"
#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal/core/result.h"
#include "lightcal/core/units.h"
#include "lightcal/core/view2d.h"
#include "lightcal/imaging/bracket/thin_frame.h"
#include "lightcal/imaging/scene/wall_samples.h"
#include "lightcal/records/scale_source.h"
#include "lightcal/records/session.h"
#include "lightcal/records/sources.h"

namespace lightcal {

struct GreyPicture {
  int width = 0, height = 0;
  std::vector<float> values;
  std::optional<Metres> focal_length;  // as the file says

  [[nodiscard]] View2d<const float> view() const { return {values.data(), width, height}; }
};

// Any picture as grey: channels of colour pictures averaged; of a mosaic each 3 x 3 pixels weighted
// 1 2 1, which holds the colours of any Bayer pattern in equal parts and moves nothing. Codes stay
// codes: it serves to find edges.   Fails: as Sources::read_frame.
[[nodiscard]] Result<GreyPicture> ReadGrey(const Sources& sources, const std::string& path);

struct WallPicture {
  GreyPicture nits;
  Thinning thinning{};                    // which made it of the camera's picture,
  int whole_width = 0, whole_height = 0;  // which has this size
  std::vector<float> sigma;  // 1 standard deviation of each pixel; empty where the file has none
  double scale_sd = 0.0;     // relative, common to all pixels, reflectance left out
  ScaleSource scale_source = ScaleSource::kPicture;
  bool flat = false;                 // the camera's profile took the lens's falloff out
  std::optional<double> shortest_s;  // exposure of its shortest frame; absent = unknown
  WallSelection selection;           // what of it shows the wall
  std::optional<Xyz> color;          // mean of that, cd/m^2, by the camera
  std::string camera, time;          // "" = unknown

  [[nodiscard]] View2d<const float> sigma_view() const {
    return sigma.empty() ? View2d<const float>()
                         : View2d<const float>(sigma.data(), nits.width, nits.height);
  }
};

// The wall in cd/m^2. One linear picture with a white luminance is
// taken as it is, its scale as sure as it says (5 % where it does not); everything else is merged
// as a bracket, at the size the capture's work asks for, and corrected for the lamp like a card.
// anchor_illuminance_lx at wall.anchor_rect sets the scale of both. wall.off_frames, read likewise,
// are taken off. Refused: mixed_size (they are not as large), and as OpenCapture, MergeCapture,
// LuminanceOfPicture, LuminanceOfLamp, bad_region.
[[nodiscard]] Result<WallPicture> ReadWallPicture(const Session& session,
                                                  const CaptureDescription& capture,
                                                  const Sources& sources, Evidence& evidence);

}  // namespace lightcal
