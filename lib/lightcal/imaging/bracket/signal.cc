// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/signal.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <optional>
#include <variant>

#include "lightcal/imaging/bracket/signal_kernels.h"

namespace lightcal {
namespace {

constexpr float kNoClipping = 1e31F;
constexpr int kMostChannels = 3;
constexpr double kSpikeShare = 1e-4;      // of a channel's samples that one value must hold
constexpr double kSpikeProminence = 8.0;  // times the mean of the values below it
constexpr int kSpikeBackground = 64;      // values below a spike that it is compared with,
constexpr float kSpikeBelow = 0.5F;       // from this share of it up: not the dark around a lamp
constexpr std::size_t kHistogramSamples = 500'000;
constexpr float kLowestClip = 0.5F;  // of the level the file names; a spike below is the scene's

// What one sample of the period means.
struct Place {
  float black = 0.0F;
  float white = 1.0F;
  int channel = 0;
};

Place PlaceOf(const FrameInfo& info, int x, int y, int c) {
  Place place;
  place.channel = info.channels == 1 ? 0 : c;
  if (info.meaning == SampleMeaning::kMosaic) place.channel = info.cfa(x, y);
  if (info.meaning == SampleMeaning::kLinear) {
    place.white = static_cast<float>(info.radiance_exposure);
    return place;
  }
  if (!info.levels) return place;
  place.black = info.levels->black.values.empty() ? 0.0F : info.levels->black(x, y);
  place.white = info.levels->white[static_cast<std::size_t>(place.channel)];
  return place;
}

template <class T>
std::pair<int, int> PeriodOf(const Periodic2d<T>& pattern) {
  return pattern.values.empty() ? std::pair{1, 1} : std::pair{pattern.width, pattern.height};
}

bool HasResponse(const ResponseCurves* response, int channels) {
  if (response == nullptr) return false;
  for (int c = 0; c < channels; ++c) {
    if (response->signal_of_code[static_cast<std::size_t>(c)].empty()) return false;
  }
  return true;
}

void ApplyResponse(const SignalFrame& frame, std::span<const std::uint16_t> codes, int y,
                   std::span<float> out) {
  const auto& channels = frame.channel[static_cast<std::size_t>(y % frame.row_period)];
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto& curve =
        frame.response->signal_of_code[static_cast<std::size_t>(channels[i % kLanes])];
    out[i] = curve[std::min<std::size_t>(codes[i], curve.size() - 1)];
  }
}

// A value and how many samples hold it.
struct Run {
  float value = 0.0F;
  std::size_t count = 0;
};

// The upper quarter of a channel's values in a frame, largest first; `values` is used up.
std::vector<Run> TopRuns(std::vector<float>& values) {
  const std::size_t kept = std::min(values.size(), std::max<std::size_t>(values.size() / 4, 4096));
  const auto end = values.begin() + static_cast<std::ptrdiff_t>(kept);
  if (end != values.end()) std::nth_element(values.begin(), end, values.end(), std::greater<>());
  std::sort(values.begin(), end, std::greater<>());
  std::vector<Run> runs;
  for (auto it = values.begin(); it != end; ++it) {
    if (runs.empty() || runs.back().value != *it) runs.push_back({*it, 0});
    ++runs.back().count;
  }
  return runs;
}

// The highest value that stands out from those just below it.
std::optional<float> SpikeOf(std::span<const Run> runs, std::size_t samples) {
  const double needed = std::max(16.0, kSpikeShare * static_cast<double>(samples));
  const auto top = std::find_if(runs.begin(), runs.end(), [&](const Run& run) {
    return static_cast<double>(run.count) >= needed;
  });
  // Nothing clips in the dark.
  if (top == runs.end() || !(top->value > 0.0F)) return std::nullopt;
  double below = 0.0;
  int values = 0;
  for (auto it = std::next(top); it != runs.end() && values < kSpikeBackground; ++it, ++values) {
    if (it->value < kSpikeBelow * top->value) break;
    below += static_cast<double>(it->count);
  }
  const bool stands_out =
      values == 0 || static_cast<double>(top->count) > kSpikeProminence * below / values;
  return stands_out ? std::optional(top->value) : std::nullopt;
}

std::array<std::optional<float>, 4> SpikesOf(const SignalFrame& frame) {
  std::array<std::vector<float>, 4> values;
  std::vector<float> row(frame.row_samples());
  for (const int y : SpreadRows(frame, kHistogramSamples)) {
    ReadSignals(frame, y, 0, row);
    const auto& channels = frame.channel[static_cast<std::size_t>(y % frame.row_period)];
    for (std::size_t i = 0; i < row.size(); ++i) {
      values[static_cast<std::size_t>(channels[i % kLanes])].push_back(row[i]);
    }
  }
  std::array<std::optional<float>, 4> spikes;
  for (std::size_t c = 0; c < values.size(); ++c) {
    const std::size_t samples = values[c].size();
    spikes[c] = SpikeOf(TopRuns(values[c]), samples);
  }
  return spikes;
}

}  // namespace

std::pair<int, int> PixelPeriod(const FrameInfo& info) {
  auto [columns, rows] =
      info.meaning == SampleMeaning::kMosaic ? PeriodOf(info.cfa) : std::pair{1, 1};
  if (info.levels && info.meaning != SampleMeaning::kLinear) {
    const auto [black_columns, black_rows] = PeriodOf(info.levels->black);
    columns = std::lcm(columns, black_columns);
    rows = std::lcm(rows, black_rows);
  }
  return {columns, rows};
}

Result<SignalFrame> SignalOf(const Frame& frame, const ResponseCurves* response) {
  const FrameInfo& info = frame.info;
  const auto [columns, rows] = PixelPeriod(info);
  if (kLanes % std::lcm(columns * info.channels, info.channels) != 0) {
    return Refused("pattern_too_wide", info.file,
                   "its colour filter or black pattern repeats after " + std::to_string(columns) +
                       " pixels, which lightcal does not handle");
  }
  SignalFrame signal;
  if (info.meaning == SampleMeaning::kEncoded) {
    if (!HasResponse(response, info.channels)) {
      return Refused("no_response", info.file,
                     "its codes passed through a camera's response curve that is not known");
    }
    signal.response = response;
  }
  signal.name = info.file;
  signal.samples = frame.samples;
  signal.width = info.width;
  signal.height = info.height;
  signal.channels = info.channels;
  signal.row_period = rows;
  signal.column_period = columns;
  for (int y = 0; y < rows; ++y) {
    auto& black = signal.black.emplace_back();
    auto& scale = signal.scale.emplace_back();
    auto& channel = signal.channel.emplace_back();
    for (int lane = 0; lane < kLanes; ++lane) {
      const Place place = PlaceOf(info, lane / info.channels, y, lane % info.channels);
      if (!(place.white > place.black)) {
        return Refused("bad_levels", info.file,
                       "its white level is not above its black level; the file is damaged or of a "
                       "kind lightcal does not know");
      }
      if (place.channel >= kMostChannels) {
        return Refused("pattern_unknown", info.file,
                       "its colour filters are not red, green and blue");
      }
      black[static_cast<std::size_t>(lane)] = place.black;
      scale[static_cast<std::size_t>(lane)] = 1.0F / (place.white - place.black);
      channel[static_cast<std::size_t>(lane)] = place.channel;
    }
  }
  if (info.meaning == SampleMeaning::kLinear) {
    // Levels of a linear picture: it holds the most that its encoding can.
    const auto most = info.levels
                          ? info.levels->maximum / static_cast<float>(info.radiance_exposure)
                          : kNoClipping;
    signal.clip.fill(most);
  }
  return signal;
}

void ReadSignals(const SignalFrame& frame, int y, std::size_t first, std::span<float> out) {
  const auto phase = static_cast<std::size_t>(y % frame.row_period);
  if (const auto* codes = std::get_if<View2d<const std::uint16_t>>(&frame.samples)) {
    const auto row = codes->row(y).subspan(first, out.size());
    if (frame.response != nullptr) return ApplyResponse(frame, row, y, out);
    kernels::SignalFromCodes(row.data(), out.size(), frame.black[phase], frame.scale[phase],
                             out.data());
    return;
  }
  const auto row = std::get<View2d<const float>>(frame.samples).row(y).subspan(first, out.size());
  kernels::SignalFromFloats(row.data(), out.size(), frame.black[phase], frame.scale[phase],
                            out.data());
}

void FindClipping(std::span<SignalFrame> frames, const FrameDone& done) {
  std::array<std::optional<float>, 4> highest;
  std::array<float, 4> known = frames.empty() ? std::array<float, 4>{} : frames[0].clip;
  for (const SignalFrame& frame : frames) {
    for (std::size_t c = 0; c < known.size(); ++c) known[c] = std::min(known[c], frame.clip[c]);
  }
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto spikes = SpikesOf(frames[i]);
    if (done) done(i);
    for (std::size_t c = 0; c < highest.size(); ++c) {
      if (spikes[c] && (!highest[c] || *spikes[c] > *highest[c])) highest[c] = spikes[c];
    }
  }
  for (SignalFrame& frame : frames) {
    for (std::size_t c = 0; c < highest.size(); ++c) {
      if (frame.clip[c] > kClipUnknownFrom) frame.clip[c] = known[c];
      const bool plausible = highest[c] && (frame.clip[c] > kClipUnknownFrom ||
                                            *highest[c] > kLowestClip * frame.clip[c]);
      if (plausible) frame.clip[c] = std::min(frame.clip[c], *highest[c]);
    }
  }
}

std::vector<int> SpreadRows(const SignalFrame& frame, std::size_t samples) {
  const int period = frame.row_period;
  const int groups = std::max(1, frame.height / period);
  const std::size_t group_samples = frame.row_samples() * static_cast<std::size_t>(period);
  const auto wanted = static_cast<int>(std::clamp<std::size_t>(
      samples / std::max<std::size_t>(group_samples, 1), 1, static_cast<std::size_t>(groups)));
  std::vector<int> rows;
  for (int i = 0; i < wanted; ++i) {
    const int group = static_cast<int>((2LL * i + 1) * groups / (2LL * wanted));
    for (int dy = 0; dy < period && group * period + dy < frame.height; ++dy) {
      rows.push_back(group * period + dy);
    }
  }
  return rows;
}

}  // namespace lightcal
