// SPDX-License-Identifier: Apache-2.0
// What colours the surfaces of a random room have: its albedo at each of eight wavelengths.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "random_rooms.h"

namespace traced_rooms {

inline constexpr std::array<int, 8> kBands_nm = {420, 460, 500, 540, 580, 620, 660, 700};

// Reflectance over that at 550 nm, ln, at 450 and at 620 nm; straight between and level beyond, and
// a white pigment's fall below 440 nm.
struct Tint {
  double ln_blue = 0.0, ln_red = 0.0;
};

struct RoomPaint {
  std::array<Tint, 6> walls{};
  std::vector<Tint> boxes;  // as room.boxes
};

// One paint on all four walls (in the unseen family every second room has one wall of a strong
// colour), a white ceiling, a floor of wood, carpet or stone, furniture of wood, cloth and lacquer.
RoomPaint PaintOf(const LitRoom& lit, Family family, int number);

// The room as it is at a wavelength. A window and the coat of a glossy wall have no colour.
Room RoomAt(const Room& room, const RoomPaint& paint, int wavelength_nm);

}  // namespace traced_rooms
