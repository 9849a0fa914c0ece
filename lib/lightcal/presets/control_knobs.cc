// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/control_knobs.h"

#include <optional>
#include <utility>

namespace lightcal {
namespace {

using records::Node;

// One row of the table; the colour stays where none is known.
Node KnobRow(const ControlSweep::Point& point, const EmittedColor& reference,
             const ColorTarget& target) {
  double energy = point.relative.value;
  Rgb color{1.0, 1.0, 1.0};
  if (point.xy && reference.xy) {
    FittedLight there;
    there.color.xy = point.xy;
    Warnings unsaid;  // of the reference they were said
    const EmittedColor emitted = ColorOfLight(there, target, unsaid);
    const auto over = [](double value, double base) { return base > 0.0 ? value / base : 1.0; };
    energy *= reference.luminance / emitted.luminance;
    const Rgb& now = emitted.max_normalised;
    const Rgb& then = reference.max_normalised;
    color = {over(now.r, then.r), over(now.g, then.g), over(now.b, then.b)};
  }
  return {point.at, energy, color.r, color.g, color.b};
}

}  // namespace

records::Node KnobsNode(const PresetOptions& options, const FittedLight& lamp,
                        const PresetLight& light) {
  Node controls = Node::Array();
  for (const ControlSweep& sweep : options.sweeps) {
    // A zoom would turn the light and leave the cone.
    if (sweep.control == kZoomControl) continue;
    if (sweep.light != lamp.name || sweep.curve.size() < 2) continue;
    Node table = Node::Array();
    for (const ControlSweep::Point& point : sweep.curve) {
      table.items.push_back(KnobRow(point, light.color(), options.color));
    }
    controls.items.push_back(
        {{"control", sweep.control}, {"reference", sweep.reference}, {"table", std::move(table)}});
  }
  return Node::UnlessEmpty(std::move(controls));
}

}  // namespace lightcal
