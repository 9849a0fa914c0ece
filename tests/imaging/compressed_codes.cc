// SPDX-License-Identifier: Apache-2.0
#include "compressed_codes.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace lightcal::test {
namespace {

constexpr int kBlock = 8;

}  // namespace

void Compress(std::vector<double>& codes, int width, int channel, double step) {
  const int height = static_cast<int>(codes.size()) / (3 * width);
  std::array<std::array<double, kBlock>, kBlock> wave{};
  for (int u = 0; u < kBlock; ++u) {
    for (int x = 0; x < kBlock; ++x) {
      wave[u][x] = (u == 0 ? std::sqrt(1.0 / kBlock) : std::sqrt(2.0 / kBlock)) *
                   std::cos((2 * x + 1) * u * std::numbers::pi / (2.0 * kBlock));
    }
  }
  const auto at = [&](int x, int y) -> double& {
    return codes[static_cast<std::size_t>((y * width + x) * 3 + channel)];
  };
  for (int by = 0; by < height; by += kBlock) {
    for (int bx = 0; bx < width; bx += kBlock) {
      std::array<std::array<double, kBlock>, kBlock> rounded{};
      for (int v = 0; v < kBlock; ++v) {
        for (int u = 0; u < kBlock; ++u) {
          double sum = 0.0;
          for (int y = 0; y < kBlock; ++y) {
            for (int x = 0; x < kBlock; ++x) sum += wave[v][y] * wave[u][x] * at(bx + x, by + y);
          }
          rounded[v][u] = step * std::round(sum / step);
        }
      }
      for (int y = 0; y < kBlock; ++y) {
        for (int x = 0; x < kBlock; ++x) {
          double sum = 0.0;
          for (int v = 0; v < kBlock; ++v) {
            for (int u = 0; u < kBlock; ++u) sum += wave[v][y] * wave[u][x] * rounded[v][u];
          }
          at(bx + x, by + y) = sum;
        }
      }
    }
  }
}

}  // namespace lightcal::test
