// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/reading_codec.h"

#include <array>
#include <cstdint>
#include <string>
#include <utility>

#include "lightcal/records/field_checker.h"
#include "lightcal/records/field_writer.h"
#include "lightcal/records/json_codec.h"
#include "lightcal/records/reading_time.h"
#include "lightcal/records/session_codec.h"

namespace lightcal {
namespace records {
namespace {

constexpr std::array<std::string_view, 2> kLampWords = {"on", "off"};
constexpr std::array<std::string_view, 4> kColorSourceWords = {"unknown", "spectrometer",
                                                               "colorimeter", "camera"};

constexpr std::array<std::string_view, 6> kQualityWords = {"unknown",  "photometer",  "colorimeter",
                                                           "spectral", "bare_sensor", "derived"};

template <class Archive, class SomeReading>
void VisitReading(Archive& archive, SomeReading& reading) {
  archive.Text("light", reading.light);
  archive.Text("meter", reading.meter);
  archive.Text("device", reading.device);
  archive.Text("time", reading.time);
  archive.Number("distance_m", reading.distance, kDistanceRule);
  archive.Number("distance_sigma_m", reading.distance_sigma, kNotNegative);
  archive.Array("position_m", reading.position_m);
  archive.Array("normal", reading.normal);
  archive.Number("illuminance_lx", reading.illuminance, kIlluminanceRule);
  archive.Degrees("tilt_deg", reading.tilt, kTiltRule);
  archive.Degrees("off_axis_deg", reading.off_axis, kOffAxisRule);
  archive.WordUnlessFirst("lamp", reading.lamp, kLampWords);
  archive.Flag("shadow_card", reading.shadow_card);
  archive.Controls("state", reading.state);
  archive.Number("cct_K", reading.cct, kPositive);
  archive.Number("duv", reading.duv);
  archive.Chromaticity("xy", reading.xy);
  archive.WordUnlessFirst("color_source", reading.color_source, kColorSourceWords);
  archive.Text("spectrum", reading.spectrum_file);
  archive.Number("sigma_relative", reading.sigma_relative, kSigmaRule);
  archive.Number("sigma_mired", reading.sigma_mired, kPositive);
  archive.Flag("over_range", reading.over_range);
  archive.Flag("under_range", reading.under_range);
  archive.WordUnlessFirst("quality", reading.quality, kQualityWords);
  archive.Number("calibration_factor", reading.calibration_factor, kPositive);
}

enum class Facing : std::uint8_t { kWritten, kUnlessSaid };  // of a meter whose position is known

std::optional<ReadingFault> FaultOfPlace(const Reading& reading, Facing facing) {
  if (reading.distance && (reading.position_m || reading.normal)) {
    return ReadingFault{"distance_m", "give distance_m, or position_m with normal, not both"};
  }
  if (reading.distance_sigma && reading.position_m) {
    return ReadingFault{"distance_sigma_m",
                        "distance_sigma_m is of a distance, and position_m gives none"};
  }
  const bool faces = facing == Facing::kUnlessSaid && !reading.normal;
  if (!faces && reading.position_m.has_value() != reading.normal.has_value()) {
    return ReadingFault{
        reading.normal ? "normal" : "position_m",
        "position_m and normal belong together: where the meter stood and where it faced"};
  }
  if (reading.position_m && reading.off_axis.value() != 0.0) {
    return ReadingFault{"off_axis_deg",
                        "position_m says already how far off the axis the meter stood"};
  }
  if (reading.normal && reading.tilt.value() != 0.0) {
    return ReadingFault{"tilt_deg", "normal says already how the meter was turned"};
  }
  if (reading.normal && Length(*reading.normal) == 0.0) {
    return ReadingFault{"normal", "normal = [0, 0, 0] is no direction"};
  }
  return std::nullopt;
}

// Of what is written; a picture's own time may be a camera's that was never set.
std::optional<ReadingFault> FaultOfTime(const Reading& reading) {
  if (reading.time.empty() || IsTime(reading.time)) return std::nullopt;
  return ReadingFault{"time", "time = " + Quoted(reading.time) +
                                  " is no ISO 8601 time such as 2026-11-21T10:00:00Z"};
}

// Of fields that are right each by itself.
std::optional<ReadingFault> FaultTogether(const Reading& reading,
                                          Facing facing = Facing::kWritten) {
  if (facing == Facing::kWritten) {
    if (auto fault = FaultOfTime(reading)) return fault;
  }
  if (auto fault = FaultOfPlace(reading, facing)) return fault;
  if (!reading.illuminance && !reading.cct && !reading.xy && reading.spectrum_file.empty()) {
    return ReadingFault{"light",
                        "nothing was measured: give illuminance_lx, xy, cct_K or spectrum"};
  }
  if (reading.duv && !reading.cct) return ReadingFault{"duv", "duv needs cct_K beside it"};
  if (reading.over_range && !reading.illuminance) {
    return ReadingFault{"over_range",
                        "over_range needs illuminance_lx: the largest value the meter shows"};
  }
  if (reading.under_range && !reading.illuminance) {
    return ReadingFault{"under_range",
                        "under_range needs illuminance_lx: the smallest value the meter shows"};
  }
  if (reading.over_range && reading.under_range) {
    return ReadingFault{"under_range", "a reading is over_range or under_range, not both"};
  }
  if (reading.shadow_card && reading.lamp == LampState::kOff) {
    return ReadingFault{"shadow_card", "shadow_card needs the lamp on; write only lamp = \"off\""};
  }
  return std::nullopt;
}

void CheckLit(FieldReader& reader, const Reading& reading, const LitKeys& keys) {
  if (!keys.given) {
    if (reader.Has("distances_m")) {
      reader.Fail("distances_m", "distances_m goes with lit; beside light write distance_m");
    }
    return;
  }
  if (!reading.state.empty()) {
    reader.Fail("state", "a reading of several lamps has no state; read the dimmed lamp by itself");
  }
  if (reader.Has("light") || reader.Has("lamp") || reading.shadow_card || reading.distance) {
    reader.Fail(
        "lit",
        "lit names the lamps that were on; leave out light, lamp and shadow_card, and give "
        "distances_m = { key = 2.0 } or position_m with normal instead of distance_m. What "
        "was read behind a card with one lamp alone lit is a reading of its own, with light "
        "= \"key\", shadow_card = true and the same position_m and normal or distance_m");
  }
  if (!reading.illuminance) reader.Fail("lit", "a reading of several lamps needs illuminance_lx");
  if (!keys.distances.empty() && reading.position_m) {
    reader.Fail("distances_m", "give distances_m, or position_m with normal, not both");
  }
}

LineError BadLine(std::string_view where, std::string message) {
  return {{ErrorKind::kRefused, "bad_reading", std::string(where), std::move(message)}};
}

}  // namespace

void ReadReading(FieldReader& reader, Reading& reading) {
  VisitReading(reader, reading);
  reader.Finish();  // a misspelt key comes before what it makes missing
  if (const auto fault = FaultTogether(reading)) reader.Fail(fault->key, fault->message);
}

void ReadReading(FieldReader& reader, Reading& reading, LitKeys& keys) {
  keys.given = reader.Has("lit");
  reader.Texts("lit", keys.lit);
  reader.NumbersByName("distances_m", keys.distances, kDistanceRule);
  ReadReading(reader, reading);
  CheckLit(reader, reading, keys);
}

tl::expected<Reading, LineError> ReadingFromLine(std::string_view line, std::string_view where) {
  LitKeys keys;
  auto reading = ReadingFromLine(line, where, keys);
  if (reading && keys.given) {
    return tl::unexpected(BadLine(where, "lit: a reading of several lamps belongs to a session"));
  }
  return reading;
}

tl::expected<Reading, LineError> ReadingFromLine(std::string_view line, std::string_view where,
                                                 LitKeys& keys) {
  const auto node = ParseJson(line);
  if (!node) {
    LineError bad = BadLine(where, node.error().message);
    bad.syntax = true;
    bad.torn = node.error().at_end;
    return tl::unexpected(std::move(bad));
  }
  if (node->kind != Node::Kind::kTable) {
    return tl::unexpected(BadLine(where, "a line of the journal must be one JSON object"));
  }
  ReadingOfFile file{std::string(where), "bad_reading", PlaceStyle::kJson, std::nullopt};
  FieldReader reader(*node, "", file);
  Reading reading;
  ReadReading(reader, reading, keys);
  if (file.error) return tl::unexpected(LineError{*std::move(file.error)});
  return reading;
}

std::optional<ReadingFault> FaultInMemory(const Reading& reading) {
  FieldChecker checker;
  VisitReading(checker, reading);
  return checker.fault() ? checker.fault() : FaultTogether(reading, Facing::kUnlessSaid);
}

}  // namespace records

std::optional<ReadingFault> FaultOf(const Reading& reading) {
  records::FieldChecker checker;
  records::VisitReading(checker, reading);
  return checker.fault() ? checker.fault() : records::FaultTogether(reading);
}

records::Node DocumentOf(const Reading& reading) {
  records::FieldWriter writer;
  records::VisitReading(writer, reading);
  return writer.TakeTable();
}

std::string ReadingToJson(const Reading& reading) {
  return PrintJson(DocumentOf(reading), records::JsonLayout::kOneLine);
}

Result<Reading> ReadingFromJson(std::string_view line, std::string_view where) {
  auto reading = records::ReadingFromLine(line, where);
  if (!reading) return tl::unexpected(reading.error().error);
  return *std::move(reading);
}

}  // namespace lightcal
