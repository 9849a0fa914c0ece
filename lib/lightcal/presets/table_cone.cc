// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/table_cone.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace lightcal {
namespace {

constexpr int kGammas = 90;  // rings of 2 degrees
constexpr int kTurns = 24;

// The table by rings, relative to its axis.
struct Ring {
  double cosine = 0.0;  // of its middle
  double weight = 0.0;  // its part of the sphere
  double mean = 0.0, least = 0.0, most = 0.0;
};
using Rings = std::array<Ring, kGammas>;

Rings RingsOf(const IntensityTable& table, double axial) {
  Rings rings;
  for (int i = 0; i < kGammas; ++i) {
    const double gamma = std::numbers::pi * (i + 0.5) / kGammas;
    const double sine = std::sin(gamma);
    Ring ring{std::cos(gamma), sine * std::numbers::pi / kGammas / 2.0, 0.0,
              std::numeric_limits<double>::infinity(), 0.0};
    for (int j = 0; j < kTurns; ++j) {
      const double c = 2.0 * std::numbers::pi * j / kTurns;
      const double part =
          table.Towards({sine * std::cos(c), sine * std::sin(c), -ring.cosine}).value() / axial;
      ring.mean += part / kTurns;
      ring.least = std::min(ring.least, part);
      ring.most = std::max(ring.most, part);
    }
    rings[static_cast<std::size_t>(i)] = ring;
  }
  return rings;
}

// The squared-linear profile from the cosines of its cone.
double ConeProfile(double cosine, double inner, double outer) {
  const double t = std::clamp((cosine - outer) / std::max(1e-12, inner - outer), 0.0, 1.0);
  return t * t;
}

template <class Model>
double SquaredError(const Rings& rings, const Model& model) {
  double sum = 0.0;
  for (const Ring& ring : rings) {
    const double off = model(ring.cosine) - ring.mean;
    sum += ring.weight * off * off;
  }
  return sum;
}

template <class Model>
TableSubstitute Judged(const Rings& rings, const Model& model) {
  TableSubstitute out;
  double ours = 0.0, theirs = 0.0;
  for (const Ring& ring : rings) {
    const double got = model(ring.cosine);
    out.worst = std::max({out.worst, std::abs(got - ring.least), std::abs(got - ring.most)});
    ours += ring.weight * got;
    theirs += ring.weight * ring.mean;
  }
  out.flux = ours / theirs;
  return out;
}

double CosineOfDegrees(int degrees) { return std::cos(RadiansFromDegrees(degrees).value()); }

}  // namespace

std::optional<TableSubstitute> SubstituteForTable(const IntensityTable& table) {
  const double axial = table.Towards({0.0, 0.0, -1.0}).value();
  if (!(axial > 0.0)) return std::nullopt;
  const Rings rings = RingsOf(table, axial);
  const auto point = [](double) { return 1.0; };
  double least = SquaredError(rings, point);
  int inner_deg = -1, outer_deg = -1;
  for (int outer = 2; outer <= 90; ++outer) {
    const double outer_cosine = CosineOfDegrees(outer);
    for (int inner = 0; inner < outer; ++inner) {
      const double inner_cosine = CosineOfDegrees(inner);
      const double error = SquaredError(
          rings, [&](double cosine) { return ConeProfile(cosine, inner_cosine, outer_cosine); });
      if (error >= least) continue;
      least = error;
      inner_deg = inner;
      outer_deg = outer;
    }
  }
  if (outer_deg < 0) return Judged(rings, point);
  const SpotCone cone{RadiansFromDegrees(inner_deg), RadiansFromDegrees(outer_deg)};
  TableSubstitute out = Judged(rings, [&](double cosine) {
    return ConeProfile(cosine, std::cos(cone.inner.value()), std::cos(cone.outer.value()));
  });
  out.cone = cone;
  return out;
}

}  // namespace lightcal
