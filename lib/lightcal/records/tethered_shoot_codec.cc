// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <utility>

#include "lightcal/records/capture_codec.h"
#include "lightcal/records/field_reader.h"
#include "lightcal/records/field_writer.h"
#include "lightcal/records/json_codec.h"
#include "lightcal/records/tethered_shoot.h"

namespace lightcal {
namespace records {
namespace {

constexpr std::string_view kSchema = "lightcal.capture/1";
constexpr std::string_view kState[] = {"shooting", "complete"};

template <class Archive, class Setting>
void VisitSetting(Archive& archive, Setting& setting) {
  archive.Text("name", setting.name);
  archive.Text("value", setting.value);
  archive.Require({"name"});
}

template <class Archive, class Frame>
void VisitFrame(Archive& archive, Frame& frame) {
  archive.Text("shutter", frame.shutter);
  archive.Number("planned_s", frame.planned_s, kPositive);
  archive.Number("rounding_s", frame.rounding_s, kNotNegative);
  archive.Text("file", frame.file);
  archive.Number("exposure_s", frame.exposure, kPositive);
  archive.Number("f_number", frame.f_number, kPositive);
  archive.Number("iso", frame.iso, kPositive);
  archive.Require({"shutter", "planned_s"});
}

template <class Archive, class Shoot>
void VisitShoot(Archive& archive, Shoot& shoot) {
  const auto setting = [](auto& a, auto& s) { VisitSetting(a, s); };
  archive.Text("light", shoot.light);
  archive.Text("device", shoot.device);
  archive.Text("camera", shoot.camera);
  archive.Text("time", shoot.time);
  archive.Text("shutter_setting", shoot.shutter_setting);
  archive.Integer("pictures", shoot.pictures);
  archive.Flag("delete_from_card", shoot.delete_from_card);
  archive.Number("f_number", shoot.f_number, kPositive);
  archive.Number("iso", shoot.iso, kPositive);
  archive.List("settings", shoot.settings, setting);
  archive.List("restore", shoot.restore, setting);
  archive.List("frames", shoot.frames, [](auto& a, auto& f) { VisitFrame(a, f); });
  archive.Require({"light", "shutter_setting", "frames"});
}

// The keys a shoot gives of a [[capture]].
void WriteCapture(FieldWriter& writer, const CaptureDescription& capture) {
  writer.Text("light", capture.light);
  writer.Text("frames", capture.frames);
  writer.Word("use", capture.use, kCaptureUseWords);
  if (capture.reflectance > 0.0) writer.Number("reflectance", capture.reflectance);
  writer.Number("distance_m", capture.distance);
  writer.Degrees("tilt_deg", capture.tilt, kTiltRule);
  if (capture.field_of_view) writer.Degrees("fov_deg", *capture.field_of_view, kFullAngleRule);
  if (capture.rect) writer.Integers("rect", {capture.rect->begin(), capture.rect->end()});
  writer.WordUnlessFirst("lamp_class", capture.lamp_class, kLampClassWords);
}

// Names of files stay in the folder.
void CheckFiles(FieldReader& reader, const TetheredShoot& shoot) {
  for (const ShotFrame& frame : shoot.frames) {
    if (frame.file.find('/') == std::string::npos) continue;
    reader.Fail("frames", "a frame's file = " + Quoted(frame.file) + " is outside the folder");
  }
}

}  // namespace
}  // namespace records

std::string TetheredShootToJson(const TetheredShoot& shoot) {
  records::FieldWriter writer;
  writer.Text("schema", std::string(records::kSchema));
  writer.Word("state", shoot.complete, records::kState);
  if (shoot.capture) {
    writer.Group("capture", [&](auto& a) { records::WriteCapture(a, *shoot.capture); });
  }
  writer.Group("shoot", [&](auto& a) { records::VisitShoot(a, shoot); });
  return records::PrintJson(writer.TakeTable(), records::JsonLayout::kPretty) + "\n";
}

Result<TetheredShoot> TetheredShootFromJson(std::string_view text, std::string_view where) {
  constexpr const char* kBad = "bad_capture";
  const auto node = records::ParseJson(text);
  if (!node) return Refused(kBad, std::string(where), "not valid JSON: " + node.error().message);
  if (node->kind != records::Node::Kind::kTable) {
    return Refused(kBad, std::string(where), "must be one JSON object");
  }
  records::ReadingOfFile file{std::string(where), kBad, records::PlaceStyle::kJson, std::nullopt};
  records::FieldReader reader(*node, "", file);
  TetheredShoot shoot;
  std::string schema;
  reader.Text("schema", schema);
  reader.Word("state", shoot.complete, records::kState);
  reader.Object("capture", shoot.capture, [&](auto& a, CaptureDescription& capture) {
    records::ReadCapture(a, capture);
    capture.where = std::string(where);
  });
  reader.Group("shoot", [&](auto& a) { records::VisitShoot(a, shoot); });
  reader.Require({"schema", "state", "shoot"});
  reader.Finish();
  if (!reader.Failed() && schema != records::kSchema) {
    reader.Fail("schema", "schema = " + records::Quoted(schema) + ": this program reads " +
                              std::string(records::kSchema));
  }
  if (!reader.Failed()) records::CheckFiles(reader, shoot);
  if (file.error) return tl::unexpected(*std::move(file.error));
  return shoot;
}

}  // namespace lightcal
