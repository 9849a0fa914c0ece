// SPDX-License-Identifier: Apache-2.0
// What the pictures of one [[capture]] say, and what its kinds share.
#pragma once

#include <string>

#include "lightcal/calibrate/merge_bracket.h"
#include "lightcal/core/result.h"
#include "lightcal/imaging/scene/patches.h"
#include "lightcal/records/session.h"

namespace lightcal::app {

inline constexpr const char* kCameraDevicePrefix = "camera:";
// Of a camera whose profile measures its scale.
inline constexpr const char* kCalibratedDevicePrefix = "calibrated_camera:";

struct CaptureReading {
  Reading reading;
  std::string camera;           // "" = unknown
  bool anchored = false;        // a lux meter's reading gives the scale
  double independent_sd = 0.0;  // relative
  double shared_sd = 0.0;       // relative: with other captures of this light by this camera
};

// The same error, saying which capture it is of, and what a person can add there.
[[nodiscard]] tl::unexpected<Error> AtCapture(const CaptureDescription& capture, Error error);

// The capture's frames, with what the session says against their files.
[[nodiscard]] Result<Bracket> OpenCapture(const Session& session,
                                          const CaptureDescription& capture);

// What capture.camera is, where it is given; its profile, where it is one, goes into `request`.
// Fails as ReadWholeFile. Refused as CameraFileFromJson.
[[nodiscard]] Result<CameraFile> CameraOfCapture(const Session& session,
                                                 const CaptureDescription& capture);
[[nodiscard]] Result<void> UseCameraOfCapture(const Session& session,
                                              const CaptureDescription& capture,
                                              BracketMergeRequest& request);

// capture.rect, else the middle ninth.  Refused: bad_region.
[[nodiscard]] Result<Region> RegionOfCapture(const CaptureDescription& capture,
                                             const FrameInfo& info);

// Warns where nothing but the ISO speed gives the scale, and counts the files as read.
void NoteCapture(const CaptureDescription& capture, const MergedBracket& merged, Session& session,
                 Warnings& warnings);

// A reading of this capture's light with everything but illuminance and distance: colour, device,
// time.
struct LampLuminance;
[[nodiscard]] Reading ReadingOfPicture(const CaptureDescription& capture, const FrameInfo& info,
                                       const MergedBracket& merged, const LampLuminance& lamp);

// 1 sigma of anchor_illuminance_lx, relative: the named meter's.
[[nodiscard]] double AnchorSigma(const Session& session, const CaptureDescription& capture);

}  // namespace lightcal::app
