// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/states/common_errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/core/standard_normal.h"

namespace lightcal {
namespace {

double Beside(double whole, double part) {
  return std::sqrt(std::max(0.0, whole * whole - part * part));
}

// Where it has a CCT that is moved, and its Duv; else u and v.
Xy Moved(Xy xy, const CctResult& cct, double ln_mired, double duv, double across) {
  if (cct.valid()) {
    return XyFromCct(Kelvin(cct.temperature.value() * std::exp(-ln_mired)), cct.duv + duv);
  }
  const Uv1960 uv = Uv1960FromXy(xy);
  return XyFromUv1960({uv.u + across, uv.v + duv});
}

bool SameLamp(const LightPoint& a, const LightPoint& b) {
  return !a.lamp.empty() && a.lamp == b.lamp;
}
bool SameOwn(const LightPoint& a, const LightPoint& b) {
  return SameLamp(a, b) && SameState(a.state, b.state);
}
bool SameColorMeter(const LightPoint& a, const LightPoint& b) {
  return a.color_meter && a.color_meter == b.color_meter;
}
bool SameLevelMeter(const LightPoint& a, const LightPoint& b) {
  return a.level_meter && b.level_meter && a.level_meter->name == b.level_meter->name;
}

double Apart(double a, double b, bool same) { return same ? a - b : std::hypot(a, b); }

}  // namespace

ErrorParts PartsOf(const LightPoint& point) {
  ErrorParts out;
  out.own = point.own;
  out.cct = CctFromXy(point.xy);
  const LightErrors rest = {Beside(point.sd.ln_mired, point.own.ln_mired),
                            Beside(point.sd.duv, point.own.duv),
                            Beside(point.sd.ln_level, point.own.ln_level)};
  if (point.level_meter) {
    out.meter.ln_level = std::min(rest.ln_level, point.level_meter->calibration_relative);
  }
  if (point.color_meter) {
    const double sigma = point.color_meter->sigma_xy;
    out.meter_xy = sigma;
    const auto by_xy = CctJacobianAt(point.xy);
    if (out.cct.valid() && by_xy) {
      const double mired = std::hypot(by_xy->dmired_dx, by_xy->dmired_dy) * sigma;
      out.meter.ln_mired = mired * out.cct.temperature.value() / 1e6;
      out.meter.duv = std::hypot(by_xy->dduv_dx, by_xy->dduv_dy) * sigma;
      // No more than there is: what an instrument is off by was stated with what it repeats within.
      double part = 1.0;
      if (out.meter.ln_mired > rest.ln_mired) part = rest.ln_mired / out.meter.ln_mired;
      if (out.meter.duv > rest.duv) part = std::min(part, rest.duv / out.meter.duv);
      out.meter_xy *= part;
      out.meter.ln_mired *= part;
      out.meter.duv *= part;
    }
  }
  out.lamp = {Beside(rest.ln_mired, out.meter.ln_mired), Beside(rest.duv, out.meter.duv),
              Beside(rest.ln_level, out.meter.ln_level)};
  return out;
}

LightErrors ErrorsApart(const LightPoint& a, const LightPoint& b) {
  const ErrorParts of_a = PartsOf(a);
  const ErrorParts of_b = PartsOf(b);
  const auto apart = [&](double LightErrors::* of, bool same_meter) {
    return std::hypot(Apart(of_a.own.*of, of_b.own.*of, SameOwn(a, b)),
                      Apart(of_a.lamp.*of, of_b.lamp.*of, SameLamp(a, b)),
                      Apart(of_a.meter.*of, of_b.meter.*of, same_meter));
  };
  return {apart(&LightErrors::ln_mired, SameColorMeter(a, b)),
          apart(&LightErrors::duv, SameColorMeter(a, b)),
          apart(&LightErrors::ln_level, SameLevelMeter(a, b))};
}

bool ColorErrorCancels(const LightPoint& a, const LightPoint& b) {
  if (a.color_meter && b.color_meter) return SameColorMeter(a, b);
  return SameLamp(a, b) && !a.color_meter && !b.color_meter;
}
bool LevelErrorCancels(const LightPoint& a, const LightPoint& b) {
  return SameLamp(a, b) || SameLevelMeter(a, b);
}

DrawnPoints::DrawnPoints(std::vector<LightPoint> points, std::uint64_t seed)
    : points_(std::move(points)), random_(seed) {
  // The first point that has a source in common names it.
  const auto source = [&](std::size_t i, const auto& same, std::size_t Sources::* of) {
    for (std::size_t k = 0; k < i; ++k) {
      if (same(points_[k], points_[i])) return sources_[k].*of;
    }
    return count_++;
  };
  for (std::size_t i = 0; i < points_.size(); ++i) {
    parts_.push_back(PartsOf(points_[i]));
    Sources of;
    of.own = source(i, SameOwn, &Sources::own);
    of.lamp = source(i, SameLamp, &Sources::lamp);
    of.color_meter = source(i, SameColorMeter, &Sources::color_meter);
    of.level_meter = source(i, SameLevelMeter, &Sources::level_meter);
    sources_.push_back(of);
  }
}

std::vector<LightPoint> DrawnPoints::Next() {
  StandardNormal normal;
  std::vector<std::array<double, 4>> drawn(count_);
  for (auto& one : drawn) {
    for (double& value : one) value = normal(random_);
  }
  std::vector<LightPoint> out = points_;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const ErrorParts& parts = parts_[i];
    const auto& own = drawn[sources_[i].own];
    const auto& lamp = drawn[sources_[i].lamp];
    const auto& color = drawn[sources_[i].color_meter];
    out[i].xy =
        Moved(out[i].xy, parts.cct, parts.own.ln_mired * own[0] + parts.lamp.ln_mired * lamp[0],
              parts.own.duv * own[1] + parts.lamp.duv * lamp[1],
              parts.own.duv * own[2] + parts.lamp.duv * lamp[2]);
    out[i].xy.x += parts.meter_xy * color[0];
    out[i].xy.y += parts.meter_xy * color[1];
    out[i].level *= std::exp(parts.own.ln_level * own[3] + parts.lamp.ln_level * lamp[3] +
                             parts.meter.ln_level * drawn[sources_[i].level_meter][0]);
  }
  return out;
}

}  // namespace lightcal
