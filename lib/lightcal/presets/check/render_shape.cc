// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/check/render_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units.h"
#include "lightcal/presets/check/reader_parts.h"
#include "lightcal/presets/check/render_lamps.h"
#include "lightcal/presets/engine_cone.h"

namespace lightcal {
namespace {

constexpr double kNinth = 0.05;  // the same under a panorama: engines keep nine harmonics of it

// ---- cones ----

struct LawRow {
  EngineConeLaw law;
  std::string_view who;
};
constexpr std::array<LawRow, 5> kOtherLaws = {{
    {EngineConeLaw::kSmooth, "smoothstep in the cosine: three.js, pbrt, Cycles from 4.0 on"},
    {EngineConeLaw::kSmoothTimesCosine, "smoothstep times cosine: Cycles before 4.0"},
    {EngineConeLaw::kSmoothInAngle, "smoothstep in the angle: UsdLux"},
    {EngineConeLaw::kLinearInAngle, "linear in the angle: Mitsuba"},
    {EngineConeLaw::kPower, "1 - u^power: Godot"},
}};

struct ConeShape {
  EngineCone cone;
  std::string code, message;
};

EngineCone ConeOf(EngineConeLaw law, double inner_deg, double outer_deg) {
  EngineCone cone;
  cone.law = law;
  cone.cone = {RadiansFromDegrees(inner_deg), RadiansFromDegrees(std::min(outer_deg, 90.0))};
  return cone;
}

std::vector<ConeShape> ConeShapes(const CheckedLamp& lamp) {
  const double inner = lamp.inner_deg, outer = lamp.outer_deg;
  const auto squared = [](double i, double o) { return ConeOf(EngineConeLaw::kSquared, i, o); };
  std::vector<ConeShape> shapes;
  for (const LawRow& row : kOtherLaws) {
    shapes.push_back({ConeOf(row.law, inner, outer), "other_cone_law",
                      "the lamp's two angles stand in an engine of another cone law (" +
                          std::string(row.who) +
                          "): export to that engine, which refits them, or {preset.spots} ies"});
  }
  shapes.push_back({squared(2.0 * inner, 2.0 * outer), "full_cone_for_half",
                    "full cone angles were given where half angles belong"});
  shapes.push_back({squared(inner / 2.0, outer / 2.0), "half_cone_for_full",
                    "half cone angles were given where full angles belong"});
  if (inner > 0.0) {
    shapes.push_back({squared(0.0, outer), "inner_cone_missing",
                      "the inner cone angle was not set: the beam falls from its axis on"});
  }
  if (inner < 0.99 * outer) {
    shapes.push_back({squared(0.999 * outer, outer), "penumbra_missing",
                      "the cone has no penumbra: its inner angle is its outer one"});
  }
  const BeamProfile beam =
      ProfileOf(SpotCone{RadiansFromDegrees(inner), RadiansFromDegrees(outer)});
  for (const LawRow& row : kOtherLaws) {
    const EngineCone refitted = RefitCone(row.law, beam);
    shapes.push_back({refitted, "cone_as_exported",
                      "no mistake: this is the nearest that the engine's own cone comes (" +
                          std::string(row.who) + "), " + ConeErrorText(refitted) +
                          "; {preset.spots} ies where it has photometric files"});
  }
  return shapes;
}

bool OneSpot(const CheckedRig& rig) {
  return rig.lamps.size() == 1 && rig.lamps.front().kind == "spot" &&
         rig.lamps.front().outer_deg > 0.0;
}

double OfAxial(const EngineCone& cone, const CheckedRig& rig) {
  return ConeFactor(cone, RadiansFromDegrees(rig.off_axis_deg));
}
double MeasuredOfAxial(const CheckedRig& rig) {
  const CheckedLamp& lamp = rig.lamps.front();
  return OfAxial(ConeOf(EngineConeLaw::kSquared, lamp.inner_deg, lamp.outer_deg), rig);
}

double FactorOf(const SeenRig& seen) { return seen.verdict->lux / seen.verdict->expected_lx; }

// What is seen on the axis, which all pictures share; 1 where none stands there.
double SharedFactor(std::span<const SeenRig> seen) {
  const auto on =
      std::ranges::find_if(seen, [](const SeenRig& one) { return one.rig->off_axis_deg == 0.0; });
  return on == seen.end() ? 1.0 : FactorOf(*on);
}

// How far a cone is from what is seen, over the axial intensity and what that allows.
double Misfit(const ConeShape& shape, std::span<const SeenRig> seen, double shared) {
  double worst = 0.0;
  for (const SeenRig& one : seen) {
    const double want = OfAxial(shape.cone, *one.rig);
    const double got = FactorOf(one) / shared * MeasuredOfAxial(*one.rig);
    worst = std::max(worst, std::abs(got - want) / (0.01 + 0.025 * want));
  }
  return worst;
}

void AddOthers(std::span<const SeenRig> seen, std::vector<RenderCause>& causes) {
  for (const SeenRig& one : seen) {
    if (one.rig->off_axis_deg != 0.0 || one.verdict->cause.code == "none") continue;
    causes.push_back(one.verdict->cause);
    const auto& alternatives = one.verdict->alternatives;
    causes.insert(causes.end(), alternatives.begin(), alternatives.end());
    return;
  }
}

std::vector<RenderCause> JudgeBeam(std::span<const SeenRig> seen) {
  const double shared = SharedFactor(seen);
  double worst = 0.0;
  for (const SeenRig& one : seen) {
    const double off = std::log(FactorOf(one) / shared);
    if (std::abs(off) > std::abs(worst)) worst = off;
  }
  std::vector<RenderCause> causes;
  if (std::abs(worst) < kAlikePictures) {
    AddOthers(seen, causes);
    if (causes.empty()) {
      causes.push_back({"none", "as bright as the meter says, on the axis and off it", 1.0, {}});
    }
    return causes;
  }
  std::vector<std::pair<double, RenderCause>> fits;
  if (std::ranges::all_of(seen, [](const SeenRig& one) { return OneSpot(*one.rig); })) {
    for (ConeShape& shape : ConeShapes(seen.front().rig->lamps.front())) {
      const double misfit = Misfit(shape, seen, shared);
      if (misfit > 1.0) continue;
      fits.emplace_back(
          misfit,
          RenderCause{std::move(shape.code), std::move(shape.message), std::exp(worst), {}});
    }
  }
  std::ranges::stable_sort(fits, {}, &std::pair<double, RenderCause>::first);
  for (auto& [misfit, cause] : fits) causes.push_back(std::move(cause));
  if (causes.empty()) {
    causes.push_back({"other_beam",
                      "right on the axis or wrong by one factor, but not off it, as no known cone "
                      "law has it: the lamp's aim, its turn about it, or its angles were changed",
                      std::exp(worst),
                      {}});
  }
  AddOthers(seen, causes);
  return causes;
}

// ---- panoramas ----

using Rgb3 = std::array<double, 3>;

Rgb3 PanoramaCard(const CheckedPanorama& panorama, std::size_t way, double turn_deg) {
  const double at = turn_deg * kTurnSteps / 360.0;
  const auto step = static_cast<std::size_t>(at);
  const double part = at - static_cast<double>(step);
  const Vec3& a = panorama.rgb_lx[way][step % kTurnSteps];
  const Vec3& b = panorama.rgb_lx[way][(step + 1) % kTurnSteps];
  Rgb3 out{};
  for (std::size_t c = 0; c < 3; ++c) {
    out[c] = (1.0 - part) * a[c] + part * b[c] + panorama.others_rgb_lx[c];
  }
  return out;
}

struct PanoramaMatch {
  std::size_t way = 0;
  double turn_deg = 0.0;
  double factor = 1.0;
  double misfit = 0.0;  // worst |ln| of a luminance or half that of a channel
};

PanoramaMatch MatchAt(std::span<const SeenRig> seen, std::size_t way, double turn_deg,
                      bool free_factor) {
  PanoramaMatch match{way, turn_deg, 1.0, 0.0};
  std::vector<Rgb3> want;
  double sum = 0.0;
  for (const SeenRig& one : seen) {
    want.push_back(PanoramaCard(*one.rig->panorama, way, turn_deg));
    sum += std::log(one.verdict->lux / std::max(1e-12, Rec709Luminance(want.back())));
  }
  if (free_factor) match.factor = std::exp(sum / static_cast<double>(seen.size()));
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const double lux = Rec709Luminance(want[i]) * match.factor;
    match.misfit =
        std::max(match.misfit, std::abs(std::log(seen[i].verdict->lux / std::max(1e-12, lux))));
    for (std::size_t c = 0; c < 3; ++c) {
      // Of the card's luminance: a channel that is nearly dark says little.
      const double off = seen[i].verdict->rgb_lx[c] - match.factor * want[i][c];
      match.misfit = std::max(match.misfit, 0.5 * std::abs(off) / std::max(1e-12, lux));
    }
  }
  return match;
}

PanoramaMatch BestTurn(std::span<const SeenRig> seen, std::size_t way, bool free_factor) {
  PanoramaMatch best = MatchAt(seen, way, 0.0, free_factor);
  for (int degree = 1; degree < 360; ++degree) {
    const PanoramaMatch match = MatchAt(seen, way, degree, free_factor);
    if (match.misfit < best.misfit) best = match;
  }
  return best;
}

RenderCause CauseOfTurn(const PanoramaMatch& match, std::size_t pictures) {
  const MistakenTurn turn = MistakenTurns()[match.way];
  std::string message(turn.message);
  if (match.turn_deg != 0.0) {
    message += match.way == 0 ? ", " : "; then turned, ";
    message += RoundedText(match.turn_deg, 3) +
               " degrees from its front to its right, seen from above clockwise";
  }
  if (pictures == 1) {
    message += ". One picture: others, whose cards face other ways, tell it from other causes";
  }
  return {"panorama_" + std::string(turn.word), std::move(message), match.factor, match.turn_deg};
}

std::vector<RenderCause> JudgePanorama(std::span<const SeenRig> seen) {
  if (MatchAt(seen, 0, 0.0, false).misfit < kNinth) {
    return {{"none", "as bright as the panorama makes it, and the right way round", 1.0, {}}};
  }
  std::vector<RenderCause> causes;
  const PanoramaMatch scaled = MatchAt(seen, 0, 0.0, true);
  if (scaled.misfit < kAlikePictures) {
    causes = CausesOfFactor(*seen.front().rig, scaled.factor);
    if (causes.front().code != "exposure_unlocked" || seen.size() > 2) return causes;
  }
  std::vector<PanoramaMatch> turns;
  for (std::size_t way = 0; way < kMistakenTurns; ++way) {
    PanoramaMatch match = BestTurn(seen, way, false);
    if (match.misfit >= kNinth && seen.size() > 1) match = BestTurn(seen, way, true);
    if (match.misfit < kNinth) turns.push_back(match);
  }
  std::ranges::stable_sort(turns, {}, &PanoramaMatch::misfit);
  std::vector<RenderCause> found;
  for (const PanoramaMatch& match : turns) found.push_back(CauseOfTurn(match, seen.size()));
  found.insert(found.end(), causes.begin(), causes.end());
  if (!found.empty()) return found;
  return {
      {"other_surroundings",
       "neither a factor nor a turned or mirrored panorama explains it: another picture, another "
       "light, or a sun left inside that nine harmonics cannot hold (take it out as a lamp)",
       scaled.factor,
       {}}};
}

// A fault of the picture itself, which says nothing of lamps.
bool OfThePicture(const RenderCause& cause) {
  constexpr std::array<std::string_view, 3> kCodes = {"not_srgb_encoded", "encoded_twice",
                                                      "tone_mapped"};
  return std::ranges::find(kCodes, cause.code) != kCodes.end();
}

}  // namespace

std::vector<RenderCause> ConeMistakes(const CheckedRig& rig) {
  std::vector<RenderCause> causes;
  if (rig.off_axis_deg == 0.0 || !OneSpot(rig)) return causes;
  const double measured = MeasuredOfAxial(rig);
  if (!(measured > 0.0)) return causes;
  for (ConeShape& shape : ConeShapes(rig.lamps.front())) {
    const double factor = OfAxial(shape.cone, rig) / measured;
    if (factor > 0.0) {
      causes.push_back({std::move(shape.code), std::move(shape.message), factor, {}});
    }
  }
  return causes;
}

std::optional<HungPanorama> FindHungPanorama(std::span<const SeenRig> seen) {
  constexpr std::size_t kFewest = 3;
  constexpr double kNearRight_deg = 4.0;
  PanoramaMatch best = MatchAt(seen, 0, 0.0, true);
  if (best.misfit >= kAlikePictures) {
    if (seen.size() < kFewest) return std::nullopt;
    for (std::size_t way = 0; way < kMistakenTurns; ++way) {
      const PanoramaMatch match = BestTurn(seen, way, true);
      if (match.misfit < best.misfit) best = match;
    }
    if (best.misfit >= kNinth) return std::nullopt;
    // Renderers turn by right angles; soft pictures tell them to a degree or two.
    const double right = 90.0 * std::round(best.turn_deg / 90.0);
    if (std::abs(best.turn_deg - right) < kNearRight_deg) {
      const PanoramaMatch match = MatchAt(seen, best.way, std::fmod(right, 360.0), true);
      if (match.misfit < std::max(kAlikePictures, 1.5 * best.misfit)) best = match;
    }
  }
  return HungPanorama{best.way, best.turn_deg, best.factor};
}

namespace {

std::vector<RenderCause> CausesOf(std::span<const SeenRig> seen) {
  // Off the axis a lamp that is turned tells the two cards apart, as a tone curve does.
  const bool on_axis =
      std::ranges::any_of(seen, [](const SeenRig& one) { return one.rig->off_axis_deg == 0.0; });
  for (const SeenRig& one : seen) {
    if (on_axis && one.rig->off_axis_deg != 0.0) continue;
    if (OfThePicture(one.verdict->cause)) return {one.verdict->cause};
  }
  if (std::ranges::all_of(seen, [](const SeenRig& one) { return one.rig->panorama.has_value(); })) {
    return JudgePanorama(seen);
  }
  std::vector<RenderCause> causes = JudgeLamps(seen);
  if (causes.empty()) causes = JudgeBeam(seen);
  return causes;
}

}  // namespace

std::vector<RenderCause> JudgeTogether(std::span<const SeenRig> seen) {
  std::vector<RenderCause> causes = CausesOf(seen);
  const auto furthest = std::ranges::max_element(seen, {}, [](const SeenRig& one) {
    const auto& color = one.verdict->color;
    return one.verdict->color_cause && color ? color->apart_uv / color->allowed_uv : 0.0;
  });
  if (causes.front().code == "none" && furthest->verdict->color_cause) {
    causes.front() = *furthest->verdict->color_cause;
  }
  NameLampsNotSeen(seen, causes.front());
  return causes;
}

}  // namespace lightcal
