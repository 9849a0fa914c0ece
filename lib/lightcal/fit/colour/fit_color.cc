// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/colour/fit_color.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/fit/colour/color_readings.h"
#include "lightcal/fit/colour/shared_color.h"

namespace lightcal::fit {
namespace {

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

void WarnOfDisagreement(const SharedColor& found, const std::string& light, Warnings& warnings) {
  if (found.scatters) {
    warnings.push_back({"color_disagrees", light,
                        "its colours, read by one instrument, are of different lamps or settings; "
                        "their mean is no lamp's, and its interval holds them all"});
  }
  if (found.disagrees) {
    warnings.push_back({"color_disagrees", light,
                        "the instruments' colours differ by more than their uncertainties explain; "
                        "the interval was widened"});
  }
}

// Said where walls and ambient light more than double the interval.
std::string NoteOfOthers(const std::vector<ColorReading>& readings, const ColorFit& fit,
                         const SharedColor& found, const std::string& light) {
  constexpr double kDoubled = 0.75;  // of the variance
  const double by_others = found.by_others.trace() / found.color.covariance.trace();
  if (!(by_others > kDoubled)) return "";
  double least = 1.0;
  for (const ColorReading& one : readings) {
    if (one.lit) least = std::min(least, one.others.walls + one.others.ambient);
  }
  const double alone = fit.color.cct_K->u95 * std::sqrt(1.0 - by_others);
  return light + ": its colour was read where " + RoundedText(100.0 * least, 2) +
         " % of the light came off the walls or from elsewhere, which tints it: \u00b1 " +
         RoundedText(fit.color.cct_K->u95, 2) + " K, of which the meter brings \u00b1 " +
         RoundedText(alone, 2) +
         "; read its colour nearer, or once more behind the shadow card at the same place";
}

}  // namespace

ColorFit FitColor(const Session& session, const LightDescription& light, const OtherLight* others,
                  Warnings& warnings, CctMethod method, const ColorOffWall* off_wall) {
  ColorFit out;
  const std::vector<ColorReading> readings =
      CollectColors(session, light, others, off_wall, method, warnings);
  if (std::ranges::none_of(readings, [](const ColorReading& one) { return one.lit; })) return out;
  const SharedColor found = SolveSharedColor(readings, method);
  WarnOfDisagreement(found, light.name, warnings);
  const bool one_meter = std::ranges::all_of(
      readings, [&](const ColorReading& one) { return one.meter == readings.front().meter; });
  if (one_meter) out.color.meter = readings.front().meter;
  Estimate2 color = found.color;
  if (!found.in_mired) {
    const Vector2 xy = color.mean;
    Vector2 mired_duv;
    out.color.xy = Xy{xy[0], xy[1]};
    if (!MiredDuvOf(xy, method, mired_duv)) {
      Withhold(xy, light, warnings);
      return out;
    }
    const Matrix2 inverse = XyByMiredDuv(mired_duv).inverse();
    color = {mired_duv, inverse * color.covariance * inverse.transpose()};
  } else {
    const Vector2 xy = XyFromMiredDuv(color.mean);
    out.color.xy = Xy{xy[0], xy[1]};
  }
  out.color.cct_K = KelvinFromMiredEstimate(color.mean[0], color.covariance(0, 0));
  out.color.duv = UncertainFromNormal(color.mean[1], std::sqrt(color.covariance(1, 1)));
  out.note = NoteOfOthers(readings, out, found, light.name);
  return out;
}

}  // namespace lightcal::fit
