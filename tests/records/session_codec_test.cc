// SPDX-License-Identifier: Apache-2.0
// What a good session.toml means, and that a reading survives its line.
#include "lightcal/records/session_codec.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <random>

namespace lightcal {
namespace {

constexpr const char* kWholeSession = R"(lightcal = 1
name = "Desk lamp"
[room]
size_m = [5.0, 4.0, 2.6]
reflectance = 0.4
[[light]]
name = "key"
kind = "spot"
position_m = [0, 0, 1.2]
aim = [0, 0, -2]
inner_deg = 20
outer_deg = 35
electrical_W = 9
flux_lm = 806
beam_deg = 36
field_deg = 60
off_axis_sigma_deg = 0.5
distance_sigma_m = 0.01
[[light]]
name = "panel"
kind = "rect"
size_m = [0.6, 0.3]
[[light]]
name = "globe"
kind = "sphere"
diameter_m = 0.06
[[light]]
name = "tube"
kind = "tube"
length_m = 1.2
radius_m = 0.013
[[meter]]
name = "c800"
sigma_relative = 0.03
cosine_f2 = 0.02
spectral_f1 = 0.06
head_radius_m = 0.01
[[reading]]
light = "key"
meter = "c800"
distance_m = 0.5
illuminance_lx = 192.0
tilt_deg = 30
cct_K = 2900
duv = -0.001
xy = [0.44, 0.40]
color_source = "spectrometer"
spectrum = "captures/a.spdx"
time = 2026-01-02T03:04:05Z
device = "sekonic:1234"
[[reading]]
light = "key"
position_m = [0, 0, 0]
normal = [0, 0, 1]
illuminance_lx = 0
lamp = "off"
[[reading]]
light = "panel"
meter = "data_sheet"
distance_m = 1
illuminance_lx = 19999
over_range = true
[[reading]]
light = "panel"
distance_m = 1
illuminance_lx = 3
shadow_card = true
sigma_relative = 0.2
)";

Session WholeSession() {
  auto session = ParseSessionToml(kWholeSession, "session.toml");
  if (!session) ADD_FAILURE() << session.error().subject << ": " << session.error().message;
  return session ? *session : Session{};
}

TEST(SessionToml, RoomHoldsItsSizeAndReflectance) {
  const Session session = WholeSession();
  EXPECT_EQ(session.name, "Desk lamp");
  ASSERT_TRUE(session.room);
  EXPECT_EQ(session.room->size_m, (Vec3{5.0, 4.0, 2.6}));
  EXPECT_EQ(session.room->reflectance, 0.4);
}

TEST(SessionToml, LightHoldsHalfAnglesOfItsConeAndFullAnglesOfItsDataSheet) {
  const Session session = WholeSession();
  ASSERT_EQ(session.lights.size(), 4U);
  const LightDescription& key = session.lights[0];
  EXPECT_EQ(key.kind, LightKind::kSpot);
  EXPECT_NEAR(key.inner.value().value(), std::numbers::pi / 9.0, 1e-15);
  EXPECT_NEAR(key.outer.value().value(), 35.0 / 180.0 * std::numbers::pi, 1e-15);
  EXPECT_NEAR(key.beam.value().value(), std::numbers::pi / 5.0, 1e-15);
  EXPECT_NEAR(key.field.value().value(), std::numbers::pi / 3.0, 1e-15);
  EXPECT_EQ(key.electrical, Watts(9.0));
  EXPECT_EQ(key.flux, Lumens(806.0));
  EXPECT_EQ(key.position_m, (Vec3{0.0, 0.0, 1.2}));
}

TEST(SessionToml, ShapesHoldTheirOwnLengths) {
  const Session session = WholeSession();
  EXPECT_EQ(session.lights[1].width, Metres(0.6));
  EXPECT_EQ(session.lights[1].height, Metres(0.3));
  EXPECT_EQ(session.lights[2].diameter, Metres(0.06));
  EXPECT_EQ(session.lights[3].length, Metres(1.2));
  EXPECT_EQ(session.lights[3].radius, Metres(0.013));
}

TEST(SessionToml, AimHasUnitLengthEvenAtTheEndsOfADoublesRange) {
  EXPECT_EQ(WholeSession().lights[0].aim, (Vec3{0.0, 0.0, -1.0}));
  const auto session = ParseSessionToml(
      "lightcal = 1\n[[light]]\nname = \"a\"\nkind = \"spot\"\naim = [3e200, 0, 4e200]\n", "s");
  ASSERT_TRUE(session) << session.error().message;
  EXPECT_NEAR(session->lights[0].aim.value()[0], 0.6, 1e-15);
  EXPECT_NEAR(session->lights[0].aim.value()[2], 0.8, 1e-15);
  const auto tiny = ParseSessionToml(
      "lightcal = 1\n[[light]]\nname = \"a\"\nkind = \"spot\"\naim = [0, 5e-324, 0]\n", "s");
  ASSERT_TRUE(tiny) << tiny.error().message;
  EXPECT_EQ(tiny->lights[0].aim, (Vec3{0.0, 1.0, 0.0}));
}

TEST(SessionToml, ReadingHoldsEveryKey) {
  const Reading reading = WholeSession().readings.at(0).reading;
  EXPECT_EQ(reading.light, "key");
  EXPECT_EQ(reading.meter, "c800");
  EXPECT_EQ(reading.distance, Metres(0.5));
  EXPECT_EQ(reading.illuminance, Lux(192.0));
  EXPECT_NEAR(reading.tilt.value(), std::numbers::pi / 6.0, 1e-15);
  EXPECT_EQ(reading.lamp, LampState::kOn);
  EXPECT_FALSE(reading.shadow_card);
  EXPECT_EQ(reading.cct, Kelvin(2900.0));
  EXPECT_EQ(reading.duv, -0.001);
  EXPECT_EQ(reading.xy.value().x, 0.44);
  EXPECT_EQ(reading.xy.value().y, 0.40);
  EXPECT_EQ(reading.color_source, ColorSource::kSpectrometer);
  EXPECT_EQ(reading.spectrum_file, "captures/a.spdx");
  EXPECT_EQ(reading.time, "2026-01-02T03:04:05Z");
  EXPECT_EQ(reading.device, "sekonic:1234");
}

TEST(SessionToml, ReadingsNameTheirPlace) {
  const Session session = WholeSession();
  EXPECT_EQ(session.readings.at(2).where, "session.toml [[reading]] 3");
}

TEST(SessionToml, LampOffShadowCardAndOverRangeAreFirstClass) {
  const Session session = WholeSession();
  EXPECT_EQ(session.readings.at(1).reading.lamp, LampState::kOff);
  EXPECT_EQ(session.readings.at(1).reading.illuminance, Lux(0.0));
  EXPECT_EQ(session.readings.at(1).reading.normal, (Vec3{0.0, 0.0, 1.0}));
  EXPECT_TRUE(session.readings.at(2).reading.over_range);
  EXPECT_TRUE(session.readings.at(3).reading.shadow_card);
}

TEST(SigmaRelative, IsTheReadingsOwnThenItsMetersThenTheDataSheetsThenFivePercent) {
  const Session session = WholeSession();
  EXPECT_EQ(SigmaRelative(session, session.readings.at(0).reading), 0.03);
  EXPECT_EQ(SigmaRelative(session, session.readings.at(1).reading), 0.05);
  EXPECT_EQ(SigmaRelative(session, session.readings.at(2).reading), 0.02);
  EXPECT_EQ(SigmaRelative(session, session.readings.at(3).reading), 0.2);
}

TEST(FindLight, IsNullForANameNobodyGave) {
  const Session session = WholeSession();
  EXPECT_EQ(FindLight(session, "panel"), &session.lights[1]);
  EXPECT_EQ(FindLight(session, "Panel"), nullptr);
}

Reading FullReading() {
  Reading reading;
  reading.light = "Fl\u00e4che \"1\"";
  reading.meter = "c800";
  reading.distance = Metres(0.1 + 0.2);
  reading.illuminance = Lux(1.0 / 3.0);
  reading.tilt = RadiansFromDegrees(30.0);
  reading.cct = Kelvin(2856.5);
  reading.duv = -1e-4;
  reading.xy = Xy{0.4476, 0.4074};
  reading.spectrum_file = "captures/a b.spdx";
  reading.sigma_relative = 0.021;
  reading.time = "2026-01-02T03:04:05+01:00";
  reading.over_range = true;
  reading.color_source = ColorSource::kColorimeter;
  reading.device = "sekonic:0001";
  return reading;
}

TEST(ReadingLine, ReadsBackAsTheSameReading) {
  const Reading reading = FullReading();
  const std::string line = ReadingToJson(reading);
  const auto back = ReadingFromJson(line, "here");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(ReadingToJson(*back), line);
  EXPECT_EQ(back->light, reading.light);
  EXPECT_EQ(back->distance, reading.distance);
  EXPECT_EQ(back->illuminance, reading.illuminance);
  EXPECT_EQ(back->tilt, reading.tilt);
  EXPECT_EQ(back->cct, reading.cct);
  EXPECT_EQ(back->duv, reading.duv);
  EXPECT_EQ(back->xy.value().y, reading.xy->y);
  EXPECT_EQ(back->sigma_relative, reading.sigma_relative);
  EXPECT_EQ(back->color_source, reading.color_source);
  EXPECT_EQ(back->device, reading.device);
  EXPECT_TRUE(back->over_range);
}

TEST(ReadingLine, IsOneLineOfOnlyWhatWasMeasured) {
  Reading reading;
  reading.light = "key";
  reading.distance = Metres(0.5);
  reading.illuminance = Lux(192.5);
  EXPECT_EQ(ReadingToJson(reading), R"({"light":"key","distance_m":0.5,"illuminance_lx":192.5})");
}

TEST(ReadingLine, WritesWholeDegreesAsAPersonWould) {
  for (int degrees = -89; degrees < 90; ++degrees) {
    if (degrees == 0) continue;
    Reading reading;
    reading.illuminance = Lux(1.5);
    reading.tilt = RadiansFromDegrees(degrees);
    EXPECT_THAT(ReadingToJson(reading),
                testing::HasSubstr("\"tilt_deg\":" + std::to_string(degrees) + ".0}"));
  }
}

TEST(ReadingLine, AnyTiltThatWasReadIsWrittenSoThatItReadsBackTheSame) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> degrees(-90.0, 90.0);
  for (int i = 0; i < 20000; ++i) {
    Reading reading;
    reading.illuminance = Lux(1.0);
    reading.tilt = RadiansFromDegrees(degrees(random));
    const auto back = ReadingFromJson(ReadingToJson(reading), "here");
    ASSERT_TRUE(back) << back.error().message;
    ASSERT_EQ(back->tilt.value(), reading.tilt.value());
  }
}

TEST(ReadingLine, NeverHoldsNaN) {
  Reading reading;
  reading.light = "key";
  reading.illuminance = Lux(std::nan(""));
  const std::string line = ReadingToJson(reading);
  EXPECT_EQ(line, R"({"light":"key","illuminance_lx":null})");
  const auto back = ReadingFromJson(line, "here");
  ASSERT_FALSE(back);
  EXPECT_EQ(back.error().code, "bad_reading");
}

}  // namespace
}  // namespace lightcal
