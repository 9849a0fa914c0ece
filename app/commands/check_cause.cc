// SPDX-License-Identifier: Apache-2.0
#include "check_cause.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
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
  if (!strays) return again;
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
  return again + "; that leaves " + PercentText(*left) + ": " + lacks + instead;
}

}  // namespace lightcal::app
