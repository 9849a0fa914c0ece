// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/dome/read_dome.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>
#include <variant>

#include "lightcal/calibrate/dome/aimed_views.h"
#include "lightcal/calibrate/inspect_picture.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/statistics.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/imaging/camera/sensor_to_xyz.h"
#include "lightcal/imaging/panorama/compose_views.h"
#include "lightcal/imaging/scene/flat_top.h"
#include "lightcal/records/fill_masked.h"

namespace lightcal {
namespace {

// Radiance's own primaries; their luminances are the .265 .670 .065 of its bright().
// Source: Ward, Radiance color.h.
constexpr RgbPrimaries kRadiancePrimaries = {
    {0.640, 0.330}, {0.290, 0.600}, {0.150, 0.060}, {1.0 / 3.0, 1.0 / 3.0}};
// The sun is 2e9 cd/m^2; a relative unit may be anything, but not this.
constexpr double kMostSample = 1e15;
constexpr double kSameAngle = 1e-4;  // radians
// What an ISO speed leaves open about a camera's scale (1 sigma), as a merge has it.
constexpr double kIsoSpeedSd = 0.2;

Result<void> CheckRange(const PictureLuminance& luminance, const std::string& file) {
  const auto brightest = std::max_element(luminance.nits.begin(), luminance.nits.end());
  const double value = *brightest / luminance.nits_per_unit;
  if (value <= kMostSample) return {};
  const auto at = static_cast<int>(brightest - luminance.nits.begin());
  return Refused("over_range", file,
                 "pixel " + std::to_string(at % luminance.width) + "," +
                     std::to_string(at / luminance.width) + " holds " + RoundedText(value, 3) +
                     ", which no scene does; repair this pixel");
}

// Pixels of negative luminance, which no light has: below what noise and black levels make of the
// dark, four times the lowest hundredth or a hundredth of the median. Colours that the primaries do
// not hold have negative channels, never that.
std::vector<std::size_t> PixelsBelowLight(const std::vector<float>& nits) {
  constexpr float kOfNoise = 4.0F, kOfMedian = 0.01F;
  if (nits.empty() || !(*std::ranges::min_element(nits) < 0.0F)) return {};
  std::vector<float> ranked = nits;
  const float noise = kOfNoise * std::max(0.0F, -Quantile(ranked, 0.01));
  const float limit = std::max(noise, kOfMedian * std::max(0.0F, UpperMedian(ranked)));
  std::vector<std::size_t> below;
  for (std::size_t i = 0; i < nits.size(); ++i) {
    if (nits[i] < -limit) below.push_back(i);
  }
  return below;
}

void FillBelowLight(const std::string& file, DomeInput& input) {
  Dome& dome = input.dome;
  const std::vector<std::size_t> below = PixelsBelowLight(dome.nits);
  if (below.empty()) return;
  const auto width = static_cast<std::size_t>(dome.width);
  const std::size_t first = below.front();
  input.warnings.push_back(
      {"bad_samples", file,
       std::to_string(below.size()) + (below.size() == 1 ? " pixel" : " pixels") +
           " of negative luminance, beyond its noise, the first at " +
           std::to_string(first % width) + "," + std::to_string(first / width) + " (" +
           RoundedText(double{dome.nits[first]}, 3) +
           "): no light is that; the nearest ones to both sides stand in"});
  FillMasked(below, width, static_cast<std::size_t>(dome.channels), dome.samples);
  FillMasked(below, width, 1, dome.nits);
}

// What a meter reads under a uniform sky is summed 1/cos(pi/(2 rows)) - 1 too high from the middles
// of so few rows: 8 % of 4. One row has no pixel above the horizon.
Result<void> CheckRows(const Dome& dome, const std::string& file) {
  constexpr int kLeastRows = 4;
  if (dome.height >= kLeastRows) return {};
  return Refused("bad_view", file,
                 "a panorama of " + std::to_string(dome.width) + " x " +
                     std::to_string(dome.height) +
                     " pixels has too few above the horizon to tell what lights what; give one of "
                     "8 x 4 or more");
}

// What our own merge wrote beside the samples.
void TakeStatedScale(const FrameInfo& info, DomeInput& input) {
  for (const auto& [name, text] : info.lightcal_attributes) {
    if (name == "scale_source") input.scale = text;
    if (name == "scale_u95_relative") input.scale_u95_relative = ParseNumber(text);
  }
}

// A merge says which share of its samples was clipped in every frame: the brightest.
std::vector<std::uint8_t> ClippedInMerge(const FrameInfo& info, const PictureLuminance& luminance) {
  const std::vector<float>& nits = luminance.nits;
  for (const auto& [name, text] : info.lightcal_attributes) {
    const double share = name == "clipped_fraction" ? ParseNumber(text).value_or(0.0) : 0.0;
    if (!(share > 0.0) || nits.empty()) continue;
    const auto all = static_cast<double>(nits.size());
    const auto from_top =
        static_cast<std::ptrdiff_t>(std::clamp(std::round(share * all), 1.0, all));
    std::vector<float> ranked = nits;
    std::ranges::nth_element(ranked, ranked.begin() + (from_top - 1), std::greater<>());
    return PixelsFrom(luminance.view(), double{ranked[static_cast<std::size_t>(from_top - 1)]});
  }
  return {};
}

std::vector<float> ScaledSamples(View2d<const float> samples, double nits_per_unit) {
  const auto scale = static_cast<float>(nits_per_unit);
  std::vector<float> scaled;
  scaled.reserve(static_cast<std::size_t>(samples.width()) * samples.height() * samples.channels());
  for (int y = 0; y < samples.height(); ++y) {
    for (const float v : samples.row(y)) scaled.push_back(v * scale);
  }
  return scaled;
}

}  // namespace

Result<DomeInput> ReadDomePicture(const std::string& file, const Sources& sources,
                                  const DomeInputRequest& request) {
  auto picture = sources.read_masked_frame(file);
  if (!picture) return Propagate(std::move(picture));
  Frame* const frame = &picture->frame;
  const auto convention = request.convention.value_or(LuminanceConvention::kPhotometric);
  auto luminance = LuminanceOfPicture(*frame, convention);
  if (!luminance) return Propagate(std::move(luminance));
  if (auto range = CheckRange(*luminance, file); !range) return Propagate(std::move(range));
  const auto color = ColorOfPicture(frame->info);
  if (!color) return tl::unexpected(color.error());

  const auto& samples = std::get<View2d<const float>>(frame->samples);
  DomeInput input;
  input.files = {file};
  input.warnings = frame->info.warnings;
  if (!picture->masked.empty()) input.warnings.push_back(WarningOfMasked(*picture));
  for (const Warning& warning : luminance->warnings) {
    if (request.convention && warning.code == "relative_scale") continue;  // the person has said
    input.warnings.push_back(warning);
  }
  input.scale = luminance->scale;
  input.absolute = request.convention || frame->info.white_luminance;
  if (convention == LuminanceConvention::kPhotometric) TakeStatedScale(frame->info, input);
  input.has_colour = frame->info.channels == 3;
  input.view = frame->info.view;
  input.primaries = frame->info.chromaticities;
  if (request.clip) {
    input.clipped = PixelsFrom(samples, *request.clip);
  } else if (frame->info.levels) {
    input.clipped = PixelsFrom(samples, frame->info.levels->maximum);
  } else {
    input.clipped = ClippedInMerge(frame->info, *luminance);
  }

  Dome& dome = input.dome;
  dome.width = luminance->width;
  dome.height = luminance->height;
  dome.channels = samples.channels();
  dome.samples = ScaledSamples(samples, luminance->nits_per_unit);
  dome.nits = std::move(luminance->nits);
  if (input.has_colour) dome.xyz_from_rgb = color->xyz_from_rgb;
  if (convention == LuminanceConvention::kRadiance && input.has_colour) {
    dome.xyz_from_rgb = XyzFromRgbMatrix(kRadiancePrimaries);
    input.primaries = kRadiancePrimaries;
  }
  FillBelowLight(file, input);
  return input;
}

namespace {

// Views that name their own projection need nobody to say it.
Result<DomeInputRequest> AsFilesSay(const DomeInputRequest& request,
                                    const std::vector<DomeInput>& pictures) {
  DomeInputRequest asked = request;
  const auto& view = pictures.front().view;
  if (!request.projection_of_file || !request.balls.empty() || !view) return asked;
  for (const DomeInput& other : pictures) {
    if (other.view && other.view->projection == view->projection &&
        std::abs(other.view->field_of_view.value() - view->field_of_view.value()) < kSameAngle) {
      continue;
    }
    return Refused("views_differ", other.files.front(),
                   "its VIEW line is not that of " + pictures.front().files.front() +
                       "; name their {view.projection}");
  }
  if (view->projection == Projection::kRectilinear && request.aims.empty()) {
    return Refused("bad_view", pictures.front().files.front(),
                   "its VIEW line says that an ordinary lens took it, which shows a part of the "
                   "surroundings; say where it looked ({dome.aims}), or name its "
                   "{view.projection}");
  }
  asked.projection = view->projection;
  asked.field_of_view = view->field_of_view;
  return asked;
}

// A person says from where on samples are clipped: if none is, something is amiss.
void WarnOfUnusedClip(const DomeInputRequest& request, std::vector<DomeInput>& pictures) {
  const bool used = std::ranges::any_of(pictures, [](const DomeInput& picture) {
    return std::ranges::find(picture.clipped, 1) != picture.clipped.end();
  });
  if (!request.clip || used) return;
  pictures.front().warnings.push_back(
      {"clip_unused", pictures.front().files.front(),
       "no sample reaches the " + RoundedText(*request.clip, 4) +
           " from which samples are said to be clipped ({dome.clip}, in the file's own unit): "
           "none is taken to be"});
}

// The dome in the plate's unit.
Result<void> TakePlate(const GreyPlate& plate, const DomeInputRequest& request,
                       const Sources& sources, DomeInput& input) {
  const std::string& file = plate.target.file;
  auto picture = InspectPicture(file, sources, {},
                                request.convention.value_or(LuminanceConvention::kPhotometric));
  if (!picture) return Propagate(std::move(picture));
  const auto scale = ScaleByGrey(plate.target, picture->luminance.view(), input);
  if (!scale) return tl::unexpected(scale.error());
  const bool relative = std::ranges::any_of(
      picture->warnings, [](const Warning& warning) { return warning.code == "relative_scale"; });
  const bool one_unit = input.absolute || std::ranges::find(input.files, file) != input.files.end();
  double factor = scale->factor, sd = scale->sd_relative;
  input.grey = DomeInput::Grey{factor, kZ95 * sd, scale->misfit_sd, std::nullopt};
  if (!request.balls.empty() && one_unit && (!relative || !input.absolute)) {
    input.grey->ball_reflectance = request.balls.front().reflectance / factor;
  }
  std::erase_if(input.warnings, [](const Warning& w) { return w.code == "relative_scale"; });
  input.absolute = !relative || request.convention || plate.exposure;
  if (relative && plate.exposure) {
    factor *= MaximumLuminance(*plate.exposure).value();
    sd = std::hypot(sd, kIsoSpeedSd);
  } else if (picture->scale_u95_relative) {
    sd = std::hypot(sd, *picture->scale_u95_relative / kZ95);
  }
  for (const Warning& warning : picture->warnings) {
    if (warning.code != "relative_scale") {
      input.warnings.push_back(warning);
    } else if (!input.absolute) {
      input.warnings.push_back(
          {"relative_scale", file,
           "the plate does not say which luminance 1.0 is: the dome is in the plate's own unit, "
           "which lights that plate rightly; for cd/m^2 name its exposure "
           "({dome.plate_exposure}), or a lux reading ({dome.illuminance})"});
    }
  }
  input.dome.Multiply(factor);
  input.scale = "grey";
  input.scale_u95_relative = kZ95 * sd;
  input.files.push_back(file);
  return {};
}

}  // namespace

Result<DomeInput> ReadDomeInput(const DomeInputRequest& request, const Sources& sources) {
  if (request.files.empty()) {
    return Refused("no_pictures", "dome", "names no picture; give the panorama, or its views");
  }
  if (request.find_aims) return ReadAimedViews(request, sources);
  std::vector<DomeInput> pictures;
  for (const std::string& file : request.files) {
    auto picture = ReadDomePicture(file, sources, request);
    if (!picture) return Propagate(std::move(picture));
    pictures.push_back(std::move(*picture));
  }
  WarnOfUnusedClip(request, pictures);
  const auto asked = AsFilesSay(request, pictures);
  if (!asked) return tl::unexpected(asked.error());
  if (!asked->IsPanorama()) return ComposeViews(std::move(pictures), *asked);
  const Dome& dome = pictures.front().dome;
  const auto view = PixelSolidAngles::Create(
      {.projection = Projection::kLatLong, .width = dome.width, .height = dome.height});
  if (!view) return tl::unexpected(view.error());
  if (auto rows = CheckRows(dome, request.files.front()); !rows) return Propagate(std::move(rows));
  return std::move(pictures.front());
}

Result<MeasuredDome> MeasureDome(const DomeRequest& request, const Sources& sources,
                                 const std::optional<GreyPlate>& plate) {
  auto input = ReadDomeInput(request.input, sources);
  if (!input) return Propagate(std::move(input));
  if (plate) {
    if (auto ok = TakePlate(*plate, request.input, sources, *input); !ok) {
      return Propagate(std::move(ok));
    }
  }
  return MeasureDome(*std::move(input), request);
}

}  // namespace lightcal
