// SPDX-License-Identifier: Apache-2.0
// What one run of a calibration found, how long each step of it took, and how far two runs differ.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/records/accuracy_profile.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal::tradeoff {

enum class Stage : std::uint8_t { kLoad, kSpectra, kPictures, kFit, kExport };
inline constexpr std::size_t kStages = 5;
inline constexpr std::array<std::string_view, kStages> kStageWords = {"load", "spectra", "pictures",
                                                                      "fit", "export"};
using StageSeconds = std::array<double, kStages>;

// The figures of one light that an engine is given, with their standard uncertainties.
struct LightFigures {
  std::string name;
  double ln_strength = 0.0;  // of the intensity (cd), else illuminance (lx), else luminance
  double sd_ln = 0.0;
  std::optional<double> mired, sd_mired;
  std::optional<double> duv, sd_duv;
  std::optional<double> ln_flux{};  // where a table of intensities makes it more than the strength
  std::string limit{};  // what its uncertainty mostly comes from, and what would halve it
};

struct Outcome {
  std::vector<LightFigures> lights;
  StageSeconds seconds{};  // of processor time
};

[[nodiscard]] std::vector<LightFigures> FiguresOf(const LightFile& lights);

// A calibration by a profile; handed in by whoever can run one.
using Runner = std::function<Result<Outcome>(const AccuracyProfile&)>;

// Differences of one light's figures, in one relative measure: 1 % = 1 mired = 0.001 of Duv, each
// about what the eye just sees in a picture.
struct Difference {
  std::string light;
  std::string_view quantity;  // of the kQuantity words below
  double relative = 0.0;      // signed
  double sd = 0.0;            // what a change is held against: the reference's own uncertainty
};
inline constexpr std::string_view kStrength = "strength";
// Half its width, relative to the strength; held against itself.
inline constexpr std::string_view kInterval = "95 % interval";
inline constexpr std::string_view kFlux = "flux";
inline constexpr std::string_view kColorTemperature = "colour temperature";
inline constexpr std::string_view kDuv = "Duv";
inline constexpr double kMiredPerUnit = 100.0;
inline constexpr double kDuvPerUnit = 0.1;

// Of every figure that both have, in the order of `reference`. A light or figure that `other` lacks
// differs by 1.
[[nodiscard]] std::vector<Difference> DifferencesFrom(const std::vector<LightFigures>& reference,
                                                      const std::vector<LightFigures>& other);

struct SettingError {
  double relative = 0.0;      // the largest of the differences but intervals'
  double over_u = 0.0;        // the largest of all differences / standard uncertainty
  std::string_view quantity;  // where the largest is
  std::string light;
};
[[nodiscard]] SettingError ErrorOf(const std::vector<Difference>& differences);

}  // namespace lightcal::tradeoff
