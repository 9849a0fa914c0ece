// SPDX-License-Identifier: Apache-2.0
#include "check_cause.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "lightcal/calibrate/wall_part.h"
#include "lightcal/core/joined.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/presets/check/fresh_preset.h"

namespace lightcal::app {
namespace {

// To the digits that files hold.
bool AreAlike(const std::vector<ComparedReading>& a, const std::vector<ComparedReading>& b) {
  constexpr double kDigits = 1e-3;
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double one = a[i].predicted_lx, other = b[i].predicted_lx;
    if (std::abs(one - other) > kDigits * std::max(std::abs(one), std::abs(other))) return false;
  }
  return true;
}

// Engines whose file, written now, gives the readings back.
std::vector<std::string_view> OthersThatHold(const CalibratedSession& calibrated,
                                             const PresetTarget& but, double max_error) {
  std::vector<std::string_view> titles;
  for (const PresetTarget* target : ReportTargets()) {
    if (target->name == but.name) continue;
    const auto fresh = FreshPresetOf(*target, calibrated.lights);
    if (!fresh) continue;
    const auto rms = WorstRms(ComparedWith(calibrated, fresh->lights));
    if (rms && *rms <= max_error) titles.push_back(target->title);
  }
  return titles;
}

// Of the lamps that stray.
std::string Substitutes(Warnings substituted, const std::vector<ComparedReading>& rows,
                        double max_error) {
  std::erase_if(substituted, [&](const Warning& w) {
    return std::ranges::none_of(rows, [&](const ComparedReading& row) {
      return row.light == w.subject && std::abs(row.Judged().value_or(0.0)) > max_error;
    });
  });
  return Joined(substituted, "; ", [](const Warning& w) { return w.subject + " is " + w.message; });
}

struct AskedForm {
  std::string_view word;  // as export takes it
  std::string held;       // what it makes of the lamps that stray
};

// The form of its spots that somebody asked for, where the file is what export makes of it.
std::optional<AskedForm> FormOf(const std::vector<ComparedReading>& rows,
                                const PresetTarget& target, const CalibratedSession& calibrated,
                                double max_error) {
  for (const auto& [word, form] : {std::pair("cone", SpotForm::kCone), {"ies", SpotForm::kIes}}) {
    const auto fresh = FreshPresetOf(target, calibrated.lights, form);
    if (!fresh || !AreAlike(rows, ComparedWith(calibrated, fresh->lights))) continue;
    return AskedForm{word, Substitutes(fresh->substituted, rows, max_error)};
  }
  return std::nullopt;
}

// ---- mistakes by their number ----

// Of what a lamp should give, at each of its readings alike; 0 where it is not.
struct LampFactor {
  std::string light;
  double factor = 0.0;
};

// Of the lamps that stray.
std::vector<LampFactor> FactorsOf(const std::vector<ComparedReading>& rows, double max_error) {
  std::vector<LampFactor> factors;
  for (const LampRms& lamp : RmsByLamp(rows)) {
    if (lamp.rms <= max_error) continue;
    std::vector<double> given;
    for (const ComparedReading& row : rows) {
      if (!row.used || row.light != lamp.light || !(row.measured_lx > row.unsure_lx)) continue;
      given.push_back(row.predicted_lx / row.measured_lx);
    }
    const double sum = std::accumulate(given.begin(), given.end(), 0.0);
    const double factor = given.empty() ? 0.0 : sum / static_cast<double>(given.size());
    const bool alike = factor > 0.0 && std::ranges::all_of(given, [&](double one) {
                         return std::abs(one / factor - 1.0) <= max_error;
                       });
    factors.push_back({lamp.light, alike ? factor : 0.0});
  }
  return factors;
}

struct UnitMistake {
  double factor;
  std::string_view text;
};
constexpr double kPi = std::numbers::pi;
constexpr std::array kUnitMistakes = {
    UnitMistake{4.0 * kPi, "4 pi: lumens where candela belong"},
    UnitMistake{1.0 / (4.0 * kPi), "1/(4 pi): candela where lumens belong"},
    UnitMistake{kPi, "pi: lumens of a cone or a flat source where candela belong"},
    UnitMistake{1.0 / kPi, "1/pi: candela where lumens of a cone or a flat source belong"},
    UnitMistake{683.0, "683 lm/W: lumens where watts belong"},
    UnitMistake{1.0 / 683.0, "1/683: watts where lumens belong"},
    UnitMistake{683.0 / (4.0 * kPi), "683/(4 pi): candela where watts belong"},
    UnitMistake{4.0 * kPi / 683.0, "4 pi/683: watts where candela belong"},
    UnitMistake{1000.0, "1000: as if its figures counted thousands"},
    UnitMistake{0.001, "1/1000: kilolux or kilocandela where lux or candela belong"},
    UnitMistake{100.0, "100: centimetres where metres belong"},
    UnitMistake{0.01, "1/100: metres where centimetres belong"},
    UnitMistake{10000.0, "10000: square centimetres where square metres belong"},
    UnitMistake{0.0001, "1/10000: square metres where square centimetres belong"}};

bool Near(double a, double b) { return std::abs(a / b - 1.0) < 0.01; }

// "" where the factor is none that has a name.
std::string UnitMistakeOf(double factor) {
  const auto known = std::ranges::find_if(
      kUnitMistakes, [&](const UnitMistake& one) { return Near(factor, one.factor); });
  return known == kUnitMistakes.end() ? std::string() : std::string(known->text);
}

double StrengthOf(const LightFile& lights, const std::string& name) {
  const auto it = std::ranges::find(lights.lights, name, &FittedLight::name);
  return it != lights.lights.end() && it->intensity_cd ? it->intensity_cd->value : 0.0;
}

// "fill and bulb have each other's figures. ": each is as bright as the other should be.
std::string Swapped(const LightFile& lights, const std::vector<LampFactor>& factors) {
  std::string text;
  for (std::size_t i = 0; i < factors.size(); ++i) {
    for (std::size_t j = i + 1; j < factors.size(); ++j) {
      const double one = StrengthOf(lights, factors[i].light);
      const double other = StrengthOf(lights, factors[j].light);
      if (!(one > 0.0) || !(other > 0.0)) continue;
      if (Near(factors[i].factor, other / one) && Near(factors[j].factor, one / other)) {
        text += factors[i].light + " and " + factors[j].light + " have each other's light. ";
      }
    }
  }
  return text;
}

// "" where no number of them has a name.
std::string NamedMistake(const LightFile& lights, const std::vector<ComparedReading>& rows,
                         double max_error) {
  const std::vector<LampFactor> factors = FactorsOf(rows, max_error);
  if (std::string swapped = Swapped(lights, factors); !swapped.empty()) return swapped;
  if (factors.empty() || !(factors.front().factor > 0.0)) return {};
  const double shared = factors.front().factor;
  if (!std::ranges::all_of(factors, [&](const LampFactor& f) { return Near(f.factor, shared); })) {
    return {};
  }
  const std::string named = UnitMistakeOf(shared);
  if (named.empty() && factors.size() < 2) return {};
  return Joined(factors, ", ", &LampFactor::light) + (factors.size() > 1 ? " alike" : "") + " by " +
         RoundedText(shared, 4) + (named.empty() ? "" : ", which is " + named) + ". ";
}

}  // namespace

std::vector<ComparedReading> ComparedWith(const CalibratedSession& calibrated,
                                          const std::vector<EngineLight>& lights) {
  return CompareWithReadings(calibrated.session, calibrated.lights, lights,
                             [&](const FittedLight& lamp, const ResidualRow& row) {
                               return WallPartOf(calibrated.session, lamp, row);
                             });
}

std::string CauseOfStraying(std::string_view preset, const CalibratedSession& calibrated,
                            const std::vector<ComparedReading>& rows, double max_error) {
  const std::string again = "Export it again, or undo what was edited in it";
  const PresetTarget* target = TargetOfFile(preset);
  const auto fresh = target != nullptr ? FreshPresetOf(*target, calibrated.lights) : std::nullopt;
  if (!fresh) return again;
  auto fresh_rows = ComparedWith(calibrated, fresh->lights);
  std::erase_if(fresh_rows, [&](const ComparedReading& row) {  // of lamps that this file is not of
    return std::ranges::find(rows, row.light, &ComparedReading::light) == rows.end();
  });
  const std::optional<double> left = WorstRms(fresh_rows);
  if (!left) return again;
  const bool strays = *left > max_error;
  if (!AreAlike(rows, fresh_rows)) {
    if (const auto form = FormOf(rows, *target, calibrated, max_error)) {
      return "The file is as exported with --spots " + std::string(form->word) +
             ", nothing in it was edited" + (form->held.empty() ? "" : ": " + form->held) +
             ". Exported without it, it is " + PercentText(*left) + " off";
    }
  }
  if (!strays) return NamedMistake(calibrated.lights, rows, max_error) + again;
  const std::string title(target->title.empty() ? target->ending : target->title);
  const std::string held = Substitutes(fresh->substituted, fresh_rows, max_error);
  const std::string lacks =
      held.empty() ? "that is what " + title + " makes of these lamps" : "in " + title + " " + held;
  const auto others = OthersThatHold(calibrated, *target, max_error);
  const std::string instead =
      others.empty() ? "" : ". " + Joined(others) + " hold them within " + PercentText(max_error);
  if (AreAlike(rows, fresh_rows)) {
    return "The file is as exported, nothing in it was edited: " + lacks + instead;
  }
  return NamedMistake(calibrated.lights, rows, max_error) + again + "; that leaves " +
         PercentText(*left) + ": " + lacks + instead;
}

}  // namespace lightcal::app
