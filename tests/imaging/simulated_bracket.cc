// SPDX-License-Identifier: Apache-2.0
#include "simulated_bracket.h"

#include <cmath>
#include <memory>
#include <utility>

namespace lightcal::test {

Frame FrameOf(const SyntheticCamera& camera, const SyntheticExposure& exposure,
              std::vector<std::uint16_t> picture, const std::string& name) {
  Frame frame;
  frame.info.file = name;
  frame.info.width = camera.width;
  frame.info.height = camera.height;
  frame.info.meaning = camera.monochrome ? SampleMeaning::kSensor : SampleMeaning::kMosaic;
  if (!camera.monochrome) frame.info.cfa = {.width = 2, .height = 2, .values = {0, 1, 1, 2}};
  SensorLevels levels;
  levels.black = {.width = 1, .height = 1, .values = {static_cast<float>(camera.black_dn)}};
  levels.white.fill(static_cast<float>(camera.white_dn));
  levels.maximum = static_cast<float>(camera.white_dn);
  frame.info.levels = levels;
  frame.info.exposure.time = Seconds(exposure.label_time_s);
  frame.info.exposure.f_number = exposure.label_f_number;
  frame.info.exposure.iso = exposure.iso;
  const auto owner = std::make_shared<const std::vector<std::uint16_t>>(std::move(picture));
  frame.samples = View2d<const std::uint16_t>(owner->data(), camera.width, camera.height);
  frame.owner = owner;
  return frame;
}

std::vector<Frame> ShootBracket(const SyntheticCamera& camera,
                                const std::vector<SyntheticExposure>& series,
                                const SyntheticScene& scene) {
  std::vector<Frame> frames;
  for (const SyntheticExposure& exposure : series) {
    frames.push_back(FrameOf(camera, exposure, Expose(camera, exposure, scene),
                             "frame_" + std::to_string(frames.size())));
  }
  return frames;
}

double LabelExposure(const SyntheticExposure& exposure) {
  const double snapped = std::exp2(std::round(3.0 * std::log2(exposure.label_time_s)) / 3.0);
  return snapped * exposure.iso / (exposure.label_f_number * exposure.label_f_number);
}

double TrueExposure(const SyntheticExposure& exposure) {
  return exposure.true_time_s * exposure.iso / (exposure.true_f_number * exposure.true_f_number);
}

}  // namespace lightcal::test
