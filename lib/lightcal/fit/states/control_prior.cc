// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/states/control_prior.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace lightcal::fit {
namespace {

constexpr double kConstantVariance = 25.0;

// How far each target may go for one unit of the rests' sizes, and by the slopes' priors.
struct TargetScale {
  double level_rest, other_rest, joint_rest;
  double level_slope, other_slope;
};
constexpr std::array<TargetScale, 3> kScales = {
    {{1.0, 1.0, 1.0, 0.0, 0.5}, {0.2, 0.4, 0.3, 0.3, 0.3}, {0.05, 0.03, 0.05, 0.002, 0.004}}};
// How far an S-curve's two ends differ, and how often a dimmer has one beside each of the others.
constexpr double kPowerOfS = 0.15;
constexpr double kWeightOfS = 0.3;
constexpr double kOtherLength = 0.45;  // of a control's range
// A dimmer's logarithmic label runs as far as the logarithm of one from .05, so that the rests'
// lengths count alike. Two to three decades are a power of 1.5 to 2.3.
constexpr double kSpanOfLogarithmic = 3.0;
constexpr double kPowerOfLogarithmic = 1.8, kPowerSdOfLogarithmic = 0.5;
constexpr double kWeightOfLogarithmic = 0.35;  // beside all straight lines
constexpr double kPowerOfZoom = -1.0, kPowerSdOfZoom = 1.0;
// Of panels that fade from a warm channel to a cool one, half way between the outermost labels read
// (0 at both, a parabola of ln label between): ln of their light (both channels full there: twice,
// or one power shared: none more), and of their mireds over the square of ln of the labels' ratio
// (a share linear in kelvin is warmer than its label by .19, one linear in mireds is about it;
// channels of unequal light by .1 more or less). Mean and 1 sigma.
constexpr double kLightOfFade = 0.28, kLightSdOfFade = 0.24;
constexpr double kMiredOfFade = 0.09, kMiredSdOfFade = 0.10;
// How far from label 0 a dimmer's light begins, or what is left of it there: a Cauchy density of
// this scale, for half of them within 6 %, a tenth beyond 38 %.
constexpr double kZeroScale = 0.06;
double ZeroDensity(double zero) {
  return kZeroScale / (std::numbers::pi * (kZeroScale * kZeroScale + zero * zero));
}

const TargetScale& ScaleOf(CurveTarget target) { return kScales[static_cast<std::size_t>(target)]; }

double Matern(double distance, double length) {
  const double r = std::sqrt(3.0) * std::abs(distance) / length;
  return (1.0 + r) * std::exp(-r);
}

// A driver's output in pieces of straight line: its slope walks at random from label 0 (integrated
// Brownian motion, Rasmussen and Williams 6.3), by this many times the rest's size up to full; over
// the output itself, which turns it into a part of it.
constexpr double kSlopeOfRest = 6.5;
double Kinks(double a, double b, double output_a, double output_b) {
  const double s = std::min(a, b);
  const double t = std::max(a, b);
  return kSlopeOfRest * kSlopeOfRest * s * s * (3.0 * t - s) / 6.0 / (output_a * output_b);
}

// Of size 1, of the level i.
double RestOfLevel(const LevelForm& form, const Rests& rests, const Seen& a, const Seen& b,
                   std::size_t i) {
  if (!rests.by_label) return Matern(a.along[i] - b.along[i], rests.level_length);
  if (static_cast<int>(i) != form.control || form.logarithmic) {
    return Matern(a.labels[i] - b.labels[i], rests.level_length);
  }
  return Kinks(a.labels[i], b.labels[i], std::exp(a.ln_level), std::exp(b.ln_level));
}

// ln S(y) but for a constant, and its derivative by the zero.
struct OfLevel {
  double ln = 0.0;
  double by_zero = 0.0;
};
OfLevel FormedLevel(double label, const LevelForm& form) {
  constexpr double kLeast = 1e-6;
  if (form.logarithmic) return {kSpanOfLogarithmic * label, 0.0};
  if (form.bend == 1.0) {
    const double above = std::max(kLeast, label + form.zero);
    return {std::log(above), 1.0 / above};
  }
  const double y = std::clamp((label + form.zero) / (1.0 + form.zero), kLeast, 1.0);
  const double up = std::pow(y, form.bend);
  const double s = up / (up + std::pow(1.0 - y, form.bend));
  return {std::log(s), form.bend * (1.0 - s) / (y * (1.0 + form.zero))};
}

}  // namespace

ControlPrior::ControlPrior(std::vector<ControlKind> kinds, CurveTarget target,
                           const std::vector<CurvePoint>& points)
    : kinds_(std::move(kinds)), target_(target) {
  for (std::size_t i = 0; i < kinds_.size(); ++i) {
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    double sum = 0.0;
    for (const CurvePoint& point : points) {
      const double along = Plain(i, point.at[i]);
      least = std::min(least, along);
      most = std::max(most, along);
      sum += along;
    }
    least_along_.push_back(least);
    middle_.push_back(sum / static_cast<double>(points.size()));
    span_.push_back(most > least ? most - least : 1.0);
  }
  if (!HasLevels()) return;
  const auto level = std::ranges::find(kinds_, ControlKind::kLevel);
  formed_ = static_cast<std::size_t>(level - kinds_.begin());
  least_ = std::numeric_limits<double>::infinity();
  for (const CurvePoint& point : points) least_ = std::min(least_, point.at[formed_]);
}

double ControlPrior::Faded(std::size_t control, double along) const {
  if (kinds_[control] != ControlKind::kTemperature) return 0.0;
  const double inside = (along - least_along_[control]) / span_[control];
  return 4.0 * inside * (1.0 - inside);
}

ControlPrior::Fade ControlPrior::FadeOf(std::size_t control) const {
  if (target_ == CurveTarget::kLnLight) return {kLightOfFade, kLightSdOfFade};
  if (target_ != CurveTarget::kLnMired) return {};
  const double square = span_[control] * span_[control];
  return {kMiredOfFade * square, kMiredSdOfFade * square};
}

double ControlPrior::Plain(std::size_t control, double label) const {
  switch (kinds_[control]) {
    case ControlKind::kLevel:
      return std::log(label + kLevelFloor);
    case ControlKind::kTemperature:
      return std::log(1e6 / label);
    case ControlKind::kZoom:
      return std::log(label);
    case ControlKind::kOther:
      break;
  }
  return label;
}

Seen ControlPrior::See(const std::vector<double>& labels, const LevelForm& form) const {
  Seen out;
  out.labels = labels;
  for (std::size_t i = 0; i < kinds_.size(); ++i) {
    const bool formed = static_cast<int>(i) == form.control;
    double along = Plain(i, labels[i]);
    if (formed) {
      const OfLevel level = FormedLevel(labels[i], form);
      along = out.ln_level = level.ln;
      out.by_zero = form.power * level.by_zero;
      out.mean += form.power * out.ln_level;
    } else if (kinds_[i] == ControlKind::kLevel) {
      if (target_ == CurveTarget::kLnLight) out.mean += along;
    } else {
      if (kinds_[i] == ControlKind::kTemperature && target_ == CurveTarget::kLnMired) {
        out.mean += along;
      } else if (kinds_[i] == ControlKind::kZoom && target_ == CurveTarget::kLnLight) {
        out.mean += kPowerOfZoom * along;
      }
      const double faded = Faded(i, along);
      out.mean += FadeOf(i).mean * faded;
      out.faded += FadeOf(i).sd * faded;
      along = (along - middle_[i]) / span_[i];
    }
    out.along.push_back(along);
  }
  return out;
}

double ControlPrior::LevelRest(const LevelForm& form, const Rests& rests, const Seen& a,
                               const Seen& b) const {
  const double by = ScaleOf(target_).level_rest;
  double sum = 0.0;
  for (std::size_t i = 0; i < kinds_.size(); ++i) {
    if (kinds_[i] == ControlKind::kLevel) sum += by * by * RestOfLevel(form, rests, a, b, i);
  }
  return sum;
}

double ControlPrior::OtherRest(const Seen& a, const Seen& b) const {
  const double by = ScaleOf(target_).other_rest;
  double sum = 0.0;
  for (std::size_t i = 0; i < kinds_.size(); ++i) {
    if (kinds_[i] != ControlKind::kLevel) sum += Matern(a.along[i] - b.along[i], kOtherLength);
  }
  return by * by * sum;
}

double ControlPrior::JointRest(const Seen& a, const Seen& b) const {
  const double by = ScaleOf(target_).joint_rest;
  double product = by * by;
  for (std::size_t i = 0; i < kinds_.size(); ++i) {
    const double length = kinds_[i] == ControlKind::kLevel ? 1.5 : 0.7;
    product *= Matern(a.along[i] - b.along[i], length);
  }
  return product;
}

double ControlPrior::Covariance(const LevelForm& form, const Rests& rests, const Seen& a,
                                const Seen& b) const {
  const TargetScale& by = ScaleOf(target_);
  const double level = by.level_rest * rests.level;
  double sum = kConstantVariance + a.faded * b.faded;
  for (std::size_t i = 0; i < kinds_.size(); ++i) {
    const double u = a.along[i];
    const double v = b.along[i];
    const bool is_level = kinds_[i] == ControlKind::kLevel;
    if (!is_level) {
      const bool zoomed = kinds_[i] == ControlKind::kZoom && target_ == CurveTarget::kLnLight;
      const double slope = zoomed ? kPowerSdOfZoom * span_[i] : by.other_slope;
      sum += slope * slope * u * v;
    } else if (static_cast<int>(i) == form.control) {
      sum += form.power_sd * form.power_sd * a.ln_level * b.ln_level +
             form.step * form.step * a.by_zero * b.by_zero;
    } else {
      sum += by.level_slope * by.level_slope * u * v;
    }
    if (is_level && level > 0.0) sum += level * level * RestOfLevel(form, rests, a, b, i);
  }
  if (rests.other > 0.0) sum += rests.other * rests.other * OtherRest(a, b);
  if (rests.joint > 0.0) sum += rests.joint * rests.joint * JointRest(a, b);
  return sum;
}

bool ControlPrior::HasLevels() const {
  return std::ranges::find(kinds_, ControlKind::kLevel) != kinds_.end();
}

bool ControlPrior::HasOthers() const {
  return std::ranges::any_of(kinds_, [](ControlKind kind) { return kind != ControlKind::kLevel; });
}

std::vector<LevelForm> ControlPrior::Forms() const {
  if (target_ != CurveTarget::kLnLight || !HasLevels()) return {LevelForm{}};
  const int control = static_cast<int>(formed_);
  const double smallest = std::max(least_, 0.01);
  std::vector<LevelForm> forms;
  double straight = 0.0;
  constexpr double kLnStep = 0.2;
  const double end = std::log(12.0 * smallest + 0.3);
  for (double ln = std::log(std::max(0.04 * smallest, 2e-3)); ln < end; ln += kLnStep) {
    const double above = std::exp(ln);
    const double zero = above - least_;
    const double weight = ZeroDensity(zero) * above * kLnStep;
    straight += weight;
    const double step = 0.5 * kLnStep * above;
    forms.push_back({control, false, 1.0, zero, step, 1.0, 0.02, weight});
    forms.push_back({control, false, 1.0, zero, step, 2.0, 1.2, 0.5 * weight});
  }
  constexpr double kLnStepOfS = 0.4;
  for (double ln = std::log(0.1 * smallest); ln < std::log(2.0 * smallest); ln += kLnStepOfS) {
    const double above = std::exp(ln);
    const double zero = above - least_;
    const double weight = kWeightOfS * ZeroDensity(zero) * above * kLnStepOfS;
    for (const double bend : {1.25, 1.5, 1.75, 2.1}) {
      forms.push_back(
          {control, false, bend, zero, 0.5 * kLnStepOfS * above, 1.0, kPowerOfS, weight});
    }
  }
  forms.push_back({control, true, 1.0, 0.0, 0.0, kPowerOfLogarithmic, kPowerSdOfLogarithmic,
                   kWeightOfLogarithmic * straight});
  return forms;
}

// Of the levels alone. Drivers bend at labels; what lamps do goes with the logarithm. A driver's
// knee between two states that were read shows in neither (a law through three has nothing left to
// be judged by), so that what bends at once counts as much as all that is smooth: of knees between
// three to seven states 94 % are held. Four states or more that lie on a law outweigh it.
std::vector<Rests> ControlPrior::LevelRests() const {
  if (!HasLevels()) return {Rests{}};
  using Sizes = std::vector<std::pair<double, double>>;  // size, weight
  const bool light = target_ == CurveTarget::kLnLight;
  const Sizes smooth = {{0.003, 0.7}, {0.012, 1.5}, {0.03, 3.0}, {0.1, 0.6}, {0.3, 0.15}};
  const Sizes sudden = {{0.003, 0.7}, {0.012, 1.5}, {0.03, 3.0}, {0.1, 0.6}, {0.3, 3.0}};
  const Sizes bends = {{0.003, 0.7}, {0.012, 1.5}, {0.03, 3.0}, {0.1, 4.8}, {0.3, 9.0}, {0.8, 6.0}};
  std::vector<Rests> out;
  const auto add = [&](double length, bool by_label, const Sizes& sizes) {
    for (const auto& [size, weight] : sizes) {
      out.push_back({size, length, by_label, 0.0, 0.0, weight});
    }
  };
  add(0.25, false, light ? sudden : smooth);
  add(1.5, false, smooth);
  add(0.3, true, light ? bends : smooth);
  return out;
}

std::vector<Rests> ControlPrior::AllRests() const {
  using Sized = std::pair<double, double>;  // size, weight
  const std::vector<Sized> none = {{0.0, 1.0}};
  const std::vector<Sized> other_sizes =
      HasOthers() ? std::vector<Sized>{{0.008, 1.0}, {0.04, 2.0}, {0.16, 2.0}, {0.4, 0.7}} : none;
  const std::vector<Sized> joint_sizes =
      HasMany() ? std::vector<Sized>{{0.002, 1.5}, {0.015, 1.0}} : none;
  std::vector<Rests> out;
  for (const Rests& level : LevelRests()) {
    for (const auto& [b, by_b] : other_sizes) {
      for (const auto& [c, by_c] : joint_sizes) {
        out.push_back(level);
        out.back().other = b;
        out.back().joint = c;
        out.back().weight *= by_b * by_c;
      }
    }
  }
  return out;
}

}  // namespace lightcal::fit
