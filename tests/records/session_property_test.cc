// SPDX-License-Identifier: Apache-2.0
// Random sessions, written as TOML here, mean what was meant.
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "lightcal/core/numbers_text.h"
#include "lightcal/records/session_codec.h"

namespace lightcal {
namespace {

class RandomSession {
 public:
  explicit RandomSession(unsigned seed) : random_(seed) {}

  Session Make() {
    Session session;
    session.name = Name();
    if (Coin()) session.room = Room{{Positive(), Positive(), Positive()}, Unit()};
    for (int i = Count(1, 4); i > 0; --i) session.lights.push_back(Light(i));
    for (int i = Count(0, 3); i > 0; --i) {
      session.meters.push_back({"m" + std::to_string(i) + Name(), 0.001 + 0.9 * Unit(),
                                std::nullopt, Maybe(Unit()), Maybe(Unit()), Maybe(Unit()),
                                Maybe(Metres(Positive()))});
    }
    for (int i = Count(0, 12); i > 0; --i) session.readings.push_back({OneReading(session), ""});
    return session;
  }

 private:
  double Unit() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }
  double Positive() { return std::exp(20.0 * Unit() - 10.0); }
  double Signed() { return Coin() ? Positive() : -Positive(); }
  bool Coin() { return Unit() < 0.5; }
  int Count(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  template <class T>
  std::optional<T> Maybe(T value) {
    return Coin() ? std::optional<T>(value) : std::nullopt;
  }
  std::string Name() {
    static constexpr std::string_view kPieces[] = {"a", "Z", "9", " ", "\"", "\\", "#", "=",
                                                   "[", "]", ".", "'", "é",  "灯", "-", ","};
    std::string name;
    for (int i = Count(1, 6); i > 0; --i) name += kPieces[Count(0, std::size(kPieces) - 1)];
    return name;
  }
  LightDescription Light(int i) {
    LightDescription light;
    light.name = "l" + std::to_string(i) + Name();
    light.kind = static_cast<LightKind>(Count(0, 8));
    light.position_m = Maybe(Vec3{Signed(), Signed(), Signed()});
    light.diameter = Maybe(Metres(Positive()));
    if (Coin()) {
      light.width = Metres(Positive());
      light.height = Metres(Positive());
    }
    light.length = Maybe(Metres(Positive()));
    light.electrical = Maybe(Watts(Positive()));
    light.flux = Maybe(Lumens(Positive()));
    return light;
  }
  Reading OneReading(const Session& session) {
    Reading reading;
    reading.light = session.lights[Count(0, static_cast<int>(session.lights.size()) - 1)].name;
    if (!session.meters.empty() && Coin()) reading.meter = session.meters.front().name;
    if (Coin()) {
      reading.distance = Metres(Positive());
    } else {
      reading.position_m = Vec3{Signed(), Signed(), Signed()};
      reading.normal = Vec3{Signed(), Signed(), Signed()};
    }
    reading.illuminance = Lux(Coin() ? 0.0 : Positive());
    reading.cct = Maybe(Kelvin(1000.0 + Positive()));
    if (reading.cct) reading.duv = Maybe(0.05 * Unit());
    const double x = 0.05 + 0.6 * Unit();
    reading.xy = Maybe(Xy{x, 0.01 + 0.9 * (0.98 - x) * Unit()});
    reading.sigma_relative = Maybe(0.001 + 0.9 * Unit());
    reading.sigma_mired = Maybe(Mireds(1.0 + 20.0 * Unit()));
    reading.lamp = Coin() ? LampState::kOn : LampState::kOff;
    reading.over_range = Coin();
    reading.under_range = !reading.over_range && Coin();
    reading.quality = static_cast<MeterQuality>(Count(0, 5));
    reading.calibration_factor = Maybe(Positive());
    return reading;
  }

  std::mt19937 random_;
};

std::string Quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

template <std::size_t N>
std::string List(const std::array<double, N>& values) {
  std::string text = "[";
  for (const double value : values) text += ShortestText(value) + ", ";
  return text + "]";
}

class TomlText {
 public:
  void Header(const std::string& header) { text_ += header + "\n"; }
  void Raw(const std::string& key, const std::string& value) {
    text_ += key + " = " + value + "\n";
  }
  void Number(const std::string& key, std::optional<double> value) {
    if (value) Raw(key, ShortestText(*value));
  }
  template <class Kind>
  void Number(const std::string& key, std::optional<Quantity<Kind>> value) {
    if (value) Raw(key, ShortestText(value->value()));
  }
  void Vector(const std::string& key, const std::optional<Vec3>& value) {
    if (value) Raw(key, List(*value));
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

void WriteLight(TomlText& toml, const LightDescription& light) {
  toml.Header("[[light]]");
  toml.Raw("name", Quoted(light.name));
  toml.Raw("kind", Quoted(std::string(LightKindName(light.kind))));
  toml.Vector("position_m", light.position_m);
  toml.Number("diameter_m", light.diameter);
  if (light.width) {
    toml.Raw("size_m", List(std::array{light.width->value(), light.height->value()}));
  }
  toml.Number("length_m", light.length);
  toml.Number("electrical_W", light.electrical);
  toml.Number("flux_lm", light.flux);
}

void WriteReading(TomlText& toml, const Reading& reading) {
  toml.Header("[[reading]]");
  toml.Raw("light", Quoted(reading.light));
  if (!reading.meter.empty()) toml.Raw("meter", Quoted(reading.meter));
  toml.Number("distance_m", reading.distance);
  toml.Vector("position_m", reading.position_m);
  toml.Vector("normal", reading.normal);
  toml.Number("illuminance_lx", reading.illuminance);
  toml.Number("cct_K", reading.cct);
  toml.Number("duv", reading.duv);
  if (reading.xy) toml.Raw("xy", List(std::array{reading.xy->x, reading.xy->y}));
  toml.Number("sigma_relative", reading.sigma_relative);
  toml.Number("sigma_mired", reading.sigma_mired);
  if (reading.lamp == LampState::kOff) toml.Raw("lamp", "\"off\"");
  if (reading.over_range) toml.Raw("over_range", "true");
  if (reading.under_range) toml.Raw("under_range", "true");
  constexpr std::array kQualities = {"unknown",  "photometer",  "colorimeter",
                                     "spectral", "bare_sensor", "derived"};
  toml.Raw("quality", Quoted(kQualities[static_cast<std::size_t>(reading.quality)]));
  toml.Number("calibration_factor", reading.calibration_factor);
}

std::string TomlOf(const Session& session) {
  TomlText toml;
  toml.Raw("lightcal", "1");
  toml.Raw("name", Quoted(session.name));
  if (session.room) {
    toml.Header("[room]");
    toml.Vector("size_m", session.room->size_m);
    toml.Number("reflectance", std::optional(session.room->reflectance));
  }
  for (const LightDescription& light : session.lights) WriteLight(toml, light);
  for (const MeterDescription& meter : session.meters) {
    toml.Header("[[meter]]");
    toml.Raw("name", Quoted(meter.name));
    toml.Number("sigma_relative", std::optional(meter.sigma_relative));
    toml.Number("cosine_f2", meter.cosine_f2);
    toml.Number("spectral_f1", meter.spectral_f1);
    toml.Number("head_radius_m", meter.head_radius);
  }
  for (const SessionReading& row : session.readings) WriteReading(toml, row.reading);
  return toml.text();
}

void ExpectSameLight(const LightDescription& a, const LightDescription& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.position_m, b.position_m);
  EXPECT_EQ(a.diameter, b.diameter);
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.length, b.length);
  EXPECT_EQ(a.electrical, b.electrical);
  EXPECT_EQ(a.flux, b.flux);
}

void ExpectSameReading(const Reading& a, const Reading& b) {
  EXPECT_EQ(a.light, b.light);
  EXPECT_EQ(a.meter, b.meter);
  EXPECT_EQ(a.distance, b.distance);
  EXPECT_EQ(a.position_m, b.position_m);
  EXPECT_EQ(a.normal, b.normal);
  EXPECT_EQ(a.illuminance, b.illuminance);
  EXPECT_EQ(a.cct, b.cct);
  EXPECT_EQ(a.duv, b.duv);
  EXPECT_EQ(a.xy.has_value(), b.xy.has_value());
  if (a.xy && b.xy) {
    EXPECT_EQ(a.xy->x, b.xy->x);
    EXPECT_EQ(a.xy->y, b.xy->y);
  }
  EXPECT_EQ(a.sigma_relative, b.sigma_relative);
  EXPECT_EQ(a.sigma_mired, b.sigma_mired);
  EXPECT_EQ(a.lamp, b.lamp);
  EXPECT_EQ(a.over_range, b.over_range);
  EXPECT_EQ(a.under_range, b.under_range);
  EXPECT_EQ(a.quality, b.quality);
  EXPECT_EQ(a.calibration_factor, b.calibration_factor);
}

TEST(SessionProperty, WhatIsWrittenIsWhatIsRead) {
  for (unsigned seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    const Session meant = RandomSession(seed).Make();
    const std::string text = TomlOf(meant);
    const auto read = ParseSessionToml(text, "session.toml");
    ASSERT_TRUE(read) << read.error().subject << " " << read.error().message << "\n" << text;
    EXPECT_EQ(read->name, meant.name);
    EXPECT_EQ(read->room.has_value(), meant.room.has_value());
    ASSERT_EQ(read->lights.size(), meant.lights.size());
    for (std::size_t i = 0; i < meant.lights.size(); ++i) {
      ExpectSameLight(read->lights[i], meant.lights[i]);
    }
    ASSERT_EQ(read->meters.size(), meant.meters.size());
    for (std::size_t i = 0; i < meant.meters.size(); ++i) {
      EXPECT_EQ(read->meters[i].sigma_relative, meant.meters[i].sigma_relative);
      EXPECT_EQ(read->meters[i].head_radius, meant.meters[i].head_radius);
    }
    ASSERT_EQ(read->readings.size(), meant.readings.size());
    for (std::size_t i = 0; i < meant.readings.size(); ++i) {
      ExpectSameReading(read->readings[i].reading, meant.readings[i].reading);
    }
  }
}

// The journal holds the same keys, so that a row may move from one file to the other.
TEST(SessionProperty, ReadingOfASessionSurvivesTheJournal) {
  for (unsigned seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    for (const SessionReading& row : RandomSession(seed).Make().readings) {
      const auto back = ReadingFromJson(ReadingToJson(row.reading), "line");
      ASSERT_TRUE(back) << back.error().message;
      ExpectSameReading(*back, row.reading);
    }
  }
}

}  // namespace
}  // namespace lightcal
