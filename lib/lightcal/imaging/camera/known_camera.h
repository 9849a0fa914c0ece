// SPDX-License-Identifier: Apache-2.0
// What a camera's profile knows of one bracket.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/imaging/bracket/plan_merge.h"
#include "lightcal/imaging/bracket/sample_corrections.h"
#include "lightcal/imaging/bracket/signal.h"
#include "lightcal/imaging/camera/sensor_to_xyz.h"
#include "lightcal/imaging/camera/spectral_mismatch.h"
#include "lightcal/records/camera_profile.h"

namespace lightcal {

// A camera of which a profile tells, and how one bracket was taken with it.
struct KnownCamera {
  std::shared_ptr<const CameraProfile> profile;
  std::string nd;    // the filter that the frames were taken through, "" = none
  bool flat = true;  // correct the lens's loss of light, where the profile knows it
};

// Refused: camera_needs_raw (a rendered picture), other_camera (another model or picture size than
// the profile's), unknown_nd (the profile has no filter of this name).
[[nodiscard]] Result<void> CheckKnownCamera(const KnownCamera& camera, const FrameInfo& info);

// The profile's noise for every frame, where it knows all their ISO speeds; else none.
[[nodiscard]] std::vector<std::vector<NoiseProfile>> CameraNoiseOf(
    const KnownCamera& camera, std::span<const FrameInfo> infos);

// Moves the frames' black levels to what the profile's dark frames showed; `signals` in the order
// of `infos`.
void CorrectBlack(const KnownCamera& camera, std::span<const FrameInfo> infos,
                  std::span<SignalFrame> signals);

// The profile's matrix, through its filter; without one that of the file's own colours, as `own`.
[[nodiscard]] PictureColor CameraColorOf(const KnownCamera& camera, PictureColor own);

// Flat field, hot pixels and the error of black, for frames `infos` in the plan's order; (x, y) is
// where the merged picture begins in the camera's.
// Refused as FlatFor; bad_camera (a flat field that cannot be), no_exposure_metadata (flat fields,
// and no f-number).
[[nodiscard]] Result<SampleCorrections> CorrectionsOf(const KnownCamera& camera,
                                                      std::span<const FrameInfo> infos,
                                                      const MergePlan& plan, int x, int y);

// 1 sigma of the scale as the profile has it, relative, for these settings; the filter's included.
[[nodiscard]] double CameraScaleSigma(const KnownCamera& camera, const FrameInfo& info);

// True luminance / luminance by the profile's matrix, of a class of lamps.
// Refused as SpectralCamera::Make.
[[nodiscard]] Result<MismatchFactor> CameraMismatch(const CameraProfile& profile, LampClass lamp);
[[nodiscard]] Result<MismatchFactor> CameraMismatch(const CameraProfile& profile,
                                                    const Spectrum& lamp, const std::string& where);

}  // namespace lightcal
