// SPDX-License-Identifier: Apache-2.0
#include "match/state_match_words.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "console.h"
#include "lamp_state.h"
#include "lamp_words.h"
#include "lightcal/colorimetry/cct.h"
#include "lightcal/core/joined.h"
#include "lightcal/core/numbers_text.h"

namespace lightcal::app {
namespace {

std::string WithRange(const std::string& value, const std::string& range) {
  return range.empty() ? value : value + " (" + range + ")";
}

std::string ValueOf(const std::optional<Uncertain>& value, const std::string& unit) {
  if (!value) return kNone;
  return WithRange(ValueText(*value) + unit, value->low && value->high ? RangeText(*value) : "");
}

// To a multiple of a power of ten.
std::string ToStep(double value, double step) {
  const double rounded = std::round(value / step) * step + 0.0;
  if (rounded == 0.0 || step >= 1.0) return ShortestText(std::round(rounded));
  const double digits = std::floor(std::log10(std::abs(rounded)) + 1e-9) - std::log10(step) + 1.0;
  return RoundedText(rounded, static_cast<int>(std::round(digits)));
}

// To the farther end of its interval.
double HalfWidth(const Uncertain& value) {
  if (!value.low || !value.high) return value.u95;
  return std::max(*value.high - value.value, value.value - *value.low);
}

// Of a difference, to what its interval leaves: "-12 ± 44 K".
std::string DifferenceOf(const Uncertain& value, const std::string& unit, double least_step) {
  const double u95 = HalfWidth(value);
  const double step = u95 > 0.0 ? std::pow(10.0, std::floor(std::log10(u95)) - 1.0) : least_step;
  const auto text = [&](double one) { return ToStep(one, std::max(step, least_step)); };
  return text(value.value) + (value.low && value.high ? " ± " + text(u95) : "") + unit;
}

std::string KelvinApart(const std::optional<Uncertain>& kelvin) {
  return kelvin ? DifferenceOf(*kelvin, " K", 1.0) : kNone;
}

// "0.0033 ± 0.0019"
std::string DistanceOf(const Uncertain& uv) { return DifferenceOf(uv, "", 1e-4); }

// Hundredths: "-1.04", "0.05".
std::string StopsOf(double stops) { return ShortestText(std::round(100.0 * stops) / 100.0 + 0.0); }

// "-1.04 ± 0.11"
std::string StopsApart(const Uncertain& stops) {
  return StopsOf(stops.value) + (stops.low && stops.high ? " ± " + StopsOf(HalfWidth(stops)) : "");
}

// "dimmer=37 ± 2.1, cct_K=4000"
std::string SettingText(const LampSetting& setting) {
  return Joined(setting.state, ", ", [&](const ControlValue& control) {
    std::string text = StateText({control});
    if (const auto u95 = NumberOfControl(setting.u95, control.name)) {
      text += " ± " + RoundedText(*u95, 2);
    }
    return text;
  });
}

// Of the labels that have one: "dimmer ± 2.1".
std::string LabelsOf(const LampSetting& setting) {
  return Joined(setting.u95, ", ", [](const ControlValue& control) {
    return control.name + " ± " + RoundedText(control.number, 2);
  });
}

std::string KelvinOf(double kelvin) { return ShortestText(std::round(kelvin)) + " K"; }

std::vector<std::string> RowOfSetting(const StateMatch& match) {
  const LampSetting& setting = match.lamps.front();
  return {StateText(setting.state),
          std::string(BasisWord(setting.basis)),
          DistanceOf(match.delta_uv),
          KelvinApart(match.delta_cct_K),
          match.cct_K ? KelvinOf(match.cct_K->value) : kNone,
          match.duv ? DuvText(match.duv->value) : kNone,
          match.stops_lost ? StopsOf(*match.stops_lost) : kNone,
          match.dimmer_stops ? StopsApart(*match.dimmer_stops) : kNone};
}

bool IsExact(const LightPoint& point) {
  return !point.color_meter && !(point.sd.ln_mired > 0.0) && !(point.sd.duv > 0.0);
}

std::string MeterText(const std::string& name) { return "\"" + name + "\""; }

// Of colour.
std::string WhoseErrors(const StateMatch& match, const LightPoint& target,
                        const std::string& title) {
  if (IsExact(target)) {
    return title + " is exact, and all that the lamp was read wrong by is in them";
  }
  std::vector<std::string> meters;
  for (const LampSetting& one : match.lamps) {
    if (one.point.color_meter) meters.push_back(one.point.color_meter->name);
  }
  const bool all = meters.size() == match.lamps.size() && target.color_meter;
  if (match.color_cancels && all) {
    return "one meter, " + MeterText(target.color_meter->name) +
           ", read both, and its own error is not in them";
  }
  if (match.color_cancels) {
    return "both are one lamp's, and what its readings have in common is not in them";
  }
  if (!all)
    return "no one meter is known to have read both, and the own errors of each are in them";
  return "the target was read by " + MeterText(target.color_meter->name) + ", the lamp by " +
         Joined(meters, " and ", MeterText) + ", and the own errors of each are in them";
}

}  // namespace

std::string StateMatchTable(const StateMatches& answer) {
  std::vector<std::vector<std::string>> rows;
  for (const StateMatch& each : answer.matches) rows.push_back(RowOfSetting(each));
  rows.push_back(RowOfSetting(answer.unfiltered));
  rows.back()[1] = "as it is";
  const std::string table =
      TextTable({"set", "was", "Δu'v'", "ΔCCT", "CCT", "Duv", "stops lost", "stops over"}, rows);
  const std::string labels = LabelsOf(answer.matches.front().lamps.front());
  if (labels.empty()) return table + "\n";
  return table + "\n" + LabelledLine("labels", "the same light may lie within " + labels);
}

std::string StateMixText(const StateMatch& mix, const std::vector<std::string>& names) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < mix.lamps.size(); ++i) {
    const LampSetting& one = mix.lamps[i];
    const std::string unit = one.point.kind == LevelKind::kIntensity ? " cd" : " lx";
    rows.push_back({names[i], SettingText(one), std::string(BasisWord(one.basis)),
                    RoundedText(one.point.level, 3) + unit});
  }
  std::string text = mix.cct_K ? KelvinOf(mix.cct_K->value) : kNone;
  if (mix.duv) text += ", Duv " + DuvText(mix.duv->value);
  text += ", Δu'v' " + DistanceOf(mix.delta_uv) + " from the target";
  if (mix.delta_cct_K) text += ", ΔCCT " + KelvinApart(mix.delta_cct_K);
  if (mix.dimmer_stops) text += ", " + StopsApart(*mix.dimmer_stops) + " stops over it";
  return TextTable({"lamp", "set", "was", "gives"}, rows) + "\n" + LabelledLine("together", text);
}

std::string DifferenceText(const StateMatch& match, const LightPoint& target,
                           const std::string& title) {
  std::string text = WhoseErrors(match, target, title);
  if (match.dimmer_stops && match.level_cancels != match.color_cancels) {
    text += match.level_cancels ? "; of the light one meter's scale cancels"
                                : "; of the light each meter's scale is in them too";
  }
  std::string out = LabelledLine("intervals", "are of the difference: " + text);
  if (!match.cct_K) return out;
  std::string own = ValueOf(match.cct_K, " K");
  if (match.duv) {
    own += ", Duv " + DuvText(match.duv->value) + " ± " + RoundedText(match.duv->u95, 2);
  }
  return out + LabelledLine("by itself", own + ": its meter's own error included");
}

std::string SameCctText(const StateMatch& nearest, const std::optional<StateMatch>& same,
                        const LightPoint& target) {
  if (!same || !same->cct_K || !nearest.cct_K || !nearest.delta_duv) return "";
  const double duv = nearest.delta_duv->value;
  std::string text = Joined(same->lamps, " with ", SettingText) + ": " +
                     KelvinOf(same->cct_K->value) + ", Δu'v' " +
                     RoundedText(same->delta_uv.value, 2);
  if (same->dimmer_stops) text += ", " + StopsOf(same->dimmer_stops->value) + " stops over it";
  const CctResult wanted = CctFromXy(target.xy);
  return LabelledLine(
      "at its CCT",
      text + ". Nearest in u'v' is " + KelvinOf(nearest.cct_K->value) + ", not the target's " +
          KelvinOf(wanted.temperature.value()) + ": the lamp's Duv is " +
          RoundedText(std::abs(duv), 2) + (duv < 0.0 ? " below" : " above") +
          " the target's, and CCT goes by distance in CIE 1960 uv, where another is nearest");
}

}  // namespace lightcal::app
