// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/locate/mistyped.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"

namespace lightcal::fit {
namespace {

// Judgement: how often people err so. What is left of 1 is any other mistake.
constexpr double kDigitShare = 0.2, kSignShare = 0.1, kPointShare = 0.1, kFeetShare = 0.1,
                 kAxesShare = 0.1, kLuxDigitShare = 0.1, kLuxPointShare = 0.05,
                 kFootCandleShare = 0.05;

constexpr int kWaysOfDigits = 29;  // of three: nine others each, and two pairs

// The number with one of its first three digits another, or two of them the other way round.
std::vector<double> ByDigits(double value) {
  constexpr int kDigits = 3;
  const std::string text = ShortestText(value);
  std::vector<double> out;
  const auto add = [&](const std::string& changed) {
    const auto number = ParseNumber(changed);
    if (number && *number != value) out.push_back(*number);
  };
  std::optional<std::size_t> before;
  int seen = 0;
  for (std::size_t i = 0; i < text.size() && seen < kDigits; ++i) {
    if (text[i] == 'e') break;
    if (std::isdigit(static_cast<unsigned char>(text[i])) == 0) continue;
    ++seen;
    std::string changed = text;
    for (char digit = '0'; digit <= '9'; ++digit) {
      changed[i] = digit;
      add(changed);
    }
    if (before) {
      changed = text;
      std::swap(changed[*before], changed[i]);
      add(changed);
    }
    before = i;
  }
  return out;
}

class CorrectionList {
 public:
  explicit CorrectionList(const Observation& reading) : reading_(reading) {}

  // Places that one kind of mistake, which can be made in so many ways, may have made of the true
  // one.
  void AddPlaces(double share, int ways, const std::vector<std::pair<Vec3, std::string>>& places) {
    for (const auto& [place, text] : places) out_.push_back({place, 1.0, share / ways, text});
  }
  void AddLux(double share, int ways, const std::vector<double>& values) {
    for (const double lux : values) {
      if (!(lux > 0.0)) continue;
      out_.push_back({*reading_.position_m, lux / reading_.raw_lx, share / ways,
                      RoundedText(lux, 4) + " lx rather than " + RoundedText(reading_.raw_lx, 4)});
    }
  }
  [[nodiscard]] std::vector<Correction> Take() { return std::move(out_); }

 private:
  const Observation& reading_;
  std::vector<Correction> out_;
};

std::string Rather(std::size_t axis, double metres, double typed) {
  constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};
  const auto text = [](double m) { return ShortestText(std::round(1e4 * m) / 1e4); };
  return std::string(kAxes[axis]) + " = " + text(metres) + " m rather than " + text(typed);
}

}  // namespace

std::vector<Correction> CorrectionsOf(const Observation& reading) {
  if (!reading.position_m) return {};
  const Vec3& typed = *reading.position_m;
  std::vector<std::pair<Vec3, std::string>> digits, signs, points, feet, axes;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto put = [&](std::vector<std::pair<Vec3, std::string>>& list, double metres) {
      Vec3 place = typed;
      place[k] = metres;
      list.emplace_back(place, Rather(k, metres, typed[k]));
    };
    for (const double metres : ByDigits(typed[k])) put(digits, metres);
    if (const std::size_t next = (k + 1) % 3; typed[k] != typed[next]) {
      Vec3 place = typed;
      std::swap(place[k], place[next]);
      axes.emplace_back(
          place, Rather(k, place[k], typed[k]) + " and " + Rather(next, place[next], typed[next]));
    }
    if (typed[k] == 0.0) continue;
    put(signs, -typed[k]);
    for (const double power : {0.1, 10.0, 0.01, 0.001}) put(points, power * typed[k]);
    put(feet, kMetresPerFoot * typed[k]);
  }
  feet.emplace_back(typed * kMetresPerFoot, "its place in feet");
  CorrectionList out(reading);
  out.AddPlaces(kDigitShare, 3 * kWaysOfDigits, digits);
  out.AddPlaces(kSignShare, 3, signs);
  out.AddPlaces(kPointShare, 12, points);
  out.AddPlaces(kFeetShare, 4, feet);
  out.AddPlaces(kAxesShare, 3, axes);
  if (!reading.differenced && !reading.ambient_subtracted && reading.raw_lx > 0.0) {
    out.AddLux(kLuxDigitShare, kWaysOfDigits, ByDigits(reading.raw_lx));
    out.AddLux(kLuxPointShare, 2, {0.1 * reading.raw_lx, 10.0 * reading.raw_lx});
    out.AddLux(kFootCandleShare, 1, {kLuxPerFootcandle * reading.raw_lx});
  }
  return out.Take();
}

}  // namespace lightcal::fit
