// SPDX-License-Identifier: Apache-2.0
// Whether the declared price of each effect (light/effects/effect_table.h) is what its own code
// takes: the median over the scenes of the gate's ladder that have it. Ends with 1 where one is off
// by more than a factor of two.
#include <algorithm>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/light/effect_cost.h"
#include "lightcal/light/effects/effect_table.h"
#include "lightcal/light/gate_ladder.h"

namespace {

void Print(std::string_view name, double declared_ns, double measured_ns, bool off) {
  std::printf("%-20s %8.1f %10.1f %9.2f%s\n", std::string(name).c_str(), declared_ns, measured_ns,
              measured_ns / declared_ns, off ? "  OFF BY MORE THAN 2" : "");
}

}  // namespace

int main() {
  using namespace lightcal;
  const std::vector<NamedScene> scenes = LadderScenes();
  int strange = 0;
  std::printf("effect               declared   measured  measured/declared\n");
  for (const Effect& effect : kEffects) {
    std::vector<double> costs;
    for (const NamedScene& named : scenes) {
      const EffectFinding finding = effect.find(named.scene);
      if (finding.applies && finding.bound > 0.0) {
        costs.push_back(MeasuredCost_ns(effect.name, named.scene));
      }
    }
    if (costs.empty()) costs.push_back(MeasuredCost_ns(effect.name, scenes.front().scene));
    std::ranges::sort(costs);
    const double median = costs[costs.size() / 2];
    const bool off = median > 2.0 * effect.cost_ns || median < 0.5 * effect.cost_ns;
    strange += off ? 1 : 0;
    Print(effect.name, effect.cost_ns, median, off);
  }
  // In a fit the walls' light is a parameter, not a box of patches.
  Scene fitted = scenes.front().scene;
  fitted.walls = WallPriors({}, std::nullopt);
  const double walls = MeasuredCost_ns("room_bounce", fitted);
  const bool off = walls > 2.0 * effects::kFittedWalls_ns || walls < 0.5 * effects::kFittedWalls_ns;
  strange += off ? 1 : 0;
  Print("room_bounce, fitted", effects::kFittedWalls_ns, walls, off);
  return strange == 0 ? 0 : 1;
}
