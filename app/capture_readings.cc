// SPDX-License-Identifier: Apache-2.0
#include "capture_readings.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bracket_merge.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/imaging/patches.h"
#include "lightcal/imaging/sensor_to_xyz.h"
#include "lightcal/imaging/spectral_mismatch.h"
#include "lightcal/records/camera_sensitivities.h"
#include "lightcal_devices/captures/bracket.h"
#include "lightcal_devices/files/import_file.h"
#include "output_files.h"

namespace lightcal::app {
namespace {

namespace fs = std::filesystem;

constexpr double kLargestUnevenness = 0.1;  // sd of the card's pixels beyond their noise, relative
constexpr double kLostSigma = 0.9;          // a pixel's sigma / value where it says nothing
constexpr double kLargestLost = 0.01;       // share of such pixels
constexpr double kGreenOnlySigma = 0.15;    // luminance by green pixels, of lamps of any colour
constexpr double kMosaicNoise = 2.0;        // interpolated neighbours share their noise
constexpr const char* kDevicePrefix = "camera:";

// What the picture of one card says.
struct CardReading {
  Reading reading;
  std::string camera;  // "" = unknown
  bool anchored = false;
  double independent_sd = 0.0;  // relative
  double shared_sd = 0.0;       // relative: with other captures by this camera
};

// Mean colour of the card in cd/m^2 and how well it is known.
struct CardPatch {
  Xyz color;              // as ColorOfPicture has it
  double noise_sd = 0.0;  // of the mean luminance, relative
  double uneven_sd = 0.0;
};

std::string PathInSession(const Session& session, const std::string& name) {
  return (fs::path(session.directory) / name).string();
}

tl::unexpected<Error> At(const CaptureDescription& capture, Error error) {
  if (error.code == "no_exposure_metadata") {
    error.message =
        "the frames do not say their exposure; give exposure_s = [..], f_number and iso in the "
        "[[capture]], or anchor_illuminance_lx (" +
        error.message + ")";
  }
  error.subject = capture.where + " (" + error.subject + ")";
  return tl::unexpected(std::move(error));
}

Region CardRegion(const CaptureDescription& capture, const FrameInfo& info) {
  if (capture.rect) {
    const auto& r = *capture.rect;
    return {r[0], r[1], r[2], r[3]};
  }
  return {info.width / 3, info.height / 3, info.width / 3, info.height / 3};
}

BracketMergeRequest RequestOf(const Session& session, const CaptureDescription& capture,
                              const Region& card, bool has_colour) {
  BracketMergeRequest request;
  request.files = {PathInSession(session, capture.frames)};
  for (const double time : capture.exposure_s) request.overrides.exposure.emplace_back(time);
  request.overrides.f_number = capture.f_number;
  request.overrides.iso = capture.iso;
  if (has_colour) request.space = RgbSpace::kSrgb;
  request.want_sigma = true;
  if (capture.anchor_illuminance) {
    const double nits =
        capture.anchor_illuminance->value() * capture.reflectance / std::numbers::pi;
    request.anchor = SpotReading{card.x, card.y, card.width, card.height, Nits(nits)};
  }
  return request;
}

Result<CardPatch> MeasureCard(const MergedBracket& merged, const Region& card) {
  double sum[3] = {}, luminance = 0.0, luminance2 = 0.0, variance = 0.0;
  int lost = 0;
  for (int y = card.y; y < card.y + card.height; ++y) {
    for (int x = card.x; x < card.x + card.width; ++x) {
      const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(merged.width) +
                     static_cast<std::size_t>(x);
      const float* pixel = &merged.picture[i * static_cast<std::size_t>(merged.channels)];
      Rgb rgb{pixel[0], pixel[0], pixel[0]};
      if (merged.channels == 3) rgb = {pixel[0], pixel[1], pixel[2]};
      sum[0] += rgb.r;
      sum[1] += rgb.g;
      sum[2] += rgb.b;
      const double value = LuminanceOfRgb(rgb, RgbSpace::kSrgb);
      const double sigma = double{merged.sigma[i]};
      luminance += value;
      luminance2 += value * value;
      variance += sigma * sigma;
      if (!(sigma < kLostSigma * value)) ++lost;
    }
  }
  const double count = static_cast<double>(card.width) * card.height;
  if (!(luminance > 0.0) || lost > kLargestLost * count) {
    return Refused("card_unreadable", "rect",
                   "the card is saturated in every frame or lost in the noise; expose shorter or "
                   "longer, or give its place with rect = [x, y, width, height]");
  }
  const double mean = luminance / count;
  const double scatter2 = std::max(0.0, luminance2 / count - mean * mean);
  CardPatch patch;
  patch.color = XyzFromLinearRgb({sum[0] / count, sum[1] / count, sum[2] / count}, RgbSpace::kSrgb);
  patch.noise_sd = kMosaicNoise * std::sqrt(variance) / luminance;
  patch.uneven_sd = std::sqrt(std::max(0.0, scatter2 - variance / count)) / mean;
  if (patch.uneven_sd > kLargestUnevenness) {
    return Refused("card_uneven", "rect",
                   "what should be the card varies by " + RoundedText(100.0 * patch.uneven_sd, 2) +
                       " %; give its place with rect = [x, y, width, height], inside its edges");
  }
  return patch;
}

Xyz Apply(const Matrix3& m, const Xyz& v) {
  const auto row = [&](std::size_t i) { return m[i][0] * v.X + m[i][1] * v.Y + m[i][2] * v.Z; };
  return {row(0), row(1), row(2)};
}

// The raw channels that ColorOfPicture made this colour of: Cramer's rule.
Xyz RawOf(const Matrix3& xyz_from_raw, const Xyz& color) {
  const auto determinant = [](const Matrix3& m) {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  };
  const auto with = [&](std::size_t column) {
    Matrix3 m = xyz_from_raw;
    m[0][column] = color.X;
    m[1][column] = color.Y;
    m[2][column] = color.Z;
    return determinant(m) / determinant(xyz_from_raw);
  };
  return {with(0), with(1), with(2)};
}

struct CorrectedColor {
  double luminance = 0.0;
  double sigma = 0.0;  // of the correction, relative
  std::optional<Xy> xy;
};

Result<MismatchFactor> FactorOf(const Session& session, const CaptureDescription& capture,
                                const SpectralCamera& camera) {
  if (capture.spectrum_file.empty()) return camera.FactorFor(capture.lamp_class);
  auto imported = ImportFile(PathInSession(session, capture.spectrum_file));
  if (!imported) return Propagate(std::move(imported));
  if (imported->spectra.size() != 1) {
    return Refused("not_one_spectrum", capture.spectrum_file, "holds several spectra or none");
  }
  return camera.FactorFor(imported->spectra.front().spectrum);
}

Result<SpectralCamera> ReadCamera(const Session& session, const CaptureDescription& capture) {
  const auto text = ReadWholeFile(PathInSession(session, capture.camera));
  if (!text) return tl::unexpected(text.error());
  const auto sensitivities = CameraSensitivitiesFromJson(*text, capture.camera);
  if (!sensitivities) return tl::unexpected(sensitivities.error());
  return SpectralCamera::Make(*sensitivities);
}

CorrectedColor Corrected(const MismatchFactor& factor, const Xyz& by_luminance, Xy xy) {
  return {by_luminance.Y * factor.At(MiredsOfLamp(xy)), factor.sigma, xy};
}

// Luminance with the scale that ISO speeds have (daylight), corrected for the lamp.
Result<CorrectedColor> CorrectColor(const Session& session, const CaptureDescription& capture,
                                    const FrameInfo& info, const PictureColor& color,
                                    const Xyz& seen) {
  const bool raw = info.meaning == SampleMeaning::kMosaic || info.meaning == SampleMeaning::kSensor;
  if (!capture.camera.empty()) {
    if (!raw || info.channels == 2 || !color.has_colour) {
      return Refused("camera_needs_raw", capture.frames,
                     "spectral sensitivities speak of raw channels; leave camera out for pictures "
                     "that were rendered");
    }
    const auto camera = ReadCamera(session, capture);
    if (!camera) return tl::unexpected(camera.error());
    const auto factor = FactorOf(session, capture, *camera);
    if (!factor) return tl::unexpected(factor.error());
    const Xyz own = Apply(camera->xyz_from_raw(), RawOf(color.xyz_from_rgb, seen));
    return Corrected(*factor, own, XyFromXyz(own));
  }
  if (!color.has_colour) return CorrectedColor{seen.Y, kGreenOnlySigma, std::nullopt};
  const MismatchFactor generic = GenericMismatch(capture.lamp_class);
  if (raw && info.matrices) {
    const auto daylight = DaylightXyzFromRaw(*info.matrices);
    if (!daylight) return tl::unexpected(daylight.error());
    return Corrected(generic, Apply(*daylight, RawOf(color.xyz_from_rgb, seen)), XyFromXyz(seen));
  }
  // A rendered picture: nobody knows by which matrix, so the mean stays an error.
  const double off = generic.At(MiredsOfLamp(XyFromXyz(seen))) - 1.0;
  return CorrectedColor{seen.Y, std::hypot(generic.sigma, off), XyFromXyz(seen)};
}

double AnchorSigma(const Session& session, const CaptureDescription& capture) {
  Reading anchor;
  anchor.meter = capture.meter;
  return SigmaRelative(session, anchor);
}

void AddUnique(const std::string& file, std::vector<std::string>& files) {
  if (std::ranges::find(files, file) == files.end()) files.push_back(file);
}

void NoteFiles(const CaptureDescription& capture, const MergedBracket& merged, Session& session) {
  for (const MergedFrame& frame : merged.frames) AddUnique(frame.info.file, session.input_files);
  for (const std::string& name : {capture.camera, capture.spectrum_file}) {
    if (!name.empty()) AddUnique(PathInSession(session, name), session.input_files);
  }
}

void WarnOfScale(const CaptureDescription& capture, const MergedBracket& merged,
                 Warnings& warnings) {
  if (capture.anchor_illuminance) return;
  warnings.push_back(
      {"scale_prior", capture.where,
       "its absolute scale is what the ISO speed promises, +-" +
           RoundedText(100.0 * merged.scale_u95_relative, 2) +
           " %; one lux reading of this light, or anchor_illuminance_lx, makes it sure"});
}

Result<CardReading> ReadCard(Session& session, const CaptureDescription& capture,
                             Warnings& warnings) {
  const std::string pattern = PathInSession(session, capture.frames);
  BracketOverrides overrides;
  for (const double time : capture.exposure_s) overrides.exposure.emplace_back(time);
  const auto bracket = OpenBracket(std::vector<std::string>{pattern}, overrides);
  if (!bracket) return At(capture, bracket.error());
  const FrameInfo& info = bracket->frames.front();
  const auto color = ColorOfPicture(info);
  if (!color) return At(capture, color.error());
  const Region card = CardRegion(capture, info);
  if (auto inside = CheckRegion(card, info.width, info.height); !inside) {
    return At(capture, inside.error());
  }
  const auto merged = MergeBracketFiles(RequestOf(session, capture, card, color->has_colour));
  if (!merged) return At(capture, merged.error());
  warnings.insert(warnings.end(), merged->warnings.begin(), merged->warnings.end());
  const auto patch = MeasureCard(*merged, card);
  if (!patch) return At(capture, patch.error());
  const auto corrected = CorrectColor(session, capture, info, *color, patch->color);
  if (!corrected) return At(capture, corrected.error());
  NoteFiles(capture, *merged, session);
  WarnOfScale(capture, *merged, warnings);

  CardReading out;
  out.camera = info.camera;
  out.anchored = capture.anchor_illuminance.has_value();
  out.independent_sd = std::hypot(patch->noise_sd, patch->uneven_sd);
  out.shared_sd = out.anchored ? AnchorSigma(session, capture)
                               : std::hypot(merged->scale_u95_relative / kZ95, corrected->sigma,
                                            capture.reflectance_sigma);
  Reading& reading = out.reading;
  reading.light = capture.light;
  reading.distance = capture.distance;
  reading.tilt = capture.tilt;
  reading.illuminance = out.anchored
                            ? *capture.anchor_illuminance
                            : Lux(std::numbers::pi * corrected->luminance / capture.reflectance);
  reading.xy = corrected->xy;
  reading.color_source = corrected->xy ? ColorSource::kCamera : ColorSource::kUnknown;
  if (corrected->xy) reading.sigma_mired = GenericColorSigma(capture.lamp_class);
  reading.quality = MeterQuality::kDerived;
  reading.device = kDevicePrefix + (info.camera.empty() ? info.format : info.camera);
  reading.time = info.time;
  return out;
}

}  // namespace

Result<void> AddCaptureReadings(Session& session, Warnings& warnings) {
  std::vector<CardReading> cards;
  std::map<std::pair<std::string, std::string>, int> sharing;  // captures by light and camera
  for (const CaptureDescription& capture : session.captures) {
    auto card = ReadCard(session, capture, warnings);
    if (!card) return Propagate(std::move(card));
    if (!card->anchored) ++sharing[{capture.light, card->camera}];
    cards.push_back(std::move(*card));
  }
  for (std::size_t i = 0; i < cards.size(); ++i) {
    CardReading& card = cards[i];
    const int others = card.anchored ? 1 : sharing[{card.reading.light, card.camera}];
    card.reading.sigma_relative =
        std::min(0.99, std::hypot(card.independent_sd, std::sqrt(others) * card.shared_sd));
    session.readings.push_back({std::move(card.reading), session.captures[i].where});
  }
  return {};
}

bool RestsOnCameraScale(const Session& session, const std::string& light) {
  bool any = false;
  for (const SessionReading& row : session.readings) {
    if (row.reading.light != light || !row.reading.illuminance) continue;
    if (!row.reading.device.starts_with(kDevicePrefix)) return false;
    any = true;
  }
  for (const CaptureDescription& capture : session.captures) {
    if (capture.light == light && capture.anchor_illuminance) return false;
  }
  return any;
}

}  // namespace lightcal::app
