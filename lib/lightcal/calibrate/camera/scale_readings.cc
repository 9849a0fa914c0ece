// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/camera/scale_readings.h"

#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "lightcal/calibrate/session_files.h"
#include "lightcal/core/matrix3.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/imaging/camera/raw_patch.h"
#include "lightcal/imaging/panorama/panorama.h"

namespace lightcal {
namespace {

constexpr double kLargestUnevenness = 0.1;
constexpr double kMisplaced = 1.0 / 3.0;

// XYZ of raw signals; green alone where the camera's colours are not known.
Xyz ColorOf(const CameraProfile& profile, const std::array<double, 3>& raw) {
  if (!profile.color) return {raw[1], raw[1], raw[1]};
  const Column3 xyz = Times(profile.color->xyz_from_raw, raw);
  return {xyz[0], xyz[1], xyz[2]};
}

struct Seen {
  Xyz color;  // per unit of what was read: y is luminance or illuminance where k = 1
  double sd = 0.0;
};

Result<Seen> SeePatch(const CameraFramesDescription& what, const CameraProfile& profile,
                      const MergedBracket& merged) {
  const auto patch = MeasureRawPatch(merged, RegionOf(what, merged), what.frames);
  if (!patch) return tl::unexpected(patch.error());
  if (patch->uneven_sd > kLargestUnevenness) {
    return Refused("patch_uneven", what.frames,
                   "what the meter read varies by " + RoundedText(100.0 * patch->uneven_sd, 2) +
                       " % in the picture; give its place with rect = [x, y, width, height]");
  }
  return Seen{ColorOf(profile, patch->rgb),
              std::hypot(patch->noise_sd, kMisplaced * patch->uneven_sd)};
}

// Illuminance of the plane at the camera that faces the picture's axis.
Result<Seen> SeePicture(const CameraFramesDescription& what, const CameraProfile& profile,
                        const MergedBracket& merged) {
  if (merged.clipped_fraction > 0.0) {
    return Refused("picture_clipped", what.frames,
                   "a part of it is saturated in every frame, and a lux meter saw that too; "
                   "expose shorter, or take the lamp out of the picture");
  }
  const auto projection = ProjectionByName(what.projection);
  const auto angles = PixelSolidAngles::Create(
      {.projection = projection.value_or(Projection::kRectilinear),
       .width = merged.width,
       .height = merged.height,
       .field_of_view = RadiansFromDegrees(what.field_of_view_deg.value_or(360.0))});
  if (!angles) return tl::unexpected(angles.error());
  const auto pixels =
      static_cast<std::size_t>(merged.width) * static_cast<std::size_t>(merged.height);
  std::vector<float> plane(pixels);
  std::array<double, 3> raw{};
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < pixels; ++i) plane[i] = merged.picture[3 * i + c];
    const auto measured =
        MeasureIlluminance(View2d<const float>(plane.data(), merged.width, merged.height), *angles,
                           {0, 0, merged.width, merged.height});
    if (!measured) return tl::unexpected(measured.error());
    raw[c] = measured->illuminance.value();
  }
  return Seen{ColorOf(profile, raw), 0.0};
}

Result<MismatchFactor> LampFactorOf(Session& session, const Sources& sources,
                                    const CameraFramesDescription& what,
                                    const CameraProfile& profile) {
  if (what.spectrum_file.empty()) return CameraMismatch(profile, what.lamp_class);
  const std::string path = PathInSession(session, what.spectrum_file);
  NoteInputFile(path, session);
  const auto one = ReadTheOneSpectrum(sources, path, what.spectrum_file);
  if (!one) return tl::unexpected(one.error());
  return CameraMismatch(profile, one->imported.spectrum, what.spectrum_file);
}

}  // namespace

Region RegionOf(const CameraFramesDescription& what, const MergedBracket& merged) {
  if (!what.rect) return MiddleOf(merged.width, merged.height);
  const auto& r = *what.rect;
  return {r[0], r[1], r[2], r[3]};
}

Result<WeighedScaleReading> ReadScale(Session& session, const Sources& sources,
                                      const CameraFramesDescription& what, const FrameInfo& info,
                                      const CameraProfile& profile, const MergedBracket& merged) {
  const bool picture = !what.projection.empty();
  const auto seen = picture ? SeePicture(what, profile, merged) : SeePatch(what, profile, merged);
  if (!seen) return tl::unexpected(seen.error());
  const auto factor = LampFactorOf(session, sources, what, profile);
  if (!factor) return tl::unexpected(factor.error());
  double true_value = 0.0, card_sd = 0.0;
  WeighedScaleReading out;
  out.reading.kind = ScaleReadingKind::kSpot;
  if (what.luminance) {
    true_value = what.luminance->value();
  } else if (picture) {
    out.reading.kind = ScaleReadingKind::kPicture;
    true_value = what.illuminance->value();
  } else {
    out.reading.kind = ScaleReadingKind::kCard;
    true_value = what.illuminance->value() * what.reflectance.value_or(1.0) / std::numbers::pi;
    card_sd = what.reflectance_sigma;
  }
  const double corrected = profile.color
                               ? seen->color.Y * factor->At(MiredsOfLamp(XyFromXyz(seen->color)))
                               : seen->color.Y;
  if (!(corrected > 0.0)) {
    return Refused("patch_unreadable", what.frames, "the camera sees no luminance there");
  }
  out.reading.frames = what.frames;
  out.reading.full_scale_constant = true_value / corrected;
  out.reading.f_number = info.exposure.f_number;
  out.reading.iso = info.exposure.iso;
  out.reading.lamp_class = what.lamp_class;
  out.meter = what.meter;
  out.meter_sd = what.sigma_relative;
  out.own_sd =
      std::hypot(std::hypot(seen->sd, merged.gauge_sd), std::hypot(card_sd, factor->sigma));
  return out;
}

}  // namespace lightcal
