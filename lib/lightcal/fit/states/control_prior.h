// SPDX-License-Identifier: Apache-2.0
// What is known of a control curve (control_curve.h) before any state was read: hypotheses of how a
// lamp's number runs along its controls, each a Gaussian process.
// Internal to this room.
#pragma once

#include <cstddef>
#include <vector>

#include "lightcal/fit/states/control_curve.h"

namespace lightcal::fit {

// Colour against a level: the logarithm's zero, so that a label of 0 has a place.
inline constexpr double kLevelFloor = 0.03;

// ln E = power ln S(y), y = (x + zero) / (1 + zero) of one level x; the zero within step, the power
// within power_sd. S(y) = y^bend / (y^bend + (1 - y)^bend): y itself, or an S-curve about its
// middle (a smooth step y^2 (3 - 2y) and a raised cosine have a bend of 1.5 to 1.7 everywhere).
// Or, logarithmic, ln E = power kSpanOfLogarithmic x: equal steps are equal ratios (IEC 62386-102,
// 9.3: 10^(3 (x - 1))), as of other such dimmers of 2 to 3 decades.
struct LevelForm {
  int control = -1;
  bool logarithmic = false;
  double bend = 1.0;
  double zero = kLevelFloor;
  double step = 0.0;
  double power = 0.0, power_sd = 0.0;
  double weight = 1.0;
};

struct Rests {
  double level = 0.0, level_length = 1.0;
  bool by_label = false;  // along the label itself, not its logarithm; of light, kinks
  double other = 0.0;
  double joint = 0.0;
  double weight = 1.0;
};

// A point's labels as one hypothesis sees them.
struct Seen {
  std::vector<double> along;   // one coordinate a control
  std::vector<double> labels;  // as they were said
  double mean = 0.0;
  double ln_level = 0.0, by_zero = 0.0;  // of the formed level
  double faded = 0.0;                    // what a fade between two channels may add, 1 sigma
};

// The hypotheses of one set of controls and points.
class ControlPrior {
 public:
  ControlPrior(std::vector<ControlKind> kinds, CurveTarget target,
               const std::vector<CurvePoint>& points);

  // Zeros a fifth of (x_min + zero) apart, and bends of S-curves; within a step the likeliest is
  // found by the solve.
  [[nodiscard]] std::vector<LevelForm> Forms() const;
  // Every combination of the rests' sizes and lengths, weighted.
  [[nodiscard]] std::vector<Rests> AllRests() const;

  [[nodiscard]] Seen See(const std::vector<double>& labels, const LevelForm& form) const;

  // Of the process under a form and its rests, between two points.
  [[nodiscard]] double Covariance(const LevelForm& form, const Rests& rests, const Seen& a,
                                  const Seen& b) const;
  // What each rest adds to it at size 1: of the levels, of all controls but levels, of all
  // together.
  [[nodiscard]] double LevelRest(const LevelForm& form, const Rests& rests, const Seen& a,
                                 const Seen& b) const;
  [[nodiscard]] double OtherRest(const Seen& a, const Seen& b) const;
  [[nodiscard]] double JointRest(const Seen& a, const Seen& b) const;

  [[nodiscard]] bool HasLevels() const;
  [[nodiscard]] bool HasOthers() const;
  [[nodiscard]] bool HasMany() const { return kinds_.size() > 1; }

 private:
  [[nodiscard]] std::vector<Rests> LevelRests() const;
  struct Fade {
    double mean = 0.0, sd = 0.0;
  };
  [[nodiscard]] Fade FadeOf(std::size_t control) const;
  [[nodiscard]] double Faded(std::size_t control, double along) const;
  [[nodiscard]] double Plain(std::size_t control, double label) const;

  std::vector<ControlKind> kinds_;
  CurveTarget target_;
  // Of each control's coordinate, over the points.
  std::vector<double> middle_, span_, least_along_;
  std::size_t formed_ = 0;  // the first level, if there is one
  double least_ = 0.0;      // its label, of the points
};

}  // namespace lightcal::fit
