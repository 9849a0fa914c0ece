// SPDX-License-Identifier: Apache-2.0
// Illuminance by brute force in long double: the kernel (n.v)(m.v)/|v|^4 summed over the source, or
// the cosine over the directions it fills, by graded Gauss-Legendre panels. Shares nothing with the
// models it judges; no closed form beyond the kernel.
#pragma once

#include <array>
#include <vector>

namespace lightcal::test {

using Real = long double;
using Real3 = std::array<Real, 3>;

// As lightcal's receivers: in the source's frame, flat sources in z = 0 shining along +z.
struct BruteReceiver {
  Real3 position;
  Real3 normal;
};

// int of the kernel over the source [lx per cd/m^2].
[[nodiscard]] Real BrutePolygon(std::vector<std::array<Real, 2>> corners, const BruteReceiver& at);
[[nodiscard]] Real BruteRect(Real half_width, Real half_height, const BruteReceiver& at);
// A line along x, of one strength per metre [lx per cd/m^2 and metre of width].
[[nodiscard]] Real BruteLine(Real half_length, const BruteReceiver& at);
[[nodiscard]] Real BruteDisk(Real radius, const BruteReceiver& at);
[[nodiscard]] Real BruteSphere(Real radius, const BruteReceiver& at);
// Mantle of a cylinder about x.
[[nodiscard]] Real BruteTube(Real half_length, Real radius, const BruteReceiver& at);

}  // namespace lightcal::test
