// SPDX-License-Identifier: Apache-2.0
// What `simulate` found, as tables and as JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/uncertain.h"
#include "lightcal/light/illuminance_map.h"
#include "lightcal/records/document.h"
#include "lightcal/records/session.h"
#include "simulate/grid_target.h"
#include "simulate/map_plane.h"

namespace lightcal::app {

struct PredictedPoint {
  SurfacePoint at;
  std::vector<LampLux> parts;  // one a lamp
  // With what the walls add where the lamp was measured; one a lamp, empty where no room is known.
  std::vector<std::optional<Uncertain>> in_room{};
};

struct MapSummary {
  double least_lx = 0.0, mean_lx = 0.0, most_lx = 0.0;
  double median_u95_relative = 0.0;  // of the points that get light
  Vec3 brightest_m{};
};
// Of the points farther than border_m from the plane's edges; of all where that leaves none.
[[nodiscard]] MapSummary Summarize(const IlluminanceMap& map, const MapPlane& plane,
                                   double border_m = 0.0);

// Everything a run of the command found.
struct Simulated {
  std::vector<PlacedLamp> lamps;
  MapSettings settings;
  std::optional<Surroundings> surroundings;  // of the session its lamps were measured in
  double ambient_lx = 0.0;                   // added everywhere; 0 = not asked for
  std::vector<PredictedPoint> points;
  std::optional<MapPlane> plane;
  IlluminanceMap map;
  double border_m = 0.0;  // of the plane, left out of its summary
  std::optional<GridTarget> target;
  std::vector<LampAccount> accounts;  // one a lamp, of points and map together
  std::optional<double> elapsed_ms;   // --timing
  std::vector<std::string> files;
};

[[nodiscard]] std::string AnswerText(const Simulated& simulated);
[[nodiscard]] records::Node AnswerNode(const Simulated& simulated);

}  // namespace lightcal::app
