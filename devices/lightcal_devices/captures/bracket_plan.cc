// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/captures/bracket_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "lightcal/photometry/exposure_grid.h"

namespace lightcal::devices {
namespace {

constexpr double kShortest = 1e-5, kLongest = 3600.0;
constexpr double kThird = 1.0 / 3.0;
constexpr double kCoarsest = 0.2;    // rounding of a label that still means one dial position
constexpr double kLeastStep = 0.33;  // "0.33EV" is meant as a third
constexpr double kMostRange = 20.0, kMostFrames = 61.0;
constexpr double kSlack = 1e-6;  // EV

std::string WithPoint(std::string_view label) {
  std::string text = LowerAscii(TrimBlanks(label));
  std::ranges::replace(text, ',', '.');
  return text;
}

// The label without the words for seconds.
std::string_view WithoutUnit(std::string_view text) {
  for (const std::string_view unit : {"seconds", "sec", "s", "\""}) {
    if (text.ends_with(unit)) return TrimBlanks(text.substr(0, text.size() - unit.size()));
  }
  return text;
}

double RoundingOf(std::string_view number) {
  const auto point = number.find('.');
  if (point == std::string_view::npos) return 0.0;
  return 0.5 * std::pow(10.0, -static_cast<double>(number.size() - point - 1));
}

// The only 2^(k/3) s within the rounding of a time.
std::optional<Seconds> ThirdStopWithin(double time, double rounding) {
  constexpr double kDigitSlack = 1.0 + 1e-9;
  const auto lowest = std::ceil(3.0 * std::log2(std::max(time - rounding * kDigitSlack, 1e-9)));
  const auto highest = std::floor(3.0 * std::log2(time + rounding * kDigitSlack));
  if (lowest != highest) return std::nullopt;
  return Seconds(std::exp2(lowest / 3.0));
}

std::optional<double> NumberAfter(std::string_view label, std::string_view word) {
  const std::string text = WithPoint(label);
  std::string_view rest = text;
  if (rest.starts_with(word)) rest = TrimBlanks(rest.substr(word.size()));
  const auto number = ParseNumber(rest);
  if (!number || !(*number > 0.0)) return std::nullopt;
  return number;
}

struct Candidate {
  std::string label;
  ShutterTime time;
  double ev = 0.0;
  double flicker = 0.0;
  bool used = false;
};

std::vector<Candidate> CandidatesOf(const std::vector<std::string>& choices, Seconds centre,
                                    const BracketRange& range) {
  std::vector<Candidate> candidates;
  for (const std::string& label : choices) {
    const auto time = TimeOfChoice(label);
    if (!time) continue;
    Candidate candidate{label, *time, std::log2(time->time / centre)};
    for (const LampFlicker& lamp : range.lamps) {
      candidate.flicker = std::max(candidate.flicker, WorstFlickerError(lamp, time->time));
    }
    candidates.push_back(std::move(candidate));
  }
  return candidates;
}

Candidate* NearestTo(double ev, double reach, bool safe, std::vector<Candidate>& candidates) {
  Candidate* nearest = nullptr;
  for (Candidate& candidate : candidates) {
    const double distance = std::abs(candidate.ev - ev);
    if (candidate.used || distance > reach + kSlack) continue;
    if (safe && candidate.flicker > kFlickerSafe) continue;
    if (nearest == nullptr || distance < std::abs(nearest->ev - ev) - kSlack) nearest = &candidate;
  }
  return nearest;
}

void WarnOfFlicker(const std::vector<PlannedFrame>& frames, Warnings& warnings) {
  std::string unsafe;
  double worst = 0.0;
  for (const PlannedFrame& frame : frames) {
    if (frame.flicker <= kFlickerSafe) continue;
    unsafe += (unsafe.empty() ? "" : ", ") + frame.shutter;
    worst = std::max(worst, frame.flicker);
  }
  if (unsafe.empty()) return;
  warnings.push_back({"flicker_unsafe_shutter", unsafe,
                      "no whole periods of the lamp: off by up to " + PercentText(worst) +
                          ", as it happens; a smaller aperture or a neutral filter lets all "
                          "times be longer"});
}

}  // namespace

std::optional<ShutterTime> TimeOfChoice(std::string_view label) {
  const std::string text = WithPoint(label);
  const std::string_view number = WithoutUnit(text);
  const auto slash = number.find('/');
  const auto above = ParseNumber(number.substr(0, slash));
  const auto below =
      slash == std::string_view::npos ? std::optional(1.0) : ParseNumber(number.substr(slash + 1));
  if (!above || !below || !(*below > 0.0)) return std::nullopt;
  const double time = *above / *below;
  if (!(time >= kShortest && time <= kLongest)) return std::nullopt;
  const double rounding = slash == std::string_view::npos ? RoundingOf(number) : 0.0;
  const auto on_dial = rounding <= kCoarsest * time ? TimeOfLabel(Seconds(time)) : std::nullopt;
  if (on_dial) return ShutterTime{*on_dial, Seconds(rounding)};
  if (const auto only = ThirdStopWithin(time, rounding))
    return ShutterTime{*only, Seconds(rounding)};
  return ShutterTime{Seconds(time), Seconds(rounding)};
}

std::optional<double> FNumberOfChoice(std::string_view label) { return NumberAfter(label, "f/"); }

std::optional<double> IsoOfChoice(std::string_view label) { return NumberAfter(label, "iso"); }

std::optional<std::string> RawFormat(const std::vector<std::string>& choices) {
  constexpr std::array<std::string_view, 4> kRawWords = {"raw", "nef", "arw", "dng"};
  // Smaller or lossy kinds of RAW, and JPEG besides.
  constexpr std::array<std::string_view, 7> kLesserWords = {"craw",  "mraw",   "sraw", "compressed",
                                                            "small", "medium", "c-raw"};
  const auto has = [](const std::string& text, std::string_view word) {
    return text.find(word) != std::string::npos;
  };
  const auto has_any = [&](const std::string& text, const auto& words) {
    return std::ranges::any_of(words, [&](std::string_view word) { return has(text, word); });
  };
  std::optional<std::string> best;
  int best_rank = 0;
  for (const std::string& choice : choices) {
    const std::string text = LowerAscii(choice);
    if (!has_any(text, kRawWords)) continue;
    const bool lesser = has_any(text, kLesserWords) && !has(text, "uncompressed");
    const int rank = 1 + (has(text, "+") ? 0 : 2) + (lesser ? 0 : 1);
    if (rank <= best_rank) continue;
    best = choice;
    best_rank = rank;
  }
  return best;
}

Result<BracketRange> ParseBracket(std::string_view text) {
  const auto wrong = [&] {
    return WrongUsage("{shoot.bracket} " + std::string(text),
                      "give half the range and the step: ±4EV/1EV is nine frames 1 EV apart");
  };
  std::string_view rest = TrimBlanks(text);
  for (const std::string_view sign : {"±", "+-", "+/-"}) {
    if (rest.starts_with(sign)) rest.remove_prefix(sign.size());
  }
  const auto slash = rest.find('/');
  if (slash == std::string_view::npos) return wrong();
  std::array<double, 2> values{};
  const std::array<std::string_view, 2> parts = {rest.substr(0, slash), rest.substr(slash + 1)};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string part = WithPoint(parts[i]);
    std::string_view number = part;
    if (number.ends_with("ev")) number = TrimBlanks(number.substr(0, number.size() - 2));
    // "1/3EV" of the step: its slash is a fraction.
    const auto fraction = number.find('/');
    const auto above = ParseNumber(number.substr(0, fraction));
    const auto below = fraction == std::string_view::npos
                           ? std::optional(1.0)
                           : ParseNumber(number.substr(fraction + 1));
    if (!above || !below || !(*below > 0.0)) return wrong();
    values[i] = *above / *below;
  }
  const auto [half, step] = std::pair(values[0], values[1]);
  if (!(step >= kLeastStep && half >= step - kSlack && half <= kMostRange) ||
      2.0 * half / step + 1.0 > kMostFrames + kSlack) {
    return wrong();
  }
  return BracketRange{half, step, {}};
}

Result<BracketPlan> PlanBracket(const std::vector<std::string>& choices, Seconds centre,
                                const BracketRange& range) {
  std::vector<Candidate> candidates = CandidatesOf(choices, centre, range);
  const int each_way = static_cast<int>(std::floor(range.half_range_ev / range.step_ev + kSlack));
  BracketPlan plan;
  std::string missing;
  for (int i = -each_way; i <= each_way; ++i) {
    const double target = i * range.step_ev;
    Candidate* chosen = NearestTo(target, range.step_ev * kThird, true, candidates);
    if (chosen == nullptr) chosen = NearestTo(target, range.step_ev / 2.0, false, candidates);
    if (chosen == nullptr) {
      missing += (missing.empty() ? "" : ", ") + RoundedText(target, 2) + " EV";
      continue;
    }
    chosen->used = true;
    plan.frames.push_back({chosen->label, chosen->time, chosen->ev, chosen->flicker});
  }
  if (plan.frames.size() < 2) {
    return Refused(
        "no_bracket", "{shoot.bracket}",
        "the camera offers no two shutter times for it; name another {shoot.center}, or a "
        "smaller range or step");
  }
  std::ranges::stable_sort(plan.frames, {}, [](const PlannedFrame& f) { return f.ev; });
  if (!missing.empty()) {
    plan.warnings.push_back(
        {"bracket_clipped", missing,
         "the camera has no shutter time there; " + std::to_string(plan.frames.size()) +
             " frames are left. Another "
             "{shoot.center}, {shoot.aperture} or {shoot.iso} moves the range"});
  }
  WarnOfFlicker(plan.frames, plan.warnings);
  return plan;
}

}  // namespace lightcal::devices
