// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/check/learn_cone.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "lightcal/core/units.h"

namespace lightcal {
namespace {

// What a renderer makes of two half angles, the likelier first.
struct AngleReading {
  std::string_view cause;  // where the law is the file's
  double outer_times, inner_times;
  bool hard;
};
constexpr std::array<AngleReading, 5> kAngleReadings = {{
    {"none", 1.0, 1.0, false},
    {"half_cone_for_full", 0.5, 0.5, false},
    {"full_cone_for_half", 2.0, 2.0, false},
    {"penumbra_missing", 1.0, 1.0, true},
    {"inner_cone_missing", 1.0, 0.0, false},
}};

// The file's own law first. Godot's power is no second angle.
std::vector<EngineConeLaw> LawsFor(EngineConeLaw written) {
  std::vector<EngineConeLaw> laws = {written};
  if (written == EngineConeLaw::kPower) return laws;
  for (const auto law :
       {EngineConeLaw::kSmooth, EngineConeLaw::kSquared, EngineConeLaw::kSmoothInAngle,
        EngineConeLaw::kLinearInAngle, EngineConeLaw::kSmoothTimesCosine}) {
    if (law != written) laws.push_back(law);
  }
  return laws;
}

// As the measured beam has it: the squared law between its own angles.
double BeamAt(const CheckedLamp& lamp, Radians angle) {
  return SpotAttenuation(angle,
                         {RadiansFromDegrees(lamp.inner_deg), RadiansFromDegrees(lamp.outer_deg)},
                         SpotFalloff::kSquaredLinear);
}

// Of a cone over the measured beam, the mean of the cards that stand about the axis.
double ShownAboutAxis(const CheckedRig& rig, const EngineCone& shape) {
  constexpr int kSide = 6;
  const auto& [white, grey] = rig.cards;
  const Vec3 middle =
      (white.inner_m[0] + white.inner_m[2] + grey.inner_m[0] + grey.inner_m[2]) * 0.25;
  double seen = 0.0, measured = 0.0;
  for (const CheckedCard& card : rig.cards) {
    for (int i = 0; i < kSide * kSide; ++i) {
      const double u = (i % kSide + 0.5) / kSide, v = (i / kSide + 0.5) / kSide;
      const Vec3 at = card.inner_m[0] + (card.inner_m[1] - card.inner_m[0]) * u +
                      (card.inner_m[3] - card.inner_m[0]) * v;
      const Radians angle(std::atan(Length(at - middle) / rig.separation_m));
      seen += ConeFactor(shape, angle);
      measured += BeamAt(rig.lamps.front(), angle);
    }
  }
  return seen / measured;
}

struct Beside {
  Radians angle{0.0};
  double part = 0.0;  // of the axial intensity, seen, times the factor on the axis
};

double MisfitOf(const EngineCone& shape, double shared, std::span<const Beside> seen) {
  double misfit = 0.0;
  for (const Beside& one : seen) {
    const double want = ConeFactor(shape, one.angle);
    misfit = std::max(misfit, std::abs(one.part / shared - want) / (0.004 + 0.01 * want));
  }
  return misfit;
}

}  // namespace

std::optional<ConeFound> FindCone(const CheckedRig& axis, double on_axis,
                                  std::span<const SeenRig> off_axis, EngineConeLaw written) {
  if (off_axis.empty()) return std::nullopt;
  const CheckedLamp& lamp = axis.lamps.front();
  std::vector<Beside> seen;
  for (const SeenRig& one : off_axis) {
    const Radians angle = RadiansFromDegrees(one.rig->off_axis_deg);
    seen.push_back({angle, one.verdict->lux / one.verdict->expected_lx * BeamAt(lamp, angle)});
  }
  const EngineCone file = RefitCone(
      written,
      ProfileOf(SpotCone{RadiansFromDegrees(lamp.inner_deg), RadiansFromDegrees(lamp.outer_deg)}));
  std::optional<ConeFound> nearest;
  double least = 4.0;
  for (const AngleReading& reading : kAngleReadings) {
    for (const EngineConeLaw law : LawsFor(written)) {
      const LearntCone cone{written, law, reading.outer_times, reading.inner_times, reading.hard};
      const EngineCone shape = cone.Of(file);
      const double shown = ShownAboutAxis(axis, shape);
      if (!(shown > 0.1)) continue;
      const double shared = on_axis / shown;
      const double misfit = MisfitOf(shape, shared, seen);
      if (misfit >= least) continue;
      // Without a penumbra the law between the angles says nothing.
      const bool own = law == written || reading.hard;
      nearest = ConeFound{cone, std::string(own ? reading.cause : "other_cone_law"), shared};
      if (misfit < 1.0) return nearest;
      least = misfit;
    }
  }
  return nearest;
}

}  // namespace lightcal
