// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/colour/fit_color.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "lightcal/colorimetry/cct.h"

namespace lightcal::fit {
namespace {

Session Empty() {
  Session session;
  session.lights.emplace_back();
  session.lights.back().name = "lamp";
  return session;
}
Reading& Add(Session& session, ColorSource source, const std::string& meter = "") {
  SessionReading row;
  row.reading.light = "lamp";
  row.reading.color_source = source;
  row.reading.meter = meter;
  session.readings.push_back(row);
  return session.readings.back().reading;
}
FittedColor Fit(const Session& session) {
  Warnings warnings;
  return FitColor(session, session.lights.front(), nullptr, warnings).color;
}

TEST(FitColor, NoColourReadingsGiveNoColour) {
  const FittedColor color = Fit(Empty());
  EXPECT_FALSE(color.cct_K || color.duv || color.xy);
}

TEST(FitColor, OneChromaticityGivesItsOwnTemperature) {
  Session session = Empty();
  Add(session, ColorSource::kSpectrometer).xy = XyFromCct(Kelvin(3200.0), 0.004);
  const FittedColor color = Fit(session);
  EXPECT_NEAR(color.cct_K->value, 3200.0, 0.01);
  EXPECT_NEAR(color.duv->value, 0.004, 1e-6);
  EXPECT_GT(color.cct_K->u95, 20.0);
  EXPECT_LT(color.cct_K->u95, 120.0);
}

TEST(FitColor, TheMeterIsNamedWhereOneReadItAll) {
  const Xy xy = XyFromCct(Kelvin(3200.0));
  Session session = Empty();
  Add(session, ColorSource::kSpectrometer, "c800").xy = xy;
  EXPECT_EQ(Fit(session).meter, (ColorMeter{"c800", kSigmaXySpectrometer}));
  Add(session, ColorSource::kColorimeter, "c800").xy = xy;
  EXPECT_FALSE(Fit(session).meter);
  for (const auto& [source, name] : {std::pair{ColorSource::kSpectrometer, ""},
                                     {ColorSource::kUnknown, kDataSheetMeter},
                                     {ColorSource::kCamera, "a7"}}) {
    Session other = Empty();
    Add(other, source, name).xy = xy;
    EXPECT_FALSE(Fit(other).meter) << name;
  }
}

TEST(FitColor, TemperatureAloneLiesOnTheLocusWithAnHonestDuv) {
  Session session = Empty();
  Add(session, ColorSource::kUnknown).cct = Kelvin(2900.0);
  const FittedColor color = Fit(session);
  EXPECT_NEAR(color.cct_K->value, 2900.0, 0.01);
  EXPECT_NEAR(color.duv->value, 0.0, 1e-6);
  EXPECT_NEAR(color.duv->u95, kZ95 * kSigmaDuvAssumed, 1e-5);
}

TEST(FitColor, ThePreciseInstrumentCountsMore) {
  Session session = Empty();
  Add(session, ColorSource::kSpectrometer, "c800").xy = XyFromCct(Kelvin(3200.0));
  Reading& camera = Add(session, ColorSource::kCamera);
  camera.cct = Kelvin(3300.0);
  camera.duv = 0.0;
  const double mired = 1e6 / Fit(session).cct_K->value;
  const double spectrometer = 1e6 / 3200.0;
  const double from_camera = 1e6 / 3300.0;
  EXPECT_GT(mired, from_camera);
  EXPECT_LT(mired, spectrometer);
  EXPECT_LT(spectrometer - mired, mired - from_camera);
}

TEST(FitColor, ACamerasOwnSigmaIsItsInterval) {
  Session session = Empty();
  Reading& camera = Add(session, ColorSource::kCamera);
  camera.xy = XyFromCct(Kelvin(4000.0));
  camera.sigma_mired = Mireds(12.0);
  const Uncertain cct = *Fit(session).cct_K;
  EXPECT_NEAR(1e6 / *cct.low - 1e6 / cct.value, kZ95 * 12.0, 1e-3);
}

// A wall of X/Y and Z/Y over those of white shows a lamp so much off: numbers by hand.
TEST(FitColor, PaintIsTakenOffWhatAWallShows) {
  const Session session = Empty();
  const Xyz lamp = XyzFromXyAtUnitY(XyFromCct(Kelvin(3000.0)));
  const Xyz off_paint = {lamp.X * std::exp(0.02), 1.0, lamp.Z * std::exp(-0.15)};
  ColorOffWall seen{XyFromXyz(off_paint), Mireds(5.0), {0.02, 0.0, -0.15, 0.0, 0.0}, {}};
  Warnings warnings;
  const auto fit = [&] {
    return FitColor(session, session.lights.front(), nullptr, warnings, CctMethod::kExact, &seen)
        .color;
  };
  const FittedColor known = fit();
  EXPECT_NEAR(known.cct_K->value, 3000.0, 0.1);
  EXPECT_NEAR(known.duv->value, 0.0, 1e-5);
  seen.paint = kTintOfPaint;
  const FittedColor any = fit();
  EXPECT_GT(any.cct_K->u95, 3.0 * known.cct_K->u95);
  EXPECT_LT(any.cct_K->low, 3000.0);
  EXPECT_GT(any.cct_K->high, 3000.0);
  seen.others = {0.3, 0.1, 0.0, 0.0};
  EXPECT_GT(fit().cct_K->u95, any.cct_K->u95);
}

// #EDEAE0: linear .8469, .8228, .7454; X, Y, Z by IEC 61966-2-1's four decimals over D65's.
TEST(FitColor, AMakersSrgbIsThePaintsTint) {
  const SurfaceTint tint = TintOfPaint(std::array<int, 3>{237, 234, 224});
  const double x = (0.4124 * 0.8469 + 0.3576 * 0.8228 + 0.1805 * 0.7454) / 0.9505;
  const double y = 0.2126 * 0.8469 + 0.7152 * 0.8228 + 0.0722 * 0.7454;
  const double z = (0.0193 * 0.8469 + 0.1192 * 0.8228 + 0.9505 * 0.7454) / 1.0890;
  EXPECT_NEAR(tint.ln_x, std::log(x / y), 1e-3);
  EXPECT_NEAR(tint.ln_z, std::log(z / y), 1e-3);
  EXPECT_LT(tint.sd_z, kTintOfPaint.sd_z);
  EXPECT_EQ(TintOfPaint({}).ln_z, kTintOfPaint.ln_z);
}

TEST(FitColor, RepeatingAReadingDoesNotLowerTheInstrumentsOwnError) {
  Session once = Empty();
  Add(once, ColorSource::kSpectrometer).xy = Xy{0.42, 0.40};
  Session often = once;
  for (int i = 0; i < 20; ++i) often.readings.push_back(once.readings.front());
  EXPECT_NEAR(Fit(often).cct_K->u95, Fit(once).cct_K->u95, 1e-9 * Fit(once).cct_K->u95);
}

TEST(FitColor, IntervalHoldsTheTruthAsOftenAsItSays) {
  std::mt19937_64 random(8);
  std::normal_distribution<double> normal;
  int covered = 0;
  for (int i = 0; i < 1000; ++i) {
    Session session = Empty();
    const Xy truth = XyFromCct(Kelvin(4200.0), 0.002);
    Add(session, ColorSource::kSpectrometer, "a").xy =
        Xy{truth.x + kSigmaXySpectrometer * normal(random),
           truth.y + kSigmaXySpectrometer * normal(random)};
    Add(session, ColorSource::kColorimeter, "b").xy =
        Xy{truth.x + kSigmaXyColorimeter * normal(random),
           truth.y + kSigmaXyColorimeter * normal(random)};
    const Uncertain cct = *Fit(session).cct_K;
    covered += 4200.0 >= *cct.low && 4200.0 <= *cct.high ? 1 : 0;
  }
  EXPECT_GE(covered, 930);
  EXPECT_LE(covered, 970);
}

TEST(FitColor, AColourFarFromTheLocusHasNoTemperature) {
  Session session = Empty();
  Add(session, ColorSource::kSpectrometer).xy = Xy{0.30, 0.60};
  Warnings warnings;
  const FittedColor color = FitColor(session, session.lights.front(), nullptr, warnings).color;
  EXPECT_FALSE(color.cct_K.has_value());
  ASSERT_TRUE(color.xy.has_value());
  EXPECT_NEAR(color.xy->y, 0.60, 1e-12);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings.front().code, "cct_withheld");
}

TEST(FitColor, ShadowAndLampOffReadingsHaveNoSay) {
  Session session = Empty();
  Add(session, ColorSource::kSpectrometer).xy = XyFromCct(Kelvin(3000.0));
  Reading& off = Add(session, ColorSource::kSpectrometer);
  off.xy = XyFromCct(Kelvin(6000.0));
  off.lamp = LampState::kOff;
  EXPECT_NEAR(Fit(session).cct_K->value, 3000.0, 0.01);
}

TEST(FitColor, InstrumentsThatDisagreeWidenTheInterval) {
  Session session = Empty();
  Add(session, ColorSource::kSpectrometer, "a").xy = XyFromCct(Kelvin(3000.0));
  const double alone = Fit(session).cct_K->u95;
  Add(session, ColorSource::kSpectrometer, "b").xy = XyFromCct(Kelvin(3600.0));
  Warnings warnings;
  const FittedColor both = FitColor(session, session.lights.front(), nullptr, warnings).color;
  EXPECT_GT(both.cct_K->u95, 2.0 * alone);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings.front().code, "color_disagrees");
}

}  // namespace
}  // namespace lightcal::fit
