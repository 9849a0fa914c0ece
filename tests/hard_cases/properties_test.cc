// SPDX-License-Identifier: Apache-2.0
// What holds for every input, by RapidCheck: scales, bounds, continuity at every branch, round
// trips. A failure prints the smallest input found and the seed that finds it again.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/colorimetry/rgb_spaces.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "lightcal/fit/estimate_light.h"
#include "lightcal/light/effects/flicker.h"
#include "lightcal/light/models/ladder.h"
#include "lightcal/light/models/source_model.h"
#include "lightcal/photometry/falloff_windows.h"
#include "lightcal/photometry/lamp_flicker.h"
#include "lightcal/photometry/solid_angle.h"
#include "lightcal/records/photometric_codec.h"

namespace lightcal {
namespace {

using std::numbers::pi;

// The same inputs on every machine, unless RC_PARAMS asks for others.
class FixedSeed : public testing::Environment {
 public:
  void SetUp() override { ::setenv("RC_PARAMS", "seed=20261122 max_success=300", 0); }
};
const testing::Environment* const kSeed = testing::AddGlobalTestEnvironment(new FixedSeed);

// A real number between two others.
double Between(double low, double high) {
  constexpr int kSteps = 1 << 30;
  return low + (high - low) * *rc::gen::inRange(0, kSteps) / kSteps;
}
// The same, evenly over the logarithm.
double Decades(double low, double high) { return std::exp(Between(std::log(low), std::log(high))); }
double Relative(double a, double b) { return std::abs(a / b - 1.0); }

Vec3 Direction() {
  const double z = Between(-1.0, 1.0);
  const double phi = Between(0.0, 2.0 * pi);
  const double s = std::sqrt(1.0 - z * z);
  return {s * std::cos(phi), s * std::sin(phi), z};
}

// ---- scales ----

fit::Observations SomeReadings() {
  fit::Observations out;
  const int count = *rc::gen::inRange(1, 7);
  for (int i = 0; i < count; ++i) {
    fit::Observation row;
    row.index = i;
    row.distance_m = Decades(0.2, 20.0);
    row.measured_lx = row.raw_lx = 100.0 / std::pow(row.distance_m, 2.0) * Between(0.95, 1.05);
    row.sigma_lx = 0.03 * row.measured_lx;
    out.rows.push_back(row);
  }
  out.readings = count;
  return out;
}

RC_GTEST_PROP(Scale, OfLightAndLengthCarriesThroughTheFit, ()) {
  const fit::Observations readings = SomeReadings();
  const double light = Decades(1e-8, 1e8);
  const double length = Decades(1e-4, 1e4);
  fit::Observations scaled = readings;
  for (fit::Observation& row : scaled.rows) {
    row.distance_m *= length;
    for (double* lux : {&row.measured_lx, &row.raw_lx, &row.sigma_lx}) *lux *= light;
  }
  const auto a = fit::EstimateLight(readings, fit::ForwardModel{}, "lamp");
  const auto b = fit::EstimateLight(scaled, fit::ForwardModel{}, "lamp");
  RC_ASSERT(a.has_value() == b.has_value());
  if (!a) return;
  RC_ASSERT(a->upper_limit.has_value() == b->upper_limit.has_value());
  if (a->upper_limit) return;
  const double shift = std::log(light) + 2.0 * std::log(length);
  RC_ASSERT(std::abs(b->theta[0] - a->theta[0] - shift) < 1e-8);
  RC_ASSERT(std::abs(b->theta[1] / length - a->theta[1]) < 1e-8);
  RC_ASSERT(Relative(b->covariance[0], a->covariance[0]) < 1e-6);
}

SourceModel SomeSource(double size) {
  switch (*rc::gen::inRange(0, 4)) {
    case 0:
      return SphereSource{size};
    case 1:
      return DiskSource{size};
    case 2:
      return RectSource{size, size * Decades(0.01, 1.0)};
    default:
      return TubeSource{size, size * Decades(0.001, 0.5)};
  }
}

SourceModel Larger(const SourceModel& source, double by) {
  if (const auto* s = std::get_if<SphereSource>(&source)) return SphereSource{by * s->radius};
  if (const auto* s = std::get_if<DiskSource>(&source)) return DiskSource{by * s->radius};
  if (const auto* s = std::get_if<RectSource>(&source)) {
    return RectSource{by * s->half_width, by * s->half_height};
  }
  const auto& tube = std::get<TubeSource>(source);
  return TubeSource{by * tube.half_length, by * tube.radius};
}

RC_GTEST_PROP(Scale, OfARoomDividesLuxPerCandelaByItsSquare, ()) {
  const SourceModel source = SomeSource(1.0);
  const Receiver<double> at{Direction() * Decades(2.0, 1e4), Direction()};
  const double by = std::exp2(*rc::gen::inRange(-30, 31));  // exact in binary
  const Receiver<double> scaled{at.position * by, at.normal};
  const double e = LuxPerCandela(source, at);
  RC_ASSERT(e >= 0.0);
  RC_ASSERT(std::abs(LuxPerCandela(Larger(source, by), scaled) * by * by - e) <=
            1e-13 / Dot(at.position, at.position));
}

// ---- bounds ----

RC_GTEST_PROP(Bound, NoLampOutshinesItsCandelaAtItsNearestPoint, ()) {
  const double size = Decades(0.01, 1.0);
  const SourceModel source = SomeSource(size);
  const double d = Decades(3.0, 1e4);
  const double e = LuxPerCandela(source, Receiver<double>{Direction() * d, Direction()});
  const double gap = d - 1.5 * size;
  RC_ASSERT(std::isfinite(e) && e >= 0.0);
  RC_ASSERT(e <= (1.0 + 1e-12) / (gap * gap));
}

RC_GTEST_PROP(Bound, TheCheapFormStaysWithinItsTolerance, ()) {
  const SourceModel source = SomeSource(1.0);
  const Receiver<double> at{Direction() * Decades(1.2, 1e3), Direction()};
  const double tolerance = Decades(1e-9, 5e-2);
  const double exact = LuxPerCandela(source, at);
  const double cheap = LuxPerCandela(source, at, tolerance);
  RC_ASSERT(std::abs(cheap - exact) <= tolerance * exact + 1e-14);
}

RC_GTEST_PROP(Bound, FlickerErrsByItsRuleAtMostAndLessTheLongerItIsRead, ()) {
  const LampFlicker lamp{Decades(50.0, 2e4), Between(0.02, 1.0)};
  const Seconds time(Decades(1e-4, 2.0));
  const double periods = lamp.frequency_hz * time.value();
  RC_ASSERT(WorstFlickerError(lamp, time) <= (1.0 - lamp.duty) / periods + 1e-12);
  SceneTime scene;
  scene.flicker_hz = lamp.frequency_hz;
  scene.duty = lamp.duty;
  const double longer = time.value() * Between(1.0, 3.0);
  RC_ASSERT(effects::FlickerBound(scene, longer) <=
            effects::FlickerBound(scene, time.value()) * (1.0 + 1e-12));
}

RC_GTEST_PROP(Bound, AnAxialSourceFadesMonotonically, ()) {
  const SourceModel source = SomeSource(1.0);
  const double near_d = 1.01 + Decades(1e-3, 1e4);
  const double far_d = near_d * Between(1.0, 1.5);
  const auto at = [](double d) { return Receiver<double>{{0.0, 0.0, d}, {0.0, 0.0, -1.0}}; };
  RC_ASSERT(LuxPerCandela(source, at(far_d)) <= LuxPerCandela(source, at(near_d)) * (1.0 + 1e-12));
}

// ---- continuity ----

RC_GTEST_PROP(Continuity, OfEverySourceUnderSmallSteps, ()) {
  const SourceModel source = SomeSource(1.0);
  const double d = Decades(2.0, 1e3);
  const Vec3 position = Direction() * d;
  const Vec3 normal = Direction();
  const Vec3 step = Direction() * (1e-10 * d);
  const double e = LuxPerCandela(source, Receiver<double>{position, normal});
  const double moved = LuxPerCandela(source, Receiver<double>{position + step, normal});
  const Vec3 turned = normal + Direction() * 1e-10;
  const double tilted =
      LuxPerCandela(source, Receiver<double>{position, turned * (1.0 / Length(turned))});
  // A gradient of 1/d^2 by d/(d - 1.5), a hundredfold.
  const double most = 1e-8 * d / (d - 1.5) / (d * d);
  RC_ASSERT(std::abs(moved - e) <= most);
  RC_ASSERT(std::abs(tilted - e) <= most);
}

RC_GTEST_PROP(Continuity, WhereTheFormOfAFlatSourceChanges, ()) {
  // 8 and 100 half diagonals of a rect, 8 radii of a disk.
  const double height = Decades(0.05, 1.0);
  const SourceModel rect = RectSource{1.0, height};
  const double diagonal = std::hypot(1.0, height);
  const Vec3 way = Direction();
  const Vec3 normal = Direction();
  const auto across = [&](const SourceModel& source, double border) {
    const auto at = [&](double d) { return Receiver<double>{way * d, normal}; };
    const double inside = LuxPerCandela(source, at(border * (1.0 - 1e-13)));
    const double outside = LuxPerCandela(source, at(border * (1.0 + 1e-13)));
    return std::abs(inside - outside) * border * border;
  };
  RC_ASSERT(across(rect, 8.0 * diagonal) < 1e-10);
  RC_ASSERT(across(rect, 100.0 * diagonal) < 1e-10);
  RC_ASSERT(across(DiskSource{1.0}, 8.0) < 1e-10);
  RC_ASSERT(across(TubeSource{1.0, height * 0.5}, 8.0) < 1e-10);
}

RC_GTEST_PROP(Continuity, OfSpotsAndRanges, ()) {
  const double outer = Between(0.01, 1.5);
  const SpotCone cone{Radians(outer * Between(0.0, 0.95)), Radians(outer)};
  const double angle = Between(0.0, 1.1 * outer);
  for (const SpotFalloff falloff :
       {SpotFalloff::kLinear, SpotFalloff::kSquaredLinear, SpotFalloff::kSmoothstep}) {
    const double a = SpotAttenuation(Radians(angle), cone, falloff);
    const double b = SpotAttenuation(Radians(angle + 1e-10), cone, falloff);
    RC_ASSERT(a >= 0.0 && a <= 1.0);
    RC_ASSERT(std::abs(a - b) < 1e-6);
  }
  const double r = Decades(0.1, 100.0);
  const double d = r * Between(0.5, 1.1);
  for (const auto falloff : {FilamentFalloff, GltfFalloff, UnrealFalloff}) {
    const double step =
        falloff(Metres(d), Metres(r)) - falloff(Metres(d * (1.0 + 1e-10)), Metres(r));
    RC_ASSERT(step * d * d > -1e-14);
    RC_ASSERT(step * d * d < 1e-7);
  }
}

RC_GTEST_PROP(Continuity, OfTemperatureOverTheWholeLocus, ()) {
  const double mired = Between(0.5, 990.0);
  const double duv = Between(-0.03, 0.03);
  const CctResult here = CctFromUv(UvFromCct(Kelvin(1e6 / mired), duv));
  const CctResult there = CctFromUv(UvFromCct(Kelvin(1e6 / (mired + 1e-3)), duv));
  RC_ASSERT(here.valid() && there.valid());
  const double moved = 1e6 / there.temperature.value() - 1e6 / here.temperature.value();
  RC_ASSERT(std::abs(moved - 1e-3) < 2e-5);
  RC_ASSERT(std::abs(there.duv - here.duv) < 1e-9);
}

// ---- round trips ----

RC_GTEST_PROP(RoundTrip, OfNumbersAndUnitsThroughText, ()) {
  const double value = Decades(1e-12, 1e12) * (*rc::gen::element(1.0, -1.0));
  RC_ASSERT(*ParseNumber(ShortestText(value)) == value);
  const double size = std::abs(value);
  const std::string text = ShortestText(size);
  RC_ASSERT(ParseLength(text + "m")->value() == size);
  RC_ASSERT(Relative(ParseLength(text + "cm")->value(), size / 100.0) < 1e-15);
  RC_ASSERT(Relative(ParseLength(text + "ft")->value(), size * 0.3048) < 1e-15);
  RC_ASSERT(ParseIlluminance(text + "lx")->value() == size);
  RC_ASSERT(Relative(ParseIlluminance(text + "fc")->value(), size / (0.3048 * 0.3048)) < 1e-15);
  RC_ASSERT(ParseTemperature(text + "K")->value() == size);
  RC_ASSERT(Relative(ParseDuration("1/" + text)->value(), 1.0 / size) < 1e-15);
  RC_ASSERT(Relative(ParseAngle(text)->value(), size * pi / 180.0) < 1e-15);
}

RC_GTEST_PROP(RoundTrip, OfColours, ()) {
  const Rgb color{Between(0.0, 4.0), Between(0.01, 4.0), Between(0.0, 4.0)};
  for (const RgbSpace space : kRgbSpaces) {
    const Rgb back = LinearRgbFromXyz(XyzFromLinearRgb(color, space), space);
    RC_ASSERT(std::abs(back.r - color.r) < 1e-12);
    RC_ASSERT(std::abs(back.g - color.g) < 1e-12);
    RC_ASSERT(std::abs(back.b - color.b) < 1e-12);
  }
  const Xyz xyz = XyzFromLinearRgb(color, RgbSpace::kRec2020);
  const Xy xy = XyFromXyz(xyz);
  const Xy back = XyFromUv1960(Uv1960FromXy(xy));
  RC_ASSERT(std::abs(back.x - xy.x) < 1e-14 && std::abs(back.y - xy.y) < 1e-14);
  const Xy white{0.31272, 0.32903};
  const Xy warm{0.4476, 0.4074};
  const Xyz adapted = AdaptBradford(AdaptBradford(xyz, white, warm), warm, white);
  RC_ASSERT(std::abs(adapted.X - xyz.X) < 1e-12 && std::abs(adapted.Z - xyz.Z) < 1e-12);
}

RC_GTEST_PROP(RoundTrip, OfTemperatureAndDuv, ()) {
  const double mired = Between(0.0, 999.0);
  const double duv = Between(-0.0499, 0.0499);
  const Kelvin temperature(mired > 0.0 ? 1e6 / mired : std::numeric_limits<double>::infinity());
  const CctResult found = CctFromXy(XyFromCct(temperature, duv));
  // Far below the locus of cold lamps its centre of curvature is near: other points are nearer.
  RC_PRE(found.valid() && std::abs(found.duv - duv) < 1e-3);
  RC_ASSERT(std::abs(1e6 / found.temperature.value() - mired) < 1e-5);
  RC_ASSERT(std::abs(found.duv - duv) < 1e-9);
}

RC_GTEST_PROP(RoundTrip, OfSolidAngles, ()) {
  const double half = Decades(1e-9, pi);
  const Radians back = ConeHalfAngleFromSolidAngle(SolidAngleOfCone(Radians(half)));
  // Near the whole sphere the angle is the square root of what is missing.
  RC_ASSERT(std::abs(back.value() - half) <= 1e-13 * half / std::max(std::cos(0.5 * half), 1e-7));
}

// A table about its nadir, in even steps.
IntensityTable SomeTable() {
  IntensityGrid grid;
  const int planes = *rc::gen::element(1, 3, 5, 9);  // axial, a quarter turn, a half, a whole
  const double last = planes == 1 ? 0.0 : planes == 3 ? 90.0 : planes == 5 ? 180.0 : 360.0;
  for (int i = 0; i < planes; ++i) {
    grid.horizontal_deg.push_back(planes == 1 ? 0.0 : last * i / (planes - 1));
  }
  const int rows = *rc::gen::element(7, 19, 37);
  for (int i = 0; i < rows; ++i) grid.vertical_deg.push_back(180.0 * i / (rows - 1));
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  std::uniform_real_distribution<double> uniform(0.01, 1.0);
  const double peak = Decades(0.1, 1e6);
  for (int i = 0; i < planes * rows; ++i) grid.candela.push_back(peak * uniform(random));
  if (planes == 9) {  // the last plane is the first
    for (int i = 0; i < rows; ++i) grid.candela[8 * rows + i] = grid.candela[i];
  }
  auto table = IntensityTable::Make(std::move(grid), "made");
  RC_ASSERT(table.has_value());
  return *table;
}

RC_GTEST_PROP(RoundTrip, OfIesAndEulumdat, ()) {
  const IntensityTable table = SomeTable();
  PhotometricFile file{PhotometricHeader{}, table};
  file.header.lamps.resize(1);
  file.header.absolute = true;
  const auto ies = IesFromText(IesText(file), "a.ies");
  RC_ASSERT(ies.has_value());
  const auto text = EulumdatText(ies->file);
  RC_ASSERT(text.has_value());
  const auto ldt = EulumdatFromText(*text, "a.ldt");
  RC_ASSERT(ldt.has_value());
  const auto again = IesFromText(IesText(ldt->file), "b.ies");
  RC_ASSERT(again.has_value());
  const double most = table.peak().intensity.value();
  for (int i = 0; i < 40; ++i) {
    const Vec3 way = Direction();
    const double truth = table.Towards(way).value();
    for (const IntensityTable* read : {&ies->file.table, &ldt->file.table, &again->file.table}) {
      RC_ASSERT(std::abs(read->Towards(way).value() - truth) < 1e-7 * most);
    }
  }
  RC_ASSERT(Relative(again->file.table.Flux().value(), table.Flux().value()) < 1e-7);
}

}  // namespace
}  // namespace lightcal
