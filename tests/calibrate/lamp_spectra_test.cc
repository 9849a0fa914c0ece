// SPDX-License-Identifier: Apache-2.0
// Which of a session's spectra is the lamp's own.
#include "lightcal/calibrate/lamp_spectra.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "lightcal/fit/states/state_spectrum.h"
#include "run_cli.h"

namespace lightcal {
namespace {

// W m-2 nm-1 falling or rising over the visible range, of so many lux.
Spectrum Slope(double per_nm, double lux) {
  Spectrum out;
  for (int nm = 380; nm <= 780; nm += 5) {
    out.wavelengths_nm.push_back(nm);
    out.values.push_back(std::exp(per_nm * (nm - 555)));
  }
  return fit::SpectrumOfLux(std::move(out), lux);
}
Spectrum Sum(Spectrum a, const Spectrum& b) {
  for (std::size_t i = 0; i < a.values.size(); ++i) a.values[i] += b.values[i];
  return a;
}

constexpr double kLamp = 0.001, kOff = -0.004, kCream = 0.005;

ReadSpectrum At(double metres, const std::string& file, Spectrum spectrum, double lux) {
  ReadSpectrum out;
  out.row.reading.light = "key";
  out.row.reading.distance = Metres(metres);
  out.row.reading.illuminance = Lux(lux);
  out.row.reading.spectrum_file = file;
  out.spectrum = std::move(spectrum);
  return out;
}
ReadSpectrum BehindCard(ReadSpectrum one) {
  one.row.reading.shadow_card = true;
  return one;
}

TEST(LampSpectra, OfTheLampOffOrBehindACardIsNotTheLamps) {
  ReadSpectrum off = At(1.0, "day.csv", Slope(kOff, 20.0), 20.0);
  off.row.reading.lamp = LampState::kOff;
  const auto found = LampSpectra({off, BehindCard(At(3.0, "walls.csv", Slope(kCream, 5.0), 5.0)),
                                  At(1.0, "lamp.csv", Slope(kLamp, 100.0), 100.0)});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.front().file, "lamp.csv");
  EXPECT_TRUE(LampSpectra({off}).empty());
}

TEST(LampSpectra, ReadWithOthersLitIsNoLamps) {
  ReadSpectrum both = At(1.0, "both.csv", Slope(kLamp, 100.0), 100.0);
  both.row.others_lit = {"fill"};
  EXPECT_TRUE(LampSpectra({both}).empty());
}

TEST(LampSpectra, TheNearestSeesTheLeastOfTheWalls) {
  const auto found = LampSpectra({At(2.0, "far.csv", Slope(kCream, 40.0), 40.0),
                                  At(0.5, "near.csv", Slope(kLamp, 400.0), 400.0),
                                  At(0.5, "again.csv", Slope(kLamp, 400.0), 400.0)});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.front().file, "near.csv");
}

TEST(LampSpectra, BesideItsCardItIsTheDifference) {
  const Spectrum lamp = Slope(kLamp, 100.0);
  const Spectrum walls = Slope(kCream, 60.0);
  // The far one's file is of any scale: its illuminance says which.
  Spectrum scaled = Sum(lamp, walls);
  scaled.quantity = SpectralQuantity::kRelative;
  for (double& value : scaled.values) value *= 7.0;
  const auto found = LampSpectra({At(0.5, "near.csv", Slope(kOff, 1600.0), 1600.0),
                                  At(2.0, "far.csv", scaled, 160.0),
                                  BehindCard(At(2.0, "card.csv", walls, 60.0))});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.front().file, "far.csv");
  for (std::size_t i = 0; i < lamp.values.size(); ++i) {
    EXPECT_NEAR(found.front().spectrum.values[i], lamp.values[i], 1e-12);
  }
}

std::string Csv(const Spectrum& spectrum) {
  std::string out = "wavelength_nm,lamp irradiance_W_m2_nm\n";
  for (std::size_t i = 0; i < spectrum.values.size(); ++i) {
    out += std::to_string(spectrum.wavelengths_nm[i]) + "," + std::to_string(spectrum.values[i]) +
           "\n";
  }
  return out;
}

TEST(LampSpectra, TheCommandKeepsTheLampsOwn) {
  const test::TempDir folder;
  folder.Write("day.csv", Csv(Slope(kOff, 20000.0)));
  folder.Write("walls.csv", Csv(Slope(kCream, 60000.0)));
  folder.Write("both.csv", Csv(Sum(Slope(kLamp, 100000.0), Slope(kCream, 60000.0))));
  const std::string reading = "[[reading]]\nlight = \"key\"\ndistance_m = 2\n";
  folder.Write("session.toml",
               "lightcal = 1\nname = \"s\"\n[[light]]\nname = \"key\"\nkind = \"point\"\n" +
                   reading + "spectrum = \"walls.csv\"\nshadow_card = true\n" + reading +
                   "spectrum = \"both.csv\"\n");
  const test::CliResult fitted = test::RunLightcal({"fit", folder.path(), "--json"});
  ASSERT_EQ(fitted.exit_code, 0) << fitted.err;
  const auto light = nlohmann::json::parse(fitted.out)["lights"][0];
  const auto& values = light["spectrum"]["values"];
  const Spectrum lamp = Slope(kLamp, 100000.0);
  ASSERT_EQ(values.size(), lamp.values.size());
  const double scale = values[40].get<double>() / lamp.values[40];
  for (std::size_t i = 0; i < lamp.values.size(); ++i) {
    EXPECT_NEAR(values[i].get<double>(), scale * lamp.values[i], 1e-4 * scale * lamp.values[40])
        << i;
  }
  // And its colour, whose X, Y and Z are that spectrum's.
  const Xyz xyz = *XyzFromSpectrum(lamp);
  EXPECT_NEAR(light["color"]["xy"][0].get<double>(), XyFromXyz(xyz).x, 1e-5);
}

TEST(LampSpectra, EachStateHasItsOwn) {
  ReadSpectrum full = At(1.0, "full.csv", Slope(kLamp, 100.0), 100.0);
  ReadSpectrum half = At(2.0, "half.csv", Slope(kLamp, 12.0), 12.0);
  full.row.reading.state = *ParseFixtureState("dimmer=100");
  half.row.reading.state = *ParseFixtureState("dimmer=50");
  const auto found = LampSpectra({half, full});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].file, "half.csv");
  EXPECT_EQ(found[1].file, "full.csv");
}

}  // namespace
}  // namespace lightcal
