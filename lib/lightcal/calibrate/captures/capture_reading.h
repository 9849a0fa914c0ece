// SPDX-License-Identifier: Apache-2.0
// What the pictures of one [[capture]] say, and what its kinds share.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lightcal/calibrate/evidence.h"
#include "lightcal/core/result.h"
#include "lightcal/imaging/bracket/merge_frames.h"
#include "lightcal/imaging/bracket/thin_frame.h"
#include "lightcal/imaging/camera/sensor_to_xyz.h"
#include "lightcal/imaging/scene/patches.h"
#include "lightcal/records/session.h"
#include "lightcal/records/sources.h"

namespace lightcal {

inline constexpr const char* kCameraDevicePrefix = "camera:";
// Of a camera whose profile measures its scale.
inline constexpr const char* kCalibratedDevicePrefix = "calibrated_camera:";

struct CaptureReading {
  Reading reading;
  bool anchored = false;        // a lux meter's reading gives the scale
  double independent_sd = 0.0;  // relative
  double shared_sd = 0.0;       // relative: with other captures of this light by this camera
  // The light with sizes that its picture gave; absent where pictures tell none.
  std::optional<LightDescription> sized{};
  // Why its picture tells no size, where one was looked for; a capture of the same light may.
  std::optional<Error> unsized{};
  PictureFacts found{};
};

// A capture's bracket as one picture, and what is known of the camera.
struct CapturePicture {
  FrameInfo info;  // of the first frame
  PictureColor color;
  CameraFile camera;
  Thinning thinning;
  MergedBracket merged;
};

// Luminance of the lamp's light in a picture, corrected for what the camera makes of its colour.
struct LampLuminance {
  double nits = 0.0;
  double sigma = 0.0;    // of the correction, relative
  std::optional<Xy> xy;  // absent where the camera sees no colour
};

// What a kind of capture makes of its picture.
struct PictureFindings {
  Lux illuminance;              // as the camera has it
  double independent_sd = 0.0;  // relative
  double method_sd = 0.0;       // relative, beside scale and colour: shared by all its captures
  double patch_unit = 0.0;      // luminance of what was read, in the merge's unit; 0 = unknown
  std::optional<double> off_middle_rad{};  // of what was read, from the lens's axis
  bool of_luminance = false;               // the lamp itself is in the picture
};

// The same error, saying which capture it is of, and what a person can add there.
[[nodiscard]] tl::unexpected<Error> AtCapture(const CaptureDescription& capture, Error error);

// The capture's frames, with what the session says against their files.
[[nodiscard]] Result<Bracket> OpenCapture(const Session& session, const CaptureDescription& capture,
                                          const Sources& sources);

// What is wrong with a place in the picture, and what may be why: frames that are shifted against
// each other (`of_merge`, told first), or that a viewer turns.
[[nodiscard]] Error AtPlace(Error error, const Bracket& bracket, const Warnings& of_merge);

// Those frames merged with sigma, in colour where there is any, by capture.camera where it is
// given. Fails and refused: merged_picture (one in cd/m^2 that says no exposure), and as
// MergeFrames, CameraFileFromJson.
[[nodiscard]] Result<CapturePicture> MergeCapture(const Session& session,
                                                  const CaptureDescription& capture,
                                                  const Bracket& bracket,
                                                  const std::optional<SpotReading>& anchor,
                                                  const Sources& sources);

// Exposure in seconds of the shortest frame that the merge used.
[[nodiscard]] std::optional<double> ShortestOf(const MergedBracket& merged);

// capture.rect, else `otherwise`.  Refused: bad_region.
[[nodiscard]] Result<Region> RegionOfCapture(const CaptureDescription& capture,
                                             const FrameInfo& info, const Region& otherwise);

// What a lux meter's reading of a capture says of the luminance of a place whose reflectance is
// given: E rho/pi.
[[nodiscard]] Nits AnchorLuminance(const CaptureDescription& capture);
// What that reading shares with all others of the named meter.
[[nodiscard]] SharedScale AnchorScale(const Session& session, const CaptureDescription& capture);
// 1 sigma of anchor_illuminance_lx, relative: the named meter's.
[[nodiscard]] double AnchorSigma(const Session& session, const CaptureDescription& capture);

// Linear sRGB of a pixel, and the luminance of all, times `factor`.
[[nodiscard]] Rgb RgbAt(const MergedBracket& merged, std::size_t pixel);
[[nodiscard]] std::vector<float> LuminanceOf(const MergedBracket& merged, double factor);

// Counts the files as read, and warns where nothing but the ISO speed gives the scale.
void AddCapture(const Session& session, const CaptureDescription& capture,
                const MergedBracket& merged, Evidence& evidence);

// The reading of this capture's light.
[[nodiscard]] CaptureReading ReadingOfPicture(const Session& session,
                                              const CaptureDescription& capture,
                                              const CapturePicture& picture,
                                              const LampLuminance& lamp,
                                              const PictureFindings& findings);

}  // namespace lightcal
