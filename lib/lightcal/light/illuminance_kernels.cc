// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/illuminance_kernels.h"

#include <cmath>

#include "lightcal/core/every_processor.h"

namespace lightcal::kernels {
namespace {

// One row: pointers, and u95/E at its beginning and how it grows along s.
struct Row {
  const double* x;
  const double* s;
  std::size_t count;
  float* lux;
  float* u95;
  double from, slope;
};

inline Row RowOf(const Tile& tile, std::size_t j, const Corners& relative) {
  const double t = tile.t[j];
  const double from = relative.at00 + t * (relative.at01 - relative.at00);
  const double to = relative.at10 + t * (relative.at11 - relative.at10);
  const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(j) * tile.stride;
  return {tile.x.data(), tile.s.data(), tile.x.size(), tile.lux + at,
          tile.u95 + at, from,          to - from};
}

}  // namespace

LIGHTCAL_EVERY_CPU
void AddPoint(const Tile& tile, const PointOver& lamp, const Corners& relative_u95) {
  const double strength = lamp.candela * lamp.height;
  const double offset = lamp.offset;
  for (std::size_t j = 0; j < tile.y.size(); ++j) {
    const Row row = RowOf(tile, j, relative_u95);
    float* __restrict lux_row = row.lux;
    float* __restrict u95_row = row.u95;
    const double dy = tile.y[j] - lamp.y;
    const double across2 = lamp.height * lamp.height + dy * dy;
    for (std::size_t i = 0; i < row.count; ++i) {
      const double dx = row.x[i] - lamp.x;
      const double d = std::sqrt(across2 + dx * dx);
      const double moved = d + offset;
      const double lux = strength / (d * moved * moved);
      lux_row[i] += static_cast<float>(lux);
      u95_row[i] += static_cast<float>(lux * (row.from + row.slope * row.s[i]));
    }
  }
}

LIGHTCAL_EVERY_CPU
void AddSpot(const Tile& tile, const SpotOver& lamp, const Corners& relative_u95) {
  const PointOver& point = lamp.point;
  const double strength = point.candela * point.height;
  for (std::size_t j = 0; j < tile.y.size(); ++j) {
    const Row row = RowOf(tile, j, relative_u95);
    float* __restrict lux_row = row.lux;
    float* __restrict u95_row = row.u95;
    const double dy = tile.y[j] - point.y;
    const double across2 = point.height * point.height + dy * dy;
    const double z_of_row = lamp.z_at_origin + lamp.z_along_y * tile.y[j];
    for (std::size_t i = 0; i < row.count; ++i) {
      const double dx = row.x[i] - point.x;
      const double d2 = across2 + dx * dx;
      const double d = std::sqrt(d2);
      const double z = z_of_row + lamp.z_along_x * row.x[i];
      const double inside = (lamp.s_outer - 0.5 * (1.0 - z / d)) * lamp.per_s;
      const double above = inside > 0.0 ? inside : 0.0;
      const double t = above < 1.0 ? above : 1.0;
      const double lux = t * (lamp.a + t * (lamp.b + t * lamp.c)) * strength / (d * d2);
      lux_row[i] += static_cast<float>(lux);
      u95_row[i] += static_cast<float>(lux * (row.from + row.slope * row.s[i]));
    }
  }
}

LIGHTCAL_EVERY_CPU
void AddFlat(const Tile& tile, const FlatOver& lamp, const Corners& relative_u95) {
  constexpr std::size_t kChunk = 64;
  alignas(64) double sum[kChunk];
  for (std::size_t j = 0; j < tile.y.size(); ++j) {
    const Row row = RowOf(tile, j, relative_u95);
    float* __restrict lux_row = row.lux;
    float* __restrict u95_row = row.u95;
    const double z_of_row = lamp.z_at_origin + lamp.z_along_y * tile.y[j];
    for (std::size_t first = 0; first < row.count; first += kChunk) {
      const std::size_t count = row.count - first < kChunk ? row.count - first : kChunk;
      const double* x = row.x + first;
      for (std::size_t i = 0; i < count; ++i) sum[i] = 0.0;
      for (const FlatNode& node : lamp.nodes) {
        const double dy = tile.y[j] - node.y;
        const double across2 = node.height * node.height + dy * dy;
        const double strength = node.candela * node.height;
        for (std::size_t i = 0; i < count; ++i) {
          const double dx = x[i] - node.x;
          const double r2 = across2 + dx * dx;
          sum[i] += strength / (r2 * r2);
        }
      }
      for (std::size_t i = 0; i < count; ++i) {
        const double z = z_of_row + lamp.z_along_x * x[i];
        const double lux = sum[i] * (z > 0.0 ? z : 0.0);
        lux_row[first + i] += static_cast<float>(lux);
        u95_row[first + i] += static_cast<float>(lux * (row.from + row.slope * row.s[first + i]));
      }
    }
  }
}

LIGHTCAL_EVERY_CPU
void AddEven(const Tile& tile, double lux, const Corners& relative_u95) {
  const float value = static_cast<float>(lux);
  for (std::size_t j = 0; j < tile.y.size(); ++j) {
    const Row row = RowOf(tile, j, relative_u95);
    float* __restrict lux_row = row.lux;
    float* __restrict u95_row = row.u95;
    for (std::size_t i = 0; i < row.count; ++i) {
      lux_row[i] += value;
      u95_row[i] += static_cast<float>(lux * (row.from + row.slope * row.s[i]));
    }
  }
}

LIGHTCAL_EVERY_CPU
void AddSmooth(const Tile& tile, const double* lux, const Corners& relative_u95) {
  for (std::size_t j = 0; j < tile.y.size(); ++j) {
    const Row row = RowOf(tile, j, relative_u95);
    float* __restrict lux_row = row.lux;
    float* __restrict u95_row = row.u95;
    const double t = tile.t[j];
    const double w0 = (1.0 - t) * (1.0 - 2.0 * t);
    const double w1 = 4.0 * t * (1.0 - t);
    const double w2 = t * (2.0 * t - 1.0);
    const double a = w0 * lux[0] + w1 * lux[3] + w2 * lux[6];
    const double b = w0 * lux[1] + w1 * lux[4] + w2 * lux[7];
    const double c = w0 * lux[2] + w1 * lux[5] + w2 * lux[8];
    const double slope = 4.0 * b - 3.0 * a - c;
    const double bend = 2.0 * (a + c - 2.0 * b);
    for (std::size_t i = 0; i < row.count; ++i) {
      const double s = row.s[i];
      const double value = a + s * (slope + s * bend);
      lux_row[i] += static_cast<float>(value);
      u95_row[i] += static_cast<float>(value * (row.from + row.slope * s));
    }
  }
}

}  // namespace lightcal::kernels
