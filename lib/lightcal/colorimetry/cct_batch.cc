// SPDX-License-Identifier: Apache-2.0
// Compiled with LIGHTCAL_VECTOR_LOOPS (CMakeLists.txt of the house), so that the loops over a block
// become vector instructions; arithmetic stays IEEE.
#include "lightcal/colorimetry/cct_batch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lightcal/colorimetry/locus_table.h"
#include "lightcal/core/every_processor.h"

namespace lightcal {
namespace {

constexpr std::size_t kBlock = 128;
using Lane = std::array<double, kBlock>;

// Starts on a grid over uv that holds every colour with a valid CCT: mireds and their slopes at the
// middle of each cell.
constexpr double kFirstU = 0.125, kFirstV = 0.195, kCell = 0.0025;
constexpr int kColumns = 160, kRows = 92;

struct Start {
  float mireds = -1.0F;  // below 0: no CCT here
  float by_u = 0.0F, by_v = 0.0F;
};

class StartGrid {
 public:
  StartGrid() : cells_(static_cast<std::size_t>(kColumns) * kRows) {
    for (int row = 0; row < kRows; ++row) {
      for (int column = 0; column < kColumns; ++column) {
        cells_[static_cast<std::size_t>(row) * kColumns + static_cast<std::size_t>(column)] =
            At({kFirstU + (column + 0.5) * kCell, kFirstV + (row + 0.5) * kCell});
      }
    }
  }
  [[nodiscard]] const Start* cells() const { return cells_.data(); }

 private:
  static double MiredsAt(Uv1960 uv) {
    const CctResult cct = CctFromUv(uv);
    return cct.status == CctStatus::kBeyondInfinity ? 0.0 : 1e6 / cct.temperature.value();
  }
  static Start At(Uv1960 middle) {
    constexpr double kHalf = kCell / 2;
    const CctResult cct = CctFromUv(middle);
    // A cell's corner is 0.0018 from its middle.
    if (std::abs(cct.duv) > 0.053) return {};
    const double by_u =
        MiredsAt({middle.u + kHalf, middle.v}) - MiredsAt({middle.u - kHalf, middle.v});
    const double by_v =
        MiredsAt({middle.u, middle.v + kHalf}) - MiredsAt({middle.u, middle.v - kHalf});
    return {static_cast<float>(MiredsAt(middle)), static_cast<float>(by_u / kCell),
            static_cast<float>(by_v / kCell)};
  }
  std::vector<Start> cells_;
};

const Start* Starts() {
  static const StartGrid grid;
  return grid.cells();
}

struct Block {
  Lane u, v;
  std::array<std::int32_t, kBlock> cell, segment;
  Lane t;
  std::array<Lane, 12> c;  // of u and v, by power of t
  Lane mireds, duv, distance, last_step;
};

// Which cell holds each colour; any cell for one outside the grid or not a number.
LIGHTCAL_EVERY_CPU
void FindCells(Block& b) {
  for (std::size_t i = 0; i < kBlock; ++i) {
    const double column = (b.u[i] - kFirstU) * (1.0 / kCell);
    const double row = (b.v[i] - kFirstV) * (1.0 / kCell);
    const double inside_column =
        column > 0.0 ? (column < kColumns - 1 ? column : kColumns - 1) : 0.0;
    const double inside_row = row > 0.0 ? (row < kRows - 1 ? row : kRows - 1) : 0.0;
    b.cell[i] =
        static_cast<std::int32_t>(inside_row) * kColumns + static_cast<std::int32_t>(inside_column);
  }
}

// The segment and the place in it from the cell's linear guess, and the segment's coefficients side
// by side.
void LoadSegments(const locus::LocusTable& table, const Start* starts, Block& b) {
  for (std::size_t i = 0; i < kBlock; ++i) {
    const std::int32_t cell = b.cell[i];
    const Start& start = starts[cell];
    const double from_u = b.u[i] - (kFirstU + (cell % kColumns + 0.5) * kCell);
    const double from_v = b.v[i] - (kFirstV + (cell / kColumns + 0.5) * kCell);
    const double guess =
        (start.mireds + start.by_u * from_u + start.by_v * from_v) * (1.0 / locus::kStepMireds);
    const double inside =
        guess > 0.0 ? (guess < locus::kSegments - 1 ? guess : locus::kSegments - 1) : 0.0;
    const auto segment = static_cast<std::int32_t>(inside);
    b.segment[i] = segment;
    b.t[i] = inside - segment;
    const locus::Segment& s = table.SegmentAt(segment);
    for (std::size_t k = 0; k < 6; ++k) {
      b.c[k][i] = s.u.c[k];
      b.c[k + 6][i] = s.v.c[k];
    }
  }
}

// Three Newton steps for the stationary point of the distance, and what the answer needs there.
LIGHTCAL_EVERY_CPU
void Solve(Block& b) {
  for (std::size_t i = 0; i < kBlock; ++i) {
    const double a0 = b.c[0][i], a1 = b.c[1][i], a2 = b.c[2][i], a3 = b.c[3][i], a4 = b.c[4][i],
                 a5 = b.c[5][i];
    const double e0 = b.c[6][i], e1 = b.c[7][i], e2 = b.c[8][i], e3 = b.c[9][i], e4 = b.c[10][i],
                 e5 = b.c[11][i];
    const double pu = b.u[i], pv = b.v[i];
    double t = b.t[i];
    double step = 0.0;
#pragma GCC unroll 3
    for (int pass = 0; pass < 3; ++pass) {
      const double t2 = t * t;
      const double ru = (a0 + a1 * t) + t2 * ((a2 + a3 * t) + t2 * (a4 + a5 * t)) - pu;
      const double rv = (e0 + e1 * t) + t2 * ((e2 + e3 * t) + t2 * (e4 + e5 * t)) - pv;
      const double du = (a1 + 2 * a2 * t) + t2 * ((3 * a3 + 4 * a4 * t) + t2 * (5 * a5));
      const double dv = (e1 + 2 * e2 * t) + t2 * ((3 * e3 + 4 * e4 * t) + t2 * (5 * e5));
      const double d2u = (2 * a2 + 6 * a3 * t) + t2 * (12 * a4 + 20 * a5 * t);
      const double d2v = (2 * e2 + 6 * e3 * t) + t2 * (12 * e4 + 20 * e5 * t);
      step = (ru * du + rv * dv) / (du * du + dv * dv + ru * d2u + rv * d2v);
      t -= step;
    }
    const double t2 = t * t;
    const double ru = pu - ((a0 + a1 * t) + t2 * ((a2 + a3 * t) + t2 * (a4 + a5 * t)));
    const double rv = pv - ((e0 + e1 * t) + t2 * ((e2 + e3 * t) + t2 * (e4 + e5 * t)));
    const double du = (a1 + 2 * a2 * t) + t2 * ((3 * a3 + 4 * a4 * t) + t2 * (5 * a5));
    const double dv = (e1 + 2 * e2 * t) + t2 * ((3 * e3 + 4 * e4 * t) + t2 * (5 * e5));
    b.duv[i] = (rv * du - ru * dv) / std::sqrt(du * du + dv * dv);
    b.distance[i] = std::sqrt(ru * ru + rv * rv);
    b.t[i] = t;
    b.mireds[i] = (b.segment[i] + t) * locus::kStepMireds;
    b.last_step[i] = step;
  }
}

// A step of s leaves about s^2 to go.
constexpr double kSettledStep = 1e-7;

bool IsSettled(const Block& b, std::size_t i, const Start* starts) {
  return starts[b.cell[i]].mireds >= 0.0F && b.t[i] >= 0.0 && b.t[i] <= 1.0 &&
         std::abs(b.last_step[i]) < kSettledStep && b.distance[i] <= locus::kDuvLimit &&
         b.mireds[i] > locus::kStepMireds && 1e6 >= b.mireds[i] * locus::kColdestKelvin;
}

// Colours u, v of the first `count` lanes are in the block; the rest of it may hold anything
// finite.
template <class OneColor>
void Answer(Block& b, std::span<CctResult> results, const OneColor& one_color) {
  const Start* starts = Starts();
  FindCells(b);
  LoadSegments(locus::Locus(), starts, b);
  Solve(b);
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (IsSettled(b, i, starts)) {
      results[i] = {Kelvin(1e6 / b.mireds[i]), b.duv[i], CctStatus::kOk};
    } else {
      results[i] = one_color(i);
    }
  }
}

template <class Color, class ToUv, class OneColor>
void InBlocks(std::span<const Color> colors, std::span<CctResult> results, const ToUv& to_uv,
              const OneColor& one_color) {
  Block b{};
  for (std::size_t from = 0; from < colors.size(); from += kBlock) {
    const std::size_t count = std::min(kBlock, colors.size() - from);
    for (std::size_t i = 0; i < count; ++i) {
      const Uv1960 uv = to_uv(colors[from + i]);
      b.u[i] = uv.u;
      b.v[i] = uv.v;
    }
    Answer(b, results.subspan(from, count),
           [&](std::size_t i) { return one_color(colors[from + i]); });
  }
}

}  // namespace

void CctBatch(std::span<const Uv1960> colors, std::span<CctResult> results) {
  InBlocks(
      colors, results, [](Uv1960 uv) { return uv; }, [](Uv1960 uv) { return CctFromUv(uv); });
}

void CctBatch(std::span<const Xy> colors, std::span<CctResult> results) {
  InBlocks(
      colors, results, [](Xy xy) { return Uv1960FromXy(xy); }, [](Xy xy) { return CctFromXy(xy); });
}

}  // namespace lightcal
