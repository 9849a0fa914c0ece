// SPDX-License-Identifier: Apache-2.0
// What to set on a fixture, or on two of them together, so that its light looks like another's.
// Judged by colour alone: between states nobody knows a spectrum.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/fit/states/state_answer.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal {

// Whose amount of light a number is: only equals are compared.
enum class LevelKind : std::uint8_t { kNone, kIntensity, kIlluminance };

// 1 sigma; of ln mired and Duv where there is a CCT, else `duv` in u and in v of 1960.
struct LightErrors {
  double ln_mired = 0.0, duv = 0.0, ln_level = 0.0;
};

// A light as one number of amount and one colour, and whose errors these have: what two of them
// have in common (a lamp's at all its states, an instrument's in all it read) is in neither's
// difference from the other.
struct LightPoint {
  Xy xy;
  LevelKind kind = LevelKind::kNone;
  double level = 0.0;  // cd or lx; 0 where kind is kNone
  LightErrors sd{};    // all of it
  LightErrors own{};   // of that, what `state` has for itself
  std::string lamp{};  // "" = no other's; of the rest, what is no instrument's
  FixtureState state{};
  std::optional<ColorMeter> color_meter{};
  std::optional<MeterShare> level_meter{};
};
// `session`: what tells one fit's lights from another's of the same names. Absent where the light
// has no colour.
[[nodiscard]] std::optional<LightPoint> PointOf(const FittedLight& light,
                                                const std::string& session);
[[nodiscard]] std::optional<LightPoint> PointOf(const FittedLight& light,
                                                const std::string& session,
                                                const StateAnswer& there);

// A lamp whose light can be set. `light` with states: by AnswerState. Without: `fixed` times a
// dimmer of 0 ... 100, taken to scale it and to leave its colour.
struct SettableLamp {
  std::string name;
  const FittedLight* light = nullptr;  // not owned; one with states
  LightPoint fixed;
  std::string session{};  // of PointOf
};

struct StateMatchRequest {
  LightPoint target;
  int count = 5;        // settings wanted
  double reach = 0.02;  // the largest distance in u'v' that is still called a match
  int draws = 400;      // behind the intervals; 0: none are stated
};

// One lamp at a setting.
struct LampSetting {
  FixtureState state;  // of a lamp without states: dimmer
  FixtureState u95{};  // half widths of the numbers: how far the same light may lie in the labels
  StateBasis basis = StateBasis::kMeasured;
  LightPoint point;
  std::optional<double> relative;  // over the lamp's reference state, or over what was read
};

// One setting, or two lamps' together, against the target.
struct StateMatch {
  std::vector<LampSetting> lamps;  // one, or the two of a mix
  LightPoint point;                // of all together
  std::optional<Uncertain> cct_K, duv, dimmer_stops;
  // From the target: distance in CIE 1976 u'v', CCT and Duv less the target's, as dimmer_stops is.
  // Their intervals are of the difference: what lamp and target have in common is no part of them.
  Uncertain delta_uv;
  std::optional<Uncertain> delta_cct_K, delta_duv;
  // Whether an instrument's own error is of what they have in common: in colour, in light.
  bool color_cancels = false, level_cancels = false;
  std::optional<double> stops_lost;  // log2 of the reference state's light over this; of one lamp
};

struct StateMatches {
  std::vector<StateMatch> matches;  // nearest first
  StateMatch unfiltered;            // the lamp as it is at its reference state
  std::optional<StateMatch> same_cct{};
};

struct StateMix {
  StateMatch nearest;
  std::optional<StateMatch> same_cct{};
};

// The setting nearest to the target: in colour first (those within 0.0005 in u'v' of the nearest,
// that nobody tells apart), then in light where both are known in one unit, else the brightest; and
// after it the states that were read, each where none before it is nearer in colour without costing
// 0.05 stops. A lamp beside the target's Duv is nearest at another CCT: lines of one CCT stand
// square to the locus in CIE 1960 uv, not in u'v', where v is stretched by 1.5. same_cct is the
// setting of the target's CCT, where these two are more than 0.001 apart along the locus. A lamp is
// matched to itself by its very state.
// Controls that are numbers are searched over what was read of them (a grid of eight a control
// and the states read, then by halving steps), words as they were read. Settings are rounded to
// what a dial shows: 0.1 % and 1 K. u95 of a label is what the intervals of colour and light are
// along it, by the slopes there. Refused: "unreachable" (says the nearest), "no_color".
[[nodiscard]] Result<StateMatches> MatchStates(const SettableLamp& lamp,
                                               const StateMatchRequest& request);

// Two lamps added, XYZ = XYZ_a(setting a) + XYZ_b(setting b), both known in one unit: the pair of
// settings nearest to the target, in colour first, then in light as above. Lamps of which nobody
// wrote a distance ("directional") add as they shone at the meter. Refused: "unreachable",
// "no_color", "no_level" (a lamp whose amount of light is not known, or in another unit).
[[nodiscard]] Result<StateMix> MixStates(const SettableLamp& lamp, const SettableLamp& with,
                                         const StateMatchRequest& request);

}  // namespace lightcal
