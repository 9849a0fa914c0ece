// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/camera/known_camera.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lightcal/imaging/camera/camera_scale.h"
#include "lightcal/imaging/camera/dark_frame.h"
#include "lightcal/imaging/camera/flat_field.h"

namespace lightcal {
namespace {

constexpr double kSameSpeed = 0.02;       // of ln
constexpr double kGreenOnlySigma = 0.15;  // luminance by green pixels, of lamps of any colour

const CameraNdFilter* FilterOf(const KnownCamera& camera) {
  const auto& filters = camera.profile->nd_filters;
  const auto found = std::ranges::find(filters, camera.nd, &CameraNdFilter::name);
  return found == filters.end() ? nullptr : &*found;
}

std::string SizeText(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

std::optional<BlackAt> BlackOf(const KnownCamera& camera, const FrameInfo& info) {
  const FrameExposure& exposure = info.exposure;
  if (!exposure.iso || !exposure.time) return std::nullopt;
  return BlackFor(camera.profile->darks, *exposure.iso, *exposure.time);
}

// What black's error does to X in the dark, where every frame counts: sum v s / sum v t, s the
// error and v what the estimator gives signals there.
double BlackSd(const KnownCamera& camera, std::span<const FrameInfo> infos, const MergePlan& plan) {
  double sum = 0.0, weights = 0.0;
  for (std::size_t i = 0; i < infos.size(); ++i) {
    const auto black = BlackOf(camera, infos[i]);
    double weight = plan.exposure[i];
    if (plan.estimator == MergeEstimator::kSums) weight = 1.0;
    if (plan.estimator == MergeEstimator::kLongest) weight = i + 1 == infos.size() ? 1.0 : 0.0;
    sum += weight * (black ? black->sigma : 0.0);
    weights += weight * plan.exposure[i];
  }
  return sum / weights;
}

}  // namespace

Result<void> CheckKnownCamera(const KnownCamera& camera, const FrameInfo& info) {
  const CameraProfile& profile = *camera.profile;
  if (info.meaning != SampleMeaning::kMosaic && info.meaning != SampleMeaning::kSensor) {
    return Refused("camera_needs_raw", info.file,
                   "a camera profile speaks of raw sensor values; give the RAW files, or leave "
                   "the camera out for pictures that were rendered");
  }
  if (!profile.camera.empty() && !info.camera.empty() && profile.camera != info.camera) {
    return Refused("other_camera", info.file,
                   "was taken by \"" + info.camera + "\", the profile is of \"" + profile.camera +
                       "\"; make one of this camera");
  }
  if (info.width != profile.width || info.height != profile.height) {
    return Refused("other_camera", info.file,
                   "is " + SizeText(info.width, info.height) +
                       " pixels, the profile's frames were " +
                       SizeText(profile.width, profile.height) + ": another camera or crop mode");
  }
  if (!camera.nd.empty() && FilterOf(camera) == nullptr) {
    std::string known;
    for (const CameraNdFilter& filter : profile.nd_filters) {
      known += (known.empty() ? "" : ", ") + filter.name;
    }
    return Refused("unknown_nd", camera.nd,
                   known.empty() ? "the camera's profile holds no filter"
                                 : "the camera's profile holds the filters " + known);
  }
  return {};
}

std::vector<std::vector<NoiseProfile>> CameraNoiseOf(const KnownCamera& camera,
                                                     std::span<const FrameInfo> infos) {
  std::vector<std::vector<NoiseProfile>> noise;
  for (const FrameInfo& info : infos) {
    const auto found = std::ranges::find_if(camera.profile->noise, [&](const CameraNoise& one) {
      return info.exposure.iso && std::abs(std::log(one.iso / *info.exposure.iso)) < kSameSpeed;
    });
    if (found == camera.profile->noise.end()) return {};
    noise.push_back({found->noise});
  }
  return noise;
}

void CorrectBlack(const KnownCamera& camera, std::span<const FrameInfo> infos,
                  std::span<SignalFrame> signals) {
  for (std::size_t i = 0; i < infos.size(); ++i) {
    const auto black = BlackOf(camera, infos[i]);
    if (!black) continue;
    SignalFrame& signal = signals[i];
    for (std::size_t row = 0; row < signal.black.size(); ++row) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const auto channel = static_cast<std::size_t>(signal.channel[row][lane]);
        signal.black[row][lane] +=
            static_cast<float>(black->black[channel] / signal.scale[row][lane]);
      }
    }
    for (std::size_t c = 0; c < 3; ++c) signal.clip[c] -= static_cast<float>(black->black[c]);
  }
}

PictureColor CameraColorOf(const KnownCamera& camera, PictureColor own) {
  PictureColor color = std::move(own);
  if (camera.profile->color) {
    color.xyz_from_rgb = camera.profile->color->xyz_from_raw;
    color.has_colour = true;
    color.warnings.clear();
  }
  if (const CameraNdFilter* filter = FilterOf(camera)) {
    for (auto& row : color.xyz_from_rgb) {
      for (std::size_t c = 0; c < 3; ++c) row[c] *= filter->attenuation[c];
    }
  }
  return color;
}

Result<SampleCorrections> CorrectionsOf(const KnownCamera& camera, std::span<const FrameInfo> infos,
                                        const MergePlan& plan, int x, int y) {
  const CameraProfile& profile = *camera.profile;
  SampleCorrections corrections(profile.width, profile.height, x, y);
  for (const CameraDark& dark : profile.darks) corrections.AddHotPixels(dark.hot_pixels);
  corrections.SetBlackSd(BlackSd(camera, infos, plan));
  if (!camera.flat || profile.flats.empty()) return corrections;
  const FrameInfo& info = infos.front();
  if (!info.exposure.f_number) {
    return Refused("no_exposure_metadata", info.file,
                   "the file does not say its f-number, which the camera's flat fields belong to; "
                   "give it, or leave flat fields out ({camera.flat})");
  }
  auto flat = FlatFor(profile.flats, *info.exposure.f_number, info.focal_length);
  if (!flat) return Propagate(std::move(flat));
  if (!LetsLightThrough(*flat, profile.width, profile.height)) {
    return Refused("bad_camera", "flats",
                   "a flat field of the profile lets no light through to a part of the picture; "
                   "make the profile again with {CalibrateCamera}");
  }
  corrections.SetFlat(*flat);
  return corrections;
}

double CameraScaleSigma(const KnownCamera& camera, const FrameInfo& info) {
  const CameraNdFilter* filter = FilterOf(camera);
  return std::hypot(ScaleSigmaAt(camera.profile->scale, info.exposure.f_number, info.exposure.iso),
                    filter != nullptr ? filter->sigma_relative : 0.0);
}

Result<MismatchFactor> CameraMismatch(const CameraProfile& profile, LampClass lamp) {
  if (profile.sensitivities) {
    const auto spectral = SpectralCamera::Make(*profile.sensitivities);
    if (!spectral) return tl::unexpected(spectral.error());
    return spectral->FactorFor(lamp);
  }
  if (profile.color) return GenericMismatch(lamp);
  MismatchFactor none;
  none.sigma = kGreenOnlySigma;
  return none;
}

Result<MismatchFactor> CameraMismatch(const CameraProfile& profile, const Spectrum& lamp,
                                      const std::string& where) {
  if (!profile.sensitivities) {
    return Refused("sensitivities_missing", where,
                   "a lamp's spectrum tells how a camera misreads it only with the camera's "
                   "spectral sensitivities: [camera] sensitivities = \"...\", or name lamp_class");
  }
  const auto spectral = SpectralCamera::Make(*profile.sensitivities);
  if (!spectral) return tl::unexpected(spectral.error());
  return spectral->FactorFor(lamp);
}

}  // namespace lightcal
