// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/continuous_light.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/colorimetry/daylight.h"
#include "lightcal/colorimetry/rendering_input.h"

namespace lightcal {
namespace {

constexpr double kLargestDeparture = 0.1;
constexpr Kelvin kColdestDaylight{4000.0};
constexpr Kelvin kHottestDaylight{25000.0};
constexpr double kWidestStepOfPumpNm = 5.0;
constexpr double kPumpFromNm = 400.0;
constexpr double kPumpToNm = 475.0;
constexpr double kNarrowestPumpNm = 10.0;
constexpr double kWidestPumpNm = 55.0;
constexpr int kFewestPumpSamples = 3;

bool Follows(const Spectrum& s, const std::vector<double>& reference) {
  if (reference.size() != s.values.size()) return false;
  const double ours = std::reduce(s.values.begin(), s.values.end());
  const double theirs = std::reduce(reference.begin(), reference.end());
  const double allowed = kLargestDeparture * *std::ranges::max_element(s.values);
  for (std::size_t i = 0; i < reference.size(); ++i) {
    if (!(std::abs(s.values[i] - reference[i] * ours / theirs) <= allowed)) return false;
  }
  return true;
}

bool IsThermalOrDaylight(const Spectrum& s) {
  const auto xyz = XyzFromSpectrum(s);
  if (!xyz) return false;
  const CctResult color = CctFromXy(XyFromXyz(*xyz));
  if (!color.valid()) return false;
  const Kelvin daylight = std::clamp(color.temperature, kColdestDaylight, kHottestDaylight);
  return Follows(s, BlackBodyAt(color.temperature, s.wavelengths_nm)) ||
         Follows(s, DaylightAt(daylight, s.wavelengths_nm));
}

// The peak at i is a band: several samples wide, and it falls to half towards red within half the
// widest pump.
bool IsPump(const Spectrum& s, std::size_t i) {
  const auto& l = s.wavelengths_nm;
  const double half = s.values[i] / 2;
  std::size_t right = i;
  while (right + 1 < l.size() && s.values[right] > half) ++right;
  if (s.values[right] > half || 2 * (l[right] - l[i]) > kWidestPumpNm) return false;
  std::size_t left = i;
  while (left > 0 && s.values[left] > half) --left;
  return static_cast<int>(right - left - 1) >= kFewestPumpSamples &&
         l[right] - l[left] > kNarrowestPumpNm;
}

bool HasPump(const Spectrum& s) {
  const auto& l = s.wavelengths_nm;
  bool found = false;
  for (std::size_t i = 1; i + 1 < l.size(); ++i) {
    if (l[i] - l[i - 1] > kWidestStepOfPumpNm) return false;
    const bool peak = s.values[i] >= s.values[i - 1] && s.values[i] > s.values[i + 1];
    found = found || (peak && l[i] >= kPumpFromNm && l[i] <= kPumpToNm && IsPump(s, i));
  }
  return found;
}

}  // namespace

bool IsContinuousLight(const Spectrum& spectrum) {
  return IsThermalOrDaylight(spectrum) || HasPump(spectrum);
}

}  // namespace lightcal
