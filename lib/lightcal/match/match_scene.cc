// SPDX-License-Identifier: Apache-2.0
#include "lightcal/match/match_scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lightcal/colorimetry/ssi.h"
#include "lightcal/core/statistics.h"

namespace lightcal::match {
namespace {

NodeXyz NodeXyzOf(const NanometrePowers& light) {
  const ViewChannels observer = ObserverChannels(ObserverAngle::kTwoDegrees);
  NodeXyz xyz;
  double y = 0.0;
  for (std::size_t k = 0; k < kRenderingCount; ++k) {
    const std::size_t node = std::min(k / kNodeStepNm, std::size_t{kNodeCount - 2});
    const double t = static_cast<double>(k - node * kNodeStepNm) / kNodeStepNm;
    for (std::size_t c = 0; c < 3; ++c) {
      const double seen = light[k] * observer.channels[c][k];
      xyz.weights[c][node] += (1.0 - t) * seen;
      xyz.weights[c][node + 1] += t * seen;
    }
    y += light[k] * observer.channels[1][k];
  }
  for (NodeValues& each : xyz.weights) {
    for (double& weight : each) weight /= y;
  }
  return xyz;
}

}  // namespace

Xyz NodeXyz::Behind(const NodeValues& transmittance) const {
  double X = 0.0;
  double Y = 0.0;
  double Z = 0.0;
  for (std::size_t k = 0; k < kNodeCount; ++k) {
    X += weights[0][k] * transmittance[k];
    Y += weights[1][k] * transmittance[k];
    Z += weights[2][k] * transmittance[k];
  }
  return {X, Y, Z};
}

ViewChannels ChannelsOf(const CameraSensitivities& camera) {
  ViewChannels view;
  view.name = camera.camera;
  const std::size_t count = camera.channels[0].size();
  for (std::size_t k = 0; k < kRenderingCount; ++k) {
    const double place =
        (kRenderingFirstNm + static_cast<double>(k) - camera.first_nm) / camera.step_nm;
    if (!(place >= 0.0) || place > static_cast<double>(count - 1)) continue;
    const auto i = std::min(static_cast<std::size_t>(place), count - 2);
    const double t = place - static_cast<double>(i);
    for (std::size_t c = 0; c < 3; ++c) {
      const auto& channel = camera.channels[c];
      view.channels[c][k] = (1.0 - t) * channel[i] + t * channel[i + 1];
    }
  }
  return view;
}

Result<MatchScene> MatchScene::Make(const MatchRequest& request, std::span<const Gel> gels) {
  const auto named = [](Error error, const char* which) {
    error.subject = which;
    return tl::unexpected(std::move(error));
  };
  const auto lamp = NanometrePowersOf(request.lamp);
  if (!lamp) return named(lamp.error(), "lamp");
  const auto target = NanometrePowersOf(request.target);
  if (!target) return named(target.error(), "target");
  auto observer =
      LightView::Make(ObserverChannels(request.observer), *lamp, *target, request.observer);
  if (!observer) return Propagate(std::move(observer));
  MatchScene scene{request, {}, {}, *std::move(observer), NodeXyzOf(*lamp), {}};
  for (const CameraSensitivities& camera : request.cameras) {
    auto view = LightView::Make(ChannelsOf(camera), *lamp, *target, request.observer);
    if (!view) return Propagate(std::move(view));
    scene.cameras.push_back(*std::move(view));
  }
  for (const Gel& gel : gels) {
    scene.gels.push_back(GelAtNodes(gel.wavelengths_nm, gel.transmittance));
  }
  const auto lamp_xyz = XyzFromSpectrum(request.lamp);
  const auto target_xyz = XyzFromSpectrum(request.target);
  scene.lamp_Y = lamp_xyz->Y;
  scene.target_Y = target_xyz->Y;
  scene.target_uv = Uv1976FromXy(XyFromXyz(*target_xyz));
  return scene;
}

NodeValues MatchScene::Transmittance(std::span<const std::size_t> stack) const {
  NodeValues through{};
  through.fill(1.0);
  if (stack.empty()) return through;
  through = gels[stack[0]].transmittance;
  for (const std::size_t gel : stack.subspan(1)) {
    through = StackOf(through, gels[gel].transmittance, request.gap);
  }
  return through;
}

Match MatchScene::Describe(std::vector<std::size_t> stack) const {
  Match match;
  match.transmittance = Transmittance(stack);
  match.gels = std::move(stack);
  const Spectrum behind = SpectrumBehind(request.lamp, match.transmittance);
  if (const auto xyz =
          XyzFromSpectrum({behind.wavelengths_nm, behind.values, SpectralQuantity::kIrradiance})) {
    const auto whole = XyzFromSpectrum(
        {request.lamp.wavelengths_nm, request.lamp.values, SpectralQuantity::kIrradiance});
    match.xy = XyFromXyz(*xyz);
    match.cct = CctFromXy(match.xy);
    const Uv1976 uv = Uv1976FromXy(match.xy);
    match.delta_uv = std::hypot(uv.u - target_uv.u, uv.v - target_uv.v);
    match.stops_lost = std::log2(whole->Y / xyz->Y);
    const bool absolute = request.lamp.quantity == SpectralQuantity::kIrradiance &&
                          request.target.quantity == SpectralQuantity::kIrradiance;
    if (absolute) match.dimmer_stops = std::log2(xyz->Y / target_Y);
  }
  const LightView::Seen eye = observer.See(match.transmittance);
  match.observer = eye.mean;
  match.observer_skin = eye.skin;
  if (!cameras.empty()) {
    CameraDifference all;
    std::vector<double> skin;
    for (const LightView& camera : cameras) {
      const LightView::Seen seen = camera.See(match.transmittance);
      all.by_camera.push_back(seen.mean);
      skin.push_back(seen.skin);
      if (all.worst_camera.empty() || seen.mean > all.worst) {
        all.worst = seen.mean;
        all.worst_camera = camera.name();
      }
    }
    std::vector<double> means = all.by_camera;
    all.median = Median(means);
    all.skin = Median(skin);
    match.camera = std::move(all);
  }
  match.ssi = SpectralSimilarity(behind, request.target).value_or(0.0);
  return match;
}

}  // namespace lightcal::match
