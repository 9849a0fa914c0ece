// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/captures/source_capture.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "lightcal/calibrate/captures/lamp_luminance.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/imaging/scene/source_luminance.h"

namespace lightcal {
namespace {

constexpr double kFieldOfViewSd = 0.005;  // relative: twice that of a solid angle
constexpr double kSizeDiffers = 0.1;      // relative

// Mean colour of the luminous face.
Xyz ColorOfFace(const MergedBracket& merged, const SourceLuminance& source, const Region& region) {
  Rgb sum;
  double count = 0.0;
  for (std::size_t i = 0; i < source.face.size(); ++i) {
    if (source.face[i] == 0) continue;
    const int x = region.x + static_cast<int>(i) % region.width;
    const int y = region.y + static_cast<int>(i) / region.width;
    const Rgb rgb = RgbAt(merged, static_cast<std::size_t>(y) * merged.width + x);
    sum = {sum.r + rgb.r, sum.g + rgb.g, sum.b + rgb.b};
    count += 1.0;
  }
  return XyzFromLinearRgb({sum.r / count, sum.g / count, sum.b / count}, RgbSpace::kSrgb);
}

FaceShape ShapeOf(const LightDescription* light) {
  const bool sides = light && (light->kind == LightKind::kRect || light->kind == LightKind::kTube);
  return sides ? FaceShape::kRectangular : FaceShape::kRound;
}

std::string WhyUnresolved(const SourceLuminance& source) {
  return "the lamp is " + RoundedText(source.pixels_across, 2) +
         " pixels across in its picture, the lens's blur in it, which is too few to tell its size "
         "and luminance from the blur; ";
}

// Takes what was measured where nothing was said.
void Settle(double measured_m, const char* what, const CaptureDescription& capture,
            std::optional<Metres>& stated, Warnings& warnings) {
  if (!stated) {
    stated = Metres(measured_m);
    return;
  }
  if (std::abs(measured_m / stated->value() - 1.0) <= kSizeDiffers) return;
  warnings.push_back({"source_size_differs", capture.where,
                      std::string("the luminous face's ") + what + " is " +
                          RoundedText(measured_m, 3) + " m in the picture, " +
                          RoundedText(stated->value(), 3) +
                          " m in the session, which is believed; check distance_m and fov_deg"});
}

// The light as large as its picture shows it, where the session does not say.
LightDescription Sized(const SourceLuminance& source, const CaptureDescription& capture,
                       LightDescription light, Warnings& warnings) {
  const double d = capture.distance->value();
  const double radius = std::sqrt(source.area / std::numbers::pi);  // at distance 1
  const double longer = std::max(source.width, source.height) * d;
  const auto settle = [&](double measured_m, const char* what, std::optional<Metres>& stated) {
    if (!stated) light.face_sd = source.area_sd_relative;
    Settle(measured_m, what, capture, stated, warnings);
  };
  switch (light.kind) {
    case LightKind::kDisk:
      settle(2.0 * radius * d, "diameter", light.diameter);
      return light;
    case LightKind::kSphere: {
      // The distance counts from its surface: R = (d + R) sin a.
      const double sine = std::sin(std::atan(radius));
      settle(2.0 * d * sine / (1.0 - sine), "diameter", light.diameter);
      return light;
    }
    case LightKind::kRect:
      settle(source.width * d, "width", light.width);
      settle(source.height * d, "height", light.height);
      return light;
    case LightKind::kTube:
      settle(longer, "length", light.length);
      settle(0.5 * std::min(source.width, source.height) * d, "radius", light.radius);
      return light;
    default:
      return light;
  }
}

// The same by a picture that may not resolve it: of a tube its length, where that alone is seen.
void AddSize(const SourceLuminance& source, const CaptureDescription& capture,
             const LightDescription& light, Warnings& warnings, CaptureReading& out) {
  constexpr double kLongTube = 16.0;  // pixels
  if (source.resolved) {
    out.sized = Sized(source, capture, light, warnings);
    return;
  }
  if (light.kind == LightKind::kTube && source.pixels_long >= kLongTube) {
    out.sized = light;
    Settle(std::max(source.width, source.height) * capture.distance->value(), "length", capture,
           out.sized->length, warnings);
    return;
  }
  if (LacksSize(light)) {
    const Error error =
        Refused("source_unresolved", capture.frames,
                WhyUnresolved(source) +
                    "state its size, or photograph it from nearer or by a longer lens so that it "
                    "is ten pixels across")
            .value();
    out.unsized = AtCapture(capture, error).value();
  } else if (light.kind == LightKind::kSphere && !light.diameter) {
    warnings.push_back({"source_unresolved", capture.where,
                        WhyUnresolved(source) +
                            "its intensity holds; for its luminance state its diameter_m, or "
                            "photograph it from nearer"});
  }
}

// What of the field of view is left in a picture made smaller, which ends with a whole block.
Radians FieldOfViewLeft(const CaptureDescription& capture, Projection projection,
                        const FrameInfo& info, const Thinning& thinning) {
  const double full = capture.field_of_view.value_or(Radians(0.0)).value();
  const auto share = [&](int thinned, int whole) {
    return static_cast<double>(thinned) * thinning.n / whole;
  };
  const double circle =
      share(std::min(thinning.width, thinning.height), std::min(info.width, info.height));
  switch (projection) {
    case Projection::kRectilinear:
      return Radians(2.0 * std::atan(share(thinning.width, info.width) * std::tan(0.5 * full)));
    case Projection::kEquidistant:
      return Radians(circle * full);
    case Projection::kEquisolid:
      return Radians(4.0 * std::asin(circle * std::sin(0.25 * full)));
    case Projection::kLatLong:
      break;
  }
  return Radians(full);
}

Result<SourceLuminance> MeasureIn(const MergedBracket& merged, const CaptureDescription& capture,
                                  const FrameInfo& info, const Region& region, FaceShape shape) {
  const Projection projection = capture.projection.value_or(Projection::kRectilinear);
  const Thinning thinning = ThinningOf(info, capture.work);
  const auto angles = PixelSolidAngles::Create(
      {projection, merged.width, merged.height,
       thinning.n == 1 ? capture.field_of_view.value_or(Radians(0.0))
                       : FieldOfViewLeft(capture, projection, info, thinning)});
  if (!angles) return tl::unexpected(angles.error());
  const std::vector<float> nits = LuminanceOf(merged, 1.0);
  return MeasureSource({nits.data(), merged.width, merged.height},
                       {merged.sigma.data(), merged.width, merged.height}, *angles, region, shape);
}

}  // namespace

Result<CaptureReading> ReadSource(const Session& session, const CaptureDescription& capture,
                                  const Sources& sources, Evidence& evidence) {
  const auto bracket = OpenCapture(session, capture, sources);
  if (!bracket) return tl::unexpected(bracket.error());
  const FrameInfo& info = bracket->frames.front();
  const auto stated = RegionOfCapture(capture, info, {0, 0, info.width, info.height});
  if (!stated) return tl::unexpected(stated.error());
  const Region region = ThinRegion(*stated, ThinningOf(info, capture.work));
  const auto picture = MergeCapture(session, capture, *bracket, std::nullopt, sources);
  if (!picture) return tl::unexpected(picture.error());
  const MergedBracket& merged = picture->merged;
  for (const Warning& warning : merged.warnings) {
    // A clipped lamp is refused or named; what else is clipped here does not count.
    if (warning.code != "clipped") evidence.warnings.push_back(warning);
  }
  const LightDescription* const light = FindLight(session, capture.light);
  const auto source = MeasureIn(merged, capture, info, region, ShapeOf(light));
  const bool anchored = capture.anchor_illuminance.has_value();
  if (!source && anchored && source.error().code == "source_clipped") {
    evidence.warnings.push_back(
        {"source_clipped", capture.where,
         "the lamp is saturated in every frame: its intensity is what the meter read; its "
         "luminance, size and colour this picture does not tell; expose shorter, stop down or use "
         "an ND filter, or state its size"});
    AddCapture(session, capture, merged, evidence);
    return ReadingOfPicture(session, capture, *picture, {},
                            {.illuminance = *capture.anchor_illuminance, .of_luminance = true});
  }
  if (!source) return tl::unexpected(AtPlace(source.error(), *bracket, merged.warnings));
  const Xyz seen = ColorOfFace(merged, *source, region);
  const auto lamp = LuminanceOfLamp(session, capture, *picture, seen, sources);
  if (!lamp) return tl::unexpected(lamp.error());
  AddCapture(session, capture, merged, evidence);
  evidence.pictures.push_back(RecordedOf(capture, merged, lamp->nits / seen.Y));
  CaptureReading out = ReadingOfPicture(
      session, capture, *picture, *lamp,
      {.illuminance = source->illuminance * (lamp->nits / seen.Y),
       .independent_sd = anchored ? 0.0 : kInterpolatedNoise * source->noise_sd_relative,
       .method_sd = 2.0 * kFieldOfViewSd,
       .patch_unit = source->luminance.value(),
       .off_middle_rad = std::acos(std::clamp(source->direction[1], -1.0, 1.0)),
       .of_luminance = true});
  if (light) AddSize(*source, capture, *light, evidence.warnings, out);
  return out;
}

bool LacksSize(const LightDescription& light) {
  return (light.kind == LightKind::kRect && !(light.width && light.height)) ||
         (light.kind == LightKind::kDisk && !light.diameter) ||
         (light.kind == LightKind::kTube && !light.length);
}

}  // namespace lightcal
