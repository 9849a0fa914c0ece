// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/camera/calibrate_camera.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "lightcal/calibrate/camera/color_calibration.h"
#include "lightcal/calibrate/camera/scale_readings.h"
#include "lightcal/calibrate/merge_bracket.h"
#include "lightcal/calibrate/session_files.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/imaging/bracket/noise.h"
#include "lightcal/imaging/camera/camera_scale.h"
#include "lightcal/imaging/camera/dark_frame.h"
#include "lightcal/imaging/camera/flat_field.h"
#include "lightcal/imaging/camera/raw_patch.h"
#include "lightcal/records/stored_pixels.h"

namespace lightcal {
namespace {

constexpr double kSameSetting = 0.02;  // of ln: ISO, time, aperture

struct OpenFrames {
  const CameraFramesDescription* what = nullptr;
  Bracket bracket;
  Bracket without;  // nd
};

bool Differ(double a, double b) { return std::abs(std::log(a / b)) > kSameSetting; }

class Calibrator {
 public:
  Calibrator(Session& session, const Sources& sources, Warnings& warnings)
      : session_(session), sources_(sources), warnings_(warnings) {}

  Result<CameraProfile> Run() {
    if (session_.camera_frames.empty()) {
      return Refused("no_camera_frames", session_.name,
                     "the session names no pictures to calibrate a camera from; add a "
                     "[[camera_frames]] with use and frames");
    }
    if (auto opened = Open(); !opened) return Propagate(std::move(opened));
    const auto each = [this](CameraFramesUse use, auto step) -> Result<void> {
      for (OpenFrames& frames : frames_) {
        if (frames.what->use != use) continue;
        auto done = (this->*step)(frames);
        if (!done) return At(*frames.what, std::move(done).error());
      }
      return {};
    };
    if (auto done = each(CameraFramesUse::kDark, &Calibrator::Dark); !done) {
      return Propagate(std::move(done));
    }
    if (auto done = Noise(); !done) return Propagate(std::move(done));
    if (auto done = each(CameraFramesUse::kFlat, &Calibrator::Flat); !done) {
      return Propagate(std::move(done));
    }
    if (auto done = Color(); !done) return Propagate(std::move(done));
    if (auto done = each(CameraFramesUse::kNd, &Calibrator::Nd); !done) {
      return Propagate(std::move(done));
    }
    if (auto done = each(CameraFramesUse::kScale, &Calibrator::Scale); !done) {
      return Propagate(std::move(done));
    }
    if (readings_.empty()) return std::move(profile_);
    auto scale = CombineScaleReadings(readings_, warnings_);
    if (!scale) return Propagate(std::move(scale));
    profile_.scale = std::move(*scale);
    return std::move(profile_);
  }

 private:
  static tl::unexpected<Error> At(const CameraFramesDescription& what, Error error) {
    if (error.code == "no_exposure_metadata") {
      error.message =
          "the frames do not say their exposure; give exposure_s = [..], f_number and iso in the "
          "[[camera_frames]] (" +
          error.message + ")";
    }
    error.subject = what.where + " (" + error.subject + ")";
    return tl::unexpected(std::move(error));
  }

  Result<Bracket> OpenOne(const CameraFramesDescription& what, const std::string& pattern) {
    BracketOverrides overrides;
    for (const double time : what.exposure_s) overrides.exposure.emplace_back(time);
    overrides.f_number = what.f_number;
    overrides.iso = what.iso;
    const std::vector<std::string> patterns = {PathInSession(session_, pattern)};
    auto bracket = sources_.open_bracket(patterns, overrides);
    if (!bracket) return bracket;
    const FrameInfo& info = bracket->frames.front();
    if (what.rect) {
      auto fits = CheckTurned(what.where, info, *what.rect, bracket->warnings);
      if (!fits) return Propagate(std::move(fits));
    }
    if (frames_.empty() && profile_.width == 0) {
      profile_.camera = info.camera;
      profile_.width = info.width;
      profile_.height = info.height;
    }
    if (auto fits = CheckKnownCamera(Known(), info); !fits) return Propagate(std::move(fits));
    for (const FrameInfo& frame : bracket->frames) NoteInputFile(frame.file, session_);
    return bracket;
  }

  Result<void> Open() {
    for (const CameraFramesDescription& what : session_.camera_frames) {
      OpenFrames open;
      open.what = &what;
      auto bracket = OpenOne(what, what.frames);
      if (!bracket) return At(what, std::move(bracket).error());
      open.bracket = std::move(*bracket);
      if (what.use == CameraFramesUse::kNd) {
        auto without = OpenOne(what, what.without);
        if (!without) return At(what, std::move(without).error());
        open.without = std::move(*without);
      }
      frames_.push_back(std::move(open));
    }
    return {};
  }

  // What is known so far.
  [[nodiscard]] KnownCamera Known() const {
    KnownCamera camera;
    camera.profile = std::make_shared<const CameraProfile>(profile_);
    return camera;
  }

  // `flat`: what is compared lies in different places of the picture, or is a place's own light.
  Result<MergedBracket> MergeRaw(const Bracket& bracket, bool flat = true) {
    BracketMergeRequest request;
    request.camera = Known();
    request.camera->flat = flat;
    request.raw = true;
    request.want_sigma = true;
    const bool noisy = bracket.frames.size() == 1 && bracket.frames.front().noise.empty() &&
                       CameraNoiseOf(*request.camera, bracket.frames).empty();
    if (noisy) request.noise = kMiddlingNoise;
    auto merged = MergeBracket(bracket, sources_, request);
    if (merged) warnings_.insert(warnings_.end(), merged->warnings.begin(), merged->warnings.end());
    return merged;
  }

  Result<void> Dark(OpenFrames& open) {
    const FrameInfo& first = open.bracket.frames.front();
    std::vector<Frame> frames;
    std::vector<SignalFrame> signals;
    for (const FrameInfo& info : open.bracket.frames) {
      const FrameExposure &one = first.exposure, &other = info.exposure;
      if (!other.iso || !other.time) {
        return Refused("no_exposure_metadata", info.file,
                       "a dark frame belongs to an ISO speed and a time; give iso and exposure_s");
      }
      if (Differ(*one.iso, *other.iso) || Differ(one.time->value(), other.time->value())) {
        return Refused("mixed_dark", info.file,
                       "differs in ISO speed or exposure time from " + first.file +
                           "; give one [[camera_frames]] for each");
      }
      auto frame = sources_.load_frame(info);
      if (!frame) return Propagate(std::move(frame));
      frames.push_back(std::move(*frame));
    }
    for (const Frame& frame : frames) {
      auto signal = SignalOf(frame);
      if (!signal) return Propagate(std::move(signal));
      signals.push_back(std::move(*signal));
    }
    auto dark = MeasureDark(signals, *first.exposure.iso, *first.exposure.time);
    if (!dark) return Propagate(std::move(dark));
    profile_.darks.push_back(std::move(*dark));
    return {};
  }

  // One noise an ISO speed: of what was taken for it, else of the brackets of the scale.
  Result<void> Noise() {
    for (const CameraFramesUse use : {CameraFramesUse::kNoise, CameraFramesUse::kScale}) {
      std::map<double, std::vector<NoiseProfile>> found;  // by ISO speed
      for (const OpenFrames& open : frames_) {
        if (open.what->use != use || open.bracket.frames.size() < 2) continue;
        const auto iso = open.bracket.frames.front().exposure.iso;
        if (!iso) continue;
        const auto noise = MeasureBracketNoise(open.bracket, sources_.load_masked_frame, Known());
        if (!noise) return At(*open.what, noise.error());
        if (*noise) found[*iso].push_back(**noise);
        if (!*noise && use == CameraFramesUse::kNoise) {
          return At(*open.what, {ErrorKind::kRefused, "noise_unseen", open.what->frames,
                                 "no two of these frames share enough well exposed pixels to show "
                                 "their noise; take a bracket 1 to 2 EV apart, or equal frames"});
        }
      }
      for (const auto& [iso, all] : found) AddNoise(iso, all);
    }
    return {};
  }

  void AddNoise(double iso, const std::vector<NoiseProfile>& all) {
    const bool known = std::ranges::any_of(
        profile_.noise, [&](const CameraNoise& one) { return !Differ(one.iso, iso); });
    if (known) return;
    NoiseProfile mean;
    for (const NoiseProfile& one : all) {
      mean.scale += one.scale / static_cast<double>(all.size());
      mean.offset += one.offset / static_cast<double>(all.size());
    }
    if (mean.scale > 0.0 && mean.offset > 0.0) profile_.noise.push_back({iso, mean});
  }

  Result<void> Flat(OpenFrames& open) {
    const FrameInfo& first = open.bracket.frames.front();
    for (const FrameInfo& info : open.bracket.frames) {
      if (!info.exposure.f_number) {
        return Refused("no_exposure_metadata", info.file,
                       "a flat field belongs to an aperture; give f_number");
      }
      if (Differ(*info.exposure.f_number, *first.exposure.f_number)) {
        return Refused("mixed_aperture", info.file,
                       "was taken at another aperture than " + first.file +
                           ", and lenses lose light by their aperture; give one "
                           "[[camera_frames]] for each");
      }
    }
    const auto merged = MergeRaw(open.bracket, false);
    if (!merged) return tl::unexpected(merged.error());
    if (merged->clipped_fraction > 0.0) {
      return Refused("flat_saturated", first.file,
                     "a part of it is saturated in every frame; expose shorter");
    }
    const View2d<const float> picture(merged->picture.data(), merged->width, merged->height, 3);
    auto flat = FitFlatField(picture, *first.exposure.f_number, first.focal_length);
    if (!flat) return Propagate(std::move(flat));
    profile_.flats.push_back(*flat);
    return {};
  }

  Result<void> Color() {
    const CameraFramesDescription* chart = nullptr;
    for (OpenFrames& open : frames_) {
      if (open.what->use != CameraFramesUse::kChart) continue;
      if (chart != nullptr || !session_.camera.sensitivities.empty()) {
        return At(*open.what, {ErrorKind::kRefused, "two_colour_sources", open.what->chart,
                               "one chart, or [camera] sensitivities, makes the camera's colours; "
                               "keep one"});
      }
      chart = open.what;
      const auto merged = MergeRaw(open.bracket);
      if (!merged) return At(*chart, merged.error());
      auto color = ColorFromChart(session_, sources_, *chart, *merged);
      if (!color) return At(*chart, std::move(color).error());
      profile_.color = *color;
    }
    if (chart != nullptr) return {};
    return AddOwnColor(session_, sources_, frames_.front().bracket.frames.front(), profile_);
  }

  Result<void> Nd(OpenFrames& open) {
    if (std::ranges::count(profile_.nd_filters, open.what->name, &CameraNdFilter::name) > 0) {
      return Refused("duplicate_name", open.what->name, "two filters bear this name; rename one");
    }
    const auto with = MergeRaw(open.bracket, false);
    if (!with) return tl::unexpected(with.error());
    const auto without = MergeRaw(open.without, false);
    if (!without) return tl::unexpected(without.error());
    const Region region = RegionOf(*open.what, *with);
    const auto dark = MeasureRawPatch(*with, region, open.what->frames);
    if (!dark) return tl::unexpected(dark.error());
    const auto bright = MeasureRawPatch(*without, region, open.what->without);
    if (!bright) return tl::unexpected(bright.error());
    CameraNdFilter filter;
    filter.name = open.what->name;
    for (std::size_t c = 0; c < 3; ++c) {
      filter.attenuation[c] = bright->rgb[c] / dark->rgb[c];
      if (!(filter.attenuation[c] >= 0.1)) {
        return Refused("patch_unreadable", open.what->frames,
                       "a colour sees nothing there; choose a brighter, whiter rect");
      }
    }
    filter.sigma_relative = std::hypot(std::hypot(dark->noise_sd, bright->noise_sd),
                                       std::hypot(with->gauge_sd, without->gauge_sd));
    profile_.nd_filters.push_back(std::move(filter));
    return {};
  }

  Result<void> Scale(OpenFrames& open) {
    const auto merged = MergeRaw(open.bracket);
    if (!merged) return tl::unexpected(merged.error());
    auto reading =
        ReadScale(session_, sources_, *open.what, open.bracket.frames.front(), profile_, *merged);
    if (!reading) return Propagate(std::move(reading));
    readings_.push_back(std::move(*reading));
    return {};
  }

  Session& session_;
  const Sources& sources_;
  Warnings& warnings_;
  CameraProfile profile_;
  std::vector<OpenFrames> frames_;
  std::vector<WeighedScaleReading> readings_;
};

}  // namespace

Result<CameraProfile> CalibrateCamera(Session& session, const Sources& sources,
                                      Warnings& warnings) {
  return Calibrator(session, sources, warnings).Run();
}

}  // namespace lightcal
