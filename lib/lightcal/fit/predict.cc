// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "lightcal/core/normal_mixture.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/fit/model/reading_model.h"
#include "lightcal/fit/model/solve.h"
#include "lightcal/fit/predicted_parts.h"
#include "lightcal/light/wall_prior.h"

namespace lightcal {
namespace {

std::optional<Metres> Length(const std::optional<double>& metres) {
  if (!metres) return std::nullopt;
  return Metres(*metres);
}

bool IsOn(const FittedLight& light, std::string_view effect) {
  return std::any_of(light.effects.begin(), light.effects.end(), [&](const EffectReport& e) {
    return e.name == effect && e.state == EffectState::kOn;
  });
}

fit::ReadingRow RowFacing(const FittedLight& light, double distance_m) {
  fit::ReadingRow row;
  row.distance = distance_m;
  if (IsOn(light, "finite_source")) {
    row.shape = AxialShapeOf(
        light.kind, {Length(light.diameter_m), Length(light.width_m), Length(light.height_m),
                     Length(light.length_m), Length(light.radius_m)});
  }
  if (light.kind == LightKind::kSphere && IsOn(light, "sphere_surface")) {
    row.distance += 0.5 * light.diameter_m.value_or(0.0);
  }
  // So that the whitened residual is -ln E.
  row.measured = 1.0;
  row.sigma = 1.0;
  return row;
}

const std::optional<Uncertain>& StrengthOf(const FittedLight& light) {
  return light.illuminance_lx ? light.illuminance_lx : light.intensity_cd;
}

double OffsetOf(const FittedLight& light) {
  return light.distance_offset_m ? light.distance_offset_m->value : 0.0;
}

// Of a meter that faces a lamp of some strength and stands before its effective source.
Result<fit::ReadingRow> RowBefore(const FittedLight& light, Metres distance,
                                  double sigma_relative) {
  if (!(sigma_relative >= 0.0) || !std::isfinite(sigma_relative)) {
    return Refused("bad_sigma", light.name,
                   "a reading scatters by a part of itself, 0 or more, not by " +
                       ShortestText(sigma_relative));
  }
  const std::optional<Uncertain>& strength = StrengthOf(light);
  if (!strength || !(strength->value > 0.0)) {
    return Refused("no_intensity", light.name, "the light has no intensity to predict from");
  }
  const fit::ReadingRow row = RowFacing(light, light.illuminance_lx ? 1.0 : distance.value());
  if (!(distance.value() > 0.0) || !(row.distance + OffsetOf(light) > 0.0)) {
    return Refused("bad_distance", light.name,
                   "no illuminance is defined " + ShortestText(distance.value()) +
                       " m from the lamp: its effective source lies there or beyond");
  }
  return row;
}

// Standard deviation of ln I of an estimate that has no covariance: a data sheet's.
double SdOfLog(const Uncertain& u) {
  if (u.low && u.high && *u.low > 0.0) return std::log(*u.high / *u.low) / (2.0 * kZ95);
  return u.u95 / (u.value * kZ95);
}

double VarianceOfLog(const FittedLight& light, const Uncertain& strength,
                     const std::array<double, fit::kParameters>& gradient) {
  if (!light.covariance_lnI_d0_E0) {
    const double sd = SdOfLog(strength);
    return gradient[0] * gradient[0] * sd * sd;
  }
  double variance = 0.0;
  constexpr int kKept = 3;
  for (int i = 0; i < kKept; ++i) {
    for (int j = 0; j < kKept; ++j) {
      variance += gradient[i] * gradient[j] * (*light.covariance_lnI_d0_E0)[i * kKept + j];
    }
  }
  return std::max(0.0, variance);
}

// One of the things that lamp and room may be, at one distance.
class PartAtDistance {
 public:
  PartAtDistance(const LampInRoom& one, const fit::ReadingRow& bare, double distance_m)
      : one_(one), row_(bare), x_(std::log(distance_m / kWallReference_m)) {
    if (!(one.width_m > 0.0)) return;
    SourceSize size;
    size.width = Metres(one.width_m);
    size.height = Metres(one.height_m);
    row_.shape = AxialShapeOf(LightKind::kRect, size);
  }

  [[nodiscard]] NormalPart Alone() const {
    const fit::RowDerivative at = fit::DifferentiateRow(row_, Theta());
    return {one_.weight, -at.residual, std::sqrt(Variance(at.gradient))};
  }
  [[nodiscard]] NormalPart Walls() const {
    const double ln = one_.ln_intensity + std::log(fit::WallsPerCandela(Lit(), Theta().data()));
    return {one_.weight, ln,
            std::hypot(std::sqrt(Variance({1.0, 0.0, 0.0, 1.0, x_})), one_.scatter)};
  }
  [[nodiscard]] NormalPart Whole(const NormalPart& walls) const {
    const fit::RowDerivative at = fit::DifferentiateRow(Lit(), Theta());
    const double share = std::exp(walls.mean + at.residual);
    return {one_.weight, -at.residual,
            std::hypot(std::sqrt(Variance(at.gradient)), share * one_.scatter)};
  }

 private:
  using Gradient = std::array<double, fit::kParameters>;

  [[nodiscard]] fit::Theta Theta() const {
    return {one_.ln_intensity, one_.distance_offset_m, one_.ambient_lx, one_.ln_b.value_or(0.0),
            one_.slope};
  }
  [[nodiscard]] fit::ReadingRow Lit() const {
    fit::ReadingRow row = row_;
    row.walls = fit::WallsOfRow{x_, one_.bend * x_ * x_, one_.scatter};
    return row;
  }
  [[nodiscard]] double Variance(const Gradient& gradient) const {
    constexpr int n = LampInRoom::kCount;
    double sum = 0.0;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) sum += gradient[i] * gradient[j] * one_.covariance[i * n + j];
    }
    return std::max(0.0, sum);
  }

  const LampInRoom& one_;
  fit::ReadingRow row_;
  double x_;  // of the walls' law
};

// What stands before its effective source, as each part has that, at one distance.
std::vector<PartAtDistance> PartsAt(const FittedLight& light, const fit::ReadingRow& bare,
                                    double distance_m) {
  std::vector<PartAtDistance> out;
  for (const LampInRoom& one : light.in_room) {
    if (bare.distance + one.distance_offset_m > 0.0) out.emplace_back(one, bare, distance_m);
  }
  return out;
}

// Each part as one further reading scatters about it.
std::vector<NormalPart> Read(std::vector<NormalPart> parts, double sigma_relative) {
  for (NormalPart& part : parts) part.sd = std::hypot(part.sd, sigma_relative);
  return parts;
}

}  // namespace

namespace fit {

PredictedParts PredictParts(const FittedLight& light, Metres distance) {
  PredictedParts out;
  const ReadingRow bare = RowFacing(light, distance.value());
  for (const PartAtDistance& part : PartsAt(light, bare, distance.value())) {
    if (!light.in_room.front().ln_b) {
      out.whole.push_back(part.Alone());
      continue;
    }
    out.walls.push_back(part.Walls());
    out.whole.push_back(part.Whole(out.walls.back()));
  }
  return out;
}

}  // namespace fit

Result<PredictedIlluminance> PredictIlluminance(const FittedLight& light, Metres distance,
                                                double sigma_relative) {
  const auto row = RowBefore(light, distance, sigma_relative);
  if (!row) return tl::unexpected(row.error());
  if (light.in_room.size() > 1 && !light.illuminance_lx) {
    std::vector<NormalPart> alone;
    for (const PartAtDistance& part : PartsAt(light, *row, distance.value())) {
      alone.push_back(part.Alone());
    }
    if (!alone.empty()) {
      return PredictedIlluminance{UncertainFromLogMixture(alone),
                                  UncertainFromLogMixture(Read(alone, sigma_relative))};
    }
  }
  const Uncertain& strength = *StrengthOf(light);
  const double ambient = light.ambient_lx ? light.ambient_lx->value : 0.0;
  const fit::Theta theta = {std::log(strength.value), OffsetOf(light), ambient};
  const fit::RowDerivative at = fit::DifferentiateRow(*row, theta);
  const double variance = VarianceOfLog(light, strength, at.gradient);
  return PredictedIlluminance{
      UncertainFromLog(-at.residual, std::sqrt(variance)),
      UncertainFromLog(-at.residual, std::sqrt(variance + sigma_relative * sigma_relative))};
}

Result<std::optional<IlluminanceInRoom>> PredictInRoom(const FittedLight& light, Metres distance,
                                                       double sigma_relative) {
  if (auto before = RowBefore(light, distance, sigma_relative); !before) {
    return Propagate(std::move(before));
  }
  const fit::PredictedParts parts = fit::PredictParts(light, distance);
  if (parts.walls.empty()) return std::optional<IlluminanceInRoom>();
  return IlluminanceInRoom{UncertainFromLogMixture(parts.whole),
                           UncertainFromLogMixture(Read(parts.whole, sigma_relative)),
                           UncertainFromLogMixture(parts.walls)};
}

}  // namespace lightcal
