// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/inspect_picture.h"

#include <limits>
#include <utility>

#include "lightcal/calibrate/merge_bracket.h"
#include "lightcal/core/numbers_text.h"

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
  for (const std::size_t pixel : picture->masked) {
    luminance->nits[pixel] = std::numeric_limits<float>::quiet_NaN();
  }
  Warnings warnings = picture->frame.info.warnings;
  warnings.insert(warnings.end(), luminance->warnings.begin(), luminance->warnings.end());
  InspectedPicture inspected{std::move(picture->frame.info), *std::move(luminance), std::nullopt,
                             std::move(picture->masked), std::move(warnings)};
  if (convention == LuminanceConvention::kPhotometric) TakeOwnScale(inspected);
  return inspected;
}

}  // namespace lightcal
