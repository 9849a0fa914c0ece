// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/spectral_doubt.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/uncertain.h"

namespace lightcal {
namespace {

constexpr double kUnlikeBandMeans = 6.0;
constexpr double kLostLinesMired = 8.0;  // by nm of step
constexpr double kLostLinesDuv = 1.0 / 300.0;
constexpr double kGap = 2.5;  // steps

struct Steps {
  double usual_nm = 0.0;
  double from_nm = 0.0, to_nm = 0.0;  // the widest
  [[nodiscard]] bool gap() const { return to_nm - from_nm > kGap * usual_nm; }
};

// As a person writes it: files' own wavelengths may be sums of rounded steps.
std::string Nm(double nm) { return ShortestText(std::round(nm * 100.0) / 100.0); }

Steps StepsOf(const Spectrum& spectrum) {
  const std::vector<double>& l = spectrum.wavelengths_nm;
  Steps out;
  std::vector<double> steps;
  for (std::size_t i = 1; i < l.size(); ++i) {
    steps.push_back(l[i] - l[i - 1]);
    if (steps.back() <= out.to_nm - out.from_nm) continue;
    out.from_nm = l[i - 1];
    out.to_nm = l[i];
  }
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::ranges::nth_element(steps, middle);
  out.usual_nm = *middle;
  return out;
}

}  // namespace

Sampling SamplingOfFormat(std::string_view format) {
  const bool table = format == "csv" || format == "argyll_sp" || format == "tm27_spdx";
  return table ? Sampling::kUnknown : Sampling::kBandAverage;
}

std::optional<Warning> WarningOfRange(const Spectrum& spectrum, const std::string& subject) {
  if (CoversVisibleRange(spectrum)) return std::nullopt;
  const auto& l = spectrum.wavelengths_nm;
  return Warning{"spectrum_truncated", subject,
                 "covers " + ShortestText(l.front()) + " to " + ShortestText(l.back()) +
                     " nm only; CIE asks for 380 to 780 nm, so colour and illuminance lack the "
                     "rest"};
}

std::optional<Warning> WarningOfClip(const Spectrum& spectrum, const std::string& subject) {
  constexpr std::ptrdiff_t kLeastWide = 5;
  constexpr double kSteps = 20.0, kLeastFall = 0.03, kNothing = 0.05;
  const std::vector<double>& s = spectrum.values;
  const auto top = std::ranges::max_element(s);
  const auto behind = std::find_if(top, s.end(), [&](double v) { return v != *top; });
  const std::ptrdiff_t wide = behind - top, half = (wide + 1) / 2;
  if (!(*top > 0.0) || wide < kLeastWide || top - s.begin() < half || s.end() - behind < half) {
    return std::nullopt;
  }
  std::vector<double> sorted = s;
  std::ranges::sort(sorted);
  double step = *top;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    const double apart = sorted[i] - sorted[i - 1];
    if (apart > 1e-9 * *top) step = std::min(step, apart);
  }
  const double fall = std::min(*top - *(top - half), *top - *(behind + half - 1));
  const bool at_once = std::max(*(top - 1), *behind) < kNothing * *top;
  if (fall < std::max(kSteps * step, kLeastFall * *top) || at_once) return std::nullopt;
  return Warning{
      "spectrum_clipped", subject,
      std::to_string(wide) + " samples from " +
          Nm(spectrum.wavelengths_nm[static_cast<std::size_t>(top - s.begin())]) +
          " nm on share its largest value, as if the instrument were full there: colour, "
          "colour rendering and illuminance lack what is above; measure again with a "
          "shorter integration time"};
}

std::optional<Warning> WarningOfSampling(const Spectrum& spectrum, const SpectralError& error,
                                         const std::string& subject, std::string_view remedy) {
  if (!error.undersampled) return std::nullopt;
  const Steps steps = StepsOf(spectrum);
  if (steps.gap()) {
    return Warning{"undersampled", subject,
                   "has no sample between " + Nm(steps.from_nm) + " and " + Nm(steps.to_nm) +
                       " nm, where others are " + Nm(steps.usual_nm) +
                       " nm apart: what shines there is not known, and the error of its colour has "
                       "no bound; give a table without the gap"};
  }
  return Warning{"undersampled", subject,
                 "is sampled every " + Nm(error.step.value()) +
                     " nm; if each sample is one wavelength, lines between them are lost, and the "
                     "error of its colour has no bound: " +
                     std::string(remedy)};
}

SpectralDoubt DoubtOf(const Spectrum& spectrum, const SpectralError& error) {
  std::optional<SpectralErrorBound> bound = error.bound;
  if (error.undersampled) {
    const auto of_means = SpectralErrorOf(spectrum, Sampling::kBandAverage);
    if (of_means) bound = of_means->bound;
  }
  Spectrum unscaled = spectrum;
  unscaled.quantity = SpectralQuantity::kRelative;
  const auto xyz = XyzFromSpectrum(unscaled);
  if (!bound || !bound->temperature || !bound->duv || !xyz) return {};
  const double kelvin = CctFromXy(XyFromXyz(*xyz)).temperature.value();
  SpectralDoubt doubt{Mireds(1e6 / kelvin - 1e6 / (kelvin + bound->temperature->value())),
                      *bound->duv};
  if (!error.undersampled) return doubt;
  const Steps steps = StepsOf(spectrum);
  if (steps.gap()) return doubt;
  const double lost_nm = error.step.value();
  return {Mireds(std::max(kUnlikeBandMeans * doubt.mireds.value(), kLostLinesMired * lost_nm)),
          std::max(kUnlikeBandMeans * doubt.duv, kLostLinesDuv * lost_nm)};
}

void WidenBy(const SpectralDoubt& doubt, FittedColor& color) {
  if (color.cct_K) {
    Uncertain& cct = *color.cct_K;
    const double mired = 1e6 / cct.value;
    const double half = std::hypot(1e6 / LowEnd(cct) - mired, doubt.mireds.value());
    const double low = 1e6 / (mired + half);
    const double high = 1e6 / std::max(mired - half, std::min(mired, 1e6 / kHottestLamp.value()));
    cct = {cct.value, 0.5 * (high - low), low, high};
  }
  if (color.duv) {
    color.duv = UncertainFromNormal(color.duv->value, std::hypot(color.duv->u95, doubt.duv) / kZ95);
  }
}

}  // namespace lightcal
