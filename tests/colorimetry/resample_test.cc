// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/resample.h"

#include <gtest/gtest.h>

#include <numeric>
#include <tuple>

namespace lightcal {
namespace {

// 1 nm, 380-780 nm, dark but for one line.
Spectrum LineAt(int nm) {
  Spectrum s;
  for (int l = 380; l <= 780; ++l) {
    s.wavelengths_nm.push_back(l);
    s.values.push_back(l == nm ? 1.0 : 0.0);
  }
  return s;
}

TEST(ResampleByArea, LosesNoLineWhereverItStands) {
  for (int nm = 380; nm < 780; ++nm) {
    const auto coarse = ResampleByArea(LineAt(nm), Nanometres(382.0), Nanometres(5.0), 80);
    ASSERT_TRUE(coarse);
    const double area = 5.0 * std::accumulate(coarse->values.begin(), coarse->values.end(), 0.0);
    EXPECT_NEAR(area, 1.0, 1e-12) << nm;
  }
}

TEST(ResampleByArea, LeavesASpectrumOnItsOwnGridAsItIs) {
  Spectrum s;
  for (int i = 0; i < 40; ++i) {
    s.wavelengths_nm.push_back(400.0 + 10.0 * i);
    s.values.push_back(1.0 + i % 7);
  }
  const auto same = ResampleByArea(s, Nanometres(400.0), Nanometres(10.0), 40);
  for (std::size_t i = 0; i < s.values.size(); ++i)
    EXPECT_NEAR(same->values[i], s.values[i], 1e-12);
}

TEST(ResampleByArea, SharesASampleBetweenTheBinsItStraddles) {
  const auto coarse = ResampleByArea(LineAt(560), Nanometres(555.0), Nanometres(10.0), 2);
  EXPECT_NEAR(coarse->values[0], 0.05, 1e-12);
  EXPECT_NEAR(coarse->values[1], 0.05, 1e-12);
}

TEST(ResampleByArea, BinsBeyondTheSpectrumAreRefused) {
  const Spectrum s = LineAt(560);
  for (const auto& [first, step, count] :
       {std::tuple{380.0, 5.0, 10}, {775.0, 5.0, 3}, {500.0, 0.0, 5}, {500.0, 5.0, 1}}) {
    const auto refused = ResampleByArea(s, Nanometres(first), Nanometres(step), count);
    ASSERT_FALSE(refused) << first;
    EXPECT_EQ(refused.error().code, "out_of_range");
  }
}

}  // namespace
}  // namespace lightcal
