// SPDX-License-Identifier: Apache-2.0
// Truth: the same light in 1 nm steps over 360-830 nm.
#include "lightcal/colorimetry/spectral_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/colorimetry/daylight.h"
#include "lightcal/colorimetry/illuminants.h"
#include "lightcal/colorimetry/resample.h"
#include "vector_file.h"

namespace lightcal {
namespace {

struct NamedSpectrum {
  std::string name;
  Spectrum fine;  // 1 nm, 355-835 nm, so that bins at both ends are whole
};

// At every nanometre, linear between samples; the end samples go on.
Spectrum At1Nm(const Spectrum& s) {
  Spectrum fine;
  for (int nm = 350; nm <= 840; ++nm) {
    const auto above = std::ranges::upper_bound(s.wavelengths_nm, nm);
    double value = s.values.front();
    if (above == s.wavelengths_nm.end()) {
      value = s.values.back();
    } else if (above != s.wavelengths_nm.begin()) {
      const auto i = static_cast<std::size_t>(above - s.wavelengths_nm.begin());
      const double t = (nm - s.wavelengths_nm[i - 1]) / (*above - s.wavelengths_nm[i - 1]);
      value = s.values[i - 1] + t * (s.values[i] - s.values[i - 1]);
    }
    fine.wavelengths_nm.push_back(nm);
    fine.values.push_back(value);
  }
  return fine;
}

// A blue pump and a phosphor, both bells.
Spectrum WhiteLed(double pump_share) {
  Spectrum s;
  for (int nm = 350; nm <= 840; ++nm) {
    const double pump = std::exp(-0.5 * std::pow((nm - 452) / 9.0, 2));
    const double phosphor = std::exp(-0.5 * std::pow((nm - 575) / 55.0, 2));
    s.wavelengths_nm.push_back(nm);
    s.values.push_back(pump_share * pump + phosphor);
  }
  return s;
}

std::vector<NamedSpectrum> SmoothLights() {
  std::vector<NamedSpectrum> lights;
  for (const double k : {1500.0, 2000.0, 2856.0, 4000.0, 6504.0, 10'000.0, 20'000.0}) {
    lights.push_back({"black body " + std::to_string(k), At1Nm(*BlackBodySpectrum(Kelvin(k)))});
  }
  for (const double k : {4000.0, 5003.0, 6504.0, 12'000.0}) {
    lights.push_back({"daylight " + std::to_string(k), At1Nm(*DaylightSpectrum(Kelvin(k)))});
  }
  lights.push_back({"warm LED", WhiteLed(0.5)});
  lights.push_back({"cool LED", WhiteLed(1.6)});
  return lights;
}

// CIE's fluorescent and LED lamps of its 1 nm tables, where a line is one row wide, and its
// discharge lamps, which it gives every 5 nm, linear between.
std::vector<NamedSpectrum> LampLights() {
  std::vector<NamedSpectrum> lights;
  const auto rows = test::ReadSampleTable("cie_lamps/cie_lamps_1nm.csv");
  for (const auto& [name, ignored] : rows.front().cells()) {
    if (name == "wavelength_nm") continue;
    Spectrum s;
    for (const test::VectorRow& row : rows) {
      s.wavelengths_nm.push_back(row.Number("wavelength_nm"));
      s.values.push_back(row.Number(name));
    }
    lights.push_back({name, At1Nm(s)});
  }
  for (const char* name : {"HP1", "HP2", "HP3", "HP4", "HP5"}) {
    lights.push_back({name, At1Nm(*IlluminantSpectrum(name))});
  }
  return lights;
}

struct Answer {
  double kelvin, duv, illuminance;
};
Answer AnswerOf(Spectrum s) {
  s.quantity = SpectralQuantity::kIrradiance;
  const Xyz xyz = *XyzFromSpectrum(s);
  const CctResult cct = CctFromXy(XyFromXyz(xyz));
  return {cct.temperature.value(), cct.duv, xyz.Y};
}

Spectrum EveryNth(const Spectrum& fine, int first, int last, int step) {
  Spectrum s;
  for (std::size_t i = 0; i < fine.values.size(); ++i) {
    const int nm = static_cast<int>(fine.wavelengths_nm[i]);
    if (nm < first || nm > last || (nm - first) % step != 0) continue;
    s.wavelengths_nm.push_back(nm);
    s.values.push_back(fine.values[i]);
  }
  return s;
}

// Every step and range the instruments have.
template <class Check>
void ForEachGrid(const Check& check) {
  for (const int step : {1, 5, 10}) {
    for (const int first : {360, 380, 400}) {
      for (const int last : {700, 730, 780}) check(first, last, step);
    }
  }
}

Answer TruthOf(const NamedSpectrum& light) {
  return AnswerOf(ResampleByArea(light.fine, Nanometres(360), Nanometres(1), 471).value());
}

// Whether the bound, if there is one, is kept.
void ExpectKept(const std::string& name, const Answer& truth, const Spectrum& measured,
                const SpectralError& error) {
  if (!error.bound) return;
  const Answer got = AnswerOf(measured);
  const std::string what = name + ", " + std::to_string(error.first.value()) + " to " +
                           std::to_string(error.last.value()) + " by " +
                           std::to_string(error.step.value());
  constexpr double kRounding = 1e-6;
  if (error.bound->temperature) {
    EXPECT_LE(std::abs(got.kelvin - truth.kelvin), error.bound->temperature->value() + kRounding)
        << what;
    EXPECT_LE(std::abs(got.duv - truth.duv), *error.bound->duv + kRounding) << what;
  }
  EXPECT_LE(std::abs(got.illuminance / truth.illuminance - 1.0),
            error.bound->illuminance_relative + kRounding)
      << what;
}

void ExpectBounded(const NamedSpectrum& light, const Spectrum& measured, Sampling sampling) {
  const auto error = SpectralErrorOf(measured, sampling);
  ASSERT_TRUE(error);
  ASSERT_TRUE(error->bound) << light.name << " roughness " << error->roughness;
  ExpectKept(light.name, TruthOf(light), measured, *error);
}

TEST(SpectralError, BoundsSmoothLightOfEveryStepAndRange) {
  for (const NamedSpectrum& light : SmoothLights()) {
    ForEachGrid([&](int first, int last, int step) {
      ExpectBounded(light, EveryNth(light.fine, first, last, step), Sampling::kBandAverage);
    });
  }
}

TEST(SpectralError, BoundsBandAveragedLampsOfEveryStepAndRange) {
  auto lights = LampLights();
  for (const NamedSpectrum& smooth : SmoothLights()) lights.push_back(smooth);
  for (const NamedSpectrum& light : lights) {
    ForEachGrid([&](int first, int last, int step) {
      const auto measured = ResampleByArea(light.fine, Nanometres(first), Nanometres(step),
                                           (last - first) / step + 1);
      ASSERT_TRUE(measured);
      ExpectBounded(light, *measured, Sampling::kBandAverage);
    });
  }
}

TEST(SpectralError, IsSmallForASmoothLightInFiveNanometreSteps) {
  const auto error =
      SpectralErrorOf(EveryNth(SmoothLights()[4].fine, 360, 830, 5), Sampling::kUnknown);
  ASSERT_TRUE(error && error->bound && error->bound->temperature);
  EXPECT_LT(error->bound->temperature->value(), 25.0);
  EXPECT_LT(*error->bound->duv, 5e-4);
  EXPECT_LT(error->roughness, 0.01);
}

TEST(SpectralError, GrowsWithTheStepAndWithWhatTheRangeLacks) {
  const Spectrum fine = SmoothLights()[4].fine;
  const auto kelvin = [&](int first, int last, int step) {
    return SpectralErrorOf(EveryNth(fine, first, last, step), Sampling::kBandAverage)
        ->bound->temperature->value();
  };
  EXPECT_LT(kelvin(360, 780, 1), kelvin(360, 780, 5));
  EXPECT_LT(kelvin(360, 780, 5), kelvin(360, 780, 10));
  EXPECT_LT(kelvin(360, 780, 1), kelvin(380, 780, 1));
  EXPECT_LT(kelvin(380, 780, 1), kelvin(400, 780, 1));
  EXPECT_LT(kelvin(380, 780, 1), kelvin(380, 700, 1));
}

TEST(SpectralError, PointSamplesOfLinesAreUndersampledAndHaveNoBound) {
  for (const NamedSpectrum& light : LampLights()) {
    if (light.name.starts_with("LED")) continue;
    for (const int step : {2, 5, 10}) {
      for (const Sampling sampling : {Sampling::kPoint, Sampling::kUnknown}) {
        const auto error = SpectralErrorOf(EveryNth(light.fine, 380, 780, step), sampling);
        ASSERT_TRUE(error);
        EXPECT_TRUE(error->undersampled) << light.name << " " << error->roughness;
        EXPECT_FALSE(error->bound);
      }
    }
  }
}

// Every lamp, step, range and place of the first sample: 9225 spectra.
TEST(SpectralError, OfPointSamplesIsNeverBoundedWrongly) {
  int bounded = 0, undersampled = 0;
  for (const NamedSpectrum& light : LampLights()) {
    const Answer truth = TruthOf(light);
    for (const int step : {1, 2, 3, 4, 5, 10}) {
      for (const int first : {360, 380, 400}) {
        for (int phase = 0; phase < step; ++phase) {
          for (const int last : {700, 730, 780}) {
            const Spectrum measured = EveryNth(light.fine, first + phase, last, step);
            const auto error = SpectralErrorOf(measured, Sampling::kUnknown);
            ASSERT_TRUE(error);
            ++(error->bound ? bounded : undersampled);
            EXPECT_NE(error->bound.has_value(), error->undersampled);
            ExpectKept(light.name, truth, measured, *error);
          }
        }
      }
    }
  }
  EXPECT_EQ(bounded, 41 * 9 + 9 * 9 * (2 + 3 + 4 + 5));  // 1 nm of all, 2 to 5 nm of the LEDs
  EXPECT_EQ(undersampled, 32 * 9 * (2 + 3 + 4 + 5) + 41 * 9 * 10);
}

TEST(SpectralError, PointSamplesOfSmoothLightHaveABound) {
  for (const NamedSpectrum& light : SmoothLights()) {
    for (const int step : {1, 2, 5}) {
      ExpectBounded(light, EveryNth(light.fine, 380, 780, step), Sampling::kPoint);
    }
  }
}

TEST(SpectralError, OfALightWithoutTemperatureIsOfItsIlluminanceOnly) {
  Spectrum green;
  for (int nm = 380; nm <= 780; ++nm) {
    green.wavelengths_nm.push_back(nm);
    green.values.push_back(std::exp(-0.5 * std::pow((nm - 530) / 12.0, 2)));
  }
  const auto error = SpectralErrorOf(green, Sampling::kBandAverage);
  ASSERT_TRUE(error && error->bound);
  EXPECT_FALSE(error->bound->temperature);
  EXPECT_LT(error->bound->illuminance_relative, 0.01);
}

}  // namespace
}  // namespace lightcal
