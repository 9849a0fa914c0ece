// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/budget.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "lightcal/fit/model/shared_scatter.h"

namespace lightcal::fit {
namespace {

constexpr double kLeastShare = 1e-6;

// What halves the standard deviation that a cause makes.
constexpr std::array<std::pair<std::string_view, std::string_view>, 39> kCures = {{
    {"readings", "four times as many readings"},
    {"meter_calibration", "another meter beside this one, or one calibrated twice as well"},
    {kCameraScale, "one lux reading of this light, or a calibrated camera"},
    {"readings_and_place", "four times as many readings, spread twice as wide"},
    {"uneven_light", "readings from all sides of the lamp, or a luminaire's own file"},
    {"distance_offset", "readings at distances that span 8 : 1, the farthest twice as far"},
    {"ambient", "a lamp-off or shadow-card reading at each distance"},
    {"aim", "readings all round the axis, or the aim set better and off_axis_sigma_deg"},
    {"cone", "four times as many readings between the beam's middle and its edge"},
    {"finite_source", "stand 1.4 times as far away, or state the lamp's size"},
    {"sphere_surface", "state position_m, so that distances reach the centre"},
    {"data_sheet", "readings that leave less open than the box does"},
    {"unknown_lamp", "state the lamp's kind, its size and its fixture"},
    {"horizon", "turn the meter towards the lamp"},
    {"meter_tilt", "point the meter within 1.5 degrees of the lamp, or state tilt_deg"},
    {"distance_error", "read distances to 2.5 mm, or stand twice as far away"},
    {"room_bounce", "a shadow-card reading; or stand half as far from the lamp"},
    {"shadow_card", "a card 0.7 times as wide that still hides the lamp"},
    {"detector_size", "stand 1.4 times as far away, or state head_radius_m"},
    {"spectral_mismatch", "a meter of half the f1', or a spectrometer"},
    {"cosine_response", "face the lamp, or a meter of half the f2"},
    {"haze", "stand half as far away, or clear the air"},
    {"narrow_beam", "stand 1.4 times as far away, or state diameter_m"},
    {"mains", "state lamp_class; of a filament, a regulated supply"},
    {"flicker", "readings that gather light for twice as long"},
    {"rolling_shutter", "an exposure twice as long, or state flicker_depth"},
    {"warm_up", "state minutes_on, or let the lamp warm up ten minutes longer"},
    {"table_interpolation", "a table with nodes 0.7 times as far apart"},
    {"vignetting", "move the patch 0.7 times as far from the picture's middle, or a flat field"},
    {"veiling_glare", "a darker surround, or a shade on the lens"},
    {"noise", "a patch of four times the pixels"},
    {"scale", "a meter held to the wall: anchor_illuminance_lx, and wall.anchor_rect around it"},
    {"lamp_position", "the lamp's place measured twice as well, and position_sigma_m that says so"},
    {"camera", "the board photographed from near, from more sides"},
    {"not_matt", "a matt wall, seen and lit from straight before it"},
    {"board_size", "the board's squares measured on the print"},
    {"other_light", "a card's shadow in the frames, a picture with the lamp off, or a darker room"},
    {"misfit", "a wall without things on it, and frames without noise"},
    {"shape_off_axis", "readings 1.4 times as far away"},
}};

std::string CureOf(std::string_view name) {
  const auto at = std::ranges::find(kCures, name, [](const auto& cure) { return cure.first; });
  return at == kCures.end() ? std::string() : std::string(at->second);
}

double IntensityVariance(const UncertaintyInput& input) {
  const Result<Covariance> covariance = EstimateCovariance(input);
  return covariance ? (*covariance)[kLnIntensity] : -1.0;
}

}  // namespace

std::vector<VariancePart> VarianceParts(
    std::string base, const std::vector<Consider>& considered,
    const std::function<double(const std::vector<Consider>&)>& variance) {
  const double alone = variance({});
  if (!(alone >= 0.0)) return {};
  std::vector<VariancePart> parts = {{std::move(base), alone}};
  for (const Consider& influence : considered) {
    parts.push_back({influence.name, std::max(0.0, variance({influence}) - alone)});
  }
  return parts;
}

std::vector<VariancePart> VarianceParts(const UncertaintyInput& input) {
  Estimation estimation = *input.estimation;
  const auto rules = estimation.rules;
  UncertaintyInput some = input;
  some.estimation = &estimation;
  some.considered.clear();
  estimation.rules[kDistanceOffset] = {};
  estimation.rules[kAmbient] = {};
  estimation.rules[kLnWalls] = estimation.rules[kWallsSlope] = {};
  estimation.rules[kAimX] = estimation.rules[kAimY] = {};
  const double readings = IntensityVariance(some);
  for (ReadingRow& row : estimation.rows) row.calibration = 0.0;
  estimation.rules[kLnScale] = {};
  const double repeated = IntensityVariance(some);
  const bool some_uneven =
      std::ranges::any_of(estimation.rows, [](const ReadingRow& row) { return row.uneven > 0.0; });
  for (ReadingRow& row : estimation.rows) row.uneven = 0.0;
  if (some_uneven) SettleScatter(estimation, input.theta);
  const double even = some_uneven ? IntensityVariance(some) : repeated;
  estimation.rows = input.estimation->rows;
  estimation.rules[kLnScale] = rules[kLnScale];
  estimation.rules[kDistanceOffset] = rules[kDistanceOffset];
  const double with_offset = IntensityVariance(some);
  estimation.rules[kAimX] = rules[kAimX];
  estimation.rules[kAimY] = rules[kAimY];
  const double with_aim = IntensityVariance(some);
  estimation.rules[kLnWalls] = rules[kLnWalls];
  estimation.rules[kWallsSlope] = rules[kWallsSlope];
  const double with_walls = IntensityVariance(some);
  estimation.rules[kAmbient] = rules[kAmbient];
  // Cutting E0 at zero may take from what the offset alone makes.
  const double whole = IntensityVariance(some);
  const std::vector<double> considered = ConsideredVariances(input);
  const bool determined = whole >= 0.0 && repeated >= 0.0 && with_offset >= 0.0;
  if (!determined || considered.size() != input.considered.size()) return {};
  std::vector<VariancePart> parts = {{"ambient", whole}};
  for (std::size_t i = 0; i < considered.size(); ++i) {
    parts.push_back({input.considered[i].name, considered[i]});
  }
  const double first = std::min(readings, whole);
  const double second = std::clamp(with_offset - readings, 0.0, whole - first);
  const double aimed = std::clamp(with_aim - with_offset, 0.0, whole - first - second);
  const double third = std::clamp(with_walls - with_aim, 0.0, whole - first - second - aimed);
  parts.front().variance = whole - first - second - aimed - third;
  parts.push_back({"distance_offset", second});
  if (aimed > 0.0) parts.push_back({"aim", aimed});
  if (third > 0.0) parts.push_back({"room_bounce", third});
  const double calibration = std::clamp(readings - repeated, 0.0, first);
  if (calibration > 0.0) parts.push_back({"meter_calibration", calibration});
  const double uneven = std::clamp(repeated - even, 0.0, first - calibration);
  if (uneven > 0.0) parts.push_back({std::string(estimation.uneven_part), uneven});
  parts.push_back({"readings", first - calibration - uneven});
  return parts;
}

std::vector<BudgetPart> BudgetOf(const std::vector<VariancePart>& parts) {
  std::vector<VariancePart> sums;
  double whole = 0.0;
  for (const VariancePart& part : parts) {
    whole += part.variance;
    const auto same = std::ranges::find(sums, part.name, &VariancePart::name);
    if (same == sums.end()) {
      sums.push_back(part);
    } else {
      same->variance += part.variance;
    }
  }
  std::ranges::stable_sort(sums, std::ranges::greater(), &VariancePart::variance);
  std::vector<BudgetPart> budget;
  for (const VariancePart& part : sums) {
    if (!(part.variance > kLeastShare * whole)) continue;
    budget.push_back(
        {part.name, std::sqrt(part.variance), part.variance / whole, CureOf(part.name)});
  }
  return budget;
}

}  // namespace lightcal::fit
