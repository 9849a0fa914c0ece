// SPDX-License-Identifier: Apache-2.0
// What bright things in a view do to whoever looks at it. Symbols: L_s luminance [cd/m^2], w_s
// solid angle [sr] and P_s position index of each source, L_b luminance of the background, E_v
// illuminance of a plane at the eye that faces the view, E_d the sources' part of it [lx].
#pragma once

#include <optional>
#include <span>

#include "lightcal/core/units.h"
#include "lightcal/core/vec3.h"

namespace lightcal {

// How much brighter than one on the line of sight a source may be for the same discomfort.
//   above it:  P = exp((35.2 - .31889 t - 1.22 exp(-2 t/9)) s/10^3
//                      + (21 + .26667 t - .002963 t^2) s^2/10^5)
//   below it:  P = 1 + .8 R (R < .6), 1 + 1.2 R (.6 <= R), R <= 3, R = tan s
// s is the angle from the line of sight, t that from the vertical around it [degrees]; P <= 16.
// `direction`: unit, in the viewer's frame: +X right, +Y ahead, +Z up. Holds ahead of the eye.
// Source: Guth (1963) as IESNA Lighting Handbook, 9th ed., eq. 9-20; below the line of sight Iwata
// and Tokura, Lighting Res. Technol. 29 (1997).
[[nodiscard]] double PositionIndex(const Vec3& direction);

struct GlareSource {
  Nits luminance;
  Steradians solid_angle{0};
  double position_index = 1.0;
};

struct GlareLight {
  Lux vertical;                           // E_v
  Lux direct;                             // E_d
  [[nodiscard]] Nits background() const;  // L_b = (E_v - E_d)/pi, not below 0
};

// Daylight glare probability, 0 to 1.
//   DGP = 5.87e-5 E_v + .0918 log10(1 + sum L_s^2 w_s / (E_v^1.87 P_s^2)) + .16
// Where `dim` and E_v < 1000 lx, times x/(1 + x), x = exp(.024 E_v - 4). Made for .2 to .8 and
// 380 lx and more. 0 where E_v is not above 0.
// Source: Wienold and Christoffersen, Energy and Buildings 38 (2006), eq. 8; the dim end Wienold,
// Dynamic daylight glare evaluation, Building Simulation 2009.
[[nodiscard]] double DaylightGlareProbability(const GlareLight& light,
                                              std::span<const GlareSource> sources, bool dim);

// The three below are absent without a source, and where the background or E_v is not above 0.

// Unified glare rating: UGR = 8 log10(.25/L_b sum L_s^2 w_s/P_s^2).   Source: CIE 117:1995; made
// for sources of .0003 to .1 sr (CIE 190:2010).
[[nodiscard]] std::optional<double> UnifiedGlareRating(const GlareLight& light,
                                                       std::span<const GlareSource> sources);
// Daylight glare index: DGI = 10 log10(.478 sum L_s^1.6 (w_s/P_s^2)^.8/(L_b + .07 w_s^.5 L_s)).
// Source: Hopkinson, Applied Ergonomics 3 (1972).
[[nodiscard]] std::optional<double> DaylightGlareIndex(const GlareLight& light,
                                                       std::span<const GlareSource> sources);
// CIE glare index: CGI = 8 log10(2 (1 + E_d/500)/E_v sum L_s^2 w_s/P_s^2).
// Source: Einhorn, Lighting Res. Technol. 11 (1979); CIE 55:1983.
[[nodiscard]] std::optional<double> CieGlareIndex(const GlareLight& light,
                                                  std::span<const GlareSource> sources);

}  // namespace lightcal
