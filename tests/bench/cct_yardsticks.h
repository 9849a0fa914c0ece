// SPDX-License-Identifier: Apache-2.0
// The two methods of colour temperature in common use, written as published but over double tables:
// yardsticks, no part of lightcal.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/colorimetry/planckian.h"

namespace lightcal {

// Robertson's 31 isotherms, as unit directions (J. Opt. Soc. Am. 58, 1528 (1968)); the table's
// values come from the exact locus, so without the misprint at 325 mired.
class Robertson31 {
 public:
  Robertson31() {
    for (int i = 0; i < 31; ++i) {
      const double mireds = i <= 10 ? 10.0 * i : 100.0 + 25.0 * (i - 10);
      const LocusPoint at = PlanckianLocusAt(Mireds(mireds));
      const double speed = std::hypot(at.du, at.dv);
      lines_[static_cast<std::size_t>(i)] = {mireds, at.uv.u, at.uv.v, at.du / speed,
                                             at.dv / speed};
    }
  }
  // 0 below 1667 K, where the table ends.
  [[nodiscard]] double KelvinOf(Uv1960 c) const {
    double before = 0.0;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      const Line& l = lines_[i];
      const double ahead = (c.u - l.u) * l.du + (c.v - l.v) * l.dv;
      if (ahead <= 0.0 && i > 0) {
        const double share = before / (before - ahead);
        return 1e6 / (lines_[i - 1].mireds + share * (l.mireds - lines_[i - 1].mireds));
      }
      before = ahead;
    }
    return 0.0;
  }

 private:
  struct Line {
    double mireds, u, v, du, dv;
  };
  std::array<Line, 31> lines_{};
};

// Ohno's search of a table, 0.1 % a step unless told otherwise, with its triangular and parabolic
// solutions (LEUKOS 10, 47 (2014)).
class OhnoTable {
 public:
  explicit OhnoTable(double step = 1e-3) {
    for (double kelvin = 1000.0; kelvin < 1.02e5; kelvin *= 1.0 + step) {
      const Uv1960 uv = UvFromCct(Kelvin(kelvin));
      rows_.push_back({kelvin, uv.u, uv.v});
    }
  }
  [[nodiscard]] double KelvinOf(Uv1960 c) const {
    const auto distance = [&](std::size_t i) {
      return std::hypot(rows_[i].u - c.u, rows_[i].v - c.v);
    };
    std::size_t m = 1;
    double least = 1e9;
    for (std::size_t i = 1; i + 1 < rows_.size(); ++i) {
      const double du = rows_[i].u - c.u;
      const double dv = rows_[i].v - c.v;
      if (du * du + dv * dv < least) {
        least = du * du + dv * dv;
        m = i;
      }
    }
    const Row &p = rows_[m - 1], &q = rows_[m], &n = rows_[m + 1];
    const double dp = distance(m - 1), dq = distance(m), dn = distance(m + 1);
    const double side = std::hypot(n.u - p.u, n.v - p.v);
    const double along = (dp * dp - dn * dn + side * side) / (2.0 * side);
    const double duv = std::sqrt(std::max(0.0, dp * dp - along * along));
    if (duv < 0.002) return p.kelvin + (n.kelvin - p.kelvin) * along / side;
    const double x = (n.kelvin - q.kelvin) * (p.kelvin - n.kelvin) * (q.kelvin - p.kelvin);
    const double a = (p.kelvin * (dn - dq) + q.kelvin * (dp - dn) + n.kelvin * (dq - dp)) / x;
    const double b = -(p.kelvin * p.kelvin * (dn - dq) + q.kelvin * q.kelvin * (dp - dn) +
                       n.kelvin * n.kelvin * (dq - dp)) /
                     x;
    return -b / (2.0 * a);
  }

 private:
  struct Row {
    double kelvin, u, v;
  };
  std::vector<Row> rows_;
};

}  // namespace lightcal
