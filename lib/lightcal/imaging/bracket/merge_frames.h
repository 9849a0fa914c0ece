// SPDX-License-Identifier: Apache-2.0
// The frames of a bracket -> a picture in cd/m^2 with its sigma.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/progress.h"
#include "lightcal/core/result.h"
#include "lightcal/core/units.h"
#include "lightcal/imaging/bracket/align_frames.h"
#include "lightcal/imaging/bracket/plan_merge.h"
#include "lightcal/imaging/camera/known_camera.h"
#include "lightcal/imaging/scene/patches.h"
#include "lightcal/records/accuracy_profile.h"
#include "lightcal/records/bracket.h"
#include "lightcal/records/masked_picture.h"
#include "lightcal/records/response_curves.h"
#include "lightcal/records/scale_source.h"

namespace lightcal {

// What a luminance meter read of a part of the picture.
struct SpotReading {
  int x = 0, y = 0, width = 0, height = 0;
  Nits luminance;
  double sigma_relative = 0.05;
};

// A demosaiced pixel shares its noise with its neighbours: the mean of many is this much less sure
// than the mean of as many independent ones (they count as a quarter).
inline constexpr double kInterpolatedNoise = 2.0;

struct BracketMergeRequest {
  std::optional<SpotReading> anchor;
  std::optional<NoiseProfile> noise;
  std::optional<ResponseCurves> response;  // of codes; absent: recovered from the frames
  std::optional<RgbSpace> space;           // absent: luminance alone
  std::optional<Xy> white;                 // what becomes the space's white
  bool want_sigma = false;
  std::optional<KnownCamera> camera;   // what is known of it; an anchor or noise above comes first
  std::optional<MismatchFactor> lamp;  // corrects luminance by the camera's scale for the lamp
  // Width of the sensor, where cos^4 is to be taken out for want of a flat field; a prior.
  std::optional<Metres> cosine_fourth;
  // Raw red, green and blue per unit of exposure t S/N^2 instead, sigma of green; what a profile is
  // made of. own_noise: from the frames alone, whatever their files say.
  bool raw = false, own_noise = false;
  bool lens_held = false;  // who asks holds what a lens without a flat field loses: not said
  bool align = false;      // take back what the camera moved, where there is evidence
  PictureChoice work{};
  Progress progress{};
};

struct MergedFrame {
  FrameInfo info;
  std::optional<double> ratio_ev;  // measured exposure relative to the shortest frame
  bool used = false;
  std::optional<FrameAlignment::Moved> moved{};  // against the one aligned to, where asked for
};

struct MergedBracket {
  std::vector<MergedFrame> frames;
  int width = 0, height = 0, channels = 1;
  std::optional<Region> crop;  // of the frame below, where frames were aligned
  std::string aligned_to;      // file of the frame that the others were brought to
  std::vector<float> picture;  // cd/m^2: Y, or RGB whose (1,1,1) is 1 cd/m^2
  std::vector<float> sigma;    // of the luminance, 1 standard deviation, cd/m^2
  double nits_per_unit = 0.0;  // luminance of full scale in the shortest frame
  ScaleSource scale_source = ScaleSource::kIsoPrior;
  double scale_u95_relative = 0.0;
  double gauge_sd = 0.0;          // what labels leave open about all exposures together, relative
  SampleCorrections corrections;  // by the camera's profile, and of masked pixels
  std::size_t masked_pixels = 0;  // that hold no number in some frame
  double clipped_fraction = 0.0;  // of the samples, in every frame
  MergePlan plan;
  NoiseSource noise_source = NoiseSource::kEstimated;
  ResponseCurves response;      // of codes; empty of other frames
  std::string response_source;  // "stated", "recovered"; "" of other frames
  Warnings warnings;
};

// The samples of one of the bracket's frames; called from several threads at once.
using FrameLoader = std::function<Result<MaskedPicture>(const FrameInfo& info, SampleStore store)>;

// Refused: no_frames (an empty bracket), no_exposure_metadata (a frame without exposure time; ISO
// or f-number unknown and no anchor), bad_anchor (outside the picture, clipped or black there),
// no_colour (a space asked of a picture without), no_codes (a response stated of other frames than
// codes), and as CheckKnownCamera, CorrectionsOf, `load`, RecoverResponse, PlanMerge,
// MeasureAlignment, MergePicture. An anchor's place is in the pixels of the shortest frame.
// Warns: vignetting_unknown (a camera's profile without a flat field; not of raw), clipped, and as
// they do.
[[nodiscard]] Result<MergedBracket> MergeFrames(const Bracket& bracket, const FrameLoader& load,
                                                const BracketMergeRequest& request);

// Noise that a bracket shows, after the camera's black; absent where no two frames share enough.
// Refused as MergeFrames.
[[nodiscard]] Result<std::optional<NoiseProfile>> MeasureBracketNoise(const Bracket& bracket,
                                                                      const FrameLoader& load,
                                                                      const KnownCamera& camera);

}  // namespace lightcal
