// SPDX-License-Identifier: Apache-2.0
#include "lamp_state.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "lightcal/core/joined.h"

namespace lightcal::app {
namespace {

struct WantedState {
  std::string light;  // "" = every one that has states
  FixtureState state;
};

Result<WantedState> ParseWanted(const std::string& text, const LightFile& file) {
  WantedState wanted;
  std::string controls = text;
  const std::size_t colon = text.find(':');
  if (colon != std::string::npos && colon < text.find('=')) {
    wanted.light = text.substr(0, colon);
    controls = text.substr(colon + 1);
    if (std::ranges::find(file.lights, wanted.light, &FittedLight::name) == file.lights.end()) {
      return WrongUsage("--state", "\"" + wanted.light + "\" is no light here; there are " +
                                       Joined(file.lights, ", ", &FittedLight::name));
    }
  }
  auto state = ParseFixtureState(controls);
  if (!state) return Propagate(std::move(state));
  wanted.state = *std::move(state);
  return wanted;
}

}  // namespace

std::string_view BasisWord(StateBasis basis) {
  constexpr std::array<std::string_view, 3> kWords = {"measured", "between", "combined"};
  return kWords[static_cast<std::size_t>(basis)];
}

Node StateNode(const FixtureState& state) {
  Node node = Node::Table();
  for (const ControlValue& control : state) {
    node.Put(control.name, control.IsWord() ? Node(control.word) : Node(control.number));
  }
  return node;
}

std::optional<Warning> CombinedWarning(const std::string& lamp, const FixtureState& state,
                                       StateBasis basis) {
  if (basis != StateBasis::kCombined) return std::nullopt;
  return Warning{"state_combined", lamp,
                 StateText(state) +
                     " was put together from states that differ from it in several controls; read "
                     "it to be sure"};
}

std::optional<Warning> SharedGeometryWarning(const FittedLight& light, const FixtureState& at) {
  const GeometryBasis basis = GeometryAt(light, at, light.intensity_cd).basis;
  if (basis == GeometryBasis::kLights || basis == GeometryBasis::kOwn) return std::nullopt;
  if (basis == GeometryBasis::kBetween) {
    return Warning{"state_geometry_between", light.name,
                   StateText(at) +
                       ": where its light starts and how wide it shines is put between "
                       "the zooms that are known; read this one to be sure"};
  }
  return Warning{"state_geometry", light.name,
                 StateText(at) + ": where its light starts and how wide it shines is taken from " +
                     StateText(light.state) +
                     "; read it at two distances and across its beam, or describe it by a "
                     "[[light.at]]"};
}

Result<Warnings> SetStates(const std::vector<std::string>& texts, LightFile& file) {
  Warnings warnings;
  for (const std::string& text : texts) {
    const auto wanted = ParseWanted(text, file);
    if (!wanted) return tl::unexpected(wanted.error());
    bool any = false;
    for (FittedLight& light : file.lights) {
      const bool named = light.name == wanted->light;
      if (!wanted->light.empty() ? !named : light.states.empty()) continue;
      any = true;
      const auto answer = AnswerState(light, wanted->state);
      if (!answer) return tl::unexpected(answer.error());
      if (auto combined = CombinedWarning(light.name, answer->state, answer->basis)) {
        warnings.push_back(*std::move(combined));
      }
      if (auto shared = SharedGeometryWarning(light, wanted->state)) {
        warnings.push_back(*std::move(shared));
      }
      auto there = LightAtState(light, wanted->state);
      if (!there) return Propagate(std::move(there));
      light = *std::move(there);
    }
    if (any) continue;
    return Refused("no_states", text,
                   "no light here was read at states of its controls; give its readings "
                   "state = { dimmer = 50 } and the like, and fit again");
  }
  return warnings;
}

}  // namespace lightcal::app
