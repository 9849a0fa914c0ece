// SPDX-License-Identifier: Apache-2.0
// How engines let a spot fall off its axis, and the cone of such a law that is nearest to a
// measured beam. The same two angles are another lamp in another law: up to 30 % of the axial
// intensity and 18 % of the flux.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/units.h"
#include "lightcal/light/intensity_table.h"
#include "lightcal/photometry/spot_cone.h"

namespace lightcal {

// Of the intensity on the axis, at theta from it; i inner, o outer half angle, ci, co their
// cosines, t = clamp((cos theta - co)/(ci - co), 0, 1), s = clamp((o - theta)/(o - i), 0, 1),
// u = (1 - cos theta)/(1 - co):
enum class EngineConeLaw : std::uint8_t {
  kSquared,            // t^2: glTF, Filament, Babylon.js, Unreal, Unity HDRP
  kSmooth,             // t^2 (3 - 2t): three.js, pbrt, Cycles from 4.0 on
  kSmoothTimesCosine,  // t^2 (3 - 2t) cos theta: Cycles before 4.0, whose spots are discs
  kSmoothInAngle,      // s^2 (3 - 2s): UsdLux
  kLinearInAngle,      // s: Mitsuba
  kPower,              // 1 - max(u, 1e-4)^power, over that on the axis: Godot
};

// A beam by angle from its axis, over its intensity there. Angles rise from 0.
struct BeamProfile {
  std::vector<double> angle_rad;
  std::vector<double> mean, least, most;  // round about the axis
  std::optional<SpotCone> squared;        // where it is the kSquared law itself
  bool lambertian = false;                // where it is the cosine, dark behind
};

// A spot of the squared-linear law, to 5 degrees beyond its outer angle.
[[nodiscard]] BeamProfile ProfileOf(const SpotCone& cone);
// A flat source far away, to 5 degrees behind it.
[[nodiscard]] BeamProfile LambertianProfile();
// A table about its aim (gamma = 0), over the whole sphere. Absent: dark along its aim.
[[nodiscard]] std::optional<BeamProfile> ProfileOf(const IntensityTable& table);

struct EngineCone {
  EngineConeLaw law = EngineConeLaw::kSquared;
  SpotCone cone{};
  double power = 1.0;     // kPower
  double worst = 0.0;     // largest |engine - measured| in any direction, over the axial intensity
  Radians worst_at{0.0};  // from the axis
  double flux = 1.0;      // the engine's over the measured one
};

[[nodiscard]] double ConeFactor(const EngineCone& cone, Radians from_axis);
// What the engine makes on the axis of the intensity it is told: 1, but 1 - 1e-4^power of kPower
// (.90 of a peaked beam).
[[nodiscard]] double AxisFactor(const EngineCone& cone);

// The cone of that law that keeps the intensity on the axis, then the flux (to kConeFluxError),
// then has the least worst error; 0 <= inner < outer <= 90 degrees (89 of kPower). To about 0.1 %
// of the axial intensity. Of a Lambertian beam the closed forms: kPower 1 and kSmoothTimesCosine
// are the cosine itself, kSquared has the least worst error, whatever its flux
// (kLambertianInnerCosine).
inline constexpr double kConeFluxError = 0.022;
[[nodiscard]] EngineCone RefitCone(EngineConeLaw law, const BeamProfile& beam);
// The same where the engine's inner angle is this share of its outer one, whatever it is told.
[[nodiscard]] EngineCone RefitCone(EngineConeLaw law, const BeamProfile& beam, double inner_share);

// What a cone of that law with these angles, kPower aside, makes of the beam.
[[nodiscard]] EngineCone JudgeCone(EngineConeLaw law, const SpotCone& cone,
                                   const BeamProfile& beam);

// "off the axis within 6.6 % of the axial intensity (at 22 degrees)"; "" where that is below 0.1 %.
[[nodiscard]] std::string ErrorOffAxis(double worst, Radians at, std::string_view of = "axial");
// "off the axis within 6.6 % of the axial intensity (at 22 degrees), flux 1.6 % low"; "" where both
// are below 0.1 %.
[[nodiscard]] std::string ConeErrorText(const EngineCone& cone);

}  // namespace lightcal
