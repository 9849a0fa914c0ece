// SPDX-License-Identifier: Apache-2.0
// Frames on one linear scale, as the merge reads them:
//   signal = (sample - black) / (white - black)          [1 = full scale, negative = noise]
// for sensor values; scene-linear samples are their own signal; codes go through a response curve.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/records/frame.h"
#include "lightcal/records/response_curves.h"

namespace lightcal {

struct NoiseShares;  // noise_shares.h

// A row of a picture is width * channels samples. What belongs to a sample (its channel, its black
// level) repeats with a period that divides this number, so that loops run over whole lanes.
inline constexpr int kLanes = 48;

// A clip above this is none: scene-linear files that do not show one.
inline constexpr float kClipUnknownFrom = 1e30F;

// One frame of a bracket. Looks at the frame's samples: the Frame must outlive it.
struct SignalFrame {
  std::string name;
  SampleView samples;
  int width = 0, height = 0, channels = 1;
  int row_period = 1;     // rows after which the lanes repeat
  int column_period = 1;  // pixels after which they do
  // [row % row_period][sample index % kLanes]
  std::vector<std::array<float, kLanes>> black;
  std::vector<std::array<float, kLanes>> scale;  // 1 / (white - black)
  std::vector<std::array<int, kLanes>> channel;  // 0 R, 1 G, 2 B; all 0 for a single channel
  // Signal at which the sensor clips, per channel: the white level, or the spike that the histogram
  // shows below it (sensors clip earlier than their tags say). Above kClipUnknownFrom: no clipping
  // known.
  std::array<float, 4> clip{1.0F, 1.0F, 1.0F, 1.0F};
  const ResponseCurves* response = nullptr;
  // Of a picture interpolated from another: what is left of its samples' variance.
  std::shared_ptr<const NoiseShares> shares{};

  [[nodiscard]] std::size_t row_samples() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
  }
};

// Columns and rows after which everything about a sample repeats: its filter, its black.
[[nodiscard]] std::pair<int, int> PixelPeriod(const FrameInfo& info);

// What the samples of a frame mean, on the scale above. `response` serves encoded frames and must
// outlive the result.
// Refused: bad_levels (white not above black), pattern_too_wide (a period that kLanes does not
// hold), pattern_unknown (filters other than red, green, blue), no_response (encoded samples and no
// curve).
[[nodiscard]] Result<SignalFrame> SignalOf(const Frame& frame,
                                           const ResponseCurves* response = nullptr);

// Told the index of each frame that was gone through: its samples may leave memory.
using FrameDone = std::function<void(std::size_t)>;

// The signals of samples [first, first + out.size()) of row y; first is a multiple of kLanes.
void ReadSignals(const SignalFrame& frame, int y, std::size_t first, std::span<float> out);

// Sets every frame's clip from the highest spike at the top of any frame's histogram, between half
// of the level the file names and that level: all frames of a bracket share one sensor, so a clip
// stays where it is from frame to frame. A spike is one value held by at least 1e-4 of the samples
// of a channel, and by eight times as many as the mean of the values just below it, down to half of
// it. Smaller lamps: top_values.h.
void FindClipping(std::span<SignalFrame> frames, const FrameDone& done = {});

// Rows spread evenly over the picture that hold about `samples` samples together, each with its
// neighbour in the pattern: y, y + 1, ... y + period - 1.
[[nodiscard]] std::vector<int> SpreadRows(const SignalFrame& frame, std::size_t samples);

}  // namespace lightcal
