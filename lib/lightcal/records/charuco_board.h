// SPDX-License-Identifier: Apache-2.0
// The printed board that tells where a wall is: a chessboard with an ArUco marker in every white
// square.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "lightcal/core/units.h"

namespace lightcal {

enum class MarkerDictionary : std::uint8_t { k4x4_50, k4x4_100, k5x5_100, k6x6_250 };
inline constexpr std::array<std::string_view, 4> kMarkerDictionaryWords = {"4x4_50", "4x4_100",
                                                                           "5x5_100", "6x6_250"};
inline constexpr std::array<int, 4> kMarkersInDictionary = {50, 100, 100, 250};

// Wall coordinates: the origin is the outer lower left corner of the chessboard, +X runs along its
// lower edge, +Z up its left edge, +Y into the wall. A lamp in front of the wall has y < 0.
struct CharucoBoard {
  int columns = 9, rows = 6;  // squares; the upper left one is black
  Metres square{0.03};        // side of a square, as measured on the print
  MarkerDictionary dictionary = MarkerDictionary::k4x4_50;
};
inline constexpr double kMarkerPerSquare = 0.75;  // side of a marker / side of a square

[[nodiscard]] constexpr int MarkersOn(const CharucoBoard& board) {
  return board.columns * board.rows / 2;
}

// A rectangle in metres; (x, z) is its lower left corner in wall coordinates.
struct BoardRectangle {
  double x = 0.0, z = 0.0, width = 0.0, height = 0.0;
  bool black = true;
};

// Where four squares meet.
struct BoardCorner {
  std::array<double, 2> wall_m{};  // x, z in wall coordinates
  std::array<double, 2> pixel{};   // x to the right, y down; pixel centres are at .5
};

}  // namespace lightcal
