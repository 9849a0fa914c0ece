// SPDX-License-Identifier: Apache-2.0
#include "light_table.h"

#include <algorithm>
#include <vector>

#include "console.h"
#include "lamp_words.h"
#include "lightcal/core/joined.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/light/effects/effect_table.h"
#include "lightcal/records/used_readings.h"

namespace lightcal::app {
namespace {

// Parts of less than a thousandth of the variance change nothing.
constexpr double kLeastShareShown = 1e-3;

std::string PercentOrNone(const std::optional<double>& relative) {
  return relative ? RoundedText(*relative * 100.0, 2) + " %" : kNone;
}

std::string Flux(const FittedLight& light) {
  return light.flux_lm ? ValueAndInterval(*light.flux_lm, "lm") : kNone;
}

std::string Cct(const FittedLight& light) {
  const auto& cct = light.color.cct_K;
  return cct ? KelvinText(*cct) : kNone;
}

std::string Duv(const FittedLight& light) {
  const auto& duv = light.color.duv;
  return duv ? ValueWithAbsolute(duv->value, duv->u95, "") : kNone;
}

bool Contains(const std::vector<std::string>& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

std::string Offset(const FittedLight& light) {
  if (!light.distance_offset_m) return kNone;
  std::string text =
      ValueWithAbsolute(light.distance_offset_m->value, light.distance_offset_m->u95, "m");
  if (light.distance_offset_m->value > 0.0) text.insert(0, "+");
  return text + (Contains(light.fit.learned, "distance_offset") ? " learned" : " prior");
}

std::string Join(const std::vector<std::string>& words) {
  return words.empty() ? kNone : Joined(words);
}

std::string Degrees(const Uncertain& angle) {
  return RoundedText(angle.value, 3) + "° ± " + RoundedText(angle.u95, 2) + "°";
}

// "; brightest at 54°, 3.9 times that", where the peak lies beside the axis: angles are of the
// axis.
std::string PeakBesideAxis(const FittedLight& light) {
  constexpr double kBrighter = 1.15;
  if (!light.distribution) return "";
  const IntensityGrid& grid = light.distribution->table.grid();
  if (grid.horizontal_deg.size() != 1 || grid.candela.empty()) return "";
  const auto most = std::ranges::max_element(grid.candela);
  if (!(*most > kBrighter * grid.candela.front())) return "";
  const auto at = static_cast<std::size_t>(most - grid.candela.begin());
  return "; brightest at " + RoundedText(grid.vertical_deg[at], 2) + "°, " +
         RoundedText(*most / grid.candela.front(), 2) + " times that";
}

// "key: beam 30° ± 1.7°, field 55° ± 3.1°, 899 cd ± 10 % on the axis", where readings told it.
std::string BeamLine(const FittedLight& light) {
  if (!light.beam || !light.beam->beam_deg) return "";
  std::string line = light.name + ": beam " + Degrees(*light.beam->beam_deg);
  if (light.beam->field_deg) line += ", field " + Degrees(*light.beam->field_deg);
  if (const auto& axial = light.beam->axial) {
    line += ", " + ValueAndInterval(*axial, "cd") + " on the axis";
  }
  line += PeakBesideAxis(light);
  return line + "\n";
}

}  // namespace

std::string PlaceFound(const FittedLight& light) {
  if (!light.position_m || !light.position_u95_m) return kNone;
  std::string text;
  for (std::size_t k = 0; k < 3; ++k) {
    text += (k == 0 ? "" : ", ") +
            ValueWithAbsolute((*light.position_m)[k], (*light.position_u95_m)[k], "m");
  }
  return text;
}

std::string Headline(const FittedLight& light) {
  if (light.intensity_cd) return ValueAndInterval(*light.intensity_cd, "cd");
  if (light.illuminance_lx) return ValueAndInterval(*light.illuminance_lx, "lx");
  if (light.luminance_nits) return ValueAndInterval(*light.luminance_nits, "cd/m²");
  if (light.flux_lm) return ValueAndInterval(*light.flux_lm, "lm");
  return kNone;
}

std::string LightTable(const LightFile& file) {
  std::vector<std::string> head = {"light", "kind", "intensity (95 %)", "flux",
                                   "CCT",   "Duv",  "distance offset"};
  const bool located = std::ranges::any_of(
      file.lights, [](const FittedLight& light) { return light.position_u95_m.has_value(); });
  if (located) head.emplace_back("position (95 %)");
  std::vector<std::vector<std::string>> rows;
  rows.reserve(file.lights.size());
  for (const FittedLight& light : file.lights) {
    rows.push_back({light.name, std::string(LightKindName(light.kind)), Headline(light),
                    Flux(light), Cct(light), Duv(light), Offset(light)});
    if (located) rows.back().push_back(PlaceFound(light));
  }
  std::string text = TextTable(head, rows);
  for (const FittedLight& light : file.lights) text += BeamLine(light);
  return text;
}

std::string FitTable(const LightFile& file) {
  std::vector<std::vector<std::string>> rows;
  rows.reserve(file.lights.size());
  for (const FittedLight& light : file.lights) {
    const FitDiagnostics& fit = light.fit;
    rows.push_back({light.name, UsedOfReadings(fit), std::to_string(fit.degrees_of_freedom),
                    PercentOrNone(fit.rms_relative), PercentOrNone(fit.leave_one_out),
                    Join(fit.learned), Join(fit.prior)});
  }
  return TextTable({"light", "readings", "dof", "rms", "leave-one-out", "learned", "prior"}, rows);
}

std::string EffectTable(const FittedLight& light) {
  constexpr const char* kStateNames[] = {"off", "on", "fitted"};
  std::vector<std::vector<std::string>> rows;
  rows.reserve(light.effects.size());
  for (const EffectReport& effect : light.effects) {
    rows.push_back({effect.name, kStateNames[static_cast<int>(effect.state)],
                    RoundedText(effect.bound * 100.0, 2) + " %", PercentOrNone(effect.contribution),
                    RoundedText(effect.cost_ns, 3) + " ns", effect.key, effect.reason});
  }
  return TextTable({"effect", "state", "bound", "found", "cost", "stated by", "why"}, rows);
}

std::string BudgetTable(const FittedLight& light) {
  if (light.budget.empty()) return "";
  std::vector<std::vector<std::string>> rows;
  for (const BudgetPart& part : light.budget) {
    if (part.share < kLeastShareShown) continue;
    rows.push_back({part.name, RoundedText(part.sd_relative * 100.0, 2) + " %",
                    RoundedText(part.share * 100.0, 2) + " %", part.halve});
  }
  return TextTable({"uncertainty from", "1 sigma", "share of u²", "what would halve it"}, rows);
}

std::string EffectsOfNoConcern(const FittedLight& light) {
  if (light.effects.empty()) return "";
  std::vector<std::string> names;
  for (const Effect& effect : kEffects) {
    const bool listed = std::ranges::any_of(
        light.effects, [&](const EffectReport& e) { return e.name == effect.name; });
    if (!listed) names.emplace_back(effect.name);
  }
  return names.empty() ? "" : "not of this scene: " + Join(names) + "\n";
}

}  // namespace lightcal::app
