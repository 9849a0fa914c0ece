// SPDX-License-Identifier: Apache-2.0
// Gauss-Legendre rules on [-1, 1], weights summing to 1: the mean of a function.
#pragma once

#include <array>

namespace lightcal {

template <int N>
struct GaussLegendre;

template <>
struct GaussLegendre<2> {
  static constexpr std::array<double, 2> kNode = {-0.5773502691896257645, 0.5773502691896257645};
  static constexpr std::array<double, 2> kWeight = {0.5, 0.5};
};
template <>
struct GaussLegendre<3> {
  static constexpr std::array<double, 3> kNode = {-0.774596669241483377, 0.0, 0.774596669241483377};
  static constexpr std::array<double, 3> kWeight = {0.2777777777777777778, 0.4444444444444444444,
                                                    0.2777777777777777778};
};
template <>
struct GaussLegendre<4> {
  static constexpr std::array<double, 4> kNode = {-0.8611363115940525752, -0.3399810435848562648,
                                                  0.3399810435848562648, 0.8611363115940525752};
  static constexpr std::array<double, 4> kWeight = {0.1739274225687269287, 0.3260725774312730713,
                                                    0.3260725774312730713, 0.1739274225687269287};
};
template <>
struct GaussLegendre<6> {
  static constexpr std::array<double, 6> kNode = {-0.9324695142031520278, -0.6612093864662645137,
                                                  -0.2386191860831969086, 0.2386191860831969086,
                                                  0.6612093864662645137,  0.9324695142031520278};
  static constexpr std::array<double, 6> kWeight = {0.08566224618958517252, 0.1803807865240693038,
                                                    0.2339569672863455237,  0.2339569672863455237,
                                                    0.1803807865240693038,  0.08566224618958517252};
};
template <>
struct GaussLegendre<16> {
  static constexpr std::array<double, 16> kNode = {
      -0.9894009349916499326, -0.9445750230732325761,  -0.8656312023878317439,
      -0.7554044083550030339, -0.6178762444026437484,  -0.4580167776572273863,
      -0.2816035507792589132, -0.09501250983763744019, 0.09501250983763744019,
      0.2816035507792589132,  0.4580167776572273863,   0.6178762444026437484,
      0.7554044083550030339,  0.8656312023878317439,   0.9445750230732325761,
      0.9894009349916499326};
  static constexpr std::array<double, 16> kWeight = {
      0.01357622970587704743, 0.03112676196932394643, 0.0475792558412463924,
      0.06231448562776693603, 0.07479799440828836604, 0.08457825969750126909,
      0.09130170752246179443, 0.09472530522753424814, 0.09472530522753424814,
      0.09130170752246179443, 0.08457825969750126909, 0.07479799440828836604,
      0.06231448562776693603, 0.0475792558412463924,  0.03112676196932394643,
      0.01357622970587704743};
};

}  // namespace lightcal
