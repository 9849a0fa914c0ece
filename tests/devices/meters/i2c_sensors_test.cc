// SPDX-License-Identifier: Apache-2.0
// Registers of the sensor chips as light.
#include <gmock/gmock.h>

#include <cmath>

#include "hex_bytes.h"
#include "lightcal_devices/meters/i2c_sensors/bh1750.h"
#include "lightcal_devices/meters/i2c_sensors/opt3001.h"
#include "lightcal_devices/meters/i2c_sensors/opt4048.h"
#include "lightcal_devices/meters/i2c_sensors/veml7700.h"

namespace lightcal::devices::i2c {
namespace {

using test::FromHex;

TEST(Bh1750, FortyOneCountsAre34Lux) {
  const auto light = bh1750::Decode(FromHex("00 29"));
  ASSERT_TRUE(light);
  EXPECT_NEAR(light->illuminance_lx, 41.0 / 1.2, 1e-12);
  EXPECT_FALSE(light->over_range || light->under_range);
}

TEST(Bh1750, ALongerMeasurementHasFinerCounts) {
  EXPECT_NEAR(bh1750::Decode(FromHex("00 29"), 138)->illuminance_lx, 41.0 / 1.2 / 2.0, 1e-12);
}

TEST(Bh1750, TheEndsOfItsScaleAreLimits) {
  const auto dark = bh1750::Decode(FromHex("00 00"));
  EXPECT_TRUE(dark->under_range);
  EXPECT_NEAR(dark->illuminance_lx, 1.0 / 1.2, 1e-12);
  const auto bright = bh1750::Decode(FromHex("FF FF"));
  EXPECT_TRUE(bright->over_range);
  EXPECT_NEAR(bright->illuminance_lx, 54612.5, 1e-9);
}

TEST(Bh1750, AByteIsNoReading) {
  EXPECT_EQ(bh1750::Decode(FromHex("29")).error().code, "bad_reply");
}

TEST(Opt3001, ExponentAndMantissaAreLux) {
  // 3 = exponent, 0x456 = 1110: 1110 * 0.08 lx.
  EXPECT_NEAR(opt3001::Decode(0x0001, 0)->illuminance_lx, 0.01, 1e-12);
  EXPECT_NEAR(opt3001::Decode(0x3456, 0)->illuminance_lx, 88.80, 1e-9);
  EXPECT_NEAR(opt3001::Decode(0xBFFF, 0)->illuminance_lx, opt3001::kHighestLx, 1e-6);
}

TEST(Opt3001, OverflowIsALimitAndAnImpossibleExponentIsRefused) {
  const auto over = opt3001::Decode(0xB123, 0x0100);
  EXPECT_TRUE(over->over_range);
  EXPECT_EQ(over->illuminance_lx, opt3001::kHighestLx);
  EXPECT_TRUE(opt3001::Decode(0x0000, 0)->under_range);
  EXPECT_EQ(opt3001::Decode(0xC001, 0).error().code, "bad_reply");
}

// Four channels with these codes (exponent 0), counter n, and the checksum of the data sheet
// spelled bit by bit.
Bytes Channels(const std::array<std::uint32_t, 4>& results, unsigned exponent = 0,
               unsigned counter = 5) {
  Bytes bytes;
  for (const std::uint32_t r : results) {
    const auto bit = [](std::uint32_t value, unsigned i) { return (value >> i) & 1U; };
    unsigned c0 = 0;
    unsigned c1 = bit(counter, 1) ^ bit(counter, 3) ^ bit(exponent, 1) ^ bit(exponent, 3);
    for (unsigned i = 0; i < 20; ++i) c0 ^= bit(r, i);
    for (unsigned i = 0; i < 4; ++i) c0 ^= bit(counter, i) ^ bit(exponent, i);
    for (unsigned i = 1; i < 20; i += 2) c1 ^= bit(r, i);
    unsigned c2 = bit(counter, 3) ^ bit(exponent, 3);
    for (unsigned i = 3; i < 20; i += 4) c2 ^= bit(r, i);
    const unsigned c3 = bit(r, 3) ^ bit(r, 11) ^ bit(r, 19);
    bytes.push_back(static_cast<std::byte>(exponent << 4U | r >> 16U));
    bytes.push_back(static_cast<std::byte>((r >> 8U) & 0xFFU));
    bytes.push_back(static_cast<std::byte>(r & 0xFFU));
    bytes.push_back(static_cast<std::byte>(counter << 4U | c3 << 3U | c2 << 2U | c1 << 1U | c0));
  }
  return bytes;
}

TEST(Opt4048, TheChecksumOfTheDataSheetIsAccepted) {
  for (const unsigned exponent : {0U, 3U, 8U}) {
    const auto channels =
        opt4048::DecodeChannels(Channels({0x80808, 123456, 0xFFFFF, 1}, exponent, 9));
    ASSERT_TRUE(channels) << channels.error().message;
    EXPECT_EQ((*channels)[1].result, 123456U);
    EXPECT_EQ((*channels)[1].Code(), 123456.0 * (1U << exponent));
  }
}

TEST(Opt4048, OneWrongBitAnywhereInResultExponentOrCounterIsNoticed) {
  const Bytes sound = Channels({70000, 100000, 60000, 90000}, 2);
  for (std::size_t bit = 0; bit < sound.size() * 8; ++bit) {
    Bytes damaged = sound;
    damaged[bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
    EXPECT_FALSE(opt4048::DecodeChannels(damaged)) << bit;
  }
  EXPECT_FALSE(opt4048::DecodeChannels(Bytes(15)));
}

TEST(Opt4048, ChannelOneIsTheIlluminanceAndTheMatrixTheColour) {
  const auto channels = opt4048::DecodeChannels(Channels({80000, 100000, 40000, 0}));
  ASSERT_TRUE(channels);
  const SensorLight light = opt4048::LightFromChannels(*channels, 0x0004);
  EXPECT_NEAR(light.illuminance_lx, 215.0, 1e-9);
  const double x = 2.34892992e-4 * 8e4 + 4.07467441e-5 * 1e5 + 9.28619404e-5 * 4e4;
  const double y = -1.89652390e-5 * 8e4 + 1.98958202e-4 * 1e5 - 1.69739553e-5 * 4e4;
  const double z = 1.20811684e-5 * 8e4 - 1.58848115e-5 * 1e5 + 6.74021520e-4 * 4e4;
  ASSERT_TRUE(light.xy);
  EXPECT_NEAR(light.xy->x, x / (x + y + z), 1e-12);
  EXPECT_NEAR(light.xy->y, y / (x + y + z), 1e-12);
}

TEST(Opt4048, OverloadAndDarknessAreLimitsWithoutColour) {
  const auto channels = opt4048::DecodeChannels(Channels({80000, 0, 40000, 0}));
  const SensorLight dark = opt4048::LightFromChannels(*channels, 0x0004);
  EXPECT_TRUE(dark.under_range);
  EXPECT_NEAR(dark.illuminance_lx, 2.15e-3, 1e-12);
  EXPECT_FALSE(dark.xy);
  const SensorLight bright = opt4048::LightFromChannels(*channels, 0x000C);
  EXPECT_TRUE(bright.over_range);
  EXPECT_EQ(bright.illuminance_lx, opt4048::kHighestLx);
}

TEST(Veml7700, TheFinestStepIsThatOfTheNewDataSheet) {
  EXPECT_NEAR(veml7700::kSettings.back().LuxPerCount(), 0.0042, 1e-15);
  EXPECT_NEAR(veml7700::kSettings[2].LuxPerCount(), 0.5376, 1e-12);
}

TEST(Veml7700, EachSettingIsMoreSensitiveThanTheOneBefore) {
  for (std::size_t i = 1; i < veml7700::kSettings.size(); ++i) {
    EXPECT_LT(veml7700::kSettings[i].LuxPerCount(), veml7700::kSettings[i - 1].LuxPerCount());
  }
}

TEST(Veml7700, BrightLightIsStraightenedAndDimLightIsNot) {
  const double lux = 10000 * 0.5376;
  const double polynomial = 6.0135e-13 * std::pow(lux, 4) - 9.3924e-9 * std::pow(lux, 3) +
                            8.1488e-5 * lux * lux + 1.0023 * lux;
  EXPECT_NEAR(veml7700::Decode(10000, veml7700::kSettings[2]).illuminance_lx, polynomial,
              1e-9 * polynomial);
  EXPECT_NEAR(veml7700::Decode(1000, veml7700::kSettings.back()).illuminance_lx, 4.2, 1e-12);
  EXPECT_TRUE(veml7700::Decode(0, veml7700::kSettings.back()).under_range);
  EXPECT_TRUE(veml7700::Decode(65535, veml7700::kSettings.front()).over_range);
  const SensorLight beyond = veml7700::Decode(30000, veml7700::kSettings.front());
  EXPECT_TRUE(beyond.over_range) << "40000 lx and more before straightening";
  EXPECT_EQ(beyond.illuminance_lx, veml7700::kHighestLx);
}

}  // namespace
}  // namespace lightcal::devices::i2c
