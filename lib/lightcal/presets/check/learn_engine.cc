// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/check/learn_engine.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lightcal/core/numbers_text.h"
#include "lightcal/presets/check/learn_cone.h"
#include "lightcal/presets/check/render_cause.h"
#include "lightcal/presets/check/render_shape.h"

namespace lightcal {
namespace {

constexpr double kLeastU95 = 0.001;
constexpr double kSameFactorApart = 0.02;  // |ln| between two pictures of one kind

struct JudgedPicture {
  const RigPicture* picture = nullptr;
  RenderVerdict verdict;

  [[nodiscard]] double Factor() const { return verdict.lux / verdict.expected_lx; }
  [[nodiscard]] const CheckedLamp& lamp() const { return picture->rig.lamps[picture->rig.lamp]; }
  [[nodiscard]] bool OnAxis() const { return picture->rig.off_axis_deg == 0.0; }
  [[nodiscard]] SeenRig Seen() const { return {&picture->rig, &verdict}; }
};
using JudgedPictures = std::vector<JudgedPicture>;

// A picture whose samples are not proportional to light, or of another colour, has no factor.
bool HasFactor(const std::string& cause) {
  constexpr std::array<std::string_view, 7> kNone = {
      "tone_mapped",        "encoded_twice",       "not_srgb_encoded", "color_missing",
      "color_read_as_srgb", "color_encoded_twice", "other_color"};
  return std::ranges::find(kNone, cause) == kNone.end();
}

// Half a code of a card, relative, and what the cards disagree by.
double Doubt(const JudgedPicture& judged) {
  const auto& cards = judged.picture->cards;
  double steps = 0.0;
  for (const CardPixels& card : cards) {
    if (!card.clipped[1] && card.rgb[1] > 0.0) {
      steps = std::max(steps, card.step[1] / 2.0 / card.rgb[1]);
    }
  }
  const bool clipped = std::ranges::any_of(
      cards, [](const CardPixels& card) { return card.clipped != std::array<bool, 3>{}; });
  const double apart =
      clipped ? 0.0
              : std::abs(std::log(judged.verdict.card_lx[0] / judged.verdict.card_lx[1])) / 2.0;
  return std::max({kLeastU95, steps, apart});
}

Result<void> CheckKind(const RigPicture& picture) {
  const CheckedLamp& lamp = picture.rig.lamps[picture.rig.lamp];
  for (const CheckedLamp& other : picture.rig.lamps) {
    if (other.kind == lamp.kind) continue;
    return Refused("mixed_kinds", picture.name,
                   "shows cards that a " + lamp.kind + " (" + lamp.name + ") and a " + other.kind +
                       " (" + other.name + ") light together; export a rig for each kind");
  }
  const auto kind = LightKindFromName(lamp.kind);
  if (kind && *kind != LightKind::kPhotometric) return {};
  return Refused("not_learnt", picture.name,
                 "is lit by a " + lamp.kind +
                     " light, whose candela stand in a file of their own that is the same for "
                     "every renderer; learn from another kind");
}

bool BesideALamp(const CheckedRig& rig) { return rig.off_axis_deg != 0.0 && !rig.panorama; }

// Cards beside a spot that shines narrower than it should are dark, which is an answer.
Result<JudgedPicture> JudgeOne(const RigPicture& picture, PixelUnit unit) {
  auto verdict = JudgeRender(picture.rig, picture.cards, unit, picture.name);
  if (verdict) return JudgedPicture{&picture, *std::move(verdict)};
  if (!BesideALamp(picture.rig) || verdict.error().code != "too_dark") {
    return tl::unexpected(verdict.error());
  }
  JudgedPicture dark{&picture, {}};
  dark.verdict.expected_lx =
      (picture.rig.cards[0].expected_lx + picture.rig.cards[1].expected_lx) / 2.0;
  return dark;
}

struct JudgedAll {
  JudgedPictures pictures;
  std::size_t right = 0;  // as bright as the meter says
  Warnings left_out;      // beside a lamp, clipped
};

Result<JudgedAll> JudgeAll(std::span<const RigPicture> pictures, bool as_nits) {
  JudgedAll all;
  for (const RigPicture& picture : pictures) {
    const PixelUnit unit = as_nits ? PixelUnit::kNits : picture.unit.value_or(PixelUnit::kNits);
    auto judged = JudgeOne(picture, unit);
    if (!judged && judged.error().code == "all_saturated" && BesideALamp(picture.rig)) {
      all.left_out.push_back({"picture_left_out", picture.name, judged.error().message});
      continue;
    }
    if (!judged) return tl::unexpected(judged.error());
    all.right += judged->verdict.cause.code == "none" ? 1 : 0;
    all.pictures.push_back(*std::move(judged));
  }
  return all;
}

Result<void> CheckPicture(const JudgedPicture& judged) {
  const RenderCause& cause = judged.verdict.cause;
  if (HasFactor(cause.code)) return {};
  return Refused(cause.code, judged.picture->name, cause.message);
}

std::string CauseOfFactor(const RenderCause& cause) {
  return cause.code == "exposure_unlocked" ? "unknown" : cause.code;
}

// ---- one kind ----

// Whether the factors agree once they are divided by area^power.
double ApartWith(const JudgedPictures& pictures, int power) {
  double least = 1e300, most = -1e300;
  for (const JudgedPicture& one : pictures) {
    const double area = one.lamp().surface_m2;
    if (power != 0 && !(area > 0.0)) return 1e300;
    const double ln = std::log(one.Factor()) - (power == 0 ? 0.0 : power * std::log(area));
    least = std::min(least, ln);
    most = std::max(most, ln);
  }
  return most - least;
}

int AreaPower(const JudgedPictures& pictures) {
  if (ApartWith(pictures, 0) > kSameFactorApart) {
    for (const int power : {-1, 1}) {
      if (ApartWith(pictures, power) < kSameFactorApart) return power;
    }
    return 0;
  }
  const std::string& cause = pictures.front().verdict.cause.code;
  return cause == "divided_by_area" ? -1 : cause == "times_area" ? 1 : 0;
}

// Factor, cause and doubt of pictures on the axis.
LearntKind LearnFactor(const JudgedPictures& pictures, Warnings& warnings) {
  LearntKind learnt;
  learnt.kind = LightKindFromName(pictures.front().lamp().kind).value_or(LightKind::kPoint);
  learnt.cause = CauseOfFactor(pictures.front().verdict.cause);
  learnt.area_power = AreaPower(pictures);
  const double apart = ApartWith(pictures, learnt.area_power);
  double sum = 0.0;
  for (const JudgedPicture& one : pictures) {
    sum += std::log(one.Factor());
    if (learnt.area_power != 0) sum -= learnt.area_power * std::log(one.lamp().surface_m2);
    learnt.u95_relative = std::max(learnt.u95_relative, Doubt(one));
    if (CauseOfFactor(one.verdict.cause) != learnt.cause) learnt.cause = "unknown";
  }
  if (learnt.area_power != 0) {
    learnt.cause = learnt.area_power < 0 ? "divided_by_area" : "times_area";
  }
  learnt.factor = std::exp(sum / static_cast<double>(pictures.size()));
  learnt.u95_relative = std::max(learnt.u95_relative, apart / 2.0);
  if (apart > kSameFactorApart) {
    warnings.push_back({"kinds_disagree", std::string(LightKindName(learnt.kind)),
                        "has pictures that are " + PercentText(std::expm1(apart)) +
                            " apart; one factor cannot be right for all"});
  }
  return learnt;
}

Result<LearntKind> LearnSpot(const JudgedPictures& pictures, std::optional<EngineConeLaw> written,
                             Warnings& warnings) {
  JudgedPictures on;
  std::vector<SeenRig> all, beside;
  for (const JudgedPicture& one : pictures) {
    all.push_back(one.Seen());
    if (one.OnAxis()) {
      on.push_back(one);
    } else {
      beside.push_back(one.Seen());
    }
  }
  if (on.empty()) {
    return Refused("no_axis_picture", pictures.front().picture->name,
                   "shows cards beside the axis of a spot, and no other picture those on it; give "
                   "the picture of the rig itself, too");
  }
  for (const JudgedPicture& one : on) {
    if (auto checked = CheckPicture(one); !checked) return Propagate(std::move(checked));
  }
  LearntKind learnt = LearnFactor(on, warnings);
  if (beside.empty()) return learnt;
  const auto found =
      written ? FindCone(on.front().picture->rig, learnt.factor, beside, *written) : std::nullopt;
  if (found) {
    learnt.cone = found->cone;
    learnt.factor = found->shared;
    learnt.cause =
        std::abs(std::log(learnt.factor)) < kSameFactorApart
            ? found->cause
            : CauseOfFactor(CausesOfFactor(on.front().picture->rig, learnt.factor).front());
    return learnt;
  }
  const RenderCause together = JudgeTogether(all).front();
  if (learnt.cause == "none") learnt.cause = CauseOfFactor(together);
  if (together.code != "none" && together.code != "cone_as_exported") {
    warnings.push_back({"cone_not_learnt", "spot",
                        written
                            ? "shows beside its axis what no known cone law makes of its angles"
                            : "is wrong beside its axis (" + together.code +
                                  "), and its cone is not learnt: {preset.target} was not said"});
  }
  return learnt;
}

Result<LearntKind> LearnPanorama(const JudgedPictures& pictures, Warnings& warnings) {
  std::vector<SeenRig> seen;
  LearntKind learnt;
  learnt.kind = LightKind::kDome;
  for (const JudgedPicture& one : pictures) {
    seen.push_back(one.Seen());
    if (auto checked = CheckPicture(one); !checked) return Propagate(std::move(checked));
    learnt.u95_relative = std::max(learnt.u95_relative, Doubt(one));
  }
  const RenderCause together = JudgeTogether(seen).front();
  learnt.cause = CauseOfFactor(together);
  const auto hung = FindHungPanorama(seen);
  if (!hung) {
    learnt.factor = pictures.front().Factor();
    warnings.push_back({"panorama_not_learnt", "dome",
                        "does not look as its picture would: bring pictures of cards that face "
                        "three ways or more, {preset.rig_at}"});
    return learnt;
  }
  learnt.factor = hung->factor;
  learnt.turn = LearntTurn{hung->way, hung->turn_deg};
  if (learnt.turn->IsNone()) {
    const bool right = std::abs(std::log(hung->factor)) < kSameFactorApart;
    learnt.cause =
        right ? "none" : CauseOfFactor(CausesOfFactor(*seen.front().rig, hung->factor).front());
  }
  return learnt;
}

Result<LearntKind> LearnKind(const JudgedPictures& pictures, std::optional<EngineConeLaw> written,
                             Warnings& warnings) {
  if (pictures.front().lamp().kind == "spot") return LearnSpot(pictures, written, warnings);
  if (std::ranges::all_of(pictures, [](const JudgedPicture& one) {
        return one.picture->rig.panorama.has_value();
      })) {
    return LearnPanorama(pictures, warnings);
  }
  for (const JudgedPicture& one : pictures) {
    if (auto checked = CheckPicture(one); !checked) return Propagate(std::move(checked));
  }
  return LearnFactor(pictures, warnings);
}

// ---- all of them ----

Result<bool> KnowsScale(std::span<const RigPicture> pictures) {
  const bool known = pictures.front().unit.has_value();
  for (const RigPicture& picture : pictures) {
    if (picture.unit.has_value() == known) continue;
    return Refused("mixed_scales", picture.name,
                   "is exposed, an earlier picture of unknown scale, or the other way round; say "
                   "with {render.pixels} what a sample stands for");
  }
  return known;
}

// Without a scale: factors over the first kind's, whose cause nobody knows.
void MakeRelative(LearntEngine& engine) {
  const double first = engine.kinds.front().factor;
  for (LearntKind& kind : engine.kinds) {
    kind.factor /= first;
    kind.cause = std::abs(std::log(kind.factor)) < kSameFactorApart ? "none" : "unknown";
  }
}

}  // namespace

Result<LearntRenderer> LearnEngine(std::span<const RigPicture> pictures,
                                   std::optional<EngineConeLaw> written) {
  LearntRenderer found;
  for (const RigPicture& picture : pictures) {
    if (auto checked = CheckKind(picture); !checked) return Propagate(std::move(checked));
  }
  const auto known = KnowsScale(pictures);
  if (!known) return tl::unexpected(known.error());
  found.engine.absolute = *known;
  auto judged = JudgeAll(pictures, false);
  if (!judged) return tl::unexpected(judged.error());
  const bool may_be_nits = std::ranges::all_of(pictures, [](const RigPicture& picture) {
    return picture.unit == PixelUnit::kExposed && picture.cards[0].step[1] == 0.0;
  });
  if (may_be_nits) {
    auto as_nits = JudgeAll(pictures, true);
    if (as_nits && as_nits->right > judged->right) {
      found.engine.exposure_applied = false;
      judged = std::move(as_nits);
    }
  }
  found.warnings = std::move(judged->left_out);
  std::vector<std::pair<std::string, JudgedPictures>> kinds;
  for (JudgedPicture& one : judged->pictures) {
    const auto it =
        std::ranges::find(kinds, one.lamp().kind, &std::pair<std::string, JudgedPictures>::first);
    if (it == kinds.end()) {
      kinds.push_back({one.lamp().kind, {std::move(one)}});
    } else {
      it->second.push_back(std::move(one));
    }
  }
  for (const auto& [word, of_kind] : kinds) {
    auto kind = LearnKind(of_kind, written, found.warnings);
    if (!kind) return tl::unexpected(kind.error());
    found.engine.kinds.push_back(*std::move(kind));
  }
  if (*known) return found;
  if (found.engine.kinds.size() == 1) {
    return Refused("scale_unknown", pictures.front().name,
                   "is linear, and nobody said what a sample stands for: one kind alone has no "
                   "ratio. Say it with {render.pixels}, or bring another kind's picture");
  }
  MakeRelative(found.engine);
  return found;
}

}  // namespace lightcal
