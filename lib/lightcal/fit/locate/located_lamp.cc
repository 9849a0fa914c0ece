// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/locate/located_lamp.h"

#include <algorithm>
#include <cmath>

#include "lightcal/fit/fit_light.h"
#include "lightcal/fit/model/least_squares.h"
#include "lightcal/fit/model/uncertainty.h"

namespace lightcal {
namespace fit {
namespace {

constexpr int kCount = LocatedLamp::kCount;
// Of the placed problem's parameters those that a prediction needs: all but the offset of readings
// that give a distance alone.
constexpr std::array<int, kCount> kKept = {
    kPlacedLnIntensity, kPlacedX,          kPlacedY,         kPlacedZ,         kPlacedAmbient,
    kPlacedLnWalls,     kPlacedWallsSlope, kPlacedGradientX, kPlacedGradientY, kPlacedGradientZ};
constexpr int kAmbientOfKept = 4;

PlacedTheta ThetaOf(const LocatedLamp& lamp) {
  PlacedTheta theta{};
  theta[kPlacedLnIntensity] = lamp.ln_intensity;
  theta[kPlacedAmbient] = lamp.ambient_lx;
  for (int k = 0; k < 3; ++k) {
    theta[kPlacedX + k] = lamp.position_m[k];
    theta[kPlacedGradientX + k] = lamp.gradient[k];
  }
  if (lamp.walls) {
    theta[kPlacedLnWalls] = lamp.walls->ln_b;
    theta[kPlacedWallsSlope] = lamp.walls->slope;
  }
  return theta;
}

// In cd, m, lx, so that the whitened residual is -ln E. `gain`: what the lamp's size leaves.
PlacedEstimation RowAt(const LocatedLamp& lamp, const std::optional<Vec3>& aim,
                       const PlaceInRoom& at, double gain) {
  PlacedRow row;
  row.position = at.position_m;
  row.normal = at.normal;
  row.direct_gain = gain;
  row.middle = lamp.middle;
  row.measured = 1.0;
  PlacedWalls walls;
  walls.ln_unit = -std::log(kWallReference_m);
  walls.bend = lamp.walls->bend;
  walls.scatter = std::hypot(lamp.walls->scatter, kTurnedScatter);
  row.walls = walls;
  PlacedEstimation out;
  out.rows = {row};
  out.aim = aim;
  return out;
}

// What the kind's law makes of the size: beyond it a lamp is no point.
double GainOf(const LocatedLamp& lamp, const std::optional<Vec3>& aim, const PlaceInRoom& at) {
  const PlacedRow row = RowAt(lamp, aim, at, 1.0).rows.front();
  const Vec3 way = lamp.position_m - at.position_m;
  PlacedTheta even = ThetaOf(lamp);
  for (int k = 0; k < 3; ++k) even[kPlacedGradientX + k] = 0.0;
  double direct = 0.0;
  return DirectPerCandela(row, aim, Length(way), even.data(), &direct)
             ? at.direct_per_candela / direct
             : 0.0;
}

}  // namespace

LocatedLamp LocatedLampOf(const PlacedFrame& frame, const std::vector<PlacedMode>& modes,
                          const MixedPlace& mixed) {
  const PlacedTheta& theta = mixed.theta;
  LocatedLamp out;
  out.ln_intensity =
      theta[kPlacedLnIntensity] + std::log(frame.lux * frame.length_m * frame.length_m);
  out.position_m = frame.origin + LampOf(theta) * frame.length_m;
  out.ambient_lx = theta[kPlacedAmbient] * frame.lux;
  for (const PlacedRow& row : modes.front().estimation.rows) {
    if (row.middle) out.middle = *row.middle;
  }
  for (int k = 0; k < 3; ++k) out.gradient[k] = theta[kPlacedGradientX + k];
  if (modes.front().walls) {
    WallsFound walls{theta[kPlacedLnWalls], theta[kPlacedWallsSlope]};
    double square = 0.0;
    for (const PlacedMode& one : modes) {
      walls.bend += one.share * one.walls->bend;
      square += one.share * one.walls->scatter * one.walls->scatter;
    }
    walls.scatter = std::sqrt(square);
    out.walls = walls;
  }
  const auto unit = [&](int parameter) {
    if (parameter == kPlacedAmbient) return frame.lux;
    return parameter >= kPlacedX && parameter <= kPlacedZ ? frame.length_m : 1.0;
  };
  for (int i = 0; i < kCount; ++i) {
    for (int j = 0; j < kCount; ++j) {
      out.covariance[i * kCount + j] = mixed.covariance[kKept[i] * kPlacedParameters + kKept[j]] *
                                       unit(kKept[i]) * unit(kKept[j]);
    }
  }
  return out;
}

void AddCalibration(double calibration, LocatedLamp& lamp) {
  std::array<double, kCount> shift{};
  shift[0] = calibration;
  shift[kAmbientOfKept] = calibration * lamp.ambient_lx;
  for (int i = 0; i < kCount; ++i) {
    for (int j = 0; j < kCount; ++j) lamp.covariance[i * kCount + j] += shift[i] * shift[j];
  }
}

}  // namespace fit

std::optional<Uncertain> PredictInRoom(const FittedLight& light, const PlaceInRoom& at) {
  if (!light.located || !light.located->walls) return std::nullopt;
  const LocatedLamp& lamp = *light.located;
  const double distance = Length(lamp.position_m - at.position_m);
  if (!(distance > 0.0)) return std::nullopt;
  const bool flat = light.kind == LightKind::kDisk || light.kind == LightKind::kRect;
  const std::optional<Vec3> aim = flat ? light.aim : std::nullopt;
  const fit::PlacedEstimation one = fit::RowAt(lamp, aim, at, fit::GainOf(lamp, aim, at));
  const fit::PlacedRow& row = one.rows.front();
  const fit::PlacedTheta theta = fit::ThetaOf(lamp);
  fit::PlacedTheta gradient{};
  const double ln = -fit::DifferentiateAt(one, 0, theta.data(), gradient.data());
  if (!std::isfinite(ln)) return std::nullopt;
  const double walls =
      std::exp(lamp.ln_intensity - ln) * fit::WallsPerCandela(row, distance, theta.data());
  double variance = std::pow(walls * row.walls->scatter, 2.0);
  for (int i = 0; i < fit::kCount; ++i) {
    for (int j = 0; j < fit::kCount; ++j) {
      variance +=
          gradient[fit::kKept[i]] * gradient[fit::kKept[j]] * lamp.covariance[i * fit::kCount + j];
    }
  }
  return UncertainFromLog(ln, std::sqrt(std::max(0.0, variance)));
}

}  // namespace lightcal
