// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/scene/highlight.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lightcal/core/statistics.h"

namespace lightcal {
namespace {

constexpr double kInside = 0.97;        // of the outline, whose edge is not the ball's alone
constexpr double kSpotStandsOut = 3.0;  // over the median
constexpr double kLargestShare = 0.1;   // of the ball
constexpr double kRival = 0.8;          // of the brightest, elsewhere

// Means of 2 x 2 pixels; below every value outside of the ball.
struct Means {
  int width, height;
  std::vector<float> value;
  std::vector<std::uint8_t> inside;

  explicit Means(View2d<const float> values)
      : width(values.width() - 1), height(values.height() - 1) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const double u = (x + 1.0) / values.width() * 2.0 - 1.0;
        const double v = (y + 1.0) / values.height() * 2.0 - 1.0;
        inside.push_back(std::hypot(u, v) < kInside ? 1 : 0);
        value.push_back(
            0.25F * (values(x, y) + values(x + 1, y) + values(x, y + 1) + values(x + 1, y + 1)));
      }
    }
  }
};

float MedianInside(const Means& means) {
  std::vector<float> all;
  for (std::size_t i = 0; i < means.value.size(); ++i) {
    if (means.inside[i] != 0) all.push_back(means.value[i]);
  }
  return UpperMedian(all);
}

// The pixels above `level` that hang together with `start`, marked.
std::vector<std::uint8_t> SpotAround(const Means& means, std::size_t start, float level) {
  std::vector<std::uint8_t> spot(means.value.size(), 0);
  std::vector<std::size_t> todo = {start};
  spot[start] = 1;
  while (!todo.empty()) {
    const auto at = static_cast<int>(todo.back());
    todo.pop_back();
    const int x = at % means.width, y = at / means.width;
    for (int ny = std::max(0, y - 1); ny <= std::min(means.height - 1, y + 1); ++ny) {
      for (int nx = std::max(0, x - 1); nx <= std::min(means.width - 1, x + 1); ++nx) {
        const auto next = static_cast<std::size_t>(ny * means.width + nx);
        if (spot[next] != 0 || means.inside[next] == 0 || !(means.value[next] > level)) continue;
        spot[next] = 1;
        todo.push_back(next);
      }
    }
  }
  return spot;
}

}  // namespace

Result<Highlight> FindHighlight(View2d<const float> values, const std::string& name) {
  const auto none = [&](const char* why) { return Refused("no_highlight", name, why); };
  constexpr int kLeastSide = 8;
  if (values.width() < kLeastSide || values.height() < kLeastSide) {
    return none("the box is smaller than 8 pixels; go nearer, or use a longer lens");
  }
  const Means means(values);
  const float median = MedianInside(means);
  std::size_t peak = 0, pixels = 0;
  for (std::size_t i = 0; i < means.value.size(); ++i) {
    if (means.inside[i] == 0) continue;
    ++pixels;
    if (means.inside[peak] == 0 || means.value[i] > means.value[peak]) peak = i;
  }
  const float brightest = means.value[peak];
  if (!(brightest > kSpotStandsOut * median) || !(brightest > 0.0F)) {
    return none(
        "nothing on the ball stands three times above the rest; switch other lamps off and "
        "expose shorter");
  }
  const float level = median + 0.5F * (brightest - median);
  const auto spot = SpotAround(means, peak, level);
  double sum = 0.0, sx = 0.0, sy = 0.0;
  std::size_t size = 0;
  Highlight highlight;
  for (std::size_t i = 0; i < spot.size(); ++i) {
    const bool rival = means.inside[i] != 0 && spot[i] == 0 &&
                       means.value[i] > std::max(double{level}, kRival * double{brightest});
    highlight.alone = highlight.alone && !rival;
    if (spot[i] == 0) continue;
    ++size;
    const double weight = double{means.value[i]} - double{level};
    sum += weight;
    sx += weight * (static_cast<int>(i) % means.width + 1.0);
    sy += weight * (static_cast<int>(i) / means.width + 1.0);
  }
  if (static_cast<double>(size) > kLargestShare * static_cast<double>(pixels)) {
    return none(
        "what is bright fills more than a tenth of the ball; expose shorter, so that the "
        "lamp's own reflection is seen");
  }
  highlight.point = {sx / sum, sy / sum};
  return highlight;
}

}  // namespace lightcal
