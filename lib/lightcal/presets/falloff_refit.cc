// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/falloff_refit.h"

#include <algorithm>
#include <cmath>

#include "lightcal/core/numbers_text.h"

namespace lightcal {
namespace {

constexpr double kPermittedLoss = 0.005;
constexpr double kPermittedResidual = 0.005;

Metres NearestGoodRange(const EngineFalloff& falloff, double farthest_m) {
  return RangeForLoss(Metres(farthest_m), kPermittedLoss, falloff.window);
}

bool AtInfinity(const PresetLight& light) {
  return light.form == LightForm::kDirectional || light.form == LightForm::kDome;
}
bool AtInfinity(const PunctualLight& light) { return light.type == PunctualType::kDirectional; }

double RelativeU95(const PresetLight& light) { return light.relative_u95.value_or(0.0); }
double RelativeU95(const PunctualLight& light) {
  return light.photometric_u95.value_or(0.0) / light.photometric;
}

const std::string& NameOf(const PresetLight& light) { return light.name(); }
const std::string& NameOf(const PunctualLight& light) { return light.name; }

template <class Light>
void WarnOfResidual(const Light& light, const FalloffRefit& refit, Metres needed,
                    Warnings& warnings) {
  if (refit.residual <= std::max(kPermittedResidual, RelativeU95(light))) return;
  warnings.push_back({"falloff_residual", NameOf(light),
                      "with a range of " + RoundedText(refit.range.value(), 3) +
                          " m the engine's falloff misses readings by up to " +
                          RoundedText(100.0 * refit.residual, 2) + " %; {preset.range} " +
                          RoundedText(needed.value(), 3) + "m or more would not"});
}

template <class Light>
std::vector<FalloffRefit> RefitEach(const LightFile& file, std::span<const Light> lights,
                                    const RefitRequest& request, Warnings& warnings) {
  std::vector<FalloffRefit> refits;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (AtInfinity(lights[i])) {
      refits.emplace_back();
      continue;
    }
    const std::vector<double> distances = ReadingDistances_m(file.lights[i]);
    refits.push_back(RefitFalloff(request, distances));
    WarnOfResidual(lights[i], refits.back(),
                   NearestGoodRange(request.falloff, std::ranges::max(distances)), warnings);
  }
  return refits;
}

}  // namespace

FalloffRefit RefitFalloff(const RefitRequest& request, std::span<const double> distances_m) {
  constexpr double kOneMetre[] = {1.0};
  if (distances_m.empty()) distances_m = kOneMetre;
  const double farthest = std::ranges::max(distances_m);
  FalloffRefit refit;
  refit.range = request.fixed
                    ? *request.fixed
                    : Metres(std::max(request.far_range.value(),
                                      NearestGoodRange(request.falloff, farthest).value()));
  double least = 1e300;
  double most = 0.0;
  for (const double d : distances_m) {
    const double g = request.falloff.per_candela(Metres(d), refit.range) * d * d;
    least = std::min(least, g);
    most = std::max(most, g);
  }
  if (!(least > 0.0)) {
    refit.residual = 1.0;
    if (most > 0.0) refit.intensity_factor = 1.0 / most;
    return refit;
  }
  constexpr double kBelowAFloat = 1e-8;
  const double factor = 1.0 / std::sqrt(least * most);
  if (std::abs(factor - 1.0) > kBelowAFloat) refit.intensity_factor = factor;
  refit.residual = std::sqrt(most / least) - 1.0;
  return refit;
}

std::vector<double> ReadingDistances_m(const FittedLight& lamp) {
  const double offset = EffectiveOffset_m(lamp);
  std::vector<double> distances;
  for (const ResidualRow& row : lamp.residuals) {
    if (!row.used || !row.distance_m) continue;
    if (const double d = *row.distance_m + offset; d > 0.0) distances.push_back(d);
  }
  if (distances.empty()) distances.push_back(1.0);
  return distances;
}

std::vector<FalloffRefit> RefitLights(const LightFile& file, std::span<const PresetLight> lights,
                                      const RefitRequest& request, Warnings& warnings) {
  return RefitEach(file, lights, request, warnings);
}

std::vector<FalloffRefit> RefitLights(const LightFile& file, std::span<const PunctualLight> lights,
                                      const RefitRequest& request, Warnings& warnings) {
  return RefitEach(file, lights, request, warnings);
}

void NoteRefit(const FalloffRefit& refit, DerivedLight& light) {
  if (!(refit.range.value() > 0.0)) return;
  light.notes.push_back({"falloff_intensity_factor", {refit.intensity_factor}});
  light.notes.push_back({"falloff_residual", {refit.residual}});
}

}  // namespace lightcal
