// SPDX-License-Identifier: Apache-2.0
#include "match/match_by_states.h"

#include <cmath>
#include <vector>

#include "calibration_options.h"
#include "lamp_state.h"
#include "lightcal/calibrate/states/match_states.h"
#include "lightcal/colorimetry/cct.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/match/match_lights.h"
#include "lightcal/records/light_codec.h"
#include "match/match_answer.h"
#include "match/state_match_words.h"
#include "output_files.h"
#include "typed_reading.h"

namespace lightcal::app {
namespace {

// What a measured spectrum's colour repeats and agrees within, 1 sigma.
constexpr double kSpectrumLnMired = 0.006, kSpectrumDuv = 0.0008;

Result<LightPoint> PointOfMatchLight(const MatchLight& light, double sigma) {
  if (light.light && light.spectrum.values.empty()) {
    auto point = light.at ? PointOf(*light.light, light.session, *light.at)
                          : PointOf(*light.light, light.session);
    if (point) return *std::move(point);
    return Refused("no_color", light.title,
                   "no colour of it is known; give its readings xy or cct_K, or its --spectrum");
  }
  const auto xyz = XyzFromSpectrum(light.spectrum);
  if (!xyz) return tl::unexpected(xyz.error());
  LightPoint point;
  point.xy = XyFromXyz(*xyz);
  if (light.measured) {
    point.sd.ln_mired = kSpectrumLnMired;
    point.sd.duv = kSpectrumDuv;
  }
  if (light.spectrum.quantity == SpectralQuantity::kIrradiance) {
    point.kind = LevelKind::kIlluminance;
    point.level = xyz->Y;
    point.sd.ln_level = light.measured ? sigma : 0.0;
  }
  return point;
}

SettableLamp SettableOf(const MatchLight& light, const LightPoint& fixed) {
  return {light.title, IsSetByStates(light) ? &*light.light : nullptr, fixed, light.session};
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
  if (match.delta_cct_K) node.Put("delta_cct_K", match.delta_cct_K->value);
  if (match.delta_duv) node.Put("delta_duv", match.delta_duv->value);
  if (match.dimmer_stops) node.Put("dimmer_stops", match.dimmer_stops->value);
  node.Put("stops_lost", Node(match.stops_lost));
  const auto told = [](bool cancels) { return cancels ? "cancels" : "counts"; };
  Node common = {{"color", told(match.color_cancels)}};
  if (match.dimmer_stops) common.Put("light", told(match.level_cancels));
  node.Put("common_error", std::move(common));
  IntervalTables tables;
  tables.Put("delta_uv", match.delta_uv);
  tables.Put("delta_cct_K", match.delta_cct_K);
  tables.Put("delta_duv", match.delta_duv);
  tables.Put("cct_K", match.cct_K);
  tables.Put("duv", match.duv);
  tables.Put("dimmer_stops", match.dimmer_stops);
  node.Put("u95", std::move(tables.u95));
  node.Put("low95", std::move(tables.low));
  node.Put("high95", std::move(tables.high));
  return node;
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
  auto there = AnswerState(*light.light, *state);
  if (!there) return Propagate(std::move(there));
  light.at = *std::move(there);
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
                StateMatchTable(*answer) +
                DifferenceText(answer->matches.front(), request->target, target.title) +
                SameCctText(answer->matches.front(), answer->same_cct, request->target));
  Node document = {{"lamp", PointNode(lamp.title, answer->unfiltered.point)},
                   {"target", PointNode(target.title, request->target)},
                   {"matches", Node::List(answer->matches, StateMatchNode)},
                   {"unfiltered", StateMatchNode(answer->unfiltered)}};
  if (answer->same_cct) document.Put("same_cct", StateMatchNode(*answer->same_cct));
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
    const auto point = PointOfMatchLight(*one, request->target.sd.ln_level);
    if (!point) return tl::unexpected(point.error());
    lamps.push_back(SettableOf(*one, *point));
  }
  const auto mix = MixStates(lamps[0], lamps[1], *request);
  if (!mix) return tl::unexpected(mix.error());
  const StateMatch& nearest = mix->nearest;
  WarnOfLevel(nearest, lamp.title + " with " + with.title, console);
  WarnOfCombined(nearest, {&lamp, &with}, console);
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  console.Print(StateMixText(nearest, {lamp.title, with.title}) +
                DifferenceText(nearest, request->target, target.title) +
                SameCctText(nearest, mix->same_cct, request->target));
  const auto settings = [](const StateMatch& match) -> Node {
    return {{"lamp", LampSettingNode(match.lamps[0])}, {"with", LampSettingNode(match.lamps[1])}};
  };
  Node document = {{"lamp", lamp.title},
                   {"with", with.title},
                   {"target", PointNode(target.title, request->target)},
                   {"settings", settings(nearest)},
                   {"mixed", StateMatchNode(nearest)}};
  if (mix->same_cct) {
    document.Put("same_cct", {{"settings", settings(*mix->same_cct)},
                              {"mixed", StateMatchNode(*mix->same_cct)}});
  }
  console.PrintDocument(std::move(document));
  return {};
}

}  // namespace lightcal::app
