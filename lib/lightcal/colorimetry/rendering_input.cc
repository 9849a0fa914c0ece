// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/rendering_input.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string>

#include "lightcal/colorimetry/cie_tables/samples.h"
#include "lightcal/colorimetry/cie_tables/tables.h"
#include "lightcal/colorimetry/daylight.h"
#include "lightcal/colorimetry/planckian.h"
#include "lightcal/core/numbers_text.h"

namespace lightcal {
namespace {

constexpr double kLeastFirstNm = 400.0;
constexpr double kLeastLastNm = 700.0;
constexpr double kWidestStepNm = 20.0;
constexpr double kLargestNegativeShare = 0.1;
constexpr double kHottestDaylightKelvin = 25000.0;
constexpr double kUnitNm = 560.0;  // where a reference is 1
constexpr double kC2NanometreKelvin = kC2MetreKelvin * 1e9;

// Shares `power` at one wavelength out to the two whole nanometres beside it.
void ShareOut(NanometrePowers& powers, double nm, double power) {
  const double below = std::floor(nm);
  const double t = nm - below;
  const double index = below - kRenderingFirstNm;
  if (index < -1.0 || index > kRenderingCount - 1) return;
  const auto k = static_cast<std::ptrdiff_t>(index);
  if (k >= 0) powers[static_cast<std::size_t>(k)] += power * (1.0 - t);
  if (t > 0.0 && k + 1 < kRenderingCount) powers[static_cast<std::size_t>(k + 1)] += power * t;
}

NanometrePowers SharedOut(std::span<const double> nm, std::span<const double> values) {
  NanometrePowers powers{};
  for (std::size_t i = 0; i < nm.size(); ++i) ShareOut(powers, nm[i], values[i]);
  return powers;
}

// Trapezoids over the samples' wavelengths and the whole nanometres together.
NanometrePowers SharedOutLinearly(const Spectrum& s) {
  NanometrePowers powers{};
  for (std::size_t i = 1; i < s.values.size(); ++i) {
    const double left = s.wavelengths_nm[i - 1];
    const double right = s.wavelengths_nm[i];
    const double slope = (s.values[i] - s.values[i - 1]) / (right - left);
    const double end = std::min<double>(right, kRenderingLastNm);
    double from = std::max<double>(left, kRenderingFirstNm);
    while (from < end) {
      const double to = std::min(std::floor(from) + 1.0, end);
      const double half = (to - from) / 2;
      ShareOut(powers, from, half * (s.values[i - 1] + slope * (from - left)));
      ShareOut(powers, to, half * (s.values[i - 1] + slope * (to - left)));
      from = to;
    }
  }
  return powers;
}

std::vector<double> WholeNanometresInside(const Spectrum& s) {
  const double first = std::max<double>(std::ceil(s.wavelengths_nm.front()), kRenderingFirstNm);
  const double last = std::min<double>(std::floor(s.wavelengths_nm.back()), kRenderingLastNm);
  std::vector<double> nm;
  for (double each = first; each <= last; each += 1.0) nm.push_back(each);
  return nm;
}

// Those that share their power out to 380-780 nm.
std::vector<double> WithinReach(std::span<const double> nm) {
  std::vector<double> kept;
  kept.reserve(nm.size());
  std::ranges::copy_if(nm, std::back_inserter(kept), [](double l) {
    return l > kRenderingFirstNm - 1 && l < kRenderingLastNm + 1;
  });
  return kept;
}

Result<void> CheckGrid(const Spectrum& s, bool equal_steps) {
  const double step = (s.wavelengths_nm.back() - s.wavelengths_nm.front()) /
                      static_cast<double>(s.values.size() - 1);
  if (equal_steps && step > kWidestStepNm) {
    return Refused("coarse_spectrum", "spectrum",
                   "has steps of " + ShortestText(step) +
                       " nm; colour rendering needs 20 nm or less, better 5 nm");
  }
  const double slack = equal_steps ? step / 2 : 0.5;
  if (s.wavelengths_nm.front() - slack > kLeastFirstNm ||
      s.wavelengths_nm.back() + slack < kLeastLastNm) {
    return Refused("truncated_spectrum", "spectrum",
                   "covers " + ShortestText(s.wavelengths_nm.front()) + " to " +
                       ShortestText(s.wavelengths_nm.back()) +
                       " nm; colour rendering and similarity need at least 400 to 700 nm");
  }
  return {};
}

Result<void> CheckNoise(const NanometrePowers& powers) {
  double positive = 0.0;
  double negative = 0.0;
  for (std::size_t k = 0; k < powers.size(); ++k) {
    const double y = powers[k] * Cie1964Cmf()[k + (kRenderingFirstNm - kCmfFirstNm)].y_bar;
    (y < 0.0 ? negative : positive) += std::abs(y);
  }
  if (positive > 0.0 && negative <= kLargestNegativeShare * positive) return {};
  return Refused("noisy_spectrum", "spectrum",
                 "negative samples take back more than a tenth of the light; measure longer or "
                 "closer, and subtract the dark signal once only");
}

void ScaleToLargest(NanometrePowers& powers) {
  double largest = 0.0;
  for (const double each : powers) largest = std::max(largest, std::abs(each));
  if (!(largest > 0.0)) return;
  for (double& each : powers) each /= largest;
}

}  // namespace

Result<NanometrePowers> NanometrePowersOf(const Spectrum& spectrum) {
  if (const auto xyz = XyzFromSpectrum(spectrum); !xyz) return tl::unexpected(xyz.error());
  const bool equal_steps = HasEqualSteps(spectrum);
  if (auto checked = CheckGrid(spectrum, equal_steps); !checked) {
    return Propagate(std::move(checked));
  }
  NanometrePowers powers = equal_steps ? SharedOut(spectrum.wavelengths_nm, spectrum.values)
                                       : SharedOutLinearly(spectrum);
  ScaleToLargest(powers);
  if (auto checked = CheckNoise(powers); !checked) return Propagate(std::move(checked));
  return powers;
}

Result<RenderingInput> PrepareRendering(const Spectrum& spectrum) {
  const auto xyz = XyzFromSpectrum(spectrum);
  if (!xyz) return tl::unexpected(xyz.error());
  const bool equal_steps = HasEqualSteps(spectrum);
  if (auto checked = CheckGrid(spectrum, equal_steps); !checked) {
    return Propagate(std::move(checked));
  }
  RenderingInput input;
  input.color = CctFromXy(XyFromXyz(*xyz));
  if (!input.color.valid() || input.color.temperature > Kelvin(kHottestDaylightKelvin)) {
    return Refused("no_reference", "spectrum",
                   "its colour has no temperature between 1000 and 25000 K, so there is no "
                   "reference light to compare it with");
  }
  input.reference_nm =
      equal_steps ? WithinReach(spectrum.wavelengths_nm) : WholeNanometresInside(spectrum);
  auto powers = NanometrePowersOf(spectrum);
  if (!powers) return Propagate(std::move(powers));
  input.powers = *powers;
  return input;
}

NanometrePowers ReferencePowers(const RenderingInput& input, std::span<const double> values) {
  return SharedOut(input.reference_nm, values);
}

std::vector<double> BlackBodyAt(Kelvin temperature, std::span<const double> nm) {
  const double c2_over_t = kC2NanometreKelvin / temperature.value();
  const double centre = PlanckRatio(c2_over_t / kUnitNm);
  std::vector<double> values;
  values.reserve(nm.size());
  for (const double l : nm) {
    const double ratio = kUnitNm / l;
    values.push_back(ratio * ratio * ratio * ratio * PlanckRatio(c2_over_t / l) / centre);
  }
  return values;
}

std::vector<double> DaylightAt(Kelvin temperature, std::span<const double> nm) {
  const auto xy = DaylightXy(temperature);
  if (!xy) return {};
  const DaylightWeights m = DaylightWeightsOf(*xy);
  const auto power = [&](std::size_t row) {
    const DaylightComponentRow& c = CieDaylightComponents()[row];
    return (c.s0 + m.m1 * c.s1 + m.m2 * c.s2) / 100.0;
  };
  std::vector<double> values;
  values.reserve(nm.size());
  for (const double l : nm) {
    const double position =
        std::clamp((l - kDaylightFirstNm) / kDaylightStepNm, 0.0, kDaylightCount - 1.0);
    const auto row = std::min(static_cast<std::size_t>(position), std::size_t{kDaylightCount - 2});
    const double t = position - static_cast<double>(row);
    values.push_back(power(row) + t * (power(row + 1) - power(row)));
  }
  return values;
}

}  // namespace lightcal
