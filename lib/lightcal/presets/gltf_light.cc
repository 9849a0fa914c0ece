// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/gltf_light.h"

#include <cmath>
#include <utility>

namespace lightcal {

Quaternion RotationFromMinusZ(const Vec3& forward) {
  // q = (a x f, 1 + a.f), normalised, for a = (0, 0, -1).
  const double w = 1.0 - forward[2];
  const double x = forward[1];
  const double y = 0.0 - forward[0];
  const double length = std::hypot(x, y, w);
  if (length < 1e-12) return {0.0, 1.0, 0.0, 0.0};
  return {x / length, y / length, 0.0, w / length};
}

Quaternion RotationFromAxes(const Vec3& x, const Vec3& y, const Vec3& z) {
  // Shepperd's method: the largest of the four components first, so that no division is by zero.
  const double trace = x[0] + y[1] + z[2];
  Quaternion q{};
  if (trace > 0.0) {
    q = {y[2] - z[1], z[0] - x[2], x[1] - y[0], 1.0 + trace};
  } else if (x[0] >= y[1] && x[0] >= z[2]) {
    q = {1.0 + x[0] - y[1] - z[2], x[1] + y[0], x[2] + z[0], y[2] - z[1]};
  } else if (y[1] >= z[2]) {
    q = {x[1] + y[0], 1.0 - x[0] + y[1] - z[2], y[2] + z[1], z[0] - x[2]};
  } else {
    q = {x[2] + z[0], y[2] + z[1], 1.0 - x[0] - y[1] + z[2], x[1] - y[0]};
  }
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (double& component : q) component /= length;
  return q;
}

std::vector<FalloffRefit> RefitInGltf(const LightFile& file, std::span<const PunctualLight> lights,
                                      const PresetOptions& options, Warnings& warnings) {
  return RefitLights(file, lights,
                     {.falloff = {&GltfFalloff, WindowPower::kPlain},
                      .far_range = Metres(kGltfRange_m),
                      .fixed = options.range},
                     warnings);
}

GltfLight GltfLightFrom(const PunctualLight& light, const FalloffRefit& refit) {
  GltfLight gltf;
  gltf.intensity = light.intensity * refit.intensity_factor;
  if (light.intensity_u95) gltf.intensity_u95 = *light.intensity_u95 * refit.intensity_factor;
  const Rgb& c = light.color.max_normalised;
  gltf.color = {c.r, c.g, c.b};
  gltf.translation = GltfFromZUp(light.position_m);
  gltf.rotation = RotationFromMinusZ(GltfFromZUp(light.aim));
  if (light.type == PunctualType::kDirectional) {
    gltf.type = "directional";
    return gltf;
  }
  gltf.range_m = refit.range.value();
  gltf.type = light.type == PunctualType::kSpot ? "spot" : "point";
  if (light.type == PunctualType::kSpot) {
    gltf.inner_cone_rad = light.cone.inner.value();
    gltf.outer_cone_rad = light.cone.outer.value();
  }
  return gltf;
}

DerivedLight DerivedGltf(const PunctualLight& light, const FalloffRefit& refit) {
  const GltfLight gltf = GltfLightFrom(light, refit);
  DerivedLight derived;
  derived.type = std::string(gltf.type);
  const auto put = [&](const char* name, const std::optional<double>& value) {
    if (value) derived.Put(name, *value);
  };
  const auto put_all = [&](const char* name, const auto& values) {
    std::vector<double> plain;
    for (const double v : values) plain.push_back(v == 0.0 ? 0.0 : v);  // -0 is written 0
    derived.Put(name, std::move(plain));
  };
  put("intensity", gltf.intensity);
  put("intensity_u95", gltf.intensity_u95);
  put_all("color", gltf.color);
  put("range", gltf.range_m);
  put("innerConeAngle", gltf.inner_cone_rad);
  put("outerConeAngle", gltf.outer_cone_rad);
  put_all("translation", gltf.translation);
  put_all("rotation", gltf.rotation);
  if (light.type != PunctualType::kDirectional) {
    derived.notes.push_back({"falloff_residual", {refit.residual}});
  }
  derived.substitution = light.substitution;
  return derived;
}

}  // namespace lightcal
