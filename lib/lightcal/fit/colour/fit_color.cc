// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/colour/fit_color.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lightcal/colorimetry/cct_approximations.h"
#include "lightcal/core/numbers_text.h"

namespace lightcal::fit {
namespace {

using Vector2 = Eigen::Vector2d;
using Matrix2 = Eigen::Matrix2d;

// Beyond |Duv| = .05 a CCT names no colour temperature (CIE 15:2018 9.4), but the chromaticity that
// a meter wrote as CCT and Duv is one still: that of a lamp behind a green gel.
constexpr double kFarthestDuv = 0.1;
constexpr double kScatter = 9.0;  // chi squared of one reading about its instrument's mean
constexpr double kColdestLocus = 1000.0;
// Chi-squared with two degrees of freedom at 95 %.
constexpr double kDisagreement = 5.991;

struct Estimate2 {
  Vector2 mean = Vector2::Zero();
  Matrix2 covariance = Matrix2::Zero();
};

struct ColorReading {
  Estimate2 in_xy;
  std::pair<std::string, ColorSource> instrument;
};

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

Vector2 XyFromMiredDuv(const Vector2& mired_duv) {
  const Xy xy = XyFromCct(KelvinFromMireds(Mireds(mired_duv[0])), mired_duv[1]);
  return {xy.x, xy.y};
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

Estimate2 FromChromaticity(const Reading& reading, CctMethod method) {
  const Vector2 xy(reading.xy->x, reading.xy->y);
  Vector2 mired_duv;
  if (reading.color_source == ColorSource::kCamera && MiredDuvOf(xy, method, mired_duv)) {
    const Matrix2 jacobian = XyByMiredDuv(mired_duv);
    const Vector2 variances(SigmaMired(reading) * SigmaMired(reading),
                            kSigmaDuvCamera * kSigmaDuvCamera);
    return {xy, jacobian * variances.asDiagonal() * jacobian.transpose()};
  }
  const double sigma = SigmaXy(reading.color_source);
  return {xy, sigma * sigma * Matrix2::Identity()};
}

// What makes a colour temperature none, "" where it is one.
std::string FaultOfTemperature(const Reading& reading) {
  const double kelvin = reading.cct->value();
  if (!std::isfinite(kelvin)) return "it is no number";
  if (kelvin < kColdestLocus) {
    return "nothing that shines for the eye is colder than 1000 K: is a digit missing?";
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

std::vector<ColorReading> CollectColors(const Session& session, const LightDescription& light,
                                        CctMethod method, Warnings& warnings) {
  std::vector<ColorReading> out;
  for (const SessionReading& row : session.readings) {
    const Reading& reading = row.reading;
    if (reading.light != light.name || reading.lamp == LampState::kOff || reading.shadow_card) {
      continue;
    }
    const std::pair<std::string, ColorSource> instrument{reading.meter, reading.color_source};
    if (UsableChromaticity(reading)) {
      out.push_back({FromChromaticity(reading, method), instrument});
    } else if (reading.cct) {
      const std::string fault = FaultOfTemperature(reading);
      if (fault.empty()) {
        out.push_back({FromTemperature(reading), instrument});
      } else {
        warnings.push_back({"color_unusable", light.name,
                            RoundedText(reading.cct->value(), 4) + " K is left out: " + fault});
      }
    }
  }
  return out;
}

// One estimate per instrument: the plain mean, its own covariance kept, scatter of the mean added.
std::vector<Estimate2> MeansOfInstruments(const std::vector<ColorReading>& readings,
                                          const LightDescription& light, Warnings& warnings) {
  bool scatters = false;
  std::map<std::pair<std::string, ColorSource>, std::vector<Estimate2>> groups;
  for (const ColorReading& reading : readings) groups[reading.instrument].push_back(reading.in_xy);
  std::vector<Estimate2> out;
  for (const auto& [instrument, group] : groups) {
    const auto n = static_cast<double>(group.size());
    Estimate2 mean;
    for (const Estimate2& one : group) {
      mean.mean += one.mean / n;
      mean.covariance += one.covariance / n;
    }
    if (group.size() > 1) {
      for (const Estimate2& one : group) {
        const Vector2 off = one.mean - mean.mean;
        mean.covariance += off * off.transpose() / (n * (n - 1.0));
        scatters = scatters || off.dot(one.covariance.inverse() * off) > kScatter;
      }
    }
    out.push_back(mean);
  }
  if (scatters) {
    warnings.push_back({"color_disagrees", light.name,
                        "its colours, read by one instrument, are of different lamps or settings; "
                        "their mean is no lamp's, and its interval holds them all"});
  }
  return out;
}

struct Combined {
  Estimate2 estimate;
  double chi_squared = 0.0;
};

// Generalised least squares of one value measured several times.
Combined Combine(const std::vector<Estimate2>& estimates) {
  Matrix2 information = Matrix2::Zero();
  Vector2 weighted = Vector2::Zero();
  for (const Estimate2& one : estimates) {
    const Matrix2 weight = one.covariance.inverse();
    information += weight;
    weighted += weight * one.mean;
  }
  Combined out;
  out.estimate.covariance = information.inverse();
  out.estimate.mean = out.estimate.covariance * weighted;
  for (const Estimate2& one : estimates) {
    const Vector2 off = one.mean - out.estimate.mean;
    out.chi_squared += off.dot(one.covariance.inverse() * off);
  }
  return out;
}

// Instruments that disagree beyond their sigmas widen the interval by the Birge ratio.
void WidenByDisagreement(std::size_t count, const LightDescription& light, Combined& combined,
                         Warnings& warnings) {
  if (count < 2) return;
  const double dof = 2.0 * static_cast<double>(count - 1);
  if (combined.chi_squared <= kDisagreement * static_cast<double>(count - 1)) return;
  combined.estimate.covariance *= combined.chi_squared / dof;
  warnings.push_back({"color_disagrees", light.name,
                      "the instruments' colours differ by more than their uncertainties explain; "
                      "the interval was widened"});
}

// The estimates in (mired, Duv); empty when one of them has no CCT.
std::vector<Estimate2> InMiredDuv(const std::vector<Estimate2>& in_xy, CctMethod method) {
  std::vector<Estimate2> out;
  for (const Estimate2& one : in_xy) {
    Estimate2 converted;
    if (!MiredDuvOf(one.mean, method, converted.mean)) return {};
    const Matrix2 inverse = XyByMiredDuv(converted.mean).inverse();
    converted.covariance = inverse * one.covariance * inverse.transpose();
    out.push_back(converted);
  }
  return out;
}

Uncertain KelvinFromMiredEstimate(double mired, double variance) {
  const double half = kZ95 * std::sqrt(variance);
  const double low = 1e6 / (mired + half);
  // A colour so blue that its interval passes infinity keeps the lower side's width.
  const double high = mired > half ? 1e6 / (mired - half) : 2.0 * (1e6 / mired) - low;
  return {1e6 / mired, 0.5 * (high - low), low, high};
}

void Withhold(const Vector2& xy, const LightDescription& light, Warnings& warnings) {
  const CctResult cct = CctFromXy({xy[0], xy[1]});
  std::string why = "its chromaticity has none";
  if (cct.status == CctStatus::kFarFromLocus) {
    why = "Duv is " + RoundedText(cct.duv, 3) + ", beyond 0.05";
  } else if (cct.status == CctStatus::kBelowRange) {
    why = "it is redder than 1000 K";
  } else if (cct.status == CctStatus::kBeyondInfinity) {
    why = "it is bluer than any temperature";
  }
  warnings.push_back(
      {"cct_withheld", light.name, "no colour temperature is given: " + why + "; use xy"});
}

}  // namespace

FittedColor FitColor(const Session& session, const LightDescription& light, Warnings& warnings,
                     CctMethod method) {
  FittedColor color;
  const std::vector<Estimate2> in_xy =
      MeansOfInstruments(CollectColors(session, light, method, warnings), light, warnings);
  if (in_xy.empty()) return color;
  const std::vector<Estimate2> in_mired = InMiredDuv(in_xy, method);
  if (!in_mired.empty()) {
    Combined combined = Combine(in_mired);
    WidenByDisagreement(in_mired.size(), light, combined, warnings);
    const Estimate2& e = combined.estimate;
    const Vector2 xy = XyFromMiredDuv(e.mean);
    color.cct_K = KelvinFromMiredEstimate(e.mean[0], e.covariance(0, 0));
    color.duv = UncertainFromNormal(e.mean[1], std::sqrt(e.covariance(1, 1)));
    color.xy = Xy{xy[0], xy[1]};
    return color;
  }
  Combined combined = Combine(in_xy);
  WidenByDisagreement(in_xy.size(), light, combined, warnings);
  color.xy = Xy{combined.estimate.mean[0], combined.estimate.mean[1]};
  Withhold(combined.estimate.mean, light, warnings);
  return color;
}

}  // namespace lightcal::fit
