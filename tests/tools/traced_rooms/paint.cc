// SPDX-License-Identifier: Apache-2.0
#include "paint.h"

#include <algorithm>
#include <cmath>

namespace traced_rooms {
namespace {

constexpr std::uint64_t kOrdinaryPaintSeed = 61127001;
constexpr std::uint64_t kUnseenPaintSeed = 83405517;
constexpr double kBlue_nm = 450.0, kGreen_nm = 550.0, kRed_nm = 620.0;
constexpr double kBrightest = 0.92;

// How common a paint is, on albedos above .6 and below, and its tint's mean and 1 sigma.
struct Sort {
  double common_on_bright, common_on_dark;
  double ln_blue, wide_blue, ln_red, wide_red;
};
// Shares as homeowners said (Gitnux 2024: white 32 %, grey 29, beige 21, blue 10, green 5); tints
// of what sells most, from the makers' own sRGB (whites: Alabaster, Pure White, White Dove, Simply
// White; greys: Agreeable Gray, Repose Gray, Revere Pewter; beiges: Accessible Beige, Kilim Beige;
// blues and greens: Palladian Blue, Sea Salt, Rainwashed).
constexpr Sort kWallPaints[] = {
    {0.50, 0.00, -0.080, 0.035, 0.030, 0.02},   // white
    {0.16, 0.45, -0.100, 0.080, 0.050, 0.05},   // grey
    {0.19, 0.29, -0.240, 0.080, 0.120, 0.05},   // beige
    {0.08, 0.13, 0.100, 0.120, -0.250, 0.12},   // blue
    {0.05, 0.08, -0.100, 0.120, -0.150, 0.10},  // green
    {0.01, 0.03, -0.100, 0.120, 0.350, 0.15},   // pink, red
    {0.01, 0.02, -0.500, 0.150, 0.050, 0.05},   // yellow
};
constexpr Sort kFloors[] = {
    {0.55, 0.55, -0.75, 0.20, 0.45, 0.12},  // walnut to light oak
    {0.25, 0.25, -0.10, 0.08, 0.05, 0.05},  // grey carpet, concrete, tiles
    {0.20, 0.20, -0.30, 0.12, 0.15, 0.07},  // beige carpet, stone
};
constexpr Sort kFurniture[] = {
    {0.40, 0.40, -0.75, 0.20, 0.45, 0.12},  // wood
    {0.25, 0.25, -0.05, 0.08, 0.02, 0.05},  // black and grey
    {0.15, 0.15, -0.08, 0.04, 0.03, 0.02},  // white lacquer
    {0.20, 0.20, 0.00, 0.45, 0.00, 0.45},   // cloth of any colour
};

// Of mean 0 and sd 1: the sum of twelve uniform shares.
double Deviate(Random& random) {
  double sum = -6.0;
  for (int i = 0; i < 12; ++i) sum += random.Share();
  return sum;
}

template <std::size_t N>
Tint Pick(Random& random, const Sort (&sorts)[N], bool bright) {
  const double at = random.Share();
  double passed = 0.0;
  const Sort* chosen = &sorts[0];
  for (const Sort& sort : sorts) {
    const double common = bright ? sort.common_on_bright : sort.common_on_dark;
    if (common > 0.0) chosen = &sort;
    passed += common;
    if (at < passed) break;
  }
  return {chosen->ln_blue + chosen->wide_blue * Deviate(random),
          chosen->ln_red + chosen->wide_red * Deviate(random)};
}

double AlbedoAt(double albedo, const Tint& tint, double nm) {
  const double blue = std::clamp((kGreen_nm - nm) / (kGreen_nm - kBlue_nm), 0.0, 1.0);
  const double red = std::clamp((nm - kGreen_nm) / (kRed_nm - kGreen_nm), 0.0, 1.0);
  const double pigment = albedo > 0.6 && nm < 440.0 ? 0.93 : 1.0;
  return std::min(kBrightest, albedo * pigment * std::exp(blue * tint.ln_blue + red * tint.ln_red));
}

}  // namespace

RoomPaint PaintOf(const LitRoom& lit, Family family, int number) {
  const bool unseen = family == Family::kUnseen;
  Random random((unseen ? kUnseenPaintSeed : kOrdinaryPaintSeed) + 1000003ULL * number);
  RoomPaint paint;
  const double mean =
      0.25 * (lit.room.albedo[0] + lit.room.albedo[1] + lit.room.albedo[2] + lit.room.albedo[3]);
  const Tint wall = Pick(random, kWallPaints, mean > 0.6);
  std::fill(paint.walls.begin(), paint.walls.begin() + 4, wall);
  paint.walls[4] = Pick(random, kFloors, false);
  paint.walls[5] = {-0.07 + 0.03 * Deviate(random), 0.025 + 0.02 * Deviate(random)};
  for (std::size_t i = 0; i < lit.room.boxes.size(); ++i) {
    const bool of_walls = lit.l_shaped && i + 1 == lit.room.boxes.size();
    paint.boxes.push_back(of_walls ? wall : Pick(random, kFurniture, false));
  }
  if (unseen && random.Share() < 0.5) {
    paint.walls[random.Below(4)] = {random.Between(-0.7, 0.4), random.Between(-0.5, 0.6)};
  }
  return paint;
}

Room RoomAt(const Room& room, const RoomPaint& paint, int wavelength_nm) {
  Room out = room;
  for (std::size_t i = 0; i < out.albedo.size(); ++i) {
    out.albedo[i] = AlbedoAt(room.albedo[i], paint.walls[i], wavelength_nm);
  }
  for (std::size_t i = 0; i < out.boxes.size(); ++i) {
    out.boxes[i].albedo = AlbedoAt(room.boxes[i].albedo, paint.boxes[i], wavelength_nm);
  }
  return out;
}

}  // namespace traced_rooms
