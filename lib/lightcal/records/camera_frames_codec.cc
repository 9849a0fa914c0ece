// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/camera_frames_codec.h"

#include <array>
#include <string>

#include "lightcal/records/capture_codec.h"

namespace lightcal::records {
namespace {

// Keys that mean something for some uses only.
struct KeyOfUse {
  std::string_view key;
  CameraFramesUse use;
};
constexpr std::array kKeysOfUses = {
    KeyOfUse{"luminance_nits", CameraFramesUse::kScale},
    KeyOfUse{"illuminance_lx", CameraFramesUse::kScale},
    KeyOfUse{"reflectance", CameraFramesUse::kScale},
    KeyOfUse{"reflectance_sigma_relative", CameraFramesUse::kScale},
    KeyOfUse{"projection", CameraFramesUse::kScale},
    KeyOfUse{"fov_deg", CameraFramesUse::kScale},
    KeyOfUse{"sigma_relative", CameraFramesUse::kScale},
    KeyOfUse{"meter", CameraFramesUse::kScale},
    KeyOfUse{"lamp_class", CameraFramesUse::kScale},
    KeyOfUse{"spectrum", CameraFramesUse::kScale},
    KeyOfUse{"name", CameraFramesUse::kNd},
    KeyOfUse{"without", CameraFramesUse::kNd},
    KeyOfUse{"chart", CameraFramesUse::kChart},
};

void RefuseStrangers(FieldReader& reader, CameraFramesUse use) {
  for (const KeyOfUse& one : kKeysOfUses) {
    if (one.use == use || !reader.Has(one.key)) continue;
    reader.Fail(one.key, std::string(one.key) + " belongs to use = " +
                             Quoted(kCameraFramesUseWords[static_cast<std::size_t>(one.use)]) +
                             ", this is use = " +
                             Quoted(kCameraFramesUseWords[static_cast<std::size_t>(use)]));
  }
}

void CheckScale(FieldReader& reader, const CameraFramesDescription& frames) {
  if (frames.luminance.has_value() == frames.illuminance.has_value()) {
    reader.Fail("use",
                "use = \"scale\" needs what a meter read: luminance_nits of rect, or "
                "illuminance_lx with reflectance (a card) or projection (the whole picture)");
  } else if (frames.illuminance && !frames.reflectance && frames.projection.empty()) {
    reader.Fail("reflectance_missing", "illuminance_lx",
                "a lux reading says how bright the picture is only with the reflectance of the "
                "card in rect, or with the projection of a picture taken from the meter's place");
  } else if (frames.luminance && (frames.reflectance || !frames.projection.empty())) {
    reader.Fail("luminance_nits",
                "luminance_nits is the brightness itself; leave reflectance and projection out");
  } else if (frames.reflectance && !frames.projection.empty()) {
    reader.Fail("projection",
                "a lux reading belongs to a card (reflectance) or to the whole picture "
                "(projection), not to both");
  } else if (!frames.projection.empty() && frames.projection != "latlong" &&
             !frames.field_of_view_deg) {
    reader.Fail("fov_deg", "projection = " + Quoted(frames.projection) +
                               " needs fov_deg, the full angle it shows");
  } else if (!frames.projection.empty() && frames.rect) {
    reader.Fail("rect", "a lux reading at the camera belongs to the whole picture; leave rect out");
  }
}

void CheckUse(FieldReader& reader, const CameraFramesDescription& frames) {
  if (frames.use == CameraFramesUse::kScale) CheckScale(reader, frames);
  if (frames.use == CameraFramesUse::kNd && (frames.name.empty() || frames.without.empty())) {
    reader.Fail("use",
                "use = \"nd\" needs name = the filter's, frames = through it, without = the same "
                "scene without it");
  }
  if (frames.use == CameraFramesUse::kChart && frames.chart.empty()) {
    reader.Fail("use", "use = \"chart\" needs chart = a file of the patches and their corners");
  }
}

}  // namespace

void ReadCameraFrames(FieldReader& reader, CameraFramesDescription& frames) {
  reader.Word("use", frames.use, kCameraFramesUseWords);
  reader.Text("frames", frames.frames);
  ReadRect(reader, frames.rect);
  reader.Numbers("exposure_s", frames.exposure_s, kPositive);
  reader.Number("f_number", frames.f_number, kPositive);
  reader.Number("iso", frames.iso, kPositive);
  reader.Number("luminance_nits", frames.luminance, kPositive);
  reader.Number("illuminance_lx", frames.illuminance, kPositive);
  reader.Number("reflectance", frames.reflectance, kCardRule);
  reader.Number("reflectance_sigma_relative", frames.reflectance_sigma, kSigmaRule);
  std::size_t projection = kProjectionWords.size();
  reader.Word("projection", projection, kProjectionWords);
  if (projection < kProjectionWords.size()) frames.projection = kProjectionWords[projection];
  reader.Number("fov_deg", frames.field_of_view_deg, kFullAngleRule);
  reader.Number("sigma_relative", frames.sigma_relative, kSigmaRule);
  reader.Text("meter", frames.meter);
  reader.Word("lamp_class", frames.lamp_class, kLampClassWords);
  reader.Text("spectrum", frames.spectrum_file);
  reader.Text("name", frames.name);
  reader.Text("without", frames.without);
  reader.Text("chart", frames.chart);
  reader.Require({"use", "frames"});
  reader.Finish();
  if (reader.Failed()) return;
  RefuseStrangers(reader, frames.use);
  if (reader.Has("meter") && reader.Has("sigma_relative")) {
    reader.Fail("meter", "meter and sigma_relative say the same; keep one");
  }
  if (!reader.Failed()) CheckUse(reader, frames);
}

}  // namespace lightcal::records
