// SPDX-License-Identifier: Apache-2.0
// What is known of a parameter before any reading, and how a problem is to be solved.
#pragma once

#include <cstdint>
#include <limits>

namespace lightcal::fit {

// A parameter is free (with or without a normal prior) or held at its start. sd <= 0: no prior.
struct ParameterRule {
  bool free = false;
  double prior_mean = 0.0;
  double prior_sd = 0.0;
};

// Readings have taught a parameter something where its standard deviation fell below this share of
// its prior's.
inline constexpr double kLearnedShare = 0.8;

// The foremost that light may start before its lamp's place, of the nearest reading's distance.
inline constexpr double kLeastOffset = -0.9;

// Where a free parameter must stay.
struct Bounds {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

enum class Loss : std::uint8_t { kSquared, kHuber, kTukey };

// Huber's and Tukey's constants: 95 % efficiency for normal errors.
inline constexpr double kHuberConstant = 1.345;
inline constexpr double kTukeyConstant = 4.685;

// A last step of Newton's this short, in standard deviations of each parameter, were it alone,
// leaves about its square.
inline constexpr double kLastStep = 1e-7;

// How the full solver works. A large first trust region makes the first steps Gauss-Newton.
struct FullSolver {
  Loss loss = Loss::kSquared;
  double scale = 1.0;  // of the loss, in sigma
  double function_tolerance = 1e-12;
  double parameter_tolerance = 1e-10;
  double first_trust_region = 1e4;
  int iterations = 200;
  bool polish = true;  // takes the last digits (least_squares.h)
};

}  // namespace lightcal::fit
