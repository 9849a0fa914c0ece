// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/beam/unstated_inner.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "lightcal/core/normal_mixture.h"
#include "lightcal/fit/beam/spot_beam.h"
#include "lightcal/fit/fit_by_distance.h"
#include "lightcal/fit/model/data_sheet.h"
#include "lightcal/fit/states/ln_of.h"
#include "lightcal/photometry/source_photometry.h"

namespace lightcal::fit {
namespace {

constexpr int kShares = 9;
constexpr double kWidestShare = 0.98;  // of outer_deg: an edge that no lens makes harder

struct HeldInner {
  Radians inner{0.0};
  double ln_weight = 0.0;
  FittedLight fitted;
  FittedSession said;
};

// A reading that is thrown out fits as badly as one that just is not.
double LnWeight(const FittedLight& fitted) {
  constexpr double kThrownOut = 4.7;
  double ln = 0.0;
  for (const ResidualRow& row : fitted.residuals) {
    if (!(row.sigma_relative > 0.0)) continue;
    const double z = row.used ? row.relative / row.sigma_relative : kThrownOut;
    ln -= 0.5 * z * z + std::log(row.sigma_relative);
  }
  return ln;
}

// What the printed flux says of a cone of that inner angle, as bright as it was read.
double LnWeightByFlux(const LightDescription& light, const FittedLight& fitted) {
  if (!HasDataSheet(light) || !fitted.intensity_cd || !(fitted.intensity_cd->value > 0.0)) {
    return 0.0;
  }
  const double omega =
      SolidAngleOfSpot({*light.inner, *light.outer}, SpotFalloff::kSquaredLinear).value();
  const double sd =
      std::hypot(SdOfLn(*fitted.intensity_cd), std::log1p(kFluxToleranceRelative) / kZ95);
  const double z = std::log(fitted.intensity_cd->value * omega / light.flux->value()) / sd;
  return -0.5 * z * z;
}

std::optional<Uncertain> MixtureOf(const std::vector<HeldInner>& held,
                                   std::optional<Uncertain> FittedLight::* quantity) {
  std::vector<NormalPart> parts;
  for (const HeldInner& one : held) {
    const std::optional<Uncertain>& own = one.fitted.*quantity;
    if (!own || !(own->value > 0.0)) return std::nullopt;
    parts.push_back({std::exp(one.ln_weight), std::log(own->value), SdOfLn(*own)});
  }
  return UncertainFromLogMixture(parts);
}

void MixInner(const std::vector<HeldInner>& held, FittedLight& out) {
  double mean = 0.0, square = 0.0;
  for (const HeldInner& one : held) {
    const double degrees = DegreesFromRadians(one.inner);
    mean += std::exp(one.ln_weight) * degrees;
    square += std::exp(one.ln_weight) * degrees * degrees;
  }
  out.inner_deg = mean;
  out.inner_u95_deg = kZ95 * std::sqrt(std::max(0.0, square - mean * mean));
}

}  // namespace

bool LacksInner(const LightDescription& light, const Observations& observations) {
  return light.kind == LightKind::kSpot && light.outer && !light.inner &&
         !NeedsBeam(observations, light);
}

Result<FittedLight> FitUnstatedInner(const Session& session, const LightDescription& light,
                                     const Observations& observations, const FitSettings& settings,
                                     const FittedLight& described, FittedSession& session_out) {
  std::vector<HeldInner> held;
  std::optional<Error> refused;
  for (int i = 0; i < kShares; ++i) {
    LightDescription one = light;
    one.inner = *light.outer * (kWidestShare * i / (kShares - 1));
    FittedSession said;
    Result<FittedLight> fitted =
        FitByDistance(session, one, observations, settings, described, said);
    if (!fitted) {
      if (!refused) refused = std::move(fitted).error();
      continue;
    }
    const double ln_weight = LnWeight(*fitted) + LnWeightByFlux(one, *fitted);
    held.push_back({*one.inner, ln_weight, *std::move(fitted), std::move(said)});
  }
  if (held.empty()) return tl::unexpected(*std::move(refused));
  const auto best = std::ranges::max_element(held, {}, &HeldInner::ln_weight);
  double sum = 0.0;
  for (const HeldInner& one : held) sum += std::exp(one.ln_weight - best->ln_weight);
  const double ln_sum = best->ln_weight + std::log(sum);
  for (HeldInner& one : held) one.ln_weight -= ln_sum;
  session_out.Warn(std::move(best->said.warnings));
  std::ranges::move(best->said.notes, std::back_inserter(session_out.notes));
  FittedLight out = best->fitted;
  MixInner(held, out);
  if (auto intensity = MixtureOf(held, &FittedLight::intensity_cd)) out.intensity_cd = intensity;
  if (auto flux = MixtureOf(held, &FittedLight::flux_lm)) out.flux_lm = flux;
  return out;
}

}  // namespace lightcal::fit
