// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/turned_panorama.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "lightcal/core/units.h"

namespace lightcal {

std::array<MistakenTurn, kMistakenTurns> MistakenTurns() {
  return {{
      {"turned",
       "the panorama is turned round the vertical: set its rotation",
       {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}},
      {"mirrored",
       "the panorama is mirrored left to right: the engine looks at it from outside",
       {{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}},
      {"upside_down",
       "the panorama stands on its head (rolled by half a turn)",
       {{{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}}}},
      {"flipped",
       "the panorama's rows are upside down: the file is read from its last row",
       {{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}}},
      {"on_its_back",
       "the panorama lies on its back: Y up and Z up were mixed",
       {{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}}},
      {"on_its_face",
       "the panorama lies on its face: Z up and Y up were mixed",
       {{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}}},
  }};
}

TurnedIrradiance IrradianceIfTurned(const EnvironmentPicture& picture, const Vec3& normal) {
  std::vector<Vec3> normals;  // in the picture's own axes
  for (const MistakenTurn& way : MistakenTurns()) {
    for (int i = 0; i < kTurnSteps; ++i) {
      const double turn = 2.0 * std::numbers::pi * i / kTurnSteps;
      // Back by the turn, then into the columns, which are orthonormal.
      const Vec3 back = {normal[0] * std::cos(turn) - normal[1] * std::sin(turn),
                         normal[0] * std::sin(turn) + normal[1] * std::cos(turn), normal[2]};
      normals.push_back(
          {Dot(way.columns[0], back), Dot(way.columns[1], back), Dot(way.columns[2], back)});
    }
  }
  const std::vector<Vec3> irradiance = IrradianceOn(picture, normals);
  TurnedIrradiance out{};
  for (std::size_t i = 0; i < irradiance.size(); ++i) {
    out[i / kTurnSteps][i % kTurnSteps] = irradiance[i];
  }
  return out;
}

EnvironmentPicture ForEngineThatTurns(const EnvironmentPicture& picture, std::size_t way,
                                      double turn_deg) {
  const MistakenTurn mistake = MistakenTurns()[way];
  const double turn = turn_deg * kRadiansPerDegree;
  EnvironmentPicture out = picture;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const Vec3 direction = PixelDirection(x, y, picture.width, picture.height);
      // Where the engine shows this pixel: by the columns, then round by the turn.
      const Vec3 hung = mistake.columns[0] * direction[0] + mistake.columns[1] * direction[1] +
                        mistake.columns[2] * direction[2];
      const Vec3 shown = {hung[0] * std::cos(turn) + hung[1] * std::sin(turn),
                          -hung[0] * std::sin(turn) + hung[1] * std::cos(turn), hung[2]};
      const auto rgb = RadianceTowards(picture, shown);
      const std::size_t at =
          3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
               static_cast<std::size_t>(x));
      for (std::size_t c = 0; c < 3; ++c) out.rgb[at + c] = static_cast<float>(rgb[c]);
    }
  }
  out.Reduce();
  return out;
}

}  // namespace lightcal
