// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "lightcal/records/camera_profile.h"
#include "lightcal/records/field_reader.h"
#include "lightcal/records/field_writer.h"
#include "lightcal/records/json_codec.h"
#include "lightcal/records/provenance_fields.h"

namespace lightcal {
namespace records {
namespace {

constexpr int kMostPixels = 100'000;  // a side
constexpr NumberRule kConstantRule{[](double v) { return v >= 1e-6 && v <= 1e9; },
                                   "must lie between 1e-6 and 1e9; by ISO 12232 it is 120"};
constexpr NumberRule kSignalRule{[](double v) { return std::abs(v) <= 1.0; },
                                 "must be a raw signal from -1 to 1"};
constexpr NumberRule kSignalSigmaRule{[](double v) { return v >= 0.0 && v <= 1.0; },
                                      "must be a raw signal from 0 to 1"};
constexpr NumberRule kVarianceRule{[](double v) { return v > 0.0 && v <= 1.0; },
                                   "must lie above 0, up to 1: of raw signals, 1 is full scale"};
constexpr NumberRule kAttenuationRule{[](double v) { return v >= 0.1 && v <= 1e8; },
                                      "must lie between 0.1 and 1e8: light without / with filter"};
constexpr NumberRule kIsoRule{[](double v) { return v > 0.0 && v <= 1e8; },
                              "must be an ISO speed above 0"};
constexpr NumberRule kFNumberRule{[](double v) { return v > 0.0 && v <= 1e4; },
                                  "must be an f-number above 0"};
constexpr NumberRule kCoefficientRule{[](double v) { return std::abs(v) <= 1e3; },
                                      "must lie between -1000 and 1000"};
constexpr NumberRule kMatrixRule{[](double v) { return std::abs(v) <= 1e6; },
                                 "must lie between -1e6 and 1e6"};

constexpr auto kVisitScaleReading = [](auto& archive, auto& reading) {
  archive.Word("kind", reading.kind, kScaleReadingWords);
  archive.Text("frames", reading.frames);
  archive.Number("full_scale_constant", reading.full_scale_constant, kConstantRule);
  archive.Number("sigma_relative", reading.sigma_relative, kSigmaRule);
  archive.Number("f_number", reading.f_number, kFNumberRule);
  archive.Number("iso", reading.iso, kIsoRule);
  archive.WordUnlessFirst("lamp_class", reading.lamp_class, kLampClassWords);
  archive.Require({"kind", "full_scale_constant", "sigma_relative"});
};

constexpr auto kVisitScale = [](auto& archive, auto& scale) {
  archive.Number("full_scale_constant", scale.full_scale_constant, kConstantRule);
  archive.Number("sigma_relative", scale.sigma_relative, kSigmaRule);
  archive.List("readings", scale.readings, kVisitScaleReading);
  archive.Require({"full_scale_constant", "sigma_relative"});
};

constexpr auto kVisitColor = [](auto& archive, auto& color) {
  archive.Word("source", color.source, kColorMatrixWords);
  constexpr std::array<const char*, 3> kRows = {"X", "Y", "Z"};
  archive.Group("xyz_from_raw", [&](auto& rows) {
    for (std::size_t i = 0; i < 3; ++i) rows.Array(kRows[i], color.xyz_from_raw[i], kMatrixRule);
    rows.Require({"X", "Y", "Z"});
  });
  archive.Number("delta_e_mean", color.delta_e_mean, kNotNegative);
  archive.Number("delta_e_max", color.delta_e_max, kNotNegative);
  archive.Require({"source", "xyz_from_raw"});
};

constexpr auto kVisitNoise = [](auto& archive, auto& noise) {
  archive.Number("iso", noise.iso, kIsoRule);
  archive.Number("scale", noise.noise.scale, kVarianceRule);
  archive.Number("offset", noise.noise.offset, kVarianceRule);
  archive.Require({"iso", "scale", "offset"});
};

constexpr std::array<const char*, 3> kChannelWords = {"red", "green", "blue"};

constexpr auto kVisitFlat = [](auto& archive, auto& flat) {
  archive.Number("f_number", flat.f_number, kFNumberRule);
  archive.Number("focal_length_m", flat.focal_length, kPositive);
  archive.Array("center", flat.center, kSignalRule);
  for (std::size_t c = 0; c < 3; ++c) {
    archive.Array(kChannelWords[c], flat.channels[c], kCoefficientRule);
  }
  archive.Number("sigma_relative", flat.sigma_relative, kErrorFractionRule);
  archive.Require({"f_number", "red", "green", "blue", "sigma_relative"});
};

constexpr auto kVisitDark = [](auto& archive, auto& dark) {
  archive.Number("iso", dark.iso, kIsoRule);
  archive.Number("exposure_s", dark.exposure, kPositive);
  archive.Array("black", dark.black, kSignalRule);
  archive.Number("sigma", dark.sigma, kSignalSigmaRule);
  archive.Integers("hot_pixels", dark.hot_pixels);
  archive.Require({"iso", "exposure_s", "black", "sigma"});
};

constexpr auto kVisitNdFilter = [](auto& archive, auto& filter) {
  archive.Text("name", filter.name);
  archive.Array("attenuation", filter.attenuation, kAttenuationRule);
  archive.Number("sigma_relative", filter.sigma_relative, kErrorFractionRule);
  archive.Require({"name", "attenuation", "sigma_relative"});
};

constexpr auto kVisitSensitivities = [](auto& archive, auto& sensitivities) {
  archive.Text("camera", sensitivities.camera);
  archive.Number("first_nm", sensitivities.first_nm, kPositive);
  archive.Number("step_nm", sensitivities.step_nm, kPositive);
  for (std::size_t c = 0; c < 3; ++c) {
    archive.Numbers(kChannelWords[c], sensitivities.channels[c], kAnyNumber);
  }
  archive.Require({"first_nm", "step_nm", "red", "green", "blue"});
};

template <class Archive, class SomeProfile>
void VisitCameraProfile(Archive& archive, SomeProfile& profile) {
  archive.Text("camera", profile.camera);
  archive.Integer("width", profile.width);
  archive.Integer("height", profile.height);
  archive.Group("scale", [&](auto& scale) { kVisitScale(scale, profile.scale); });
  archive.Object("color", profile.color, kVisitColor);
  archive.List("noise", profile.noise, kVisitNoise);
  archive.List("flats", profile.flats, kVisitFlat);
  archive.List("darks", profile.darks, kVisitDark);
  archive.List("nd_filters", profile.nd_filters, kVisitNdFilter);
  archive.Object("sensitivities", profile.sensitivities, kVisitSensitivities);
  VisitProvenance(archive, profile.provenance);
  archive.Require({"width", "height", "scale"});
}

// What single values do not show.
void CheckProfile(FieldReader& reader, const CameraProfile& profile) {
  if (reader.Failed()) return;
  if (profile.width < 1 || profile.height < 1 || profile.width > kMostPixels ||
      profile.height > kMostPixels) {
    reader.Fail("width", "width and height must be those of a picture, in pixels");
  }
  if (profile.sensitivities) {
    const std::string fault = FaultOf(*profile.sensitivities);
    if (!fault.empty()) reader.Fail("sensitivities", "sensitivities " + fault);
  }
  for (const CameraDark& dark : profile.darks) {
    bool inside = dark.hot_pixels.size() % 2 == 0;
    for (std::size_t i = 0; i + 1 < dark.hot_pixels.size(); i += 2) {
      const int x = dark.hot_pixels[i], y = dark.hot_pixels[i + 1];
      inside = inside && x >= 0 && x < profile.width && y >= 0 && y < profile.height;
    }
    if (!inside) reader.Fail("darks", "hot_pixels must be x, y, x, y, ... inside the picture");
  }
  for (const CameraNdFilter& filter : profile.nd_filters) {
    if (std::ranges::count(profile.nd_filters, filter.name, &CameraNdFilter::name) > 1) {
      reader.Fail("nd_filters", "two filters are named " + Quoted(filter.name));
    }
  }
}

}  // namespace
}  // namespace records

records::Node DocumentOf(const CameraProfile& profile) {
  records::FieldWriter writer;
  writer.Put("schema", kCameraSchema);
  records::VisitCameraProfile(writer, profile);
  return writer.TakeTable();
}

Result<std::string> CameraProfileToJson(const CameraProfile& profile) {
  return records::FiniteJson(DocumentOf(profile));
}

Result<CameraProfile> CameraProfileFromJson(std::string_view text, std::string_view where) {
  const auto node = records::ParseJson(text);
  if (!node) return Refused("bad_camera", std::string(where), node.error().message);
  if (node->kind != records::Node::Kind::kTable) {
    return Refused("bad_camera", std::string(where), "a camera.json must be one JSON object");
  }
  records::ReadingOfFile reading{std::string(where), "bad_camera", records::PlaceStyle::kJson,
                                 std::nullopt};
  records::FieldReader reader(*node, "", reading);
  CameraProfile profile;
  reader.RequireSchema(kCameraSchema, "camera.json",
                       "make the profile again with {CalibrateCamera}");
  records::VisitCameraProfile(reader, profile);
  reader.Ignore("warnings");  // an answer may add them to the same document
  reader.Finish();
  records::CheckProfile(reader, profile);
  if (reading.error) return tl::unexpected(*std::move(reading.error));
  return profile;
}

Result<CameraFile> CameraFileFromJson(std::string_view text, std::string_view where) {
  const auto node = records::ParseJson(text);
  CameraFile file;
  if (node && node->Find("schema") != nullptr) {
    auto profile = CameraProfileFromJson(text, where);
    if (!profile) return Propagate(std::move(profile));
    file.sensitivities = profile->sensitivities;
    file.profile = std::move(*profile);
    return file;
  }
  auto sensitivities = CameraSensitivitiesFromJson(text, where);
  if (!sensitivities) {
    Error error = std::move(sensitivities).error();
    error.message += ". A profile written by {CalibrateCamera} is the other kind of file";
    return tl::unexpected(std::move(error));
  }
  file.sensitivities = std::move(*sensitivities);
  return file;
}

}  // namespace lightcal
