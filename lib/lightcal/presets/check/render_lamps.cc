// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/check/render_lamps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

#include "lightcal/core/joined.h"
#include "lightcal/core/numbers_text.h"

namespace lightcal {
namespace {

constexpr double kSeenShare = 0.2;   // a tenth of such a lamp moves its cards by 2 %
constexpr double kOwnPicture = 0.5;  // its factor is told from it

// E_pk/E_p; 0 where the file does not say.
double ShareOf(std::size_t lamp, const SeenRig& seen) {
  const std::vector<double>& shares = seen.rig->lamp_shares;
  return lamp < shares.size() ? shares[lamp] : 0.0;
}

const SeenRig* OwnPictureOf(std::size_t lamp, std::span<const SeenRig> seen) {
  const auto most =
      std::ranges::max_element(seen, {}, [&](const SeenRig& one) { return ShareOf(lamp, one); });
  return ShareOf(lamp, *most) > kOwnPicture ? &*most : nullptr;
}

double SeenOfExpected(const SeenRig& seen) { return seen.verdict->lux / seen.verdict->expected_lx; }

double Foretold(const SeenRig& seen, const std::vector<double>& factors) {
  double sum = 0.0;
  for (std::size_t k = 0; k < factors.size(); ++k) sum += factors[k] * ShareOf(k, seen);
  return sum;
}

struct ToldLamp {
  std::size_t lamp = 0;
  const SeenRig* own = nullptr;
  double factor = 1.0;

  [[nodiscard]] const std::string& name() const { return own->rig->lamps[lamp].name; }
  [[nodiscard]] double LooseLn() const { return kAlikePictures / ShareOf(lamp, *own); }
  [[nodiscard]] bool IsRight() const {
    return factor > 0.0 && std::abs(std::log(factor)) < LooseLn();
  }
};

std::vector<ToldLamp> ToldLamps(std::span<const SeenRig> seen) {
  std::vector<ToldLamp> told;
  const std::size_t count = seen.front().rig->lamps.size();
  for (std::size_t k = 0; k < count; ++k) {
    if (const SeenRig* own = OwnPictureOf(k, seen)) told.push_back({k, own});
  }
  // Each lamp gives more than half of its picture's light: the sweeps converge.
  constexpr int kSweeps = 500;
  std::vector<double> factors(count, 1.0);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (const ToldLamp& one : told) {
      double& factor = factors[one.lamp];
      const double rest = SeenOfExpected(*one.own) - Foretold(*one.own, factors);
      factor = std::max(0.0, factor + rest / ShareOf(one.lamp, *one.own));
    }
  }
  for (ToldLamp& one : told) one.factor = factors[one.lamp];
  const bool explained = std::ranges::all_of(seen, [&](const SeenRig& one) {
    const double foretold = Foretold(one, factors);
    return foretold > 0.0 && std::abs(std::log(SeenOfExpected(one) / foretold)) < kAlikePictures;
  });
  if (!explained) told.clear();
  return told;
}

std::string NamesOf(const std::vector<ToldLamp>& lamps) {
  return Joined(lamps, ", ", [](const ToldLamp& one) { return one.name(); });
}

// A mistake of exposure or of a picture's unit makes every lamp brighter alike.
bool OfAllLamps(const RenderCause& cause) {
  constexpr std::array<std::string_view, 4> kCodes = {"exposure_unlocked", "exposure_missing",
                                                      "ev100_calibration", "over_683"};
  return std::ranges::find(kCodes, cause.code) != kCodes.end();
}

// Of one lamp that is wrong; whether others are right tells exposure from intensity.
RenderCause CauseOf(const ToldLamp& lamp, bool others_are_right) {
  if (!(lamp.factor > 0.0)) {
    return {"lamp_missing", lamp.name() + " does not shine", 0.0, {}};
  }
  std::vector<RenderCause> causes = CausesOfFactor(*lamp.own->rig, lamp.factor);
  if (others_are_right) {
    std::erase_if(causes, OfAllLamps);
    causes.push_back({"other_intensity",
                      "no known mistake has this factor: its intensity was changed",
                      lamp.factor,
                      {}});
  }
  RenderCause cause = std::move(causes.front());
  cause.message = lamp.name() + " gives " + RoundedText(lamp.factor, 3) +
                  " times what was measured: " + cause.message;
  return cause;
}

}  // namespace

std::vector<std::string> LampsNotSeen(std::span<const SeenRig> seen) {
  std::vector<std::string> names;
  const CheckedRig& rig = *seen.front().rig;
  for (std::size_t k = 0; k < rig.lamp_shares.size(); ++k) {
    const bool shows = std::ranges::any_of(
        seen, [&](const SeenRig& one) { return ShareOf(k, one) >= kSeenShare; });
    if (!shows) names.push_back(rig.lamps[k].name);
  }
  return names;
}

void NameLampsNotSeen(std::span<const SeenRig> seen, RenderCause& cause) {
  if (cause.code != "none") return;
  const std::vector<std::string> names = LampsNotSeen(seen);
  if (names.empty()) return;
  cause.message += ". Of " + Joined(names) +
                   " that says nothing, for others light these cards: export a rig before " +
                   (names.size() == 1 ? "it" : "each") + " ({preset.rig_at} " + names.front() +
                   ") and give its picture, too";
}

std::vector<RenderedLamp> RenderedLamps(std::span<const SeenRig> seen) {
  std::vector<RenderedLamp> factors;
  for (const ToldLamp& one : ToldLamps(seen)) factors.push_back({one.name(), one.factor});
  return factors;
}

std::vector<RenderCause> JudgeLamps(std::span<const SeenRig> seen) {
  const std::vector<ToldLamp> told = ToldLamps(seen);
  if (told.empty()) return {};
  std::vector<ToldLamp> right, wrong;
  for (const ToldLamp& one : told) (one.IsRight() ? right : wrong).push_back(one);
  if (wrong.empty()) {
    return {{"none", "as bright as the meter says: " + NamesOf(right), 1.0, {}}};
  }
  const auto [least, most] = std::ranges::minmax(wrong, {}, &ToldLamp::factor);
  const bool shared = right.empty() && wrong.size() > 1 && least.factor > 0.0 &&
                      std::log(most.factor / least.factor) < least.LooseLn() + most.LooseLn();
  if (shared) return CausesOfFactor(*most.own->rig, std::sqrt(least.factor * most.factor));
  const auto off = [](const ToldLamp& one) {
    return one.factor > 0.0 ? std::abs(std::log(one.factor)) : 1e3;
  };
  std::ranges::stable_sort(wrong, std::ranges::greater(), off);
  RenderCause cause = CauseOf(wrong.front(), !right.empty());
  for (std::size_t i = 1; i < wrong.size(); ++i) {
    cause.message += "; " + CauseOf(wrong[i], !right.empty()).message;
  }
  if (!right.empty()) cause.message += ". As measured: " + NamesOf(right);
  return {std::move(cause)};
}

}  // namespace lightcal
