// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/noise_shares.h"

#include <cmath>
#include <tuple>

#include "lightcal/imaging/bracket/cubic_weights.h"

namespace lightcal {
namespace {

constexpr std::size_t kShareSteps = 64;

std::array<float, kShareSteps> SquaresOfSteps() {
  std::array<float, kShareSteps> squares{};
  for (std::size_t i = 0; i < kShareSteps; ++i) {
    for (const float w : CubicWeightsAt(static_cast<float>(i) / kShareSteps)) squares[i] += w * w;
  }
  return squares;
}

float SquaresAt(double place) {
  static const std::array<float, kShareSteps> squares = SquaresOfSteps();
  const double share = place - std::floor(place);
  return squares[static_cast<std::size_t>(share * kShareSteps + 0.5) % kShareSteps];
}

}  // namespace

void NoiseShares::Row(int row, std::size_t first, std::span<float> out) const {
  const auto per_pixel = static_cast<std::size_t>(channels);
  double u = 0.0, v = 0.0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::size_t channel = (first + i) % per_pixel;
    if (i == 0 || channel == 0) {
      const auto column = static_cast<double>((first + i) / per_pixel);
      std::tie(u, v) = from_reference(column + x + 0.5, row + y + 0.5);
    }
    float sum = 0.0F;
    for (const auto& [px, py] : places[channel]) {
      sum += SquaresAt((u - 0.5 - px) / period) * SquaresAt((v - 0.5 - py) / period);
    }
    const auto lattices = static_cast<float>(places[channel].size());
    out[i] = sum / (lattices * lattices);
  }
}

double NoiseShares::Mean(int width, int height) const {
  constexpr int kRows = 64;
  std::vector<float> row(static_cast<std::size_t>(width) * static_cast<std::size_t>(channels));
  double sum = 0.0;
  for (int i = 0; i < kRows; ++i) {
    Row(height * (2 * i + 1) / (2 * kRows), 0, row);
    double line = 0.0;
    for (const float share : row) line += share;
    sum += line / static_cast<double>(row.size());
  }
  return sum / kRows;
}

}  // namespace lightcal
