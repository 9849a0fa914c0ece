// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/session_codec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "lightcal/records/camera_frames_codec.h"
#include "lightcal/records/capture_codec.h"
#include "lightcal/records/reading_codec.h"
#include "lightcal/records/session_rules.h"
#include "lightcal/records/session_toml.h"
#include "lightcal/records/toml_codec.h"

namespace lightcal {
namespace records {
namespace {

constexpr int kSessionVersion = 1;

template <class Named>
void CheckName(FieldReader& reader, const std::vector<Named>& all) {
  if (reader.Failed()) return;
  if (const auto fault = FaultOfName(all, all.size() - 1)) {
    reader.Fail(fault->code, "name", fault->message);
  }
}

template <class Described>
void FailTogether(FieldReader& reader, const Described& described) {
  if (const auto fault = DisagreementIn(described)) reader.Fail(fault->key, fault->message);
}

std::optional<Vec3> UnitVector(FieldReader& reader, std::string_view key,
                               const std::optional<Vec3>& given) {
  if (!given) return given;
  const double largest =
      std::max({std::abs((*given)[0]), std::abs((*given)[1]), std::abs((*given)[2])});
  if (largest == 0.0) {
    reader.Fail(key, std::string(key) + " = [0, 0, 0] is no direction");
    return std::nullopt;
  }
  // Scaled first, so that neither tiny nor huge components leave the range of a double.
  const Vec3 scaled{(*given)[0] / largest, (*given)[1] / largest, (*given)[2] / largest};
  return scaled * (1.0 / Length(scaled));
}

// Angles that the person gave the wrong way round.
void CloseCone(LightDescription& light, std::string_view where, Warnings& warnings) {
  if (!light.inner || !light.outer || *light.inner <= *light.outer) return;
  warnings.push_back({"cone_order", light.name,
                      std::string(where) + ": inner_deg exceeds outer_deg; both are taken as " +
                          "the outer half angle. Half angles are expected; write the smaller "
                          "one as inner_deg"});
  light.inner = light.outer;
}

class SessionReader {
 public:
  SessionReader(LoadedSession& out, std::string_view where) : out_(out), where_(where) {}

  void Read(FieldReader& reader) {
    ReadVersion(reader);
    Session& session = out_.session;
    reader.Text("name", session.name);
    reader.Object("room", session.room,
                  [&](FieldReader& r, Room& room) { ReadRoom(r, room, session); });
    if (session.room && !(session.room->size_m[0] > 0.0)) session.room.reset();
    reader.List("light", session.lights, [this](FieldReader& r, LightDescription& light) {
      ReadLight(r, light);
      CheckName(r, out_.session.lights);
    });
    reader.List("meter", session.meters, [this](FieldReader& r, MeterDescription& meter) {
      ReadMeter(r, meter);
      CheckName(r, out_.session.meters);
    });
    std::vector<SessionReading> rows;
    reader.List("reading", rows, [this](FieldReader& r, SessionReading& row) { ReadRow(r, row); });
    reader.List("capture", session.captures,
                [this](FieldReader& r, CaptureDescription& c) { ReadCaptureOfLight(r, c); });
    std::optional<CameraDescription> camera;
    reader.Object("camera", camera, [](FieldReader& r, CameraDescription& c) {
      r.Text("sensitivities", c.sensitivities);
      r.Require({"sensitivities"});
    });
    session.camera = camera.value_or(CameraDescription{});
    reader.List("camera_frames", session.camera_frames,
                [this](FieldReader& r, CameraFramesDescription& f) { ReadFramesOfCamera(r, f); });
  }

 private:
  static void ReadVersion(FieldReader& reader) {
    int version = 0;
    reader.Integer("lightcal", version);
    if (!reader.Has("lightcal")) {
      reader.Fail("lightcal", "lightcal is missing; begin the file with lightcal = 1");
    } else if (version != kSessionVersion) {
      reader.Fail("lightcal", "lightcal = " + std::to_string(version) +
                                  ": this program reads sessions of version 1");
    }
  }

  static void ReadRoom(FieldReader& reader, Room& room, Session& session) {
    bool outdoors = false;
    bool dark = false;
    reader.Truth("outdoors", outdoors);
    reader.Truth("dark", dark);
    VisitRoom(reader, room);
    reader.Number("haze_per_m", session.haze_per_metre, kNotNegative);
    if (outdoors) session.surroundings = Surroundings::kOutdoors;
    if (dark) session.surroundings = Surroundings::kDark;
    if (!outdoors && !dark) {
      const bool hazy_only =
          session.haze_per_metre && !reader.Has("reflectance") && !reader.Has("reflectance_u95");
      return hazy_only ? void() : reader.Require({"size_m"});
    }
    for (const std::string_view key : {"size_m", "reflectance", "reflectance_u95"}) {
      if (!reader.Has(key)) continue;
      reader.Fail(key, std::string(key) + " describes walls, and " + (dark ? "dark" : "outdoors") +
                           " = true says there are none; keep one");
    }
  }

  void ReadLight(FieldReader& reader, LightDescription& light) {
    VisitLight(reader, light);
    light.aim = UnitVector(reader, "aim", light.aim);
    light.axis = UnitVector(reader, "axis", light.axis);
    reader.List("at", light.at, &ReadAtState);
    reader.Require({"name", "kind"});
    reader.Finish();
    CloseCone(light, where_, out_.warnings);
    FailTogether(reader, light);
  }

  static void ReadAtState(FieldReader& reader, StateDescription& one) {
    VisitAtState(reader, one);
    reader.Require({"state"});
    reader.Finish();
    FailTogether(reader, one);
  }

  static void ReadMeter(FieldReader& reader, MeterDescription& meter) {
    VisitMeter(reader, meter);
    meter.states_sigma = reader.Has("sigma_relative");
    reader.Require({"name"});
    reader.Finish();
    FailTogether(reader, meter);
  }

  void ReadRow(FieldReader& reader, SessionReading& row) {
    row.where = std::string(where_) + " " + reader.Place();
    if (!reader.Has("lit")) reader.Require({"light"});
    LitKeys keys;
    ReadReading(reader, row.reading, keys);
    if (reader.Failed()) return;
    Session& session = out_.session;
    const auto strange = keys.given ? FindStrangeName(session, row.reading, keys)
                                    : FindStrangeName(session, row.reading);
    if (strange) {
      reader.Fail(strange->code, strange->key, strange->message);
    } else if (keys.given) {
      session.lit_readings.push_back(
          {std::move(row.reading), row.where, std::move(keys.lit), std::move(keys.distances)});
    } else {
      session.readings.push_back(row);
    }
  }

  void ReadCaptureOfLight(FieldReader& reader, CaptureDescription& capture) {
    capture.where = std::string(where_) + " " + reader.Place();
    ReadCapture(reader, capture);
    if (reader.Failed()) return;
    if (const auto strange = FindStrangeName(out_.session, capture)) {
      reader.Fail(strange->code, strange->key, strange->message);
      return;
    }
    // A card in the sun stands at no distance from it.
    const LightDescription* const light = FindLight(out_.session, capture.light);
    if (capture.use == CaptureUse::kCard && light->kind != LightKind::kDirectional) {
      reader.Require({"distance_m"});
    }
  }

  void ReadFramesOfCamera(FieldReader& reader, CameraFramesDescription& frames) {
    frames.where = std::string(where_) + " " + reader.Place();
    ReadCameraFrames(reader, frames);
    if (reader.Failed() || frames.meter.empty()) return;
    const MeterDescription* const meter = FindMeter(out_.session, frames.meter);
    if (meter == nullptr) {
      reader.Fail("unknown_meter", "meter",
                  "meter = " + Quoted(frames.meter) + " names no [[meter]]");
      return;
    }
    frames.sigma_relative = meter->sigma_relative;
  }

  LoadedSession& out_;
  std::string_view where_;
};

template <class Named>
std::string NearestAmong(std::string_view word, const std::vector<Named>& all) {
  std::vector<std::string_view> names;
  names.reserve(all.size());
  for (const Named& named : all) names.push_back(named.name);
  return DidYouMean(word, names);
}

std::optional<StrangeName> StrangeLight(const Session& session, const std::string& name,
                                        const char* key) {
  if (FindLight(session, name) != nullptr) return std::nullopt;
  return StrangeName{"unknown_light", key,
                     std::string(key) + " = " + Quoted(name) + " names no [[light]]" +
                         NearestAmong(name, session.lights)};
}

std::optional<StrangeName> StrangeMeter(const Session& session, const Reading& reading) {
  const bool known = reading.meter.empty() || reading.meter == kDataSheetMeter ||
                     std::ranges::any_of(session.meters, [&](const MeterDescription& meter) {
                       return meter.name == reading.meter;
                     });
  if (known) return std::nullopt;
  return StrangeName{"unknown_meter", "meter",
                     "meter = " + Quoted(reading.meter) + " names no [[meter]]" +
                         NearestAmong(reading.meter, session.meters)};
}

}  // namespace

std::optional<StrangeName> FindStrangeName(const Session& session, const Reading& reading) {
  if (auto light = StrangeLight(session, reading.light, "light")) return light;
  return StrangeMeter(session, reading);
}

std::optional<StrangeName> FindStrangeName(const Session& session, const Reading& reading,
                                           const LitKeys& keys) {
  for (const std::string& name : keys.lit) {
    if (auto light = StrangeLight(session, name, "lit")) return light;
  }
  for (const auto& [name, distance] : keys.distances) {
    if (auto light = StrangeLight(session, name, "distances_m")) return light;
  }
  return StrangeMeter(session, reading);
}

std::optional<StrangeName> FindStrangeName(const Session& session,
                                           const CaptureDescription& capture) {
  Reading named;
  named.light = capture.light;
  named.meter = capture.meter;
  if (auto strange = FindStrangeName(session, named)) return strange;
  const LampClass known = ClassOfLamp(session, capture.light);
  const bool said = known != LampClass::kUnknown && capture.lamp_class != LampClass::kUnknown;
  if (!said || known == capture.lamp_class) return std::nullopt;
  const auto word = [](LampClass one) {
    return Quoted(kLampClassWords[static_cast<std::size_t>(one)]);
  };
  return StrangeName{"lamp_class_conflict", "lamp_class",
                     "lamp_class = " + word(capture.lamp_class) + ", but light " +
                         Quoted(capture.light) + " is said to be " + word(known) +
                         "; say it once, at the [[light]]"};
}

Result<LoadedSession> ParseSession(std::string_view text, std::string_view where) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != std::string_view::npos && text[first] == '{') {
    return Refused("bad_session", std::string(where),
                   "is JSON, not a session (TOML): where it is a light.json made of one, give that "
                   "session or its folder");
  }
  const auto document = ParseToml(text);
  if (!document) {
    const int line = document.error().line;
    return Refused("bad_session",
                   std::string(where) + (line > 0 ? ":" + std::to_string(line) : std::string()),
                   "not valid TOML: " + document.error().message);
  }
  ReadingOfFile file{std::string(where), "bad_session", PlaceStyle::kToml, std::nullopt};
  LoadedSession loaded;
  FieldReader reader(*document, "", file);
  SessionReader(loaded, where).Read(reader);
  reader.Finish();
  if (file.error) return tl::unexpected(*std::move(file.error));
  if (loaded.session.lights.empty() && loaded.session.camera_frames.empty()) {
    return Refused("no_light", std::string(where),
                   "no [[light]] is described; add one with a name and a kind");
  }
  return loaded;
}

}  // namespace records

Result<Session> ParseSessionToml(std::string_view text, std::string_view where) {
  auto loaded = records::ParseSession(text, where);
  if (!loaded) return Propagate(std::move(loaded));
  SpreadLitReadings(loaded->session);
  if (auto split = SplitStates(loaded->session); !split) return Propagate(std::move(split));
  return std::move(loaded->session);
}

}  // namespace lightcal
