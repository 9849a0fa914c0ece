// SPDX-License-Identifier: Apache-2.0
// Fitted lights for the tests of light.json.
#pragma once

#include <string>
#include <utility>

#include "lightcal/records/fitted_light.h"

namespace lightcal::test {

// Every field of every record filled, with numbers that have no short decimal form.
inline LightFile FullLightFile() {
  FittedLight light;
  light.name = "Führung \"1\"";
  light.kind = LightKind::kSpot;
  light.intensity_cd = {1.0 / 3.0, 0.1 + 0.2, 0.1, 0.7};
  light.flux_lm = {1e300, 1e-300, std::nullopt, std::nullopt};
  light.illuminance_lx = {2.0 / 3.0, 0.1, std::nullopt, std::nullopt};
  light.luminance_nits = {12345.678901234567, 5e-324, std::nullopt, std::nullopt};
  light.distance_offset_m = {-0.067, 0.035, std::nullopt, std::nullopt};
  light.ambient_lx = {0.0, 0.5, 0.0, 0.5};
  light.inner_deg = 20.1;
  light.outer_deg = 35.7;
  light.inner_u95_deg = 1.1;
  light.outer_u95_deg = 0.7;
  light.aim_u95_deg = 0.3;
  light.diameter_m = 0.06;
  light.width_m = 0.3;
  light.height_m = 0.2;
  light.length_m = 1.2;
  light.radius_m = 0.013;
  light.angular_diameter_deg = 0.53;
  light.position_m = Vec3{0.1, -0.2, 1.2};
  light.position_u95_m = Vec3{0.01, 1.0 / 7.0, 0.03};
  light.aim = Vec3{0.0, 0.6, -0.8};
  light.axis = Vec3{1.0, 0.0, 0.0};
  IntensityGrid grid{GoniometerType::kC, {0.0}, {0.0, 30.0, 60.1}, {1.0 / 7.0, 900.5, 0.0}};
  light.distribution = MeasuredDistribution{IntensityTable::Make(std::move(grid), "sample").value(),
                                            0.013,
                                            {{"camera", 0.01, 1e-9}},
                                            {0.0, 1.0 / 7.0, 0.02}};
  light.color.cct_K = Uncertain{2900.4, 31.5, 2869.0, 2932.0};
  light.color.duv = Uncertain{-0.0012, 0.0004, -0.0016, -0.0008};
  light.color.xy = Xy{0.4476, 0.4074};
  light.color.meter = ColorMeter{"c7000", 0.0015};
  light.fit = {7, 5, {1, 6}, 0.012, 0.9, 2, 0.02, 314.5, {"intensity"}, {"ambient", "offset"}};
  light.effects = {
      {"cosine", EffectState::kOn, 0.03, 0.011, 2.5, "the meter was tilted"},
      {"bounce", EffectState::kOff, 0.004, std::nullopt, 1700.0, "below the tolerance"},
      {"source_size", EffectState::kFitted, 0.2, -0.1, 108.0, "near readings", "light.size_m"}};
  light.environment = EnvironmentFile{"dome.hdr", "latlong", 12.5};
  light.beam = MeasuredBeam{Uncertain{900.5, 40.0, 862.0, 941.0},
                            Uncertain{25.0, 2.0, 23.1, 27.0},
                            Uncertain{44.0, 3.0, 41.2, 47.1},
                            {{"cos_power", 0.7, 0.9}},
                            0.25};
  light.in_room = {{0.7, 6.8, -0.01, 0.1, -2.1, -1.0, -0.27, 0.07, 0.12, 0.09, {0.1}}};
  light.located = LocatedLamp{
      6.8,  {1.0, 2.0, 2.2}, 0.1, {{-2.1, -1.0, -0.27, 0.07}}, {0.0, 0.1, 0.2}, {0.0, 0.0, -0.7},
      {0.1}};
  light.uneven = UnevenLight{{0.09, 0.08, 0.22}, {0.0, 0.1, -0.9}};
  light.meter = MeterShare{"c800", 0.031};
  light.state = {{"dimmer", 100.0}, {"cct_K", 4000.0}, {"modifier", 0.0, "softbox"}};
  MeasuredState full{light.state, Uncertain{1.0, 0.0, 1.0, 1.0}, 0.01};
  full.intensity_cd = light.intensity_cd;
  full.color = light.color;
  full.readings = 3;
  MeasuredState dim{{{"dimmer", 12.5}, {"cct_K", 4000.0}, {"modifier", 0.0, "softbox"}},
                    Uncertain{1.0 / 7.0, 0.01, 0.13, 0.15},
                    0.02};
  dim.illuminance_lx = Uncertain{12.3, 0.4, 11.9, 12.7};
  dim.readings = 1;
  full.spectrum =
      Spectrum{{400.0, 500.5, 601.0}, {0.1, 1.0 / 3.0, -0.002}, SpectralQuantity::kIrradiance};
  full.emitter_amounts = {0.25, 1.0 / 7.0};
  dim.emitter_amounts = {0.125, 0.0};
  light.states = {full, dim};
  light.spectrum = Spectrum{{400.0, 500.0}, {0.1, 0.9}, SpectralQuantity::kRelative};
  light.emitters = FixtureEmitters{{400.0, 500.0, 600.0},
                                   {{{0.0, 1.0 / 3.0, 1.0}, Xy{0.52, 0.41}, full.state, 0.97},
                                    {{1.0, 0.25, 0.0}, std::nullopt, dim.state, 0.61}},
                                   2,
                                   0.0031};
  StateGeometry bare_front;
  bare_front.state = {{"dimmer", 100.0}, {"cct_K", 4000.0}, {"modifier", 0.0, "bare"}};
  bare_front.kind = LightKind::kRect;
  bare_front.distance_offset_m = Uncertain{0.07, 0.02, {}, {}};
  bare_front.flux_lm = Uncertain{806.0, 1.0 / 3.0, {}, {}};
  bare_front.luminance_nits = Uncertain{1234.5, 0.1, {}, {}};
  bare_front.inner_deg = 6.1;
  bare_front.outer_deg = 8.3;
  bare_front.inner_u95_deg = 0.9;
  bare_front.outer_u95_deg = 0.4;
  bare_front.diameter_m = 0.07;
  bare_front.width_m = 0.9;
  bare_front.height_m = 0.6;
  bare_front.length_m = 1.3;
  bare_front.radius_m = 0.011;
  bare_front.distribution = light.distribution;
  bare_front.beam = light.beam;
  light.geometries = {bare_front};
  light.of_file = Uncertain{0.78, 0.04, {}, {}};
  light.residuals = {{0, 0.5, 192.0, 191.1, 0.0047, 0.05, true, 8.25, 230.5},
                     {1, std::nullopt, 60.0, 52.0, 0.15, 0.05, false}};
  light.covariance_lnI_d0_E0 = {0.1, 0.2, 0.3, 0.2, 0.5, 0.6, 0.3, 0.6, 1.0 / 7.0};
  light.budget = {{"readings", 1.0 / 30.0, 0.9, "four times as many readings"}};
  FittedLight bare;
  bare.name = "bare";
  LightFile file;
  file.lights = {light, bare};
  file.provenance = {"lightcal 0.1.0",
                     {{"session.toml", std::string(64, 'a')}},
                     "2026-01-02T03:04:05Z",
                     {"sekonic:JN1-01"}};
  return file;
}

}  // namespace lightcal::test
