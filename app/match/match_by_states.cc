// SPDX-License-Identifier: Apache-2.0
#include "match/match_by_states.h"

#include <cmath>
#include <vector>

#include "calibration_options.h"
#include "lamp_state.h"
#include "lamp_words.h"
#include "lightcal/calibrate/states/match_states.h"
#include "lightcal/colorimetry/cct.h"
#include "lightcal/core/joined.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/match/match_lights.h"
#include "lightcal/records/light_codec.h"
#include "match/match_answer.h"
#include "output_files.h"
#include "typed_reading.h"

namespace lightcal::app {
namespace {

// What a measured spectrum's colour repeats and agrees within, 1 sigma.
constexpr double kSpectrumLnMired = 0.006, kSpectrumDuv = 0.0008;

std::string ValueOf(const std::optional<Uncertain>& value, const std::string& unit) {
  if (!value) return kNone;
  if (value->low && value->high) return ValueText(*value) + unit + " (" + RangeText(*value) + ")";
  return ValueText(*value) + unit;
}

// Hundredths: "-1.04", "0.05".
std::string StopsOf(double stops) { return ShortestText(std::round(100.0 * stops) / 100.0 + 0.0); }

// "-1.04 (-1.15 … -0.93)"
std::string StopsRange(const Uncertain& stops) {
  if (!stops.low || !stops.high) return StopsOf(stops.value);
  return StopsOf(stops.value) + " (" + StopsOf(*stops.low) + " … " + StopsOf(*stops.high) + ")";
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

std::vector<std::string> RowOfSetting(const StateMatch& match) {
  const LampSetting& setting = match.lamps.front();
  return {SettingText(setting),
          std::string(BasisWord(setting.basis)),
          RoundedText(match.delta_uv.value, 2),
          ValueOf(match.cct_K, " K"),
          match.duv ? DuvText(match.duv->value) + " ± " + RoundedText(match.duv->u95, 2) : kNone,
          match.stops_lost ? StopsOf(*match.stops_lost) : kNone,
          match.dimmer_stops ? StopsRange(*match.dimmer_stops) : kNone};
}

Result<LightPoint> PointOfMatchLight(const MatchLight& light, double sigma) {
  if (light.light && light.spectrum.values.empty()) {
    if (auto point = PointOf(*light.light)) return *point;
    return Refused("no_color", light.title,
                   "no colour of it is known; give its readings xy or cct_K, or its --spectrum");
  }
  const auto xyz = XyzFromSpectrum(light.spectrum);
  if (!xyz) return tl::unexpected(xyz.error());
  LightPoint point;
  point.xy = XyFromXyz(*xyz);
  if (light.measured) {
    point.sd_ln_mired = kSpectrumLnMired;
    point.sd_duv = kSpectrumDuv;
  }
  if (light.spectrum.quantity == SpectralQuantity::kIrradiance) {
    point.kind = LevelKind::kIlluminance;
    point.level = xyz->Y;
    point.sd_ln_level = light.measured ? sigma : 0.0;
  }
  return point;
}

SettableLamp SettableOf(const MatchLight& light, const LightPoint& fixed) {
  return {light.title, IsSetByStates(light) ? &*light.light : nullptr, fixed};
}

Node LampSettingNode(const LampSetting& setting) {
  Node node = {{"state", StateNode(setting.state)}, {"basis", BasisWord(setting.basis)}};
  node.Put("state_u95", Node::UnlessEmpty(StateNode(setting.u95)));
  if (setting.point.kind == LevelKind::kIntensity) node.Put("intensity_cd", setting.point.level);
  if (setting.point.kind == LevelKind::kIlluminance) {
    node.Put("illuminance_lx", setting.point.level);
  }
  node.Put("relative", Node(setting.relative));
  return node;
}

Node StateMatchNode(const StateMatch& match) {
  Node node = Node::Table();
  if (match.lamps.size() == 1) node.Put(LampSettingNode(match.lamps.front()));
  node.Put("gels", Node::Array());
  node.Put("xy", Node{match.point.xy.x, match.point.xy.y});
  node.Put("delta_uv", match.delta_uv.value);
  if (match.cct_K) node.Put("cct_K", match.cct_K->value);
  if (match.duv) node.Put("duv", match.duv->value);
  if (match.dimmer_stops) node.Put("dimmer_stops", match.dimmer_stops->value);
  node.Put("stops_lost", Node(match.stops_lost));
  IntervalTables tables;
  tables.Put("delta_uv", match.delta_uv);
  tables.Put("cct_K", match.cct_K);
  tables.Put("duv", match.duv);
  tables.Put("dimmer_stops", match.dimmer_stops);
  node.Put("u95", std::move(tables.u95));
  node.Put("low95", std::move(tables.low));
  node.Put("high95", std::move(tables.high));
  return node;
}

std::string StateMatchTable(const std::vector<StateMatch>& matches, const StateMatch& unfiltered) {
  std::vector<std::vector<std::string>> rows;
  for (const StateMatch& each : matches) rows.push_back(RowOfSetting(each));
  rows.push_back(RowOfSetting(unfiltered));
  rows.back().front() += " (as it is)";
  return TextTable({"set", "was", "Δu'v'", "CCT", "Duv", "stops lost", "over target, stops"}, rows);
}

std::string StateMixText(const StateMatch& mix, const std::vector<std::string>& names) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < mix.lamps.size(); ++i) {
    const LampSetting& one = mix.lamps[i];
    const std::string unit = one.point.kind == LevelKind::kIntensity ? " cd" : " lx";
    rows.push_back({names[i], SettingText(one), std::string(BasisWord(one.basis)),
                    RoundedText(one.point.level, 3) + unit});
  }
  std::string text = TextTable({"lamp", "set", "was", "gives"}, rows) + "\ntogether ";
  text += ValueOf(mix.cct_K, " K");
  if (mix.duv) text += ", Duv " + DuvText(mix.duv->value);
  text += ", Δu'v' " + RoundedText(mix.delta_uv.value, 2) + " from the target";
  if (mix.dimmer_stops) text += ", " + StopsRange(*mix.dimmer_stops) + " stops" + " over it";
  return text + "\n";
}

Result<StateMatchRequest> StateRequestOf(const StateMatchWords& o, const MatchLight& target) {
  StateMatchRequest request;
  const auto sigma =
      o.meter.empty() ? Result<double>(match::MatchSpread{}.level) : SigmaOfMeter(o.meter);
  if (!sigma) return tl::unexpected(sigma.error());
  const auto point = PointOfMatchLight(target, *sigma);
  if (!point) return tl::unexpected(point.error());
  request.target = *point;
  request.count = o.count;
  request.reach = o.reach;
  return request;
}

// What no state that was read gives, of a match's dimmer_stops.
void WarnOfLevel(const StateMatch& match, const std::string& title, Console& console) {
  constexpr double kSeen = 0.1;
  if (!match.dimmer_stops || std::abs(match.dimmer_stops->value) < kSeen) return;
  const double stops = match.dimmer_stops->value;
  console.Warn({stops < 0.0 ? "lamp_too_weak" : "lamp_too_bright", title,
                "in the nearest colour it is " + RoundedText(std::abs(stops), 2) + " stops " +
                    (stops < 0.0 ? "below the target; move it nearer or dim the target"
                                 : "above the target at the lowest that was read; move it away")});
}

void WarnOfCombined(const StateMatch& match, const std::vector<const MatchLight*>& lamps,
                    Console& console) {
  for (std::size_t i = 0; i < match.lamps.size(); ++i) {
    const LampSetting& one = match.lamps[i];
    if (auto warning = CombinedWarning(lamps[i]->title, one.state, one.basis)) {
      console.Warn(*std::move(warning));
    }
  }
}

Result<std::vector<OutputFile>> SetLightFile(const StateMatchWords& o, const MatchLight& lamp,
                                             const StateMatches& answer) {
  std::vector<OutputFile> files;
  if (o.output.empty()) return files;
  const auto taken = static_cast<std::size_t>(o.take);
  if (taken > answer.matches.size()) {
    return WrongUsage("--take", "there are " + std::to_string(answer.matches.size()) + " matches");
  }
  const StateMatch& match = taken == 0 ? answer.unfiltered : answer.matches[taken - 1];
  auto light = LightAtState(*lamp.light, match.lamps.front().state);
  if (!light) return Propagate(std::move(light));
  LightFile file;
  file.lights.push_back(*std::move(light));
  file.provenance.generator = GeneratorName();
  file.provenance.inputs = lamp.inputs;
  auto text = LightFileToJson(file);
  if (!text) return Propagate(std::move(text));
  files.push_back({o.output, *std::move(text)});
  return files;
}

Node PointNode(const std::string& title, const LightPoint& point) {
  Node node = LightNode(title, point.xy, CctFromXy(point.xy));
  if (point.kind == LevelKind::kIntensity) node.Put("intensity_cd", point.level);
  if (point.kind == LevelKind::kIlluminance) node.Put("illuminance_lx", point.level);
  return node;
}

}  // namespace

bool IsSetByStates(const MatchLight& light) {
  return light.light && light.light->states.size() > 1 && light.spectrum.values.empty();
}

Result<void> SetMatchState(const std::string& text, MatchLight& light) {
  const auto state = ParseFixtureState(text);
  if (!state) return tl::unexpected(state.error());
  if (!light.light) {
    return WrongUsage("--to-state", "the target is no light.json or session with states");
  }
  auto there = LightAtState(*light.light, *state);
  if (!there) return Propagate(std::move(there));
  light.light = *std::move(there);
  light.title += " at " + StateText(*state);
  return {};
}

Result<void> RunMatchByStates(const StateMatchWords& o, const MatchLight& lamp,
                              const MatchLight& target, Console& console) {
  const auto request = StateRequestOf(o, target);
  if (!request) return tl::unexpected(request.error());
  const auto answer = MatchStates(SettableOf(lamp, {}), *request);
  if (!answer) return tl::unexpected(answer.error());
  WarnOfLevel(answer->matches.front(), lamp.title, console);
  WarnOfCombined(answer->matches.front(), {&lamp}, console);
  const auto files = SetLightFile(o, lamp, *answer);
  if (!files) return tl::unexpected(files.error());
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  if (auto written = WriteOutputs(*files, o.force); !written) return written;
  console.Print(lamp.title + " to " + target.title + " by its own controls, in colour alone\n\n" +
                StateMatchTable(answer->matches, answer->unfiltered));
  Node document = {{"lamp", PointNode(lamp.title, answer->unfiltered.point)},
                   {"target", PointNode(target.title, request->target)},
                   {"matches", Node::List(answer->matches, StateMatchNode)},
                   {"unfiltered", StateMatchNode(answer->unfiltered)}};
  if (!files->empty()) document.Put("files", PathsOf(*files));
  console.PrintDocument(std::move(document));
  for (const OutputFile& file : *files) console.Note("wrote " + file.path);
  return {};
}

Result<void> RunMixByStates(const StateMatchWords& o, const MatchLight& lamp,
                            const MatchLight& with, const MatchLight& target, Console& console) {
  const auto request = StateRequestOf(o, target);
  if (!request) return tl::unexpected(request.error());
  std::vector<SettableLamp> lamps;
  for (const MatchLight* one : {&lamp, &with}) {
    const auto point = PointOfMatchLight(*one, request->target.sd_ln_level);
    if (!point) return tl::unexpected(point.error());
    lamps.push_back(SettableOf(*one, *point));
  }
  const auto mix = MixStates(lamps[0], lamps[1], *request);
  if (!mix) return tl::unexpected(mix.error());
  WarnOfLevel(*mix, lamp.title + " with " + with.title, console);
  WarnOfCombined(*mix, {&lamp, &with}, console);
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  console.Print(StateMixText(*mix, {lamp.title, with.title}));
  console.PrintDocument(
      {{"lamp", lamp.title},
       {"with", with.title},
       {"target", PointNode(target.title, request->target)},
       {"settings",
        {{"lamp", LampSettingNode(mix->lamps[0])}, {"with", LampSettingNode(mix->lamps[1])}}},
       {"mixed", StateMatchNode(*mix)}});
  return {};
}

}  // namespace lightcal::app
