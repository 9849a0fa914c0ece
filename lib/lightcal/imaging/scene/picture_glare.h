// SPDX-License-Identifier: Apache-2.0
// A picture of what an eye sees -> its glare: the sources, and four indices with their intervals.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/core/view2d.h"
#include "lightcal/imaging/panorama/panorama.h"
#include "lightcal/imaging/scene/patches.h"
#include "lightcal/photometry/glare_indices.h"

namespace lightcal {

// Defaults are those of evalglare 2.10 (Wienold, 25.06.2020).
struct GlareSettings {
  // Above 100 a luminance [cd/m^2]; else a multiple of the task's mean, or of the whole view's
  // where there is no task. Absent: 2000 cd/m^2, 5 times the mean where there is a task.
  std::optional<double> threshold;
  // Pixels above the threshold that are within half of it of each other are one source.
  Radians search_radius{0.2};
  // From here on they are sources of their own; absent: nothing is taken out.
  std::optional<Nits> peak = Nits(50000.0);
  std::optional<Region> task;
  // E_v as a meter at the eye read it, instead of the picture's: of a picture that does not hold
  // all light that reaches the eye, or at another scale. The sources stay those of the picture.
  std::optional<Lux> vertical;
  bool dim_correction = true;  // of DGP below 1000 lx
  double scale_u95 = 0.0;      // of all luminances in common, relative
};

struct FoundGlareSource {
  GlareSource source;
  Vec3 direction{};            // of its centre, weighed by solid angle
  std::array<double, 2> at{};  // the same in the picture, pixel centres being at .5
  Lux vertical;                // its part of E_v
  Nits max;
  std::int64_t pixels = 0;
};

struct PictureGlare {
  GlareLight light;
  Lux vertical_of_picture;  // E_v as the picture has it
  Nits background, mean;    // of the view, by solid angle
  Nits threshold;           // in use
  std::optional<Nits> task;
  Uncertain vertical, dgp;  // 95 %, low and high set
  std::optional<Uncertain> ugr, dgi, cgi;
  // Where nothing is above the default threshold and there is no task: 5 times the mean is tried
  // for UGR alone (of electric light indoors): its threshold where something is above that, the
  // brightest that the eye sees where nothing is.
  std::optional<Nits> ugr_threshold, brightest;
  std::vector<FoundGlareSource> sources;  // those that matter most to DGP first
  std::vector<int> source_of;             // a pixel: 1 + the source it belongs to; 0 = none
};

// `sigma`: of each pixel, independent of its neighbours' [cd/m^2]; empty = none known.
// The scale's error moves pixels over the threshold: the analysis is done again at both ends and
// half way, and the interval holds all of their answers.
// The view is that of fisheyes of 180 degrees and more, or of a lat-long picture along its
// horizon's middle; what lies behind it counts nothing.
// A stated E_v is taken as sure.
// Refused: bad_view (neither; sizes differ), bad_region (the task), no_light (E_v is not above 0),
// bad_vertical (the sources alone make more light than the stated E_v).
[[nodiscard]] Result<PictureGlare> MeasureGlare(View2d<const float> nits,
                                                const PixelSolidAngles& angles,
                                                const GlareSettings& settings,
                                                View2d<const float> sigma = {});

}  // namespace lightcal
