// SPDX-License-Identifier: Apache-2.0
// A request made ready: lights on one grid, gels at the nodes, viewers set to the target.
#pragma once

#include <span>
#include <vector>

#include "lightcal/colorimetry/light_view.h"
#include "lightcal/match/match_lights.h"

namespace lightcal::match {

// XYZ of the lamp behind a filter as a sum over the nodes, CIE 1931, Y = 1 without one.
struct NodeXyz {
  std::array<NodeValues, 3> weights{};
  [[nodiscard]] Xyz Behind(const NodeValues& transmittance) const;
};

struct MatchScene {
  const MatchRequest& request;
  std::vector<GelNodes> gels;
  std::vector<LightView> cameras;
  LightView observer;
  NodeXyz lamp_xyz;
  Uv1976 target_uv;
  double lamp_Y = 0.0, target_Y = 0.0;  // as XyzFromSpectrum gives them

  // Refused as MatchLights, but for "unreachable".
  [[nodiscard]] static Result<MatchScene> Make(const MatchRequest& request,
                                               std::span<const Gel> gels);
  [[nodiscard]] NodeValues Transmittance(std::span<const std::size_t> stack) const;
  // Everything but the intervals.
  [[nodiscard]] Match Describe(std::vector<std::size_t> stack) const;
};

// A camera's channels on whole nanometres, straight between its samples, 0 outside them.
[[nodiscard]] ViewChannels ChannelsOf(const CameraSensitivities& camera);

}  // namespace lightcal::match
