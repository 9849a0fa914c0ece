// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/dome/view_groups.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>

#include "lightcal/core/numbers_text.h"

namespace lightcal {
namespace {

constexpr double kSameStep = 0.17;  // stops: half a third

struct GroupedFrame {
  std::string file, time;
  std::optional<double> stops;  // of exposure; absent: the file does not say
};

// log2 of t S / N^2 as far as the tags go.
std::optional<double> StopsOf(const FrameExposure& exposure) {
  if (!exposure.time) return std::nullopt;
  double stops = std::log2(exposure.time->value());
  if (exposure.iso) stops += std::log2(*exposure.iso);
  if (const auto n = exposure.light_f_number()) stops -= 2.0 * std::log2(*n);
  return stops;
}

Result<void> CheckPattern(const std::vector<GroupedFrame>& frames, std::size_t size) {
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const GroupedFrame& first = frames[i % size];
    const GroupedFrame& zero = frames[i - i % size];
    if (!frames[i].stops || !first.stops || !zero.stops) continue;
    const double step = *frames[i].stops - *zero.stops;
    const double step_first = *first.stops - *frames.front().stops;
    if (std::abs(step - step_first) > kSameStep) {
      return Refused("bracket_pattern", frames[i].file,
                     "its exposure is " + RoundedText(step, 2) +
                         " EV from its bracket's first frame, that of the first bracket's frame " +
                         std::to_string(i % size + 1) + " is " + RoundedText(step_first, 2) +
                         " EV: a frame is missing, or {view.bracket} is not how many a view has");
    }
    const bool last = i % size == size - 1;
    if (last && size > 1) {
      bool differs = false;
      for (std::size_t k = i + 1 - size; k < i; ++k) {
        differs = differs || !frames[k].stops ||
                  std::abs(*frames[k].stops - *frames[i].stops) > kSameStep;
      }
      if (!differs) {
        return Refused("bracket_pattern", frames[i].file,
                       "all frames of its bracket have one exposure; without {view.bracket} each "
                       "file is a view");
      }
    }
  }
  return {};
}

}  // namespace

Result<std::vector<std::vector<std::string>>> GroupBrackets(std::vector<std::string> files,
                                                            int frames, const Sources& sources) {
  const auto size = static_cast<std::size_t>(std::max(1, frames));
  std::vector<std::vector<std::string>> groups;
  if (size == 1) {
    for (std::string& file : files) groups.push_back({std::move(file)});
    return groups;
  }
  if (files.size() % size != 0) {
    return Refused("bracket_count", files.back(),
                   std::to_string(files.size()) + " files are no brackets of " +
                       std::to_string(size) + "; give every frame, or another {view.bracket}");
  }
  std::vector<GroupedFrame> tagged;
  std::set<std::string> times;
  for (const std::string& file : files) {
    const auto info = sources.read_frame_info(file);
    if (!info) return tl::unexpected(info.error());
    tagged.push_back({file, info->time, StopsOf(info->exposure)});
    times.insert(info->time);
  }
  // Times are whole seconds: frames of one second stay in the order of their names.
  if (!times.contains("") && times.size() > 1) {
    std::ranges::stable_sort(tagged, {}, &GroupedFrame::time);
  }
  if (auto ok = CheckPattern(tagged, size); !ok) return Propagate(std::move(ok));
  for (std::size_t i = 0; i < tagged.size(); ++i) {
    if (i % size == 0) groups.emplace_back();
    groups.back().push_back(tagged[i].file);
  }
  return groups;
}

}  // namespace lightcal
