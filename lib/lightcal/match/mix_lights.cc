// SPDX-License-Identifier: Apache-2.0
#include "lightcal/match/mix_lights.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/match/match_intervals.h"
#include "lightcal/match/match_scene.h"
#include "lightcal/match/smooth_noise.h"
#include "lightcal/match/stack_search.h"

namespace lightcal::match {
namespace {

constexpr int kShareSteps = 20;
constexpr int kGoldenSteps = 18;
constexpr double kMixMeterCorrelationNm = 100.0;
constexpr std::uint64_t kMixSeed = 20260122;

// On whole nanometres, Y = 1 of the 2 degree observer over them.
NanometrePowers AtUnitY(NanometrePowers powers) {
  const ViewChannels observer = ObserverChannels(ObserverAngle::kTwoDegrees);
  double y = 0.0;
  for (std::size_t k = 0; k < powers.size(); ++k) y += powers[k] * observer.channels[1][k];
  for (double& each : powers) each /= y;
  return powers;
}

Spectrum MixedSpectrum(const NanometrePowers& lamp, const NanometrePowers& with, double share) {
  Spectrum mix;
  for (std::size_t k = 0; k < lamp.size(); ++k) {
    mix.wavelengths_nm.push_back(kRenderingFirstNm + static_cast<double>(k));
    mix.values.push_back(share * lamp[k] + (1.0 - share) * with[k]);
  }
  return mix;
}

// The place of a function's minimum in 0..1: a coarse scan, then golden sections.
template <class Function>
double LeastAt(const Function& function) {
  double best = 0.0;
  double least = function(0.0);
  for (int i = 1; i <= kShareSteps; ++i) {
    const double share = static_cast<double>(i) / kShareSteps;
    if (const double value = function(share); value < least) {
      least = value;
      best = share;
    }
  }
  const double golden = (std::sqrt(5.0) - 1.0) / 2.0;
  double low = std::max(0.0, best - 1.0 / kShareSteps);
  double high = std::min(1.0, best + 1.0 / kShareSteps);
  for (int i = 0; i < kGoldenSteps; ++i) {
    const double left = high - golden * (high - low);
    const double right = low + golden * (high - low);
    (function(left) <= function(right) ? high : low) =
        function(left) <= function(right) ? right : left;
  }
  const double inner = (low + high) / 2.0;
  return function(inner) < least ? inner : best;
}

Xyz XyzOf(const NanometrePowers& powers, const NodeValues& factors) {
  const ViewChannels observer = ObserverChannels(ObserverAngle::kTwoDegrees);
  double xyz[3] = {};
  for (std::size_t k = 0; k < powers.size(); ++k) {
    const double power = powers[k] * AtNodes(factors, kRenderingFirstNm + static_cast<double>(k));
    for (std::size_t c = 0; c < 3; ++c) xyz[c] += power * observer.channels[c][k];
  }
  return {xyz[0], xyz[1], xyz[2]};
}

// Standard deviation of the share that brings the mix nearest in u'v', under the meters' errors.
double ShareSigma(const MatchRequest& request, const std::array<NanometrePowers, 3>& lights,
                  const std::array<bool, 3>& measured) {
  const SmoothNoise meter(kMixMeterCorrelationNm);
  std::mt19937_64 random(kMixSeed);
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < request.draws; ++i) {
    std::array<Xyz, 3> xyz{};
    for (std::size_t l = 0; l < lights.size(); ++l) {
      NodeValues factors = meter.Draw(random);
      for (double& each : factors) {
        each = 1.0 + (measured[l] ? request.spread.spectral * each : 0.0);
      }
      xyz[l] = XyzOf(lights[l], factors);
      xyz[l] = {xyz[l].X / xyz[l].Y, 1.0, xyz[l].Z / xyz[l].Y};
    }
    const Uv1976 goal = Uv1976FromXy(XyFromXyz(xyz[2]));
    const double share = LeastAt([&](double s) {
      const Uv1976 uv = Uv1976FromXy(
          XyFromXyz({s * xyz[0].X + (1 - s) * xyz[1].X, 1.0, s * xyz[0].Z + (1 - s) * xyz[1].Z}));
      return std::hypot(uv.u - goal.u, uv.v - goal.v);
    });
    sum += share / request.draws;
    squares += share * share / request.draws;
  }
  return std::sqrt(std::max(0.0, squares - sum * sum));
}

Uncertain Dimmer(double value, double share, double share_sigma, double level_sigma) {
  const double relative = std::hypot(share > 0.0 ? share_sigma / share : 0.0, level_sigma);
  if (value <= 0.0) return UncertainFromNormal(0.0, share_sigma);
  return UncertainFromLog(std::log(value), relative);
}

// What each must give of what it gave, and how sure that is.
void SetDimmers(const MatchRequest& request, const Spectrum& with, double share_sigma,
                const std::array<bool, 3>& measured, LightMix& mix) {
  if (request.lamp.quantity != SpectralQuantity::kIrradiance ||
      with.quantity != SpectralQuantity::kIrradiance) {
    return;
  }
  const double lamp_lx = XyzFromSpectrum(request.lamp)->Y;
  const double with_lx = XyzFromSpectrum(with)->Y;
  const double share = mix.share.value;
  double total = 1e300;  // the most both can give in this mix
  if (share > 0.0) total = std::min(total, lamp_lx / share);
  if (share < 1.0) total = std::min(total, with_lx / (1.0 - share));
  const bool known = request.target.quantity == SpectralQuantity::kIrradiance;
  if (known) total = XyzFromSpectrum(request.target)->Y;
  const double target_sigma = known && measured[2] ? request.spread.level : 0.0;
  const auto level = [&](bool own) {
    return std::hypot(own ? request.spread.level : 0.0, target_sigma);
  };
  mix.dimmer_lamp = Dimmer(share * total / lamp_lx, share, share_sigma, level(measured[0]));
  mix.dimmer_with =
      Dimmer((1.0 - share) * total / with_lx, 1.0 - share, share_sigma, level(measured[1]));
}

}  // namespace

Result<LightMix> MixLights(const MatchRequest& request, const Spectrum& with, bool with_measured) {
  const auto lamp = NanometrePowersOf(request.lamp);
  if (!lamp) return tl::unexpected(lamp.error());
  const auto other = NanometrePowersOf(with);
  if (!other) return tl::unexpected(other.error());
  const auto target = NanometrePowersOf(request.target);
  if (!target) return tl::unexpected(target.error());
  const NanometrePowers a = AtUnitY(*lamp);
  const NanometrePowers b = AtUnitY(*other);
  NodeValues open{};
  open.fill(1.0);
  MatchRequest one = request;
  one.lamp_measured = request.lamp_measured || with_measured;
  std::optional<Error> failure;
  const double share = LeastAt([&](double s) {
    one.lamp = MixedSpectrum(a, b, s);
    const auto scene = MatchScene::Make(one, {});
    if (!scene) failure = scene.error();
    return scene ? DecidingDifference(*scene, open) : 1e300;
  });
  if (failure) return tl::unexpected(*failure);
  one.lamp = MixedSpectrum(a, b, share);
  const auto scene = MatchScene::Make(one, {});
  if (!scene) return tl::unexpected(scene.error());
  LightMix mix;
  mix.mixed = scene->Describe({});
  if (mix.mixed.delta_uv > request.reach) {
    return Refused("unreachable", "target",
                   "it lies beside the line between the two lamps: the nearest mix, " +
                       PercentText(share) + " of the first, leaves " +
                       RoundedText(mix.mixed.delta_uv, 2) +
                       " in u'v'; gel one of them first, take another lamp, or {match.reach}");
  }
  const std::array<bool, 3> measured = {request.lamp_measured, with_measured,
                                        request.target_measured};
  const double sigma =
      request.draws > 0 ? ShareSigma(request, {a, b, AtUnitY(*target)}, measured) : 0.0;
  mix.share = UncertainFromNormal(share, sigma);
  mix.share.low = std::max(0.0, share - kZ95 * sigma);
  mix.share.high = std::min(1.0, share + kZ95 * sigma);
  SetDimmers(request, with, sigma, measured, mix);
  if (request.draws > 0) mix.mixed.intervals = MatchDraws(*scene).Of(mix.mixed);
  return mix;
}

}  // namespace lightcal::match
