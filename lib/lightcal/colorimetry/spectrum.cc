// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/spectrum.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "lightcal/colorimetry/cie_tables/alpha_opic.h"
#include "lightcal/colorimetry/cie_tables/tables.h"
#include "lightcal/core/numbers_text.h"

namespace lightcal {
namespace {

constexpr double kEqualStepTolerance = 1e-3;
constexpr double kVisibleFirstNm = 380.0;
constexpr double kVisibleLastNm = 780.0;
constexpr double kMelanopicWattsPerLumenOfD65 = 1.3262e-3;

// Three weights at a wavelength.
using Weighting = Xyz (*)(Nanometres);

// Integrals over wavelength, without K: of S times each weight, and of S.
struct Integrals {
  Weighting weighting;
  Xyz weighted{};
  double plain = 0.0;

  // power: value times the width it stands for.
  void AddWeighted(double wavelength, double power) {
    const Xyz weight = weighting(Nanometres(wavelength));
    weighted.X += power * weight.X;
    weighted.Y += power * weight.Y;
    weighted.Z += power * weight.Z;
  }
};

double MeanStep(const Spectrum& s) {
  return (s.wavelengths_nm.back() - s.wavelengths_nm.front()) /
         static_cast<double>(s.wavelengths_nm.size() - 1);
}

Integrals PlainSum(const Spectrum& s, Weighting weighting) {
  const double step = MeanStep(s);
  Integrals sums{weighting};
  for (std::size_t i = 0; i < s.values.size(); ++i) {
    sums.AddWeighted(s.wavelengths_nm[i], s.values[i] * step);
    sums.plain += s.values[i] * step;
  }
  return sums;
}

// Between two neighbouring samples: `plain` as one trapezoid, the weighted integrals over the part
// inside the CIE table, cut at each of its whole nanometres.
void AddGap(Integrals& sums, double left, double left_value, double right, double right_value) {
  const auto value_at = [&](double l) {
    return left_value + (right_value - left_value) * (l - left) / (right - left);
  };
  sums.plain += (left_value + right_value) / 2 * (right - left);
  const double end = std::min<double>(right, kCmfLastNm);
  double from = std::max<double>(left, kCmfFirstNm);
  while (from < end) {
    const double to = std::min(std::floor(from) + 1.0, end);
    sums.AddWeighted(from, value_at(from) * (to - from) / 2);
    sums.AddWeighted(to, value_at(to) * (to - from) / 2);
    from = to;
  }
}

Integrals TrapezoidSum(const Spectrum& s, Weighting weighting) {
  Integrals sums{weighting};
  for (std::size_t i = 1; i < s.values.size(); ++i) {
    AddGap(sums, s.wavelengths_nm[i - 1], s.values[i - 1], s.wavelengths_nm[i], s.values[i]);
  }
  return sums;
}

tl::unexpected<Error> Bad(std::string message) {
  return Refused("bad_spectrum", "spectrum", std::move(message));
}

Result<void> CheckSamples(const Spectrum& s) {
  const auto& l = s.wavelengths_nm;
  if (l.size() != s.values.size()) {
    return Bad(std::to_string(l.size()) + " wavelengths but " + std::to_string(s.values.size()) +
               " values; give one value for each wavelength");
  }
  if (l.size() < 2) return Bad("fewer than two samples; a spectrum needs at least two");
  if (l.front() <= 0.0) {
    return Bad("a wavelength of " + ShortestText(l.front()) +
               " nm is none; correct or remove that sample");
  }
  for (std::size_t i = 0; i < l.size(); ++i) {
    if (!std::isfinite(l[i]) || !std::isfinite(s.values[i])) {
      return Bad("sample " + std::to_string(i + 1) +
                 " is not a finite number; correct or remove it");
    }
    if (i > 0 && l[i] <= l[i - 1]) {
      return Bad("wavelengths must increase: " + ShortestText(l[i]) + " nm follows " +
                 ShortestText(l[i - 1]) + " nm; sort the samples and remove repeated ones");
    }
  }
  return {};
}

Result<Integrals> Integrate(const Spectrum& s, Weighting weighting = ColorMatchingAt) {
  if (auto checked = CheckSamples(s); !checked) return Propagate(std::move(checked));
  const Integrals sums = HasEqualSteps(s) ? PlainSum(s, weighting) : TrapezoidSum(s, weighting);
  if (!(sums.weighted.Y > 0.0) || !(sums.weighted.X + sums.weighted.Y + sums.weighted.Z > 0.0)) {
    return Bad(
        "no light between 360 and 830 nm (the weighted sum is not positive); subtract less dark "
        "signal or measure a brighter lamp");
  }
  if (!std::isfinite(sums.weighted.X + sums.weighted.Y + sums.weighted.Z) ||
      !std::isfinite(sums.plain)) {
    return Bad("the values are too large to add; check their unit");
  }
  return sums;
}

// The melanopic action spectrum beside V, which is y bar.
Xyz MelanopicAndLuminous(Nanometres wavelength) {
  const double position = wavelength.value() - kMelanopicFirstNm;
  const double luminous = ColorMatchingAt(wavelength).Y;
  if (!(position >= 0.0 && position <= kMelanopicCount - 1)) return {0.0, luminous, 0.0};
  const auto& s_mel = MelanopicActionSpectrum();
  const auto row = std::min(static_cast<std::size_t>(position), std::size_t{kMelanopicCount - 2});
  const double t = position - static_cast<double>(row);
  return {s_mel[row] + t * (s_mel[row + 1] - s_mel[row]), luminous, 0.0};
}

}  // namespace

Xyz ColorMatchingAt(Nanometres wavelength) {
  const double position = wavelength.value() - kCmfFirstNm;
  if (!(position >= 0.0 && position <= kCmfCount - 1)) return {};
  const auto row = std::min(static_cast<std::size_t>(position), std::size_t{kCmfCount - 2});
  const double t = position - static_cast<double>(row);
  const CmfRow& a = Cie1931Cmf()[row];
  const CmfRow& b = Cie1931Cmf()[row + 1];
  return {a.x_bar + t * (b.x_bar - a.x_bar), a.y_bar + t * (b.y_bar - a.y_bar),
          a.z_bar + t * (b.z_bar - a.z_bar)};
}

Result<Xyz> XyzFromSpectrum(const Spectrum& spectrum) {
  const auto sums = Integrate(spectrum);
  if (!sums) return tl::unexpected(sums.error());
  const Xyz& w = sums->weighted;
  const double k =
      spectrum.quantity == SpectralQuantity::kIrradiance ? kMaximumLuminousEfficacy : 100.0 / w.Y;
  return Xyz{k * w.X, k * w.Y, k * w.Z};
}

bool CoversVisibleRange(const Spectrum& spectrum) {
  if (spectrum.wavelengths_nm.size() < 2) return false;
  const auto& l = spectrum.wavelengths_nm;
  const double first_step = l[1] - l[0];
  const double last_step = l[l.size() - 1] - l[l.size() - 2];
  return l.front() - first_step / 2 <= kVisibleFirstNm &&
         l.back() + last_step / 2 >= kVisibleLastNm;
}

bool HasEqualSteps(const Spectrum& spectrum) {
  const double step = MeanStep(spectrum);
  for (std::size_t i = 1; i < spectrum.wavelengths_nm.size(); ++i) {
    const double own = spectrum.wavelengths_nm[i] - spectrum.wavelengths_nm[i - 1];
    if (std::abs(own - step) > kEqualStepTolerance * step) return false;
  }
  return true;
}

Result<LumensPerWatt> EfficacyOfRadiation(const Spectrum& spectrum) {
  const auto sums = Integrate(spectrum);
  if (!sums) return tl::unexpected(sums.error());
  if (!(sums->plain > 0.0)) return Bad("the values add up to no radiation; check the dark signal");
  return LumensPerWatt(kMaximumLuminousEfficacy * sums->weighted.Y / sums->plain);
}

Result<double> MelanopicDaylightEfficacyRatio(const Spectrum& spectrum) {
  const auto sums = Integrate(spectrum, MelanopicAndLuminous);
  if (!sums) return tl::unexpected(sums.error());
  if (sums->weighted.X < 0.0) {
    return Bad("the blue and green samples add up to less than nothing; subtract less dark signal");
  }
  const double watts_per_lumen = sums->weighted.X / (kMaximumLuminousEfficacy * sums->weighted.Y);
  return watts_per_lumen / kMelanopicWattsPerLumenOfD65;
}

}  // namespace lightcal
