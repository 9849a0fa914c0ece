// SPDX-License-Identifier: Apache-2.0
// Fitted lights made by hand, for tests of the rooms that read them.
#pragma once

#include <string>

#include "lightcal/records/fitted_light.h"

namespace lightcal::test {

// A 1000 cd point at 3 m height, 2700 K, fitted from five readings with the third rejected and an
// offset of 6 cm; the rows are the model's own values moved by known factors.
inline FittedLight WarmPoint() {
  FittedLight light;
  light.name = "key";
  light.kind = LightKind::kPoint;
  light.intensity_cd = Uncertain{1000.0, 40.0, 961.0, 1041.0};
  light.flux_lm = Uncertain{12566.4, 502.7, std::nullopt, std::nullopt};
  light.distance_offset_m = Uncertain{0.06, 0.02, std::nullopt, std::nullopt};
  light.ambient_lx = Uncertain{1.5, 0.8, std::nullopt, std::nullopt};
  light.position_m = Vec3{1.0, 2.0, 3.0};
  light.color.cct_K = Uncertain{2700.0, 35.0, std::nullopt, std::nullopt};
  light.color.duv = Uncertain{0.001, 0.0008, std::nullopt, std::nullopt};
  light.fit.readings = 5;
  light.fit.used = 4;
  light.fit.rejected = {2};
  light.fit.rms_relative = 0.012;
  light.fit.chi2_dof = 0.9;
  light.fit.degrees_of_freedom = 2;
  light.fit.leave_one_out = 0.018;
  light.fit.condition = 12.0;
  light.fit.learned = {"intensity", "distance_offset"};
  light.fit.prior = {"ambient"};
  light.effects = {{"distance_offset", EffectState::kFitted, 0.3, 0.12, 1.0, "E d^2 varies",
                    "light.fixture"},
                   {"room_bounce", EffectState::kOff, 0.002, std::nullopt, 9.0, "below 1 %"}};
  const double distances[] = {0.5, 1.0, 1.5, 2.0, 3.0};
  const double relative[] = {0.01, -0.015, 0.35, 0.012, -0.006};
  for (int i = 0; i < 5; ++i) {
    ResidualRow row;
    row.index = i;
    row.distance_m = distances[i];
    row.predicted_lx = 1000.0 / ((distances[i] + 0.06) * (distances[i] + 0.06)) + 1.5;
    row.measured_lx = row.predicted_lx * (1.0 + relative[i]);
    row.relative = relative[i];
    row.sigma_relative = 0.02;
    row.used = i != 2;
    light.residuals.push_back(row);
  }
  light.covariance_lnI_d0_E0 = {4e-4, 1e-4, 0.0, 1e-4, 1e-4, 0.0, 0.0, 0.0, 0.16};
  return light;
}

inline FittedLight SimpleLight(const std::string& name, LightKind kind, double intensity_cd) {
  FittedLight light;
  light.name = name;
  light.kind = kind;
  light.intensity_cd = Uncertain{intensity_cd, intensity_cd * 0.1, std::nullopt, std::nullopt};
  light.color.cct_K = Uncertain{4000.0, 60.0, std::nullopt, std::nullopt};
  light.fit.readings = 1;
  light.fit.used = 1;
  light.fit.prior = {"distance_offset"};
  return light;
}

inline FittedLight Spot() {
  FittedLight light = SimpleLight("spot", LightKind::kSpot, 5000.0);
  light.inner_deg = 15.0;
  light.outer_deg = 25.0;
  light.position_m = Vec3{0.0, 0.0, 2.0};
  light.aim = Vec3{1.0, 0.0, 0.0};
  return light;
}

inline FittedLight Sun() {
  FittedLight light;
  light.name = "sun";
  light.kind = LightKind::kDirectional;
  light.illuminance_lx = Uncertain{98000.0, 3000.0, std::nullopt, std::nullopt};
  light.aim = Vec3{0.0, 0.6, -0.8};
  light.color.xy = Xy{0.3324, 0.3474};
  light.color.cct_K = Uncertain{5488.0, 40.0, std::nullopt, std::nullopt};
  light.fit.readings = 1;
  light.fit.used = 1;
  return light;
}

inline LightFile FileOf(std::vector<FittedLight> lights) {
  LightFile file;
  file.lights = std::move(lights);
  file.provenance.generator = "lightcal 0.1.0";
  file.provenance.time = "2026-05-01T10:00:00Z";
  file.provenance.inputs = {{"session.toml", std::string(64, 'a')},
                            {"readings.jsonl", std::string(64, 'b')}};
  return file;
}

}  // namespace lightcal::test
