// SPDX-License-Identifier: Apache-2.0
#include "lightcal/match/match_intervals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "lightcal/colorimetry/ssi.h"
#include "lightcal/core/standard_normal.h"
#include "lightcal/match/smooth_noise.h"

namespace lightcal::match {
namespace {

constexpr double kGelCorrelationNm = 50.0;
constexpr double kMeterCorrelationNm = 100.0;
constexpr double kChannelCorrelationNm = 50.0;
constexpr double kEulersNumber = 2.718281828459045;
constexpr double kLow = 0.025, kHigh = 0.975;
constexpr std::uint64_t kSceneSeed = 20260121;
constexpr std::uint64_t kGelSeed = 0x9E3779B97F4A7C15ULL;

const SmoothNoise& GelNoise() {
  static const SmoothNoise noise(kGelCorrelationNm);
  return noise;
}

NodeValues OnePlus(const NodeValues& noise, double sigma) {
  NodeValues out{};
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = 1.0 + sigma * noise[k];
  return out;
}

// Between the two values beside rank p (n + 1), counted from 1; the ends beyond.
double OrderStatistic(std::vector<double> values, double p) {
  std::ranges::sort(values);
  const double rank = std::clamp(p * static_cast<double>(values.size() + 1), 1.0,
                                 static_cast<double>(values.size()));
  const auto below = static_cast<std::size_t>(rank);
  const double t = rank - static_cast<double>(below);
  if (below == values.size()) return values.back();
  return values[below - 1] + t * (values[below] - values[below - 1]);
}

Uncertain IntervalOf(double value, std::vector<double> drawn) {
  std::erase_if(drawn, [](double v) { return !std::isfinite(v); });
  if (drawn.size() < 2) return {value, 0.0, std::nullopt, std::nullopt};
  const double low = std::min(value, OrderStatistic(drawn, kLow));
  const double high = std::max(value, OrderStatistic(drawn, kHigh));
  return {value, (high - low) / 2.0, low, high};
}

// The draws' interval moved to the other cameras' median, and their spread beside it.
Uncertain WithCameras(const Uncertain& drawn, const CameraDifference& cameras) {
  if (cameras.by_camera.size() < 2) return drawn;
  const double down = cameras.median - OrderStatistic(cameras.by_camera, kLow);
  const double up = OrderStatistic(cameras.by_camera, kHigh) - cameras.median;
  const double low = std::max(
      0.0, cameras.median - std::hypot(down, drawn.value - drawn.low.value_or(drawn.value)));
  const double high =
      cameras.median + std::hypot(up, drawn.high.value_or(drawn.value) - drawn.value);
  return {cameras.median, (high - low) / 2.0, low, high};
}

// The camera whose difference lies nearest the median.
std::size_t MiddleCamera(const CameraDifference& cameras) {
  std::size_t middle = 0;
  for (std::size_t c = 1; c < cameras.by_camera.size(); ++c) {
    if (std::abs(cameras.by_camera[c] - cameras.median) <
        std::abs(cameras.by_camera[middle] - cameras.median)) {
      middle = c;
    }
  }
  return middle;
}

double YOf(Spectrum spectrum) {
  spectrum.quantity = SpectralQuantity::kIrradiance;
  const auto xyz = XyzFromSpectrum(spectrum);
  return xyz ? xyz->Y : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

MatchDraws::MatchDraws(const MatchScene& scene) : scene_(scene) {
  const MatchRequest& request = scene.request;
  const MatchSpread& spread = request.spread;
  const SmoothNoise meter(kMeterCorrelationNm);
  const SmoothNoise channels(kChannelCorrelationNm);
  std::mt19937_64 random(kSceneSeed);
  StandardNormal normal;
  const double lamp_sigma = request.lamp_measured ? spread.spectral : 0.0;
  const double target_sigma = request.target_measured ? spread.spectral : 0.0;
  const double levels = std::hypot(request.lamp_measured ? spread.level : 0.0,
                                   request.target_measured ? spread.level : 0.0);
  for (int i = 0; i < request.draws; ++i) {
    Draw draw{};
    draw.lamp = OnePlus(meter.Draw(random), lamp_sigma);
    draw.target = OnePlus(meter.Draw(random), target_sigma);
    for (NodeValues& channel : draw.channel) {
      channel = OnePlus(channels.Draw(random), spread.sensitivity);
    }
    draw.level = std::exp(levels * normal(random));
    draw.plain_Y = YOf(SpectrumBehind(request.lamp, draw.lamp));
    draw.target_spectrum = SpectrumBehind(request.target, draw.target);
    draws_.push_back(std::move(draw));
  }
}

NodeValues MatchDraws::Through(const Match& match, std::size_t draw) const {
  const double dye = scene_.request.spread.gel_points / kZ95 * kEulersNumber;
  NodeValues all{};
  all.fill(1.0);
  for (std::size_t g = 0; g < match.gels.size(); ++g) {
    const std::size_t gel = match.gels[g];
    // One gel doubled is cut from one roll: the same draw twice.
    std::mt19937_64 random(kGelSeed * (gel + 1) + draw);
    const NodeValues noise = GelNoise().Draw(random);
    std::uniform_real_distribution<double> anything(0.0, 1.0);
    const double blue = anything(random);
    const double red = anything(random);
    const GelNodes& known = scene_.gels[gel];
    NodeValues through{};
    for (std::size_t k = 0; k < kNodeCount; ++k) {
      const double T = known.transmittance[k];
      const double moved = T > 0.0 ? T + T * std::log(T) * dye * noise[k] : 0.0;
      through[k] = static_cast<int>(k) < known.known_from ? blue
                   : static_cast<int>(k) > known.known_to ? red
                                                          : std::clamp(moved, 0.0, 1.0);
    }
    all = g == 0 ? through : StackOf(all, through, scene_.request.gap);
  }
  return all;
}

Match::Intervals MatchDraws::Of(const Match& match) const {
  const MatchRequest& request = scene_.request;
  const std::size_t middle = match.camera ? MiddleCamera(*match.camera) : 0;
  std::vector<double> kelvin, duv, delta_uv, observer, camera, ssi, lost, dimmer;
  for (std::size_t i = 0; i < draws_.size(); ++i) {
    const Draw& draw = draws_[i];
    ViewFactors factors;
    factors.lamp = StackOf(Through(match, i), draw.lamp, SheetGap::kNone);
    factors.target = draw.target;
    for (NodeValues& channel : factors.channel) channel.fill(1.0);
    observer.push_back(scene_.observer.Difference(factors));
    if (match.camera) {
      factors.channel = draw.channel;
      camera.push_back(scene_.cameras[middle].Difference(factors));
    }
    Spectrum behind = SpectrumBehind(request.lamp, factors.lamp);
    behind.quantity = SpectralQuantity::kIrradiance;
    const auto xyz = XyzFromSpectrum(behind);
    const auto target_xyz = XyzFromSpectrum(draw.target_spectrum);
    if (!xyz || !target_xyz) continue;
    const Xy xy = XyFromXyz(*xyz);
    const Uv1976 uv = Uv1976FromXy(xy);
    const Uv1976 target_uv = Uv1976FromXy(XyFromXyz(*target_xyz));
    delta_uv.push_back(std::hypot(uv.u - target_uv.u, uv.v - target_uv.v));
    if (const CctResult cct = CctFromXy(xy); cct.valid()) {
      kelvin.push_back(cct.temperature.value());
      duv.push_back(cct.duv);
    }
    const double stops = std::log2(draw.plain_Y / xyz->Y);
    lost.push_back(stops);
    if (match.dimmer_stops) {
      dimmer.push_back(*match.dimmer_stops + match.stops_lost - stops + std::log2(draw.level));
    }
    if (const auto similar = SpectralSimilarity(behind, draw.target_spectrum)) {
      ssi.push_back(*similar);
    }
  }
  Match::Intervals out;
  if (match.cct.valid()) {
    out.cct_K = IntervalOf(match.cct.temperature.value(), std::move(kelvin));
    out.duv = IntervalOf(match.cct.duv, std::move(duv));
  }
  out.delta_uv = IntervalOf(match.delta_uv, std::move(delta_uv));
  out.observer = IntervalOf(match.observer, std::move(observer));
  out.ssi = IntervalOf(match.ssi, std::move(ssi));
  out.stops_lost = IntervalOf(match.stops_lost, std::move(lost));
  if (match.dimmer_stops) out.dimmer_stops = IntervalOf(*match.dimmer_stops, std::move(dimmer));
  if (match.camera) {
    out.camera =
        WithCameras(IntervalOf(match.camera->by_camera[middle], std::move(camera)), *match.camera);
  }
  return out;
}

}  // namespace lightcal::match
