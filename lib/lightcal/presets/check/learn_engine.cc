// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/check/learn_engine.h"

#include <algorithm>
#include <cmath>

#include "lightcal/presets/check/render_cause.h"

namespace lightcal {
namespace {

constexpr double kLeastU95 = 0.001;

// A picture whose samples are not proportional to light, or of another colour, has no factor.
bool HasFactor(const std::string& cause) {
  constexpr std::array<std::string_view, 7> kNone = {
      "tone_mapped",        "encoded_twice",       "not_srgb_encoded", "color_missing",
      "color_read_as_srgb", "color_encoded_twice", "other_color"};
  return std::ranges::find(kNone, cause) == kNone.end();
}

// Half a code of a card, relative, and what the cards disagree by.
double Doubt(const std::array<CardPixels, 2>& cards, const RenderVerdict& verdict) {
  double steps = 0.0;
  for (std::size_t i = 0; i < 2; ++i) {
    if (!cards[i].clipped[1] && cards[i].rgb[1] > 0.0) {
      steps = std::max(steps, cards[i].step[1] / 2.0 / cards[i].rgb[1]);
    }
  }
  const bool clipped = cards[0].clipped[1] || cards[1].clipped[1];
  const double apart =
      clipped ? 0.0 : std::abs(std::log(verdict.card_lx[0] / verdict.card_lx[1])) / 2.0;
  return std::max({kLeastU95, steps, apart});
}

}  // namespace

Result<LearntKind> LearnKind(const CheckedRig& rig, const std::array<CardPixels, 2>& cards,
                             PixelUnit unit, const std::string& picture) {
  const CheckedLamp& lamp = rig.lamps[rig.lamp];
  for (const CheckedLamp& other : rig.lamps) {
    if (other.kind == lamp.kind) continue;
    return Refused("mixed_kinds", picture,
                   "shows cards that a " + lamp.kind + " (" + lamp.name + ") and a " + other.kind +
                       " (" + other.name + ") light together; export a rig for each kind");
  }
  LearntKind learnt;
  const auto kind = LightKindFromName(lamp.kind);
  if (!kind || *kind == LightKind::kPhotometric) {
    return Refused("not_learnt", picture,
                   "is lit by a " + lamp.kind +
                       " light, whose candela stand in a file of their "
                       "own that is the same for every renderer; learn from another kind");
  }
  learnt.kind = *kind;
  const auto verdict = JudgeRender(rig, cards, unit, picture);
  if (!verdict) return tl::unexpected(verdict.error());
  if (!HasFactor(verdict->cause.code)) {
    return Refused(verdict->cause.code, picture, verdict->cause.message);
  }
  learnt.factor = verdict->lux / verdict->expected_lx;
  learnt.u95_relative = Doubt(cards, *verdict);
  learnt.cause = verdict->cause.code == "exposure_unlocked" ? "unknown" : verdict->cause.code;
  return learnt;
}

}  // namespace lightcal
