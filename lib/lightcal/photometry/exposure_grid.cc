// SPDX-License-Identifier: Apache-2.0
#include "lightcal/photometry/exposure_grid.h"

#include <cmath>
#include <span>

namespace lightcal {
namespace {

constexpr double kLabelTolerance = 0.005;
constexpr double kApexTolerance = 0.005;

struct Label {
  double label;
  int steps;  // thirds or halves of a stop
};

// Speeds (1/time); the times of one second and more are written as such below.
constexpr Label kSpeedsInThirds[] = {
    {32000, 45},  {25600, 44}, {20000, 43}, {25000, 44}, {16000, 42},  {12800, 41}, {10000, 40},
    {8000, 39},   {6400, 38},  {5000, 37},  {4000, 36},  {3200, 35},   {2500, 34},  {2000, 33},
    {1600, 32},   {1250, 31},  {1000, 30},  {800, 29},   {640, 28},    {500, 27},   {400, 26},
    {320, 25},    {250, 24},   {200, 23},   {160, 22},   {125, 21},    {100, 20},   {80, 19},
    {60, 18},     {50, 17},    {40, 16},    {30, 15},    {25, 14},     {20, 13},    {15, 12},
    {13, 11},     {10, 10},    {8, 9},      {6, 8},      {5, 7},       {4, 6},      {3, 5},
    {1 / 0.3, 5}, {2.5, 4},    {2, 3},      {1.6, 2},    {1 / 0.6, 2}, {1.3, 1},    {1 / 0.8, 1},
    {1, 0}};
constexpr Label kTimesInThirds[] = {{1.3, 1}, {1.6, 2}, {2, 3},   {2.5, 4}, {3, 5},   {3.2, 5},
                                    {4, 6},   {5, 7},   {6, 8},   {8, 9},   {10, 10}, {13, 11},
                                    {15, 12}, {20, 13}, {25, 14}, {30, 15}};
constexpr Label kSpeedsInHalves[] = {{6000, 25}, {3000, 23}, {1500, 21},   {750, 19}, {350, 17},
                                     {180, 15},  {90, 13},   {1 / 0.7, 1}, {45, 11}};
constexpr Label kTimesInHalves[] = {{1.5, 1}};

constexpr Label kFNumbersInThirds[] = {
    {1, 0},    {1.1, 1},  {1.4, 3},  {1.6, 4}, {1.8, 5},  {2, 6},   {2.2, 7},  {2.5, 8},
    {2.8, 9},  {3.2, 10}, {3.5, 11}, {4, 12},  {4.5, 13}, {5, 14},  {5.6, 15}, {6.3, 16},
    {7.1, 17}, {8, 18},   {9, 19},   {10, 20}, {11, 21},  {13, 22}, {14, 23},  {16, 24},
    {18, 25},  {20, 26},  {22, 27},  {25, 28}, {29, 29},  {32, 30}};
constexpr Label kFNumbersInHalves[] = {{1.2, 1},  {1.7, 3},  {2.4, 5}, {3.3, 7}, {4.8, 9},
                                       {6.7, 11}, {9.5, 13}, {19, 17}, {27, 19}};

std::optional<double> LabelOf(int steps, std::span<const Label> labels) {
  for (const Label& l : labels) {
    if (l.steps == steps) return l.label;
  }
  return std::nullopt;
}

std::optional<int> StepsOf(double value, std::span<const Label> labels) {
  for (const Label& l : labels) {
    if (std::abs(value / l.label - 1.0) <= kLabelTolerance) return l.steps;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Seconds> TimeOfLabel(Seconds label) {
  const double time = label.value();
  if (!(time > 0.0)) return std::nullopt;
  if (const auto k = StepsOf(1.0 / time, kSpeedsInThirds)) return Seconds(std::exp2(-*k / 3.0));
  if (const auto k = StepsOf(time, kTimesInThirds)) return Seconds(std::exp2(*k / 3.0));
  if (const auto k = StepsOf(1.0 / time, kSpeedsInHalves)) return Seconds(std::exp2(-*k / 2.0));
  if (const auto k = StepsOf(time, kTimesInHalves)) return Seconds(std::exp2(*k / 2.0));
  return std::nullopt;
}

std::optional<Seconds> LabelOfTime(Seconds time) {
  if (!(time.value() > 0.0)) return std::nullopt;
  const double thirds = 3.0 * std::log2(time.value());
  const double nearest = std::round(thirds);
  if (!(std::abs(std::exp2((thirds - nearest) / 3.0) - 1.0) <= kLabelTolerance)) {
    return std::nullopt;
  }
  const int k = static_cast<int>(nearest);
  if (const auto time_label = LabelOf(k, kTimesInThirds); k > 0 && time_label) {
    return Seconds(*time_label);
  }
  if (const auto speed = LabelOf(-k, kSpeedsInThirds)) return Seconds(1.0 / *speed);
  return std::nullopt;
}

std::optional<double> FNumberOfLabel(double label) {
  if (const auto k = StepsOf(label, kFNumbersInThirds)) return std::exp2(*k / 6.0);
  if (const auto k = StepsOf(label, kFNumbersInHalves)) return std::exp2(*k / 4.0);
  return std::nullopt;
}

std::optional<double> ApexOnGrid(double apex) {
  for (const double steps_per_stop : {3.0, 2.0}) {
    const double nearest = std::round(apex * steps_per_stop) / steps_per_stop;
    if (std::abs(apex - nearest) <= kApexTolerance) return nearest;
  }
  return std::nullopt;
}

std::optional<double> FocusFactor(Metres focal_length, Metres subject_distance) {
  if (!(focal_length.value() > 0.0) || !(subject_distance > focal_length)) return std::nullopt;
  const double magnification = focal_length / (subject_distance - focal_length);
  return (1.0 + magnification) * (1.0 + magnification);
}

}  // namespace lightcal
