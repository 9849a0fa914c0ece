// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/intensity_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <utility>

namespace lightcal {
namespace {

using std::numbers::pi;
using enum GoniometerType;
using enum TableInterpolation;

double Rad(double degrees) { return degrees * pi / 180.0; }

std::vector<double> Range(double from, double to, double step) {
  std::vector<double> out;
  for (int i = 0; from + i * step <= to + 1e-9; ++i) out.push_back(from + i * step);
  return out;
}

IntensityTable TableOf(GoniometerType type, std::vector<double> horizontal,
                       std::vector<double> vertical,
                       const std::function<double(double, double)>& candela) {
  IntensityGrid grid{type, std::move(horizontal), std::move(vertical), {}};
  for (const double h : grid.horizontal_deg) {
    for (const double v : grid.vertical_deg) grid.candela.push_back(candela(h, v));
  }
  auto table = IntensityTable::Make(std::move(grid), "test");
  EXPECT_TRUE(table) << table.error().message;
  return *std::move(table);
}

// ---- the independent side: rotations, and quadrature cell by cell ----

Vec3 AboutX(const Vec3& v, double a) {
  return {v[0], std::cos(a) * v[1] - std::sin(a) * v[2], std::sin(a) * v[1] + std::cos(a) * v[2]};
}
Vec3 AboutY(const Vec3& v, double a) {
  return {std::cos(a) * v[0] + std::sin(a) * v[2], v[1], -std::sin(a) * v[0] + std::cos(a) * v[2]};
}
Vec3 AboutZ(const Vec3& v, double a) {
  return {std::cos(a) * v[0] - std::sin(a) * v[1], std::sin(a) * v[0] + std::cos(a) * v[1], v[2]};
}

constexpr Vec3 kNadir = {0.0, 0.0, -1.0};

// A goniometer turns the photometric zero by its inner angle, then by its outer one; H clockwise in
// types A and B (LM-63-2002). A turns H about the lamp's length, C0, last; B turns V about its
// width, C90, last.
Vec3 DirectionOf(GoniometerType type, double h_deg, double v_deg) {
  const double h = Rad(h_deg);
  const double v = Rad(v_deg);
  if (type == kC) return AboutZ(AboutY(kNadir, -v), h);
  if (type == kB) return AboutY(AboutX(kNadir, -h), -v);
  return AboutX(AboutY(kNadir, -v), -h);
}

// Boole's rule with 32 panels in every cell between the given angles (degrees, ends included).
double SphereIntegral(const IntensityTable& table, TableInterpolation way,
                      const std::vector<double>& horizontal, const std::vector<double>& vertical) {
  constexpr int kPanels = 32;
  const GoniometerType type = table.grid().type;
  const auto weight = [&](double h, double v) {
    if (type == kC) return std::sin(Rad(v));
    return std::cos(Rad(type == kB ? h : v));
  };
  const auto boole = [](double a, double b, const auto& f) {
    const double step = (b - a) / kPanels;
    double sum = 0.0;
    for (int i = 0; i <= kPanels; ++i) {
      // Just inside the cell: the interpolant may jump at its rim.
      const double x = std::clamp(a + i * step, a + 1e-12 * (b - a), b - 1e-12 * (b - a));
      constexpr std::array<double, 4> kWeights = {14.0, 32.0, 12.0, 32.0};
      sum += f(x) * (i == 0 || i == kPanels ? 7.0 : kWeights[static_cast<std::size_t>(i % 4)]);
    }
    return sum * step * 2.0 / 45.0;
  };
  double flux = 0.0;
  for (std::size_t i = 1; i < horizontal.size(); ++i) {
    for (std::size_t j = 1; j < vertical.size(); ++j) {
      flux += boole(horizontal[i - 1], horizontal[i], [&](double h) {
        return boole(vertical[j - 1], vertical[j], [&](double v) {
          return table.Towards(DirectionOf(type, h, v), way).value() * weight(h, v);
        });
      });
    }
  }
  return flux * Rad(1.0) * Rad(1.0);
}

std::vector<double> WholeTurn(const IntensityTable& table) {
  const auto& c = table.grid().horizontal_deg;
  std::vector<double> all;
  for (const double one : c) {
    for (const double mirrored : {one, 180.0 - one, 180.0 + one, 360.0 - one, 540.0 - one}) {
      if (mirrored >= 0.0 && mirrored <= 360.0) all.push_back(mirrored);
    }
  }
  for (const double quarter : {0.0, 90.0, 180.0, 270.0, 360.0}) all.push_back(quarter);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

// ---- flux ----

TEST(IntensityTable, ConstantIntensityCarriesFourPi) {
  for (const auto way : {kLinear, kCubic}) {
    const auto table = TableOf(kC, {0.0}, Range(0, 180, 7.5), [](double, double) { return 100.0; });
    EXPECT_NEAR(table.Flux(way).value(), 400.0 * pi, 1e-10);
    const auto b =
        TableOf(kB, Range(-90, 90, 10), Range(-90, 90, 15), [](double, double) { return 100.0; });
    EXPECT_NEAR(b.Flux(way).value(), 200.0 * pi, 1e-10);
    const auto a =
        TableOf(kA, {0.0, 90.0}, {0.0, 30.0, 90.0}, [](double, double) { return 100.0; });
    EXPECT_NEAR(a.Flux(way).value(), 200.0 * pi, 1e-10);
  }
}

TEST(IntensityTable, LambertianLobeCarriesPi) {
  const auto lobe = [](double, double v) { return v < 90.0 ? 100.0 * std::cos(Rad(v)) : 0.0; };
  const auto table = TableOf(kC, {0.0}, Range(0, 90, 5), lobe);
  EXPECT_NEAR(table.Flux(kCubic).value() / (100.0 * pi), 1.0, 2e-5);
  EXPECT_NEAR(table.Flux(kLinear).value() / (100.0 * pi), 1.0, 2e-3);
}

struct Layout {
  GoniometerType type;
  std::vector<double> horizontal, vertical;
  TableSymmetry symmetry;
};

std::vector<Layout> Layouts() {
  using enum TableSymmetry;
  return {{kC, {0.0}, Range(0, 90, 10), kAxial},
          {kC, {0.0, 30.0, 45.0, 90.0}, {0, 2, 7, 30, 90}, kQuadrant},
          {kC, Range(0, 180, 30), Range(0, 180, 20), kBilateral},
          {kC, Range(90, 270, 45), Range(90, 180, 15), kBilateral90},
          {kC, Range(0, 360, 45), Range(0, 180, 30), kNone},
          {kC, Range(0, 315, 45), Range(0, 120, 20), kNone},
          {kB, Range(-40, 40, 20), Range(-30, 60, 15), kNone},
          {kB, Range(0, 90, 30), Range(-90, 90, 45), kBilateral},
          {kA, Range(-60, 45, 15), Range(-10, 10, 5), kNone},
          {kA, Range(0, 60, 20), Range(0, 90, 30), kQuadrant},
          {kB, Range(-90, 90, 45), Range(0, 60, 20), kBilateral90}};
}

TEST(IntensityTable, FluxIsTheIntegralOfTheInterpolantForRandomTables) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> level(0.0, 1.0);
  for (const Layout& layout : Layouts()) {
    for (int trial = 0; trial < 3; ++trial) {
      // Cubed: deep valleys, where the cubic would dip below zero.
      const auto table = TableOf(layout.type, layout.horizontal, layout.vertical,
                                 [&](double, double) { return std::pow(level(random), 3.0); });
      ASSERT_EQ(table.symmetry(), layout.symmetry);
      std::vector<double> h = layout.type == kC ? WholeTurn(table) : layout.horizontal;
      std::vector<double> v = layout.vertical;
      const auto mirror = [](std::vector<double>& x) {
        for (std::size_t i = 0, n = x.size(); i < n; ++i) x.push_back(-x[i]);
        std::sort(x.begin(), x.end());
        x.erase(std::unique(x.begin(), x.end()), x.end());
      };
      if (layout.type != kC && h.front() == 0.0) mirror(h);
      if (layout.type != kC && v.front() == 0.0) mirror(v);
      const double brute = SphereIntegral(table, kLinear, h, v);
      EXPECT_NEAR(table.Flux(kLinear).value() / brute, 1.0, 1e-9);
    }
  }
}

TEST(IntensityTable, CubicFluxIsTheIntegralOfTheCubicWhereItStaysPositive) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> level(0.6, 1.0);
  for (const Layout& layout : Layouts()) {
    if (layout.type != kC) continue;
    const auto table = TableOf(layout.type, layout.horizontal, layout.vertical,
                               [&](double, double) { return level(random); });
    const double brute = SphereIntegral(table, kCubic, WholeTurn(table), layout.vertical);
    EXPECT_NEAR(table.Flux(kCubic).value() / brute, 1.0, 1e-9);
  }
}

TEST(IntensityTable, CubicNeverFallsBelowZeroAndItsFluxKnowsIt) {
  const auto spike = [](double, double v) { return v == 40.0 ? 1000.0 : (v == 50.0 ? 5.0 : 0.5); };
  const auto table = TableOf(kC, {0.0}, Range(0, 180, 10), spike);
  double sum = 0.0;
  constexpr int kCells = 400000;
  for (int i = 0; i < kCells; ++i) {
    const double gamma = pi * (i + 0.5) / kCells;
    const double value = table.At(Radians(0.3), Radians(gamma), kCubic).value();
    ASSERT_GE(value, 0.0);
    sum += value * std::sin(gamma);
  }
  sum *= 2.0 * pi * pi / kCells;
  EXPECT_NEAR(table.Flux(kCubic).value() / sum, 1.0, 1e-8);
}

// ---- directions ----

TEST(IntensityTable, EveryTypeAnswersInItsOwnAnglesByRotation) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (const Layout& layout : Layouts()) {
    const auto smooth = [](double h, double v) {
      return 2.0 + std::sin(0.05 * h + 1.0) * std::cos(0.03 * v);
    };
    const auto table = TableOf(layout.type, layout.horizontal, layout.vertical, smooth);
    for (int trial = 0; trial < 200; ++trial) {
      const auto pick = [&](const std::vector<double>& nodes) {
        if (nodes.size() == 1) return std::pair<std::size_t, double>{0, 0.0};
        const auto i =
            static_cast<std::size_t>(part(random) * static_cast<double>(nodes.size() - 1));
        return std::pair<std::size_t, double>{i, part(random)};
      };
      const auto [hi, hp] = pick(layout.horizontal);
      const auto [vi, vp] = pick(layout.vertical);
      const auto at = [&](const std::vector<double>& nodes, std::size_t i, double p) {
        return nodes.size() == 1 ? nodes[0] : nodes[i] + p * (nodes[i + 1] - nodes[i]);
      };
      const auto node = [&](std::size_t i, std::size_t j) {
        return smooth(layout.horizontal[std::min(i, layout.horizontal.size() - 1)],
                      layout.vertical[j]);
      };
      const double want = (1 - hp) * ((1 - vp) * node(hi, vi) + vp * node(hi, vi + 1)) +
                          hp * ((1 - vp) * node(hi + 1, vi) + vp * node(hi + 1, vi + 1));
      const Vec3 d =
          DirectionOf(layout.type, at(layout.horizontal, hi, hp), at(layout.vertical, vi, vp));
      EXPECT_NEAR(table.Towards(d * 3.0).value(), want, 1e-9 * want);
      // The same direction, spelled in C and gamma.
      const double c = std::atan2(d[1], d[0]);
      const double gamma = std::atan2(std::hypot(d[0], d[1]), -d[2]);
      EXPECT_NEAR(table.At(Radians(c), Radians(gamma)).value(), want, 1e-8 * want);
    }
  }
}

TEST(IntensityTable, MirrorImagesShine) {
  const auto ramp = [](double h, double v) { return 10.0 + h + 0.1 * v; };
  const auto quadrant = TableOf(kC, {0, 90}, {0, 90, 180}, ramp);
  const auto at = [](const IntensityTable& t, double c, double g) {
    return t.At(Radians(Rad(c)), Radians(Rad(g))).value();
  };
  for (const double c : {150.0, 210.0, 330.0, -30.0, 390.0}) {
    EXPECT_NEAR(at(quadrant, c, 50), at(quadrant, 30, 50), 1e-9) << c;
  }
  const auto half = TableOf(kC, {0, 90, 180}, {0, 90, 180}, ramp);
  EXPECT_NEAR(at(half, 300, 50), at(half, 60, 50), 1e-9);
  EXPECT_NE(at(half, 120, 50), at(half, 60, 50));
  const auto half90 = TableOf(kC, {90, 180, 270}, {0, 90, 180}, ramp);
  EXPECT_NEAR(at(half90, 20, 50), at(half90, 160, 50), 1e-9);
  EXPECT_NEAR(at(half90, 300, 50), at(half90, 240, 50), 1e-9);
  const auto b = TableOf(kB, {0, 30}, {-20, 0, 40}, ramp);
  EXPECT_NEAR(b.Towards(DirectionOf(kB, -12, 7)).value(), b.Towards(DirectionOf(kB, 12, 7)).value(),
              1e-9);
  EXPECT_EQ(b.Towards(DirectionOf(kB, 31, 7)).value(), 0.0);
  EXPECT_EQ(b.Towards(DirectionOf(kB, 12, 41)).value(), 0.0);
  EXPECT_EQ(b.Towards({0, 0, 1}).value(), 0.0);
}

TEST(IntensityTable, CubicPassesTheNodesAndBeatsTheBrokenLineOnSmoothLobes) {
  const auto lobe = [](double, double v) {
    return v < 90.0 ? std::pow(std::cos(Rad(v)), 8.0) : 0.0;
  };
  const auto table = TableOf(kC, {0.0}, Range(0, 180, 5), lobe);
  double worst_line = 0.0;
  double worst_cubic = 0.0;
  for (int i = 0; i < 1800; ++i) {
    const double v = 0.1 * i;
    const double truth = lobe(0, v);
    const auto error = [&](TableInterpolation way) {
      return std::abs(table.At(Radians(0), Radians(Rad(v)), way).value() - truth);
    };
    worst_line = std::max(worst_line, error(kLinear));
    worst_cubic = std::max(worst_cubic, error(kCubic));
    if (i % 50 == 0) {
      EXPECT_LT(error(kCubic), 1e-12);
    }
  }
  EXPECT_LT(worst_cubic, 0.002);
  EXPECT_GT(worst_line, 0.007);
}

// ---- peak and lobes ----

TEST(IntensityTable, BeamAndFieldOfAPowerOfTheCosineAreClosedForms) {
  const auto lobe = [](double, double v) {
    return v < 90.0 ? 500.0 * std::pow(std::cos(Rad(v)), 8.0) : 0.0;
  };
  const auto table = TableOf(kC, {0.0}, Range(0, 90, 0.5), lobe);
  EXPECT_DOUBLE_EQ(table.peak().intensity.value(), 500.0);
  EXPECT_DOUBLE_EQ(table.peak().gamma.value(), 0.0);
  const auto width = [&](double level) {
    return DegreesFromRadians(LobeWidthsAt(table, level).mean);
  };
  EXPECT_NEAR(width(0.5), 2.0 * std::acos(std::pow(0.5, 1.0 / 8.0)) / Rad(1), 0.01);
  EXPECT_NEAR(width(0.1), 2.0 * std::acos(std::pow(0.1, 1.0 / 8.0)) / Rad(1), 0.01);
}

TEST(IntensityTable, LobesOfUplightsAndBatwingsAreMeasuredFromTheirOwnSide) {
  const auto up = TableOf(kC, {0.0}, Range(90, 180, 1),
                          [](double, double v) { return std::pow(-std::cos(Rad(v)), 2.0) + 1e-9; });
  EXPECT_NEAR(DegreesFromRadians(LobeWidth(up, Radians(0), 0.5)), 90.0, 0.02);
  // A dark centre does not end the lobe; the weaker lobe upwards does not count.
  const auto wings = TableOf(kC, {0.0}, {0, 30, 60, 90, 150, 180}, [](double, double v) {
    return v == 30 ? 10.0 : (v == 0 ? 2.0 : (v > 90 ? 8.0 : 0.0));
  });
  EXPECT_NEAR(DegreesFromRadians(LobeWidth(wings, Radians(0), 0.5)), 2 * 45.0, 1e-6);
  const auto bulb = TableOf(kC, {0.0}, {0, 180}, [](double, double) { return 5.0; });
  EXPECT_NEAR(DegreesFromRadians(LobeWidthsAt(bulb, 0.1).mean), 360.0, 1e-9);
}

TEST(IntensityTable, PeakOfEveryTypeIsFoundWhereItStands) {
  const auto b = TableOf(kB, Range(-90, 90, 10), Range(-90, 90, 10),
                         [](double h, double v) { return h == 20 && v == -30 ? 9.0 : 1.0; });
  const Vec3 d = DirectionOf(kB, 20, -30);
  EXPECT_NEAR(b.peak().gamma.value(), std::acos(-d[2]), 1e-12);
  EXPECT_NEAR(b.peak().c.value(), std::atan2(d[1], d[0]) + 2.0 * pi, 1e-12);
}

TEST(IntensityTable, HeadlampsAreMeasuredAboutTheirOwnZero) {
  const auto a = TableOf(kA, Range(-40, 40, 1), Range(-20, 20, 1), [](double h, double v) {
    return std::max(0.0, 100.0 * (1.0 - std::abs(h) / 30.0) * (1.0 - std::abs(v) / 12.0));
  });
  const auto beam = LobeWidthsAt(a, 0.5);
  EXPECT_NEAR(DegreesFromRadians(beam.along), 12.0, 1e-6);
  EXPECT_NEAR(DegreesFromRadians(beam.across), 30.0, 1e-6);
  EXPECT_NEAR(DegreesFromRadians(a.peak().gamma), 0.0, 1e-9);
}

// I = exp(-ln 2 (a / 15 deg)^2), a the angle to the peak: 30 degrees wide at a half, and
// 30 sqrt(log2 10) = 54.68 at a tenth, wherever the peak lies.
TEST(IntensityTable, ALobeBesideTheAxisIsMeasuredAboutItsOwnPeak) {
  for (const double gamma : {60.0, 90.0}) {
    const Vec3 peak{std::sin(Rad(gamma)) * std::cos(Rad(90)),
                    std::sin(Rad(gamma)) * std::sin(Rad(90)), -std::cos(Rad(gamma))};
    const auto table = TableOf(kC, Range(0, 360, 2.5), Range(0, 180, 1), [&](double c, double g) {
      const Vec3 u{std::sin(Rad(g)) * std::cos(Rad(c)), std::sin(Rad(g)) * std::sin(Rad(c)),
                   -std::cos(Rad(g))};
      const double off = std::acos(std::clamp(Dot(u, peak), -1.0, 1.0)) / Rad(15);
      return 1000.0 * std::exp2(-off * off);
    });
    const auto beam = LobeWidthsAt(table, 0.5);
    const auto field = LobeWidthsAt(table, 0.1);
    EXPECT_TRUE(beam.beside_axis);
    EXPECT_NEAR(DegreesFromRadians(beam.along), 30.0, 0.1) << gamma;
    EXPECT_NEAR(DegreesFromRadians(beam.across), 30.0, 0.2) << gamma;
    EXPECT_NEAR(DegreesFromRadians(field.along), 30.0 * std::sqrt(std::log2(10.0)), 0.1) << gamma;
    EXPECT_NEAR(DegreesFromRadians(field.across), 30.0 * std::sqrt(std::log2(10.0)), 0.3) << gamma;
  }
}

TEST(IntensityTable, AHeadlampSampledAsTypeCKeepsItsAngles) {
  const auto a = TableOf(kA, Range(-40, 40, 1), Range(-20, 20, 1), [](double h, double v) {
    return std::max(0.0, 100.0 * (1.0 - std::abs(h) / 30.0) * (1.0 - std::abs(v) / 12.0));
  });
  const auto c = SampledAsTypeC(a, Range(0, 360, 1), Range(0, 180, 1), kLinear);
  ASSERT_TRUE(c);
  const auto beam = LobeWidthsAt(*c, 0.5);
  EXPECT_NEAR(DegreesFromRadians(beam.along), 12.0, 0.05);
  EXPECT_NEAR(DegreesFromRadians(beam.across), 30.0, 0.05);
}

// One smooth lobe of the sphere, written in each type's own angles. By CIE 121 the pole of A planes
// is C0, that of B planes C90, so that sin V (A) = sin gamma cos C = d.x and sin H (B) = -d.y.
TEST(IntensityTable, OneBeamIsTheSameInEveryType) {
  const auto beam = [](const Vec3& d) {  // oblong, turned, beside its axis
    const double x = d[0] - 0.1;
    const double y = d[1] - 0.05;
    return 1000.0 * std::exp(-30.0 * x * x - 60.0 * y * y + 20.0 * x * y) *
           (d[2] < 0.0 ? 1.0 : 0.0);
  };
  const auto of_type_a = [&](double h, double v) {
    const double across = std::cos(Rad(v));
    return beam({std::sin(Rad(v)), -across * std::sin(Rad(h)), -across * std::cos(Rad(h))});
  };
  const auto of_type_b = [&](double h, double v) {
    const double across = std::cos(Rad(h));
    return beam({across * std::sin(Rad(v)), -std::sin(Rad(h)), -across * std::cos(Rad(v))});
  };
  const auto of_type_c = [&](double c, double g) {
    const double across = std::sin(Rad(g));
    return beam({across * std::cos(Rad(c)), across * std::sin(Rad(c)), -std::cos(Rad(g))});
  };
  const auto c = TableOf(kC, Range(0, 360, 1), Range(0, 180, 0.5), of_type_c);
  const auto a = TableOf(kA, Range(-90, 90, 1), Range(-90, 90, 1), of_type_a);
  const auto b = TableOf(kB, Range(-90, 90, 1), Range(-90, 90, 1), of_type_b);
  for (const auto* table : {&a, &b, &c}) {
    EXPECT_NEAR(table->Flux().value() / c.Flux().value(), 1.0, 5e-4);
    for (const Vec3& d : {Vec3{0.1, 0.05, -1}, {0.3, 0, -1}, {0, 0.3, -1}, {-0.2, -0.4, -1}}) {
      const double want = beam(d * (1.0 / Length(d)));
      EXPECT_NEAR(table->Towards(d).value(), want, 6.0);  // linear between a degree
    }
  }
}

// A Gaussian of 47.1 by 18.8 degrees (full widths at a half) about the axis, turned by any angle:
// its widths are those, and a tenth lies sqrt(log2 10) as far out as a half.
TEST(IntensityTable, AnOblongLobeIsMeasuredAlongItsOwnAxes) {
  for (const double turned : {0.0, 20.0, 45.0, -30.0, 90.0, 120.0}) {
    const auto table = TableOf(kC, Range(0, 355, 5), Range(0, 90, 0.5), [&](double c, double g) {
      const double u = g * std::cos(Rad(c - turned)) / 23.55;
      const double v = g * std::sin(Rad(c - turned)) / 9.4;
      return 1000.0 * std::exp2(-u * u - v * v);
    });
    const double turn = std::remainder(turned, 90.0);
    const bool swapped = std::abs(std::remainder(turned - turn, 180.0)) > 1.0;
    for (const double level : {0.5, 0.1}) {
      const double out = std::sqrt(-std::log2(level));
      const auto lobe = LobeWidthsAt(table, level);
      const auto near = [&](Radians width, double want) {
        EXPECT_NEAR(DegreesFromRadians(width), out * want, 0.02 * out * want) << turned;
      };
      near(lobe.along, swapped ? 18.8 : 47.1);
      near(lobe.across, swapped ? 47.1 : 18.8);
      near(lobe.mean, 0.5 * (47.1 + 18.8));
      EXPECT_NEAR(DegreesFromRadians(lobe.turn), turn, 0.5) << turned;
    }
  }
  // A square lobe and a round one have no such axes.
  const auto square = TableOf(kC, Range(0, 350, 10), Range(0, 90, 1), [](double c, double g) {
    return 1000.0 * std::exp2(-0.01 * g * g * (1.0 + 0.3 * std::cos(Rad(4.0 * (c - 10.0)))));
  });
  EXPECT_EQ(LobeWidthsAt(square, 0.5).turn.value(), 0.0);
}

// Two wings make one lamp about its axis, though each shines beside it.
TEST(IntensityTable, ABatwingOfTwoPlanesIsMeasuredAboutItsAxis) {
  const auto wings = TableOf(kC, Range(0, 360, 5), Range(0, 90, 1), [](double c, double g) {
    const double off = (g - 40.0) / 10.0;
    return 100.0 * std::exp2(-off * off) * (0.2 + 0.8 * std::pow(std::cos(Rad(c)), 2.0));
  });
  const auto beam = LobeWidthsAt(wings, 0.5);
  EXPECT_FALSE(beam.beside_axis);
  EXPECT_NEAR(DegreesFromRadians(beam.along), 100.0, 0.1);
}

TEST(IntensityTable, SampledAsTypeCKeepsTheValues) {
  const auto b = TableOf(kB, Range(-60, 60, 5), Range(-60, 60, 5), [](double h, double v) {
    return 100.0 * std::cos(Rad(1.5 * h)) * std::cos(Rad(1.5 * v));
  });
  const auto c = SampledAsTypeC(b, Range(0, 360, 2.5), Range(0, 180, 1), kLinear);
  ASSERT_TRUE(c);
  EXPECT_NEAR(c->Flux().value() / b.Flux().value(), 1.0, 2e-4);
  EXPECT_NEAR(c->At(Radians(Rad(40)), Radians(Rad(25))).value(),
              b.At(Radians(Rad(40)), Radians(Rad(25))).value(), 1e-9);
}

TEST(IntensityTable, ScalingScalesEverything) {
  const auto t = TableOf(kC, {0.0}, Range(0, 90, 10), [](double, double v) { return 91.0 - v; });
  const auto twice = t.Scaled(2.0);
  EXPECT_DOUBLE_EQ(twice.Flux(kCubic).value(), 2.0 * t.Flux(kCubic).value());
  EXPECT_DOUBLE_EQ(twice.peak().intensity.value(), 182.0);
  EXPECT_DOUBLE_EQ(twice.At(Radians(0), Radians(0.4)).value(),
                   2.0 * t.At(Radians(0), Radians(0.4)).value());
}

// ---- refusals ----

TEST(IntensityTable, RefusesWhatIsNoLamp) {
  const auto refused = [](IntensityGrid grid) {
    const auto table = IntensityTable::Make(std::move(grid), "x.ies");
    return table ? std::string() : table.error().code;
  };
  const double nan = std::nan("");
  EXPECT_EQ(refused({kC, {0}, {0, 90}, {1}}), "bad_table");
  EXPECT_EQ(refused({kC, {0}, {0, 90}, {1, -1}}), "bad_table");
  EXPECT_EQ(refused({kC, {0}, {0, 90}, {1, nan}}), "bad_table");
  EXPECT_EQ(refused({kC, {0}, {0, 90}, {0, 0}}), "bad_table");
  EXPECT_EQ(refused({kC, {0}, {90, 0}, {1, 1}}), "bad_table");
  EXPECT_EQ(refused({kC, {0}, {0, nan}, {1, 1}}), "bad_table");
  EXPECT_EQ(refused({kC, {0}, {0}, {1}}), "bad_table");
  EXPECT_EQ(refused({kC, {}, {0, 90}, {}}), "bad_table");
  EXPECT_EQ(refused({kC, {0, 45, 60}, {0, 90}, {1, 1, 1, 1, 1, 1}}), "bad_table");
  EXPECT_EQ(refused({kC, {0}, {0, 190}, {1, 1}}), "bad_table");
  EXPECT_EQ(refused({kB, {0}, {0, 90}, {1, 1}}), "bad_table");
  EXPECT_EQ(refused({kB, {-95, 0}, {0, 90}, {1, 1, 1, 1}}), "bad_table");
}

}  // namespace
}  // namespace lightcal
