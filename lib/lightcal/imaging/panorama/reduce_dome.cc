// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/panorama/reduce_dome.h"

#include <algorithm>
#include <cstddef>

#include "lightcal/core/parallel.h"
#include "lightcal/core/view2d.h"

namespace lightcal {
namespace {

std::vector<float> BlockMeans(const std::vector<float>& from, int width, int height, int channels,
                              int step) {
  const int columns = width / step, rows = height / step;
  const int left = (width - columns * step) / 2, top = (height - rows * step) / 2;
  const View2d<const float> view(from.data(), width, height, channels);
  std::vector<float> to(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) *
                        static_cast<std::size_t>(channels));
  ParallelFor(rows, [&](int y) {
    std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) *
                     static_cast<std::size_t>(channels);
    for (int x = 0; x < columns; ++x) {
      for (int c = 0; c < channels; ++c) {
        double sum = 0.0;
        for (int i = 0; i < step * step; ++i) {
          sum += double{view(left + x * step + i % step, top + y * step + i / step, c)};
        }
        to[at++] = static_cast<float>(sum / (step * step));
      }
    }
  });
  return to;
}

}  // namespace

Dome ReducedDome(const Dome& dome, int step) {
  Dome small;
  small.width = dome.width / step;
  small.height = dome.height / step;
  small.channels = dome.channels;
  small.xyz_from_rgb = dome.xyz_from_rgb;
  small.samples = BlockMeans(dome.samples, dome.width, dome.height, dome.channels, step);
  small.nits = BlockMeans(dome.nits, dome.width, dome.height, 1, step);
  return small;
}

std::vector<std::uint8_t> ReducedMarks(const std::vector<std::uint8_t>& marks, int width,
                                       int height, int step) {
  const int columns = width / step, rows = height / step;
  const int left = (width - columns * step) / 2, top = (height - rows * step) / 2;
  std::vector<std::uint8_t> to;
  to.reserve(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  const View2d<const std::uint8_t> view(marks.data(), width, height, 1);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      bool any = false;
      for (int i = 0; i < step * step; ++i) {
        any = any || view(left + x * step + i % step, top + y * step + i / step, 0) != 0;
      }
      to.push_back(any ? 1 : 0);
    }
  }
  return to;
}

}  // namespace lightcal
