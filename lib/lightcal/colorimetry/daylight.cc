// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/daylight.h"

#include <cmath>
#include <cstddef>
#include <string>

#include "lightcal/colorimetry/cie_tables/tables.h"
#include "lightcal/colorimetry/planckian.h"
#include "lightcal/core/numbers_text.h"

namespace lightcal {
namespace {

constexpr double kColdestPhaseKelvin = 4000.0;
constexpr double kJoinKelvin = 7000.0;
constexpr double kHottestPhaseKelvin = 25000.0;

// ((c3/T + c2)/T + c1)/T + c0
struct ReciprocalCubic {
  double c3, c2, c1, c0;
  [[nodiscard]] constexpr double At(double t) const { return ((c3 / t + c2) / t + c1) / t + c0; }
};
constexpr ReciprocalCubic kBelowJoin = {-4.6070e9, 2.9678e6, 0.09911e3, 0.244063};
constexpr ReciprocalCubic kAboveJoin = {-2.0064e9, 1.9018e6, 0.24748e3, 0.237040};

double RoundedToThousandths(double value) { return std::round(value * 1000.0) / 1000.0; }

}  // namespace

Result<Xy> DaylightXy(Kelvin temperature) {
  const double t = temperature.value();
  if (!(t >= kColdestPhaseKelvin && t <= kHottestPhaseKelvin)) {
    return Refused("out_of_range", "daylight",
                   (std::isfinite(t) ? ShortestText(t) + " K" : std::string("this temperature")) +
                       " lies outside CIE daylight, 4000 to 25000 K; use the Planckian locus");
  }
  const double x = (t <= kJoinKelvin ? kBelowJoin : kAboveJoin).At(t);
  return Xy{x, (-3.0 * x + 2.870) * x - 0.275};
}

Kelvin DaylightTemperatureOfName(Kelvin named) {
  return named * (kC2MetreKelvin / kC2OfDaylightNamesMetreKelvin);
}

DaylightWeights DaylightWeightsOf(Xy xy) {
  const auto [x, y] = xy;
  const double m = 0.0241 + 0.2562 * x - 0.7341 * y;
  return {(-1.3515 - 1.7703 * x + 5.9114 * y) / m, (0.0300 - 31.4424 * x + 30.0717 * y) / m};
}

Result<Spectrum> DaylightSpectrum(Kelvin temperature) {
  auto xy = DaylightXy(temperature);
  if (!xy) return Propagate(std::move(xy));
  const DaylightWeights weights = DaylightWeightsOf(*xy);
  const double m1 = RoundedToThousandths(weights.m1);
  const double m2 = RoundedToThousandths(weights.m2);
  const auto power = [&](std::size_t row) {
    const DaylightComponentRow& c = CieDaylightComponents()[row];
    return c.s0 + m1 * c.s1 + m2 * c.s2;
  };
  Spectrum spectrum;
  for (int nm = kDaylightFirstNm; nm <= kCmfLastNm; ++nm) {
    const int offset = nm - kDaylightFirstNm;
    const auto row = static_cast<std::size_t>(offset / kDaylightStepNm);
    const double t = static_cast<double>(offset % kDaylightStepNm) / kDaylightStepNm;
    const double here = power(row);
    spectrum.wavelengths_nm.push_back(nm);
    spectrum.values.push_back(t == 0.0 ? here : here + t * (power(row + 1) - here));
  }
  return spectrum;
}

}  // namespace lightcal
