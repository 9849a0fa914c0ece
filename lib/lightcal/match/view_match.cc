// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <utility>

#include "lightcal/match/match_lights.h"
#include "lightcal/match/match_scene.h"

namespace lightcal::match {

Result<ViewedMatch> ViewMatch(const MatchRequest& request, const Match& match) {
  auto scene = MatchScene::Make(request, {});
  if (!scene) return Propagate(std::move(scene));
  const LightView* view = &scene->observer;
  if (match.camera) {
    double nearest = 0.0;
    for (std::size_t c = 0; c < scene->cameras.size(); ++c) {
      const double off = std::abs(match.camera->by_camera[c] - match.camera->median);
      if (c > 0 && off >= nearest) continue;
      nearest = off;
      view = &scene->cameras[c];
    }
  }
  NodeValues open{};
  open.fill(1.0);
  return ViewedMatch{view->name(), view->Target(), view->See(open), view->See(match.transmittance)};
}

}  // namespace lightcal::match
