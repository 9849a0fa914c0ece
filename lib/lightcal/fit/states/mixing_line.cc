// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/states/mixing_line.h"

#include <algorithm>
#include <cmath>

#include "lightcal/colorimetry/cct.h"

namespace lightcal::fit {
namespace {

constexpr double kLeastLength = 0.005;
constexpr double kMostScatter = 0.0015;

Xy Along(const MixingLine& line, double t) {
  return {line.first.x + t * (line.last.x - line.first.x),
          line.first.y + t * (line.last.y - line.first.y)};
}

}  // namespace

std::optional<MixingLine> MixingLineOf(const std::vector<Xy>& colors) {
  if (colors.size() < 3) return std::nullopt;
  const auto n = static_cast<double>(colors.size());
  double mx = 0.0;
  double my = 0.0;
  for (const Xy& one : colors) {
    mx += one.x / n;
    my += one.y / n;
  }
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (const Xy& one : colors) {
    xx += (one.x - mx) * (one.x - mx);
    xy += (one.x - mx) * (one.y - my);
    yy += (one.y - my) * (one.y - my);
  }
  const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
  const double dx = std::cos(angle);
  const double dy = std::sin(angle);
  double least = 0.0;
  double most = 0.0;
  double off = 0.0;
  for (const Xy& one : colors) {
    const double along = (one.x - mx) * dx + (one.y - my) * dy;
    const double beside = (one.y - my) * dx - (one.x - mx) * dy;
    least = std::min(least, along);
    most = std::max(most, along);
    off += beside * beside;
  }
  const double scatter = std::sqrt(off / (n - 2.0));
  if (most - least < kLeastLength || scatter > kMostScatter) return std::nullopt;
  MixingLine line{{mx + least * dx, my + least * dy}, {mx + most * dx, my + most * dy}, 0.0};
  // Duv is a distance in CIE 1960 uv, where chromaticities lie about two thirds as far apart.
  line.sd_duv = 0.67 * scatter * std::sqrt(1.0 + 1.0 / n);
  return line;
}

std::optional<double> DuvOnLine(const MixingLine& line, Kelvin cct) {
  const auto mired_at = [&](double t) {
    return 1e6 / CctFromXy(Along(line, t)).temperature.value();
  };
  const double wanted = 1e6 / cct.value();
  double low = 0.0;
  double high = 1.0;
  double off_low = mired_at(low) - wanted;
  double off_high = mired_at(high) - wanted;
  if (off_low * off_high > 0.0) return std::nullopt;
  // False position, halving the end that stays (Illinois): a CCT costs sums over the whole table.
  constexpr double kNear_mired = 1e-9;
  double at = std::abs(off_low) < std::abs(off_high) ? low : high;
  for (int step = 0; step < 50 && std::abs(off_high - off_low) > kNear_mired; ++step) {
    at = low - off_low * (high - low) / (off_high - off_low);
    const double off = mired_at(at) - wanted;
    if (std::abs(off) < kNear_mired) break;
    if (off * off_high < 0.0) {
      low = high;
      off_low = off_high;
    } else {
      off_low *= 0.5;
    }
    high = at;
    off_high = off;
  }
  return CctFromXy(Along(line, at)).duv;
}

}  // namespace lightcal::fit
