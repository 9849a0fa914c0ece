// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/asked_sampling.h"

#include <cmath>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/uncertain.h"

namespace lightcal::fit {

std::optional<SamplingRule> SamplingOf(const FitSettings& settings) {
  const int samples = settings.estimator.interval_samples;
  if (!settings.monte_carlo && samples <= 0) return std::nullopt;
  SamplingRule rule = settings.monte_carlo ? SamplingRule{} : JustSamples(samples);
  rule.progress = settings.progress;
  return rule;
}

std::string SayOfSampling(const LightEstimate& estimate, const std::string& light) {
  if (!estimate.sampled) {
    return light +
           ": no samples: its interval comes from the covariance (a place or cone was found "
           "too, or only an upper limit)";
  }
  const SampledParameter& ln = estimate.sampled->parameters[kLnIntensity];
  const double middle = estimate.theta[kLnIntensity];
  const double linear = kZ95 * SdOf(estimate.covariance, kLnIntensity);
  const auto percent = [](double ln_ratio) { return PercentText(std::expm1(ln_ratio), 3); };
  return light + ": " + std::to_string(estimate.sampled->samples) + " samples" +
         (estimate.sampled->stable ? "" : " (two digits would take more)") + ": 95 % from " +
         percent(ln.low - middle) + " to +" + percent(ln.high - middle) +
         "; the covariance alone says " + percent(-linear) + " to +" + percent(linear);
}

}  // namespace lightcal::fit
