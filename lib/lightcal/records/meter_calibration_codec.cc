// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "lightcal/records/field_reader.h"
#include "lightcal/records/meter_calibration.h"
#include "lightcal/records/toml_codec.h"

namespace lightcal {
namespace records {
namespace {

constexpr int kMetersVersion = 1;
constexpr NumberRule kFactorRule{[](double v) { return v >= 0.01 && v <= 100.0; },
                                 "must lie between 0.01 and 100: true lux = factor x shown"};

void ReadCalibration(FieldReader& reader, MeterCalibration& calibration) {
  reader.Text("device", calibration.device);
  reader.Number("factor", calibration.factor, kFactorRule);
  reader.Text("date", calibration.date);
  reader.Number("sigma_relative", calibration.sigma_relative, kSigmaRule);
  reader.Require({"device", "factor"});
  if (reader.Has("device") && calibration.device.find(':') == std::string::npos) {
    reader.Fail("device",
                "device is a driver and its serial number, as `{FindMeters}` prints it: "
                "sekonic:J0123");
  }
}

void ReadMeters(FieldReader& reader, std::vector<MeterCalibration>& calibrations) {
  int version = 0;
  reader.Integer("lightcal", version);
  reader.List("calibration", calibrations, [&](FieldReader& inner, MeterCalibration& one) {
    ReadCalibration(inner, one);
    const auto same = std::ranges::count(calibrations, one.device, &MeterCalibration::device);
    if (same > 1) inner.Fail("device", Quoted(one.device) + " is calibrated twice; keep one");
  });
  reader.Require({"lightcal"});
  if (reader.Has("lightcal") && version != kMetersVersion) {
    reader.Fail("lightcal", "lightcal = 1 is the only version of this file there is");
  }
}

}  // namespace
}  // namespace records

Result<std::vector<MeterCalibration>> MeterCalibrationsFromToml(std::string_view text,
                                                                std::string_view where) {
  const auto document = records::ParseToml(text);
  if (!document) {
    return Refused("bad_meters", std::string(where) + ":" + std::to_string(document.error().line),
                   "not valid TOML: " + document.error().message);
  }
  records::ReadingOfFile file{std::string(where), "bad_meters", records::PlaceStyle::kToml,
                              std::nullopt};
  std::vector<MeterCalibration> calibrations;
  records::FieldReader reader(*document, "", file);
  records::ReadMeters(reader, calibrations);
  reader.Finish();
  if (file.error) return tl::unexpected(*std::move(file.error));
  return calibrations;
}

}  // namespace lightcal
