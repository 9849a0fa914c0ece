// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/inspect_picture.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <variant>
#include <vector>

#include "lightcal/calibrate/merge_bracket.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/imaging/scene/flat_top.h"

namespace lightcal {
namespace {

// What a single RAW without a noise profile is taken for: 30,000 electrons, 12 bits of read noise.
// Its statistics do not depend on it.
constexpr NoiseProfile kMiddlingSensor{1.0 / 30000.0, 1.0 / (4096.0 * 4096.0)};

// A single RAW is a bracket of one frame: its luminance by the ISO prior.
Result<InspectedPicture> InspectRaw(FrameInfo info, const Sources& sources,
                                    const BracketOverrides& overrides) {
  const auto bracket = sources.open_bracket(std::vector<std::string>{info.file}, overrides);
  if (!bracket) return tl::unexpected(bracket.error());
  BracketMergeRequest request;
  if (info.noise.empty()) request.noise = kMiddlingSensor;
  auto merged = MergeBracket(*bracket, sources, request);
  if (!merged) return Propagate(std::move(merged));
  InspectedPicture inspected;
  for (const Warning& warning : merged->warnings) {
    if (warning.code != "one_frame") inspected.warnings.push_back(warning);  // asked for one
  }
  inspected.info = std::move(info);
  inspected.luminance.width = merged->width;
  inspected.luminance.height = merged->height;
  inspected.luminance.nits = std::move(merged->picture);
  inspected.luminance.scale = WordOf(merged->scale_source);
  inspected.scale_u95_relative = merged->scale_u95_relative;
  return inspected;
}

// What our own merge wrote beside the samples.
void TakeOwnScale(InspectedPicture& inspected) {
  for (const auto& [name, text] : inspected.info.lightcal_attributes) {
    if (name == "scale_source") inspected.luminance.scale = text;
    if (name == "scale_u95_relative") inspected.scale_u95_relative = ParseNumber(text);
  }
}

// Where the brightest that a picture holds is cut off, or drawn flat, it is three times as bright
// as the mean or more; a grey card that fills the frame is not meant.
std::vector<std::size_t> BrightEndsOf(const Frame& frame, const std::vector<float>& nits) {
  constexpr double kFarAbove = 3.0;
  const auto& samples = std::get<View2d<const float>>(frame.samples);
  const auto count = static_cast<std::size_t>(samples.width()) * samples.height();
  const auto channels = static_cast<std::size_t>(samples.channels());
  const std::vector<std::uint8_t> ends =
      CutOffPixels({samples.data(), count * channels}, samples.channels(), nits);
  std::vector<std::size_t> pixels;
  double sum = 0.0, at_end = 0.0;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    sum += double{nits[i]};
    if (ends[i] == 0) continue;
    at_end += double{nits[i]};
    pixels.push_back(i);
  }
  const double mean_share = static_cast<double>(pixels.size()) / static_cast<double>(nits.size());
  if (!(at_end > kFarAbove * mean_share * sum)) pixels.clear();
  return pixels;
}

}  // namespace

Result<InspectedPicture> InspectPicture(const std::string& path, const Sources& sources,
                                        const BracketOverrides& overrides,
                                        LuminanceConvention convention) {
  auto info = sources.read_frame_info(path);
  if (!info) return Propagate(std::move(info));
  if (info->meaning == SampleMeaning::kMosaic || info->meaning == SampleMeaning::kSensor) {
    return InspectRaw(*std::move(info), sources, overrides);
  }
  if (info->meaning == SampleMeaning::kEncoded) {
    return Refused("no_response", path,
                   "its codes are no luminance without the camera's response curve; merge the "
                   "bracket it belongs to ({MergeBracket}), or use the RAW");
  }
  auto picture = sources.read_masked_frame(path);
  if (!picture) return Propagate(std::move(picture));
  auto luminance = LuminanceOfPicture(picture->frame, convention);
  if (!luminance) return Propagate(std::move(luminance));
  std::vector<std::size_t> cut_off = BrightEndsOf(picture->frame, luminance->nits);
  for (const std::size_t pixel : picture->masked) {
    luminance->nits[pixel] = std::numeric_limits<float>::quiet_NaN();
  }
  Warnings warnings = picture->frame.info.warnings;
  warnings.insert(warnings.end(), luminance->warnings.begin(), luminance->warnings.end());
  InspectedPicture inspected{
      std::move(picture->frame.info), *std::move(luminance), std::nullopt,
      std::move(picture->masked),     std::move(warnings),   std::move(cut_off)};
  if (convention == LuminanceConvention::kPhotometric) TakeOwnScale(inspected);
  return inspected;
}

}  // namespace lightcal
