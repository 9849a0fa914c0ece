// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/colour/color_readings.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/fit/colour/fit_color.h"
#include "lightcal/fit/model/row_values.h"

namespace lightcal::fit {
namespace {

// Beyond |Duv| = .05 a CCT names no colour temperature (CIE 15:2018 9.4), but the chromaticity that
// a meter wrote as CCT and Duv is one still: that of a lamp behind a green gel.
constexpr double kFarthestDuv = 0.1;

double SigmaXy(ColorSource source) {
  switch (source) {
    case ColorSource::kSpectrometer:
      return kSigmaXySpectrometer;
    case ColorSource::kColorimeter:
      return kSigmaXyColorimeter;
    case ColorSource::kCamera:
    case ColorSource::kUnknown:
      break;
  }
  return kSigmaXyUnknown;
}

double SigmaMired(const Reading& reading) {
  return reading.sigma_mired.value_or(Mireds(kSigmaMiredCamera)).value();
}

std::optional<ColorMeter> MeterOfColor(const Reading& reading) {
  const std::string& name = InstrumentOf(reading);
  if (name.empty() || name == kDataSheetMeter || reading.quality == MeterQuality::kDerived ||
      reading.color_source == ColorSource::kCamera) {
    return std::nullopt;
  }
  return ColorMeter{name, SigmaXy(reading.color_source)};
}

Estimate2 FromTemperature(const Reading& reading) {
  const bool camera = reading.color_source == ColorSource::kCamera;
  const Vector2 at(MiredsFromKelvin(*reading.cct).value(), reading.duv.value_or(0.0));
  const Matrix2 jacobian = XyByMiredDuv(at);
  Estimate2 out{XyFromMiredDuv(at), Matrix2::Zero()};
  const double sigma_xy = SigmaXy(reading.color_source);
  Matrix2 own = Matrix2::Zero();  // in (mired, Duv)
  if (camera) {
    own(0, 0) = SigmaMired(reading) * SigmaMired(reading);
    own(1, 1) = kSigmaDuvCamera * kSigmaDuvCamera;
  } else {
    const Matrix2 inverse = jacobian.inverse();
    own = sigma_xy * sigma_xy * inverse * inverse.transpose();
  }
  if (!reading.duv) {
    own(0, 1) = own(1, 0) = 0.0;
    own(1, 1) = kSigmaDuvAssumed * kSigmaDuvAssumed;
  }
  out.covariance = jacobian * own * jacobian.transpose();
  return out;
}

Estimate2 ByCamera(const Vector2& xy, double sigma_mired, CctMethod method) {
  Vector2 mired_duv;
  if (!MiredDuvOf(xy, method, mired_duv)) {
    return {xy, kSigmaXyUnknown * kSigmaXyUnknown * Matrix2::Identity()};
  }
  const Matrix2 jacobian = XyByMiredDuv(mired_duv);
  const Vector2 variances(sigma_mired * sigma_mired, kSigmaDuvCamera * kSigmaDuvCamera);
  return {xy, jacobian * variances.asDiagonal() * jacobian.transpose()};
}

Estimate2 FromChromaticity(const Reading& reading, CctMethod method) {
  const Vector2 xy(reading.xy->x, reading.xy->y);
  if (reading.color_source == ColorSource::kCamera) {
    return ByCamera(xy, SigmaMired(reading), method);
  }
  const double sigma = SigmaXy(reading.color_source);
  return {xy, sigma * sigma * Matrix2::Identity()};
}

ColorReading FromWall(const ColorOffWall& wall, CctMethod method) {
  ColorReading out;
  const double by_room = kRoomFollowsPaint * wall.others.walls;
  SurfaceTint paint = wall.paint;
  paint.ln_x += by_room * (wall.paint.ln_x - kTintOfPaint.ln_x);
  paint.ln_z += by_room * (wall.paint.ln_z - kTintOfPaint.ln_z);
  paint.sd_x *= 1.0 + by_room;
  paint.sd_z *= 1.0 + by_room;
  const Vector2 lamp = Tinted({wall.seen.x, wall.seen.y}, -paint.ln_x, -paint.ln_z);
  const Matrix2 by_tint = XyByTint(lamp);
  out.in_xy = ByCamera(lamp, wall.sigma.value(), method);
  out.in_xy.covariance += by_tint * CovarianceOf(paint) * by_tint.transpose();
  out.instrument = {"", ColorSource::kCamera};
  out.others = wall.others;
  return out;
}

// What makes a colour temperature none, "" where it is one.
std::string FaultOfTemperature(const Reading& reading) {
  const double kelvin = reading.cct->value();
  if (!std::isfinite(kelvin)) return "it is no number";
  if (kelvin < kColdestLamp.value()) {
    return "nothing that shines for the eye is colder than 1000 K: is a digit missing?";
  }
  if (!IsTemperatureOfLamp(*reading.cct)) {
    return "no lamp is hotter than 100 000 K: is there a digit too many?";
  }
  const double duv = reading.duv.value_or(0.0);
  const Xy xy = XyFromCct(*reading.cct, std::clamp(duv, -1.0, 1.0));
  const bool light = xy.x > 0.0 && xy.y > 0.0 && xy.x + xy.y < 1.0;
  if (std::abs(duv) > kFarthestDuv || !light) {
    return "with Duv " + ShortestText(duv) + " it is no colour of light: Duv is a few thousandths";
  }
  return "";
}

bool UsableChromaticity(const Reading& reading) {
  return reading.xy && std::isfinite(reading.xy->x) && std::isfinite(reading.xy->y) &&
         reading.xy->y > 0.0;
}

// Of one lamp among others: what remains of X, Y, Z of a reading with it and one without it, of the
// same place and meter, the latter known within `lost` (1 sigma, relative). Their meter's own error
// stays one, whatever the ratio; the rest grows with it.
std::optional<ColorReading> Difference(const Reading& both, const Reading& others, double lost,
                                       CctMethod method) {
  const double whole = both.illuminance->value();
  const double rest = others.illuminance->value();
  const double own = whole - rest;
  if (!(own > 0.0)) return std::nullopt;
  const auto xyz = [](const Reading& reading) -> Eigen::Vector3d {
    const Xyz unit = XyzFromXyAtUnitY(*reading.xy);
    return Eigen::Vector3d(unit.X, unit.Y, unit.Z) * reading.illuminance->value();
  };
  const Eigen::Vector3d left = xyz(both) - xyz(others);
  if (!(left.minCoeff() > 0.0)) return std::nullopt;
  ColorReading out;
  out.in_xy = FromChromaticity(both, method);
  out.in_xy.mean = left.head<2>() / left.sum();
  const Vector2 apart = out.in_xy.mean - Vector2(others.xy->x, others.xy->y);
  const double ratio = std::hypot(kRepeatLux * whole, kRepeatLux * rest, lost * rest) / own;
  const double chroma = kRepeatXy * std::hypot(whole, rest) / own;
  out.own = ratio * ratio * apart * apart.transpose() + chroma * chroma * Matrix2::Identity();
  out.instrument = {both.meter, both.color_source};
  out.meter = MeterOfColor(both);
  return out;
}

bool TellsItsLight(const Reading& reading) {
  return UsableChromaticity(reading) && reading.illuminance && reading.illuminance->value() > 0.0;
}

// From pairs of one place that this lamp alone sets apart.
std::vector<ColorReading> Differences(const Session& session, const LightDescription& light,
                                      CctMethod method) {
  std::vector<ColorReading> out;
  for (const SessionReading& both : session.readings) {
    if (both.reading.light != light.name || both.others_lit.empty() || !IsLit(both.reading) ||
        both.place < 0 || !TellsItsLight(both.reading)) {
      continue;
    }
    const auto others = std::ranges::find_if(session.readings, [&](const SessionReading& row) {
      return row.reading.light == light.name && row.reading.lamp == LampState::kOff &&
             row.place == both.place && row.others_lit == both.others_lit &&
             TellsItsLight(row.reading) && row.reading.meter == both.reading.meter;
    });
    if (others == session.readings.end()) continue;
    if (auto one = Difference(both.reading, others->reading, 0.0, method)) out.push_back(*one);
  }
  return out;
}

}  // namespace

Vector2 XyFromMiredDuv(const Vector2& mired_duv) {
  const Xy xy = XyFromCct(KelvinFromMireds(Mireds(mired_duv[0])), mired_duv[1]);
  return {xy.x, xy.y};
}

Vector2 Tinted(const Vector2& xy, double ln_x, double ln_z) {
  const double x = xy[0] / xy[1] * std::exp(ln_x);
  const double z = std::max(0.0, (1.0 - xy[0] - xy[1]) / xy[1]) * std::exp(ln_z);
  return Vector2(x, 1.0) / (x + 1.0 + z);
}

// With x = X/(X + Y + Z): d x = x (1 - x) d ln X - x z d ln Z, d y = -y (x d ln X + z d ln Z).
Matrix2 XyByTint(const Vector2& xy) {
  const double x = xy[0], y = xy[1], z = std::max(0.0, 1.0 - xy[0] - xy[1]);
  Matrix2 out;
  out << x * (1.0 - x), -x * z, -x * y, -z * y;
  return out;
}

Matrix2 CovarianceOf(const SurfaceTint& tint) {
  const double cross = tint.correlation * tint.sd_x * tint.sd_z;
  Matrix2 out;
  out << tint.sd_x * tint.sd_x, cross, cross, tint.sd_z * tint.sd_z;
  return out;
}

// d(x, y)/d(mired, Duv), central differences: the locus is smooth on this scale.
Matrix2 XyByMiredDuv(const Vector2& at) {
  const Vector2 mired_step(0.05, 0.0);
  const Vector2 duv_step(0.0, 1e-4);
  Matrix2 jacobian;
  jacobian.col(0) = (XyFromMiredDuv(at + mired_step) - XyFromMiredDuv(at - mired_step)) / 0.1;
  jacobian.col(1) = (XyFromMiredDuv(at + duv_step) - XyFromMiredDuv(at - duv_step)) / 2e-4;
  return jacobian;
}

// (mired, Duv) of a chromaticity; false where it has none.
bool MiredDuvOf(const Vector2& xy, CctMethod method, Vector2& out) {
  const CctResult cct = CctFromXy({xy[0], xy[1]}, method);
  if (!cct.valid()) return false;
  out = {MiredsFromKelvin(cct.temperature).value(), cct.duv};
  return true;
}

std::vector<ColorReading> CollectColors(const Session& session, const LightDescription& light,
                                        const OtherLight* others, const ColorOffWall* off_wall,
                                        CctMethod method, Warnings& warnings) {
  std::vector<ColorReading> out;
  if (off_wall != nullptr) out.push_back(FromWall(*off_wall, method));
  for (const SessionReading& row : session.readings) {
    const Reading& reading = row.reading;
    const bool lit = reading.lamp == LampState::kOn && !reading.shadow_card;
    if (reading.light != light.name || !row.others_lit.empty() || (!lit && others == nullptr)) {
      continue;
    }
    ColorReading one;
    one.lit = lit;
    one.instrument = {reading.meter, reading.color_source};
    one.meter = MeterOfColor(reading);
    if (others != nullptr) one.others = others->SharesIn(row);
    if (!lit && !one.others.any()) continue;
    const Reading* card = lit && one.others.any() ? others->CardBeside(reading) : nullptr;
    if (card != nullptr && card->meter == reading.meter && TellsItsLight(*card) &&
        TellsItsLight(reading)) {
      if (auto alone = Difference(reading, *card, kCardHides, method)) {
        out.push_back(*std::move(alone));
        continue;
      }
    }
    if (UsableChromaticity(reading)) {
      one.in_xy = FromChromaticity(reading, method);
    } else if (reading.cct) {
      const std::string fault = FaultOfTemperature(reading);
      if (!fault.empty()) {
        warnings.push_back({"color_unusable", light.name,
                            RoundedText(reading.cct->value(), 4) + " K is left out: " + fault});
        continue;
      }
      one.in_xy = FromTemperature(reading);
    } else {
      continue;
    }
    out.push_back(std::move(one));
  }
  const auto lit = [](const ColorReading& one) { return one.lit; };
  // What was read without the lamp tells nothing where each reading is the lamp's own.
  if (std::ranges::none_of(out, [](const auto& one) { return one.lit && one.others.any(); })) {
    std::erase_if(out, std::not_fn(lit));
  }
  if (std::ranges::none_of(out, lit)) out = Differences(session, light, method);
  return out;
}

}  // namespace lightcal::fit
