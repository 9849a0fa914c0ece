// SPDX-License-Identifier: Apache-2.0
// Pictures of all around as one dome, on whatever scale they have.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/imaging/panorama/aimed_picture.h"
#include "lightcal/imaging/panorama/dome_lights.h"
#include "lightcal/imaging/panorama/panorama.h"
#include "lightcal/imaging/scene/picture_luminance.h"

namespace lightcal {

// A view whose camera's pitch and roll are known: 0 and 0 of one that stood level.
struct LevelView {
  std::string file;  // as in DomeInputRequest, or the end of one, or a number from 1
  Radians pitch{0.0}, roll{0.0};
};

struct DomeInputRequest {
  std::vector<std::string> files;
  std::optional<LuminanceConvention> convention;  // absent: photometric, relative if no file says
  std::optional<double> clip;  // samples of a file from here on are clipped, in the file's own unit
  Projection projection = Projection::kLatLong;
  bool projection_of_file = false;  // what all files say of their view stands before the two here
  Radians field_of_view{0.0};       // as PictureView has it
  std::vector<ViewAim> aims;        // one a file; empty: a panorama as it is, a fisheye looking up
  std::vector<BallView> balls;  // one a file: each shows a mirror ball; `projection` is not asked
  std::optional<int> width;     // of the lat-long dome made of views; absent: WidthForViews
  ViewLens lens;                // the views' own
  bool find_aims = false;  // aims, lens and (a prior, if given) the field of view, from overlaps
  int bracket = 1;         // files of one view
  std::function<void(const std::string&)> progress;  // told what was done, if set
  std::optional<LevelView> level;  // what is known of the horizon where aims are found

  // One lat-long file that needs no projecting.
  [[nodiscard]] bool IsPanorama() const {
    return projection == Projection::kLatLong && files.size() == 1 && aims.empty() && balls.empty();
  }
};

// One file of several on one scale.
struct DomeViewScale {
  std::string file;
  double factor = 1.0;        // what its luminances were multiplied by
  double u95_relative = 0.0;  // as a deviation from all views' common scale
  ViewAim aim;
  std::optional<double> aim_u95_deg;  // of aims that were found: the angle between it and the truth
};

// What a single mirror ball hides: all within half_angle of the way from camera to ball.
struct BlindCap {
  Vec3 direction{};
  Radians half_angle{0.0};
};

struct DomeInput {
  Dome dome;
  std::vector<std::uint8_t> clipped;  // by pixel; empty = nothing is known to be
  std::string scale;                  // as PictureLuminance has it, or what a merge wrote
  bool absolute = false;              // the scale is meant as cd/m^2 by file or person
  std::optional<double> scale_u95_relative;
  std::optional<RgbPrimaries> primaries;  // the file's own
  bool has_colour = false;
  std::optional<WrittenView> view;  // what the file says of its projection
  std::vector<std::string> files;
  std::vector<DomeViewScale> views;      // of a dome composed of views
  double aims_rms_px = 0.0;              // of features' coordinates, where aims were found
  std::optional<Radians> field_of_view;  // where aims were found, as they have it
  double rim_transmission = 1.0;         // what their lens passes at its rim, of what in its middle
  double agreement_sd = 0.0;             // of the views where they overlap, relative
  double apart_share = 0.0;              // of what views share, by more than 10 %
  double seen_share = 1.0;               // of the sphere
  std::vector<std::uint8_t> unseen;      // by pixel, black; empty = none
  std::optional<BlindCap> blind_cap;
  // What a grey ball or card in a plate said.
  struct Grey {
    double factor = 1.0, u95_relative = 0.0;  // plate over dome; without the plate's own scale
    double misfit_sd = 0.0;                   // of its shading, relative
    std::optional<double> ball_reflectance;   // of the mirror ball, where both have one unit
  };
  std::optional<Grey> grey;
  Warnings warnings;
};

}  // namespace lightcal
