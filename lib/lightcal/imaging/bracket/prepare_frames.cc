// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/prepare_frames.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "lightcal/core/parallel.h"
#include "lightcal/imaging/bracket/align_prepared.h"
#include "lightcal/imaging/bracket/compare_labels.h"
#include "lightcal/imaging/bracket/merge_bracket.h"
#include "lightcal/imaging/bracket/release_rows.h"
#include "lightcal/imaging/bracket/thin_frame.h"
#include "lightcal/imaging/bracket/top_values.h"
#include "lightcal/imaging/camera/flat_field.h"

namespace lightcal {
namespace {

constexpr std::size_t kScratchFrom = std::size_t{1} << 29;  // bytes of samples

// Frames into prepared.frames, and which of their pixels hold no number.
Result<void> LoadFrames(const std::vector<FrameInfo>& infos, const FrameLoader& load,
                        const Progress& progress, PreparedFrames& prepared, Warnings& warnings) {
  std::size_t bytes = 0;
  for (const FrameInfo& info : infos) {
    const std::size_t sample = info.meaning == SampleMeaning::kLinear ? 4 : 2;
    bytes += sample * static_cast<std::size_t>(info.width) * static_cast<std::size_t>(info.height) *
             static_cast<std::size_t>(info.channels);
  }
  const SampleStore store = bytes > kScratchFrom ? SampleStore::kScratchFile : SampleStore::kMemory;
  std::vector<std::optional<Result<MaskedPicture>>> loaded(infos.size());
  CountedProgress counted(progress, static_cast<int>(infos.size()));
  ParallelFor(static_cast<int>(infos.size()), [&](int i) {
    auto& picture = loaded[static_cast<std::size_t>(i)];
    picture = load(infos[static_cast<std::size_t>(i)], store);
    if (!*picture) return;
    const Frame& frame = (*picture)->frame;
    ReleaseRows(frame, 0, frame.info.height);  // before the next one needs the memory
    counted.Done();
  });
  for (auto& picture : loaded) {
    if (!*picture) return Propagate(std::move(*picture));
    if (!(*picture)->masked.empty()) warnings.push_back(WarningOfMasked(**picture));
    Frame& frame = prepared.frames.emplace_back(std::move((*picture)->frame));
    for (const std::size_t pixel : (*picture)->masked) {
      prepared.masked.push_back(static_cast<int>(pixel) % frame.info.width);
      prepared.masked.push_back(static_cast<int>(pixel) / frame.info.width);
    }
  }
  return {};
}

tl::unexpected<Error> NoExposure(const std::string& file, const std::string& what,
                                 const std::string& todo) {
  return Refused("no_exposure_metadata", file, "the file does not say its " + what + "; " + todo);
}

// Exposures t S / N^2 as the tags have them. Without ISO or f-number, which is only possible under
// an anchor, these are the same for all frames.
Result<std::vector<double>> LabelsOf(const std::vector<FrameInfo>& infos, bool anchored) {
  std::vector<double> labels;
  for (const FrameInfo& info : infos) {
    const FrameExposure& exposure = info.exposure;
    if (!exposure.time) {
      return NoExposure(info.file, "exposure time",
                        "give one a file with {merge.exposures} 1/250,1/60,...");
    }
    if (!anchored && !exposure.iso) {
      return NoExposure(info.file, "ISO speed",
                        "give it with {merge.iso}, or a spot reading ({merge.anchor})");
    }
    if (!anchored && !exposure.light_f_number()) {
      return NoExposure(info.file, "f-number",
                        "give it with {exposure.f_number}, or a spot reading ({merge.anchor})");
    }
    const FrameExposure& first = infos.front().exposure;
    if (exposure.iso.has_value() != first.iso.has_value() ||
        exposure.light_f_number().has_value() != first.light_f_number().has_value()) {
      return NoExposure(info.file, "ISO or f-number where other frames do (or the other way round)",
                        "give {merge.iso} and {exposure.f_number}");
    }
    const double n = exposure.light_f_number().value_or(1.0);
    labels.push_back(exposure.time->value() * exposure.iso.value_or(1.0) / (n * n));
  }
  return labels;
}

// An ideal lens's loss of light, for a sensor of this width.
Result<CameraFlat> CosineFourthOf(const FrameInfo& info, Metres sensor_width) {
  if (!info.focal_length) {
    return Refused("no_focal_length", info.file,
                   "the file does not say its focal length, which cos^4 needs; take a flat field "
                   "with {CalibrateCamera} instead");
  }
  const Metres half_diagonal(0.5 * sensor_width.value() *
                             std::hypot(1.0, static_cast<double>(info.height) / info.width));
  return CosineFourthFlat(half_diagonal, *info.focal_length, info.exposure.f_number.value_or(1.0));
}

// `whole`: a frame as it was taken, not made smaller.
Result<void> SetCorrections(const BracketMergeRequest& request, const FrameInfo& whole,
                            PreparedFrames& prepared) {
  std::vector<FrameInfo> infos;
  for (const std::size_t i : prepared.planned.order) infos.push_back(prepared.frames[i].info);
  const int x = prepared.alignment ? prepared.alignment->x : 0,
            y = prepared.alignment ? prepared.alignment->y : 0;
  prepared.corrections = SampleCorrections(whole.width, whole.height, x, y);
  if (request.camera) {
    auto corrections = CorrectionsOf(*request.camera, infos, prepared.planned.plan, x, y);
    if (!corrections) return Propagate(std::move(corrections));
    prepared.corrections = std::move(*corrections);
  }
  prepared.corrections.AddHotPixels(prepared.masked);
  prepared.corrections.SetThinning(prepared.thinning);
  if (!request.cosine_fourth || prepared.corrections.flat()) return {};
  const auto flat = CosineFourthOf(infos.front(), *request.cosine_fourth);
  if (!flat) return tl::unexpected(flat.error());
  prepared.corrections.SetFlat(*flat, SampleCorrections::FlatSource::kCosineFourth);
  return {};
}

// The one that is stated, or what the frames tell, their exposures with it.
Result<void> FindResponse(const BracketMergeRequest& request, PreparedFrames& prepared,
                          MergeRequest& merge) {
  merge.stated_response = request.response.has_value();
  if (request.response) {
    const FrameInfo& info = prepared.frames.front().info;
    prepared.response = ResponseOfCodes(*request.response, static_cast<int>(HighestCode(info)),
                                        std::min(info.channels, 3));
    return {};
  }
  merge.keep_labels = true;
  auto recovered = RecoverResponse(prepared.frames, merge.label_exposure);
  if (!recovered) return Propagate(std::move(recovered));
  prepared.response = std::move(recovered->curves);
  prepared.label_errors = std::move(recovered->exposures.off);
  merge.power_sd = recovered->exposures.power_sd;
  merge.power_reach = recovered->exposures.power_reach;
  prepared.labels_certain = recovered->exposures.certain;
  for (std::size_t i = 0; i < merge.label_exposure.size(); ++i) {
    merge.label_exposure[i] = std::exp(recovered->exposures.ln_exposure[i]);
  }
  return {};
}

Result<void> NameOddLabels(const PreparedFrames& prepared, Warnings& warnings) {
  if (!prepared.labels_certain) {
    warnings.push_back(
        {"labels_disagree", prepared.frames.front().info.file,
         "beside each other the frames were not exposed as their tags or {merge.exposures} say, "
         "and "
         "which exposure is wrong they do not tell where their curve is not known either: sigma "
         "holds each of these; take more frames, check the exposures, or state a curve "
         "that was kept from such a bracket ({merge.response})"});
    return {};
  }
  for (std::size_t i = 0; i < prepared.label_errors.size(); ++i) {
    auto named = NameOddLabel(prepared.label_errors[i], prepared.frames[i].info.file, warnings);
    if (!named) return named;
  }
  return {};
}

}  // namespace

Result<std::unique_ptr<PreparedFrames>> PrepareFrames(const BracketMergeRequest& request,
                                                      const Bracket& bracket,
                                                      const FrameLoader& load, Warnings& warnings) {
  if (bracket.frames.empty()) {
    return Refused("no_frames", "bracket", "holds no frame; open one or more pictures of a scene");
  }
  const auto labels = LabelsOf(bracket.frames, request.anchor.has_value());
  if (!labels) return tl::unexpected(labels.error());
  if (request.camera) {
    if (auto fits = CheckKnownCamera(*request.camera, bracket.frames.front()); !fits) {
      return Propagate(std::move(fits));
    }
  }
  auto color = ColorOfPicture(bracket.frames.front());
  if (!color) return Propagate(std::move(color));
  if (request.camera) *color = CameraColorOf(*request.camera, std::move(*color));
  if (request.space && !color->has_colour) {
    return Refused(
        "no_colour", bracket.frames.front().file,
        "holds no colour, or nobody knows its camera's; leave {merge.space} out for luminance");
  }
  Append(color->warnings, warnings);
  auto prepared = std::make_unique<PreparedFrames>();
  const Progress loading = PartOf(request.progress, 0.0, kLoadingShare);
  if (auto loaded = LoadFrames(bracket.frames, load, loading, *prepared, warnings); !loaded) {
    return Propagate(std::move(loaded));
  }
  prepared->thinning = ThinningOf(prepared->frames.front().info, request.work);
  if (!prepared->thinning.averaged) {
    for (Frame& frame : prepared->frames) frame = ThinFrame(frame, prepared->thinning);
  }
  prepared->color = std::move(*color);
  MergeRequest merge;
  merge.label_exposure = *labels;
  merge.noise = request.noise;
  merge.keep_labels = !request.work.measure_ratios;
  if (bracket.frames.front().meaning == SampleMeaning::kEncoded) {
    if (auto found = FindResponse(request, *prepared, merge); !found) {
      return Propagate(std::move(found));
    }
  } else if (request.response) {
    return Refused("no_codes", bracket.frames.front().file,
                   "holds what its sensor saw, or linear values: there is no response to state; "
                   "leave {merge.response} out");
  }
  for (const Frame& frame : prepared->frames) {
    auto signal = SignalOf(frame, &prepared->response);
    if (!signal) return Propagate(std::move(signal));
    prepared->signals.push_back(std::move(*signal));
    ReleaseRows(frame, 0, frame.info.height);
    merge.noise_in_file.push_back(request.own_noise ? std::vector<NoiseProfile>()
                                                    : frame.info.noise);
  }
  if (request.camera) {
    CorrectBlack(*request.camera, bracket.frames, prepared->signals);
    auto noise = CameraNoiseOf(*request.camera, bracket.frames);
    merge.noise_of_camera = !noise.empty();
    if (!noise.empty()) merge.noise_in_file = std::move(noise);
  }
  if (prepared->thinning.averaged) {
    FindClipping(prepared->signals);
    ClipHeldTops(prepared->signals, FindTops(prepared->signals), *labels);
    ParallelFor(static_cast<int>(prepared->frames.size()), [&](int i) {
      const auto at = static_cast<std::size_t>(i);
      AverageFrame(prepared->thinning, prepared->frames[at], prepared->signals[at]);
    });
    merge.samples_averaged = prepared->thinning.n;
  }
  merge.done = [&frames = prepared->frames](std::size_t i) {
    ReleaseRows(frames[i], 0, frames[i].info.height);
  };
  auto planned = PlanMerge(prepared->signals, merge);
  if (!planned) return Propagate(std::move(planned));
  prepared->planned = std::move(*planned);
  for (const Frame& frame : prepared->frames) ReleaseRows(frame, 0, frame.info.height);
  if (request.align) {
    if (auto aligned = AlignPrepared(std::move(merge), *labels, *prepared); !aligned) {
      return Propagate(std::move(aligned));
    }
  }
  if (auto named = NameOddLabels(*prepared, warnings); !named) return Propagate(std::move(named));
  prepared->planned.plan.estimator = request.work.estimator;
  Append(prepared->planned.warnings, warnings);
  if (auto set = SetCorrections(request, bracket.frames.front(), *prepared); !set)
    return Propagate(std::move(set));
  if (prepared->alignment && prepared->alignment->interpolated && prepared->corrections.flat()) {
    return Refused("flat_of_moved", bracket.frames.front().file,
                   "the camera moved, and what its lens loses towards the corners moved with it; "
                   "flat fields are for tripods: leave yours out");
  }
  return prepared;
}

}  // namespace lightcal
