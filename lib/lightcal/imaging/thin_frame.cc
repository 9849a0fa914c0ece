// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/thin_frame.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <variant>
#include <vector>

namespace lightcal {
namespace {

struct Block {
  int width = 1, height = 1;
};

Block PatternOf(const FrameInfo& info) {
  Block block{info.cfa.values.empty() ? 1 : info.cfa.width,
              info.cfa.values.empty() ? 1 : info.cfa.height};
  if (info.levels && !info.levels->black.values.empty()) {
    block.width = std::lcm(block.width, info.levels->black.width);
    block.height = std::lcm(block.height, info.levels->black.height);
  }
  return block;
}

template <class Sample>
Frame Kept(const Frame& frame, View2d<const Sample> from, const Block& block, int n) {
  const int across = std::max(1, from.width() / (block.width * n));
  const int down = std::max(1, from.height() / (block.height * n));
  Frame out;
  out.info = frame.info;
  out.info.width = across * block.width;
  out.info.height = down * block.height;
  const auto channels = static_cast<std::size_t>(from.channels());
  const auto pixels =
      static_cast<std::size_t>(out.info.width) * static_cast<std::size_t>(out.info.height);
  auto samples = std::make_shared<std::vector<Sample>>(pixels * channels);
  const View2d<Sample> to(samples->data(), out.info.width, out.info.height, from.channels());
  for (int y = 0; y < out.info.height; ++y) {
    const int from_y = y / block.height * block.height * n + y % block.height;
    for (int x = 0; x < out.info.width; ++x) {
      const int from_x = x / block.width * block.width * n + x % block.width;
      for (int c = 0; c < from.channels(); ++c) to(x, y, c) = from(from_x, from_y, c);
    }
  }
  out.samples = View2d<const Sample>(to);
  out.owner = std::move(samples);
  return out;
}

}  // namespace

Frame ThinFrame(const Frame& frame, int n) {
  const Block block = PatternOf(frame.info);
  const bool too_small = frame.info.width < block.width * n || frame.info.height < block.height * n;
  if (n <= 1 || too_small) return frame;
  return std::visit([&](const auto& from) { return Kept(frame, from, block, n); }, frame.samples);
}

Region ThinRegion(const Region& region, int n) {
  if (n <= 1) return region;
  // Blocks of two pixels, the widest common pattern: a block shows where its first pixel stood.
  const auto inner = [n](int start, int length) {
    const int first = (start + 2 * n - 1) / (2 * n) * 2;
    const int last = (start + length) / (2 * n) * 2;
    return std::pair(first, std::max(1, last - first));
  };
  const auto [x, width] = inner(region.x, region.width);
  const auto [y, height] = inner(region.y, region.height);
  return {x, y, width, height};
}

}  // namespace lightcal
