// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/captures/lamp_luminance.h"

#include <cmath>
#include <utility>

#include "lightcal/calibrate/session_files.h"
#include "lightcal/imaging/camera/known_camera.h"
#include "lightcal/imaging/camera/spectral_mismatch.h"

namespace lightcal {
namespace {

constexpr double kGreenOnlySigma = 0.15;  // luminance by green pixels, of lamps of any colour

// The colour that another matrix makes of the raw channels which ColorOfPicture made `seen` of.
Xyz Reinterpret(const Matrix3& xyz_from_raw, const PictureColor& color, const Xyz& seen) {
  const Column3 raw = Times(Inverse(color.xyz_from_rgb), {seen.X, seen.Y, seen.Z});
  const Column3 xyz = Times(xyz_from_raw, raw);
  return {xyz[0], xyz[1], xyz[2]};
}

// `camera` answers for a class of lamps and for a spectrum.
template <class Camera>
Result<MismatchFactor> FactorOf(const Session& session, const CaptureDescription& capture,
                                const Camera& camera, const Sources& sources) {
  if (capture.spectrum_file.empty()) {
    return camera.FactorFor(ClassOfLamp(session, capture.light));
  }
  const auto one = ReadTheOneSpectrum(sources, PathInSession(session, capture.spectrum_file),
                                      capture.spectrum_file);
  if (!one) return tl::unexpected(one.error());
  return camera.FactorFor(one->imported.spectrum);
}

struct ProfiledCamera {
  const CameraProfile& profile;
  const CaptureDescription& capture;

  [[nodiscard]] Result<MismatchFactor> FactorFor(LampClass lamp) const {
    return CameraMismatch(profile, lamp);
  }
  [[nodiscard]] Result<MismatchFactor> FactorFor(const Spectrum& lamp) const {
    return CameraMismatch(profile, lamp, capture.spectrum_file);
  }
};

LampLuminance Corrected(const MismatchFactor& factor, const Xyz& by_luminance, Xy xy) {
  return {by_luminance.Y * factor.At(MiredsOfLamp(xy)), factor.sigma, xy};
}

}  // namespace

Result<LampLuminance> LuminanceOfLamp(const Session& session, const CaptureDescription& capture,
                                      const CapturePicture& picture, const Xyz& seen,
                                      const Sources& sources) {
  const FrameInfo& info = picture.info;
  const PictureColor& color = picture.color;
  const bool raw = info.meaning == SampleMeaning::kMosaic || info.meaning == SampleMeaning::kSensor;
  if (const auto& profile = picture.camera.profile) {
    // `seen` is by the profile's own matrix, to which its scale belongs.
    const auto factor = FactorOf(session, capture, ProfiledCamera{*profile, capture}, sources);
    if (!factor) return tl::unexpected(factor.error());
    if (!profile->color) return LampLuminance{seen.Y, factor->sigma, std::nullopt};
    return Corrected(*factor, seen, XyFromXyz(seen));
  }
  if (picture.camera.sensitivities) {
    if (!raw || info.channels == 2 || !color.has_colour) {
      return Refused("camera_needs_raw", capture.frames,
                     "spectral sensitivities speak of raw channels; leave camera out for pictures "
                     "that were rendered");
    }
    const auto camera = SpectralCamera::Make(*picture.camera.sensitivities);
    if (!camera) return tl::unexpected(camera.error());
    const auto factor = FactorOf(session, capture, *camera, sources);
    if (!factor) return tl::unexpected(factor.error());
    const Xyz own = Reinterpret(camera->xyz_from_raw(), color, seen);
    return Corrected(*factor, own, XyFromXyz(own));
  }
  if (!color.has_colour) return LampLuminance{seen.Y, kGreenOnlySigma, std::nullopt};
  const MismatchFactor generic = GenericMismatch(ClassOfLamp(session, capture.light));
  // ColorOfPicture's matrix of RAW frames is the one for daylight, which the factor belongs to.
  if (raw && info.matrices) return Corrected(generic, seen, XyFromXyz(seen));
  // A rendered picture: nobody knows by which matrix, so the mean stays an error.
  const double off = generic.At(MiredsOfLamp(XyFromXyz(seen))) - 1.0;
  return LampLuminance{seen.Y, std::hypot(generic.sigma, off), XyFromXyz(seen)};
}

}  // namespace lightcal
