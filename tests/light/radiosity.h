// SPDX-License-Identifier: Apache-2.0
// Light in a grey box, the slow way: every wall in patches, every patch lit by every other until
// nothing changes. Shares nothing with lightcal's own bounce; no header of the room it judges.
#pragma once

#include <array>

namespace lightcal::test {

using Place = std::array<double, 3>;

// The origin lies on the floor under the middle, Z up.
struct GreyBox {
  Place size{};
  double reflectance = 0.5;
};

// 1 cd on its axis; cos^exponent off it, an even lamp where the exponent is 0.
struct PointLamp {
  Place position{};
  Place aim{};  // unit
  double exponent = 0.0;
};

struct RadiositySteps {
  int patches = 6;        // along each side of a wall, of the further bounces
  int first_bounce = 48;  // along each side of a wall
};

// What the walls send to a meter [lx], all bounces.
[[nodiscard]] double IndirectIlluminance(const GreyBox& box, const PointLamp& lamp,
                                         const Place& meter, const Place& normal,
                                         const RadiositySteps& steps);

}  // namespace lightcal::test
