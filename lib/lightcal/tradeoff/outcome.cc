// SPDX-License-Identifier: Apache-2.0
#include "lightcal/tradeoff/outcome.h"

#include <algorithm>
#include <cmath>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/uncertain.h"

namespace lightcal::tradeoff {
namespace {

constexpr double kLost = 1.0;      // what a figure that is gone counts as
constexpr double kLeastSd = 1e-9;  // no figure is surer

const Uncertain* StrengthOf(const FittedLight& light) {
  if (light.intensity_cd) return &*light.intensity_cd;
  if (light.illuminance_lx) return &*light.illuminance_lx;
  if (light.luminance_nits) return &*light.luminance_nits;
  return light.flux_lm ? &*light.flux_lm : nullptr;
}

LightFigures FiguresOfLight(const FittedLight& light) {
  LightFigures out;
  out.name = light.name;
  if (const Uncertain* strength = StrengthOf(light); strength != nullptr && strength->value > 0.0) {
    out.ln_strength = std::log(strength->value);
    out.sd_ln = strength->u95 / (kZ95 * strength->value);
  }
  if (light.distribution && light.flux_lm && light.flux_lm->value > 0.0) {
    out.ln_flux = std::log(light.flux_lm->value);
  }
  if (!light.budget.empty()) {
    const BudgetPart& part = light.budget.front();
    out.limit = part.name + " (" + PercentText(part.share) + " of the variance)" +
                (part.halve.empty() ? "" : "; what halves it: " + part.halve);
  }
  if (const auto& cct = light.color.cct_K) {
    out.mired = 1e6 / cct->value;
    out.sd_mired = 1e6 * cct->u95 / (kZ95 * cct->value * cct->value);
  }
  if (const auto& duv = light.color.duv) {
    out.duv = duv->value;
    out.sd_duv = duv->u95 / kZ95;
  }
  return out;
}

void Compare(const LightFigures& reference, const LightFigures* other,
             std::vector<Difference>& out) {
  const auto add = [&](std::string_view quantity, double relative, double sd) {
    out.push_back({reference.name, quantity, relative, std::max(sd, kLeastSd)});
  };
  add(kStrength, other != nullptr ? other->ln_strength - reference.ln_strength : kLost,
      reference.sd_ln);
  add(kInterval, other != nullptr ? kZ95 * (other->sd_ln - reference.sd_ln) : kLost,
      kZ95 * reference.sd_ln);
  if (reference.ln_flux) {
    const bool there = other != nullptr && other->ln_flux.has_value();
    add(kFlux, there ? *other->ln_flux - *reference.ln_flux : kLost, reference.sd_ln);
  }
  if (reference.mired) {
    const bool there = other != nullptr && other->mired.has_value();
    add(kColorTemperature, there ? (*other->mired - *reference.mired) / kMiredPerUnit : kLost,
        reference.sd_mired.value_or(0.0) / kMiredPerUnit);
  }
  if (reference.duv) {
    const bool there = other != nullptr && other->duv.has_value();
    add(kDuv, there ? (*other->duv - *reference.duv) / kDuvPerUnit : kLost,
        reference.sd_duv.value_or(0.0) / kDuvPerUnit);
  }
}

}  // namespace

std::vector<LightFigures> FiguresOf(const LightFile& lights) {
  std::vector<LightFigures> out;
  for (const FittedLight& light : lights.lights) out.push_back(FiguresOfLight(light));
  return out;
}

std::vector<Difference> DifferencesFrom(const std::vector<LightFigures>& reference,
                                        const std::vector<LightFigures>& other) {
  std::vector<Difference> out;
  for (const LightFigures& light : reference) {
    const auto same = std::ranges::find(other, light.name, &LightFigures::name);
    Compare(light, same != other.end() ? &*same : nullptr, out);
  }
  return out;
}

SettingError ErrorOf(const std::vector<Difference>& differences) {
  SettingError error;
  for (const Difference& d : differences) {
    const double size = std::abs(d.relative);
    error.over_u = std::max(error.over_u, size / d.sd);
    if (d.quantity == kInterval || size < error.relative || (size == 0.0 && !error.light.empty()))
      continue;
    error.relative = size;
    error.quantity = d.quantity;
    error.light = d.light;
  }
  return error;
}

}  // namespace lightcal::tradeoff
