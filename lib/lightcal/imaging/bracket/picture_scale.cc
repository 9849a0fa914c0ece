// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/picture_scale.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "lightcal/core/numbers_text.h"
#include "lightcal/imaging/camera/sensor_to_xyz.h"
#include "lightcal/photometry/exposure.h"
#include "lightcal/photometry/exposure_grid.h"

namespace lightcal {
namespace {

// What ISO speeds leave open about a camera's absolute scale (1 sigma): makers choose their
// headroom; published factors of calibrated cameras lie 18 to 24 % above the standard.
constexpr double kIsoPriorSd = 0.2;
// Standard output sensitivity: code 118 of 255 at H = 10/S.   Source: ISO 12232:2006, 6.4.
constexpr double kOutputSensitivityExposure = 10.0;
constexpr double kOutputSensitivityCode = 118.0 / 255.0;
constexpr double kEncodedPriorSd = 0.3;
// Display curves rise as code^1.6 and steeper; the labels' rounding bends a linear one to 1.1.
constexpr double kSteepestLinear = 1.3;
constexpr double kClippedSpotSigma = 0.99;

// How much less light focusing near lets onto the sensor.
double FocusOf(const FrameInfo& info) {
  if (!info.focal_length || !info.subject_distance) return 1.0;
  return FocusFactor(*info.focal_length, *info.subject_distance).value_or(1.0);
}

// Signals of the shortest frame per unit of exposure t S/N^2.
double PerExposure(const PreparedFrames& prepared) {
  return FocusOf(prepared.frames[prepared.planned.order.front()].info) /
         std::exp(prepared.planned.ln_exposure.front());
}

// What two tags that say different f-numbers leave open about t/N^2 (1 sigma, relative): half of
// their distance in stops. Labels stray from their grid by an eighth of a stop at most.
double FNumberSpread(const FrameExposure& exposure) {
  constexpr double kLabelStops = 0.12;
  const auto& label = exposure.written.f_number;
  const auto& apex = exposure.written.aperture_apex;
  if (exposure.overridden || !label || !apex || !(*label > 0.0) || !(*apex > 0.0)) return 0.0;
  const double stops = std::abs(2.0 * std::log2(*label) - *apex);
  return stops > kLabelStops ? std::numbers::ln2 * stops / 2.0 : 0.0;
}

// Whether codes are the signal itself: the mean slope of ln(signal) over ln(code).
bool IsLinear(std::span<const float> signal_of_code) {
  const auto top = static_cast<double>(signal_of_code.size() - 1);
  const auto low = static_cast<std::size_t>(0.1 * top), high = static_cast<std::size_t>(0.9 * top);
  const double rise = std::log(double{signal_of_code[high]} / double{signal_of_code[low]});
  return rise < kSteepestLinear * std::log(static_cast<double>(high) / static_cast<double>(low));
}

// Luminance of full scale (signal 1) in the shortest frame, as far as ISO speed tells.
Nits PriorScale(const PreparedFrames& prepared) {
  const FrameInfo& info = prepared.frames[prepared.planned.order.front()].info;
  const double exposure = std::exp(prepared.planned.ln_exposure.front());  // t S / N^2
  double nits = SaturatingExposure(1.0).value / (kIsoLensConstant * exposure);
  if (info.meaning == SampleMeaning::kEncoded) {
    const auto& green = prepared.response.signal_of_code[info.channels == 3 ? kGreenChannel : 0];
    const auto code =
        static_cast<std::size_t>(kOutputSensitivityCode * static_cast<double>(green.size() - 1));
    // Code 118 is a level of an output-referred picture; linear codes end where the sensor does.
    if (!IsLinear(green)) {
      nits = kOutputSensitivityExposure / (kIsoLensConstant * exposure * double{green[code]});
    }
  } else if (info.meaning != SampleMeaning::kLinear) {
    const bool rgb = info.channels == 3 || info.meaning == SampleMeaning::kMosaic;
    nits /= double{prepared.signals.front().clip[rgb ? kGreenChannel : 0]};
  }
  return Nits(nits * FocusOf(info));
}

bool IsClippedIn(const BracketMerger& merger, const SpotReading& spot) {
  const SignalFrame& frame = merger.frames()[0];
  std::vector<float> value(frame.row_samples());
  std::vector<float> variance(value.size());
  const auto width = static_cast<int>(value.size());
  for (int y = spot.y; y < spot.y + spot.height; ++y) {
    static_cast<void>(merger.MergeRows(y, 1, View2d<float>(value.data(), width, 1),
                                       View2d<float>(variance.data(), width, 1)));
    for (int x = spot.x * frame.channels; x < (spot.x + spot.width) * frame.channels; ++x) {
      const auto i = static_cast<std::size_t>(x);
      const bool bright =
          value[i] > 0.5F * static_cast<float>(merger.plan().usable) * frame.clip[0];
      if (bright && variance[i] > kClippedSpotSigma * value[i] * value[i]) return true;
    }
  }
  return false;
}

// What the quarters of a spot differ by: the standard deviation of their means, relative. `width`:
// of the rows that hold it.
double SpreadOfQuarters(std::span<const float> luminance, std::size_t width,
                        const SpotReading& spot) {
  if (spot.width < 2 || spot.height < 2) return 0.0;
  std::array<double, 4> sum{}, count{};
  for (int y = 0; y < spot.height; ++y) {
    for (int x = 0; x < spot.width; ++x) {
      const std::size_t quarter = (2 * y < spot.height ? 0U : 2U) + (2 * x < spot.width ? 0U : 1U);
      sum[quarter] +=
          luminance[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(spot.x + x)];
      count[quarter] += 1.0;
    }
  }
  double mean = 0.0, square = 0.0;
  for (std::size_t q = 0; q < 4; ++q) mean += sum[q] / count[q] / 4.0;
  for (std::size_t q = 0; q < 4; ++q) square += std::pow(sum[q] / count[q] - mean, 2) / 4.0;
  return mean > 0.0 ? std::sqrt(square) / mean : 0.0;
}

// What brings the spot's mean luminance to the reading.
Result<PictureScale> AnchorScale(const BracketMerger& merger, const PictureRows& rows, double prior,
                                 const SpotReading& spot, double ratio_sd) {
  const SignalFrame& frame = merger.frames()[0];
  const std::string where = std::to_string(spot.x) + "," + std::to_string(spot.y) + "," +
                            std::to_string(spot.width) + "," + std::to_string(spot.height);
  if (spot.x < 0 || spot.y < 0 || spot.width < 1 || spot.height < 1 ||
      spot.x + spot.width > frame.width || spot.y + spot.height > frame.height) {
    return Refused("bad_anchor", where,
                   "is not inside the picture of " + std::to_string(frame.width) + " x " +
                       std::to_string(frame.height) + " pixels");
  }
  if (IsClippedIn(merger, spot)) {
    return Refused("bad_anchor", where,
                   "is saturated in every frame; read a darker place, or expose shorter");
  }
  const std::size_t samples =
      static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(spot.height);
  std::vector<float> luminance(samples), sigma(samples);
  const auto done = MergePicture(
      merger,
      {.picture = {rows.luminance}, .luminance = rows.luminance, .corrections = rows.corrections},
      spot.y, spot.height, View2d<float>(luminance.data(), frame.width, spot.height),
      View2d<float>(sigma.data(), frame.width, spot.height));
  if (!done) return tl::unexpected(done.error());
  double sum = 0.0, variance = 0.0;
  for (int y = 0; y < spot.height; ++y) {
    for (int x = spot.x; x < spot.x + spot.width; ++x) {
      const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) +
                     static_cast<std::size_t>(x);
      sum += luminance[i];
      variance += double{sigma[i]} * sigma[i];
    }
  }
  const double sd = kInterpolatedNoise * std::sqrt(variance) / sum;
  if (!(sum > 0.0) || !(sd < 0.5)) {
    return Refused("bad_anchor", where, "is too dark to be measured; read a brighter place");
  }
  const double mean = sum / (static_cast<double>(spot.width) * spot.height);
  // What a flat field leaves open is alike over the spot: it averages out of no mean.
  const auto& flat = rows.corrections.flat();
  const double flat_sd = flat ? flat->sigma_relative : 0.0;
  const double spread = SpreadOfQuarters(luminance, static_cast<std::size_t>(frame.width), spot);
  // A quarter of the spot aside, the meter sees half of that more or less.
  const double place_sd = 0.5 * spread;
  return PictureScale{prior * spot.luminance.value() / mean,
                      std::hypot(std::hypot(spot.sigma_relative, sd, place_sd), ratio_sd, flat_sd),
                      std::nullopt, spread};
}

// Of the light that the camera balanced for; the middle of the factor's lamps where it does not
// say.
Mireds MiredsOfFrame(const FrameInfo& info, const MismatchFactor& lamp) {
  if (info.matrices && info.as_shot_neutral) {
    if (const auto xy = XyFromCameraNeutral(*info.matrices, *info.as_shot_neutral)) {
      return MiredsOfLamp(*xy);
    }
  }
  return Mireds(lamp.middle_mired);
}

}  // namespace

PictureRows RowsOf(const PreparedFrames& prepared, const BracketMergeRequest& request,
                   double scale) {
  const Matrix3& xyz = prepared.color.xyz_from_rgb;
  PictureRows rows;
  rows.corrections = prepared.corrections;
  if (request.raw) {
    const bool one = prepared.signals.front().channels == 1 &&
                     prepared.frames.front().info.meaning != SampleMeaning::kMosaic;
    rows.picture = {{scale, 0.0, 0.0}, {0.0, scale, 0.0}, {0.0, 0.0, scale}};
    if (one) rows.picture.assign(3, {scale, 0.0, 0.0});
    rows.luminance = rows.picture[1];
    return rows;
  }
  for (std::size_t c = 0; c < 3; ++c) rows.luminance[c] = scale * xyz[1][c];
  if (!request.space) {
    rows.picture = {rows.luminance};
    return rows;
  }
  const Xy target = PrimariesOf(*request.space).white;
  rows.picture.resize(3);
  for (std::size_t c = 0; c < 3; ++c) {
    Xyz color{xyz[0][c], xyz[1][c], xyz[2][c]};
    if (request.white) {
      // X and Z adapt; Y stays, so that a saturated lamp keeps its luminance.
      color = AdaptBradford(color, *request.white, target);
      color.Y = xyz[1][c];
    }
    const Rgb rgb = LinearRgbFromXyz(color, *request.space);
    rows.picture[0][c] = scale * rgb.r;
    rows.picture[1][c] = scale * rgb.g;
    rows.picture[2][c] = scale * rgb.b;
  }
  return rows;
}

ScaleSource ScaleSourceOf(const BracketMergeRequest& request) {
  if (request.anchor) return ScaleSource::kAnchor;
  const bool read = request.camera && !request.camera->profile->scale.readings.empty();
  return read ? ScaleSource::kCamera : ScaleSource::kIsoPrior;
}

void WarnOfAnchor(const PictureScale& scale, const std::string& file, Warnings& warnings) {
  constexpr double kUneven = 0.1;
  if (scale.anchor_spread > kUneven) {
    warnings.push_back({"anchor_uneven", file,
                        "the quarters of the spot reading's place differ by " +
                            PercentText(scale.anchor_spread) +
                            " (1 sd): the meter's circle may have held more of one than of "
                            "another; read, and name, a place that is even"});
  }
  if (!scale.iso_nits_per_unit) return;
  constexpr double kFarSd = 4.0;
  constexpr double kUnitSd = 2.0;
  const double off = std::log(scale.nits_per_unit / *scale.iso_nits_per_unit);
  const double sd = std::hypot(kEncodedPriorSd, scale.sd_relative);
  if (std::abs(off) <= kFarSd * sd) return;
  struct Cause {
    double factor;
    const char* words;
  };
  constexpr std::array kCauses = {
      Cause{1e3, "written in a unit a thousand times smaller (kcd/m2 for cd/m2)"},
      Cause{1e4, "in cd/m2 where it is cd/cm2"},
      Cause{3.426, "in foot-lamberts (1 fL is 3.426 cd/m2)"},
      Cause{std::numbers::pi, "an illuminance over a white card, or in apostilb: a factor of pi"},
      Cause{10.76, "in candela per square foot"},
  };
  std::string why = "the place, the unit, or an ND filter that the frames do not name";
  for (const Cause& cause : kCauses) {
    if (std::abs(std::abs(off) - std::log(cause.factor)) > kUnitSd * kIsoPriorSd) continue;
    why = std::string("was it ") + cause.words + "? Else the place, or an ND filter";
    break;
  }
  const double factor = std::exp(std::abs(off));
  warnings.push_back({"prior_conflict", file,
                      "the spot reading asks for " + RoundedText(factor, 3) + " times " +
                          (off > 0.0 ? "more" : "less") +
                          " light than the frames' ISO speed promises, which is right within " +
                          PercentText(kFarSd * kIsoPriorSd) + ": check " + why});
}

Result<PictureScale> ScaleOf(const BracketMerger& merger, const PreparedFrames& prepared,
                             const BracketMergeRequest& request) {
  if (request.raw) return PictureScale{PerExposure(prepared), prepared.planned.gauge_sd};
  const double prior = PriorScale(prepared).value();
  if (request.anchor) {
    const double ratio_sd =
        *std::max_element(prepared.planned.sd_ln.begin(), prepared.planned.sd_ln.end());
    SpotReading spot = *request.anchor;
    if (prepared.alignment) {
      spot.x -= prepared.alignment->x;
      spot.y -= prepared.alignment->y;
    }
    auto scale = AnchorScale(merger, RowsOf(prepared, request, prior), prior, spot, ratio_sd);
    const FrameInfo& shortest = prepared.frames[prepared.planned.order.front()].info;
    if (scale && shortest.exposure.iso && shortest.exposure.time) scale->iso_nits_per_unit = prior;
    return scale;
  }
  const bool encoded = prepared.frames[0].info.meaning == SampleMeaning::kEncoded;
  const FrameInfo& info = prepared.frames[prepared.planned.order.front()].info;
  PictureScale scale{prior, encoded ? kEncodedPriorSd : kIsoPriorSd, std::nullopt, 0.0};
  if (request.camera && !request.camera->profile->scale.readings.empty()) {
    scale = {request.camera->profile->scale.full_scale_constant * PerExposure(prepared),
             CameraScaleSigma(*request.camera, info), std::nullopt, 0.0};
  }
  scale.sd_relative = std::hypot(scale.sd_relative, prepared.planned.gauge_sd);
  scale.sd_relative = std::hypot(scale.sd_relative, FNumberSpread(info.exposure));
  if (request.lamp) {
    scale.nits_per_unit *= request.lamp->At(MiredsOfFrame(info, *request.lamp));
    scale.sd_relative = std::hypot(scale.sd_relative, request.lamp->sigma);
  }
  return scale;
}

}  // namespace lightcal
