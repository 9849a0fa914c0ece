// SPDX-License-Identifier: Apache-2.0
#include "dome/dome_files.h"

#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/captures/picture.h"

namespace lightcal::app {
namespace {

Matrix3 Product(const Matrix3& a, const Matrix3& b) {
  Matrix3 out{};
  for (std::size_t column = 0; column < 3; ++column) {
    const Column3 image = Times(a, {b[0][column], b[1][column], b[2][column]});
    for (std::size_t row = 0; row < 3; ++row) out[row][column] = image[row];
  }
  return out;
}

// Columns of XYZ seen under `from` as they look under `to`; each keeps its Y.
Matrix3 Adapted(const Matrix3& xyz, Xy from, Xy to) {
  Matrix3 out = xyz;
  for (std::size_t c = 0; c < 3; ++c) {
    const Xyz adapted = AdaptBradford({xyz[0][c], xyz[1][c], xyz[2][c]}, from, to);
    out[0][c] = adapted.X;
    out[2][c] = adapted.Z;
  }
  return out;
}

double SamplesPerNit(const std::optional<CameraSettings>& plate) {
  return plate ? ExposureScale(*plate) : 1.0;
}

std::string PlateText(const CameraSettings& plate) {
  return "f/" + RoundedText(plate.f_number, 4) + ", " + RoundedText(plate.shutter.value(), 6) +
         " s, ISO " + RoundedText(plate.iso, 6);
}

}  // namespace

RgbPrimaries PrimariesOfOutput(const MeasuredDome& measured, const DomeColors& colors) {
  if (colors.space) return PrimariesOf(*colors.space);
  return measured.input.primaries.value_or(PrimariesOf(RgbSpace::kSrgb));
}

std::optional<Xy> ColorInOutput(const MeasuredDome& measured, const DomeColors& colors,
                                std::optional<Xy> xy) {
  if (!xy || !colors.white) return xy;
  const Xy white = PrimariesOfOutput(measured, colors).white;
  return XyFromXyz(AdaptBradford(XyzFromXyAtUnitY(*xy), *colors.white, white));
}

void FinishDome(std::size_t extracted, const DomeColors& colors,
                const std::optional<CameraSettings>& plate, MeasuredDome& measured) {
  Dome& dome = measured.input.dome;
  for (std::size_t i = 0; i < extracted; ++i) TakeOut(measured.lights[i], dome);
  TurnNorth(measured.north, dome);
  const auto scale = static_cast<float>(SamplesPerNit(plate));
  if (dome.channels != 3) {
    for (float& v : dome.samples) v *= scale;
    return;
  }
  const RgbPrimaries target = PrimariesOfOutput(measured, colors);
  Matrix3 xyz = dome.xyz_from_rgb;
  if (colors.white) xyz = Adapted(xyz, *colors.white, target.white);
  const Matrix3 m = Product(Inverse(XyzFromRgbMatrix(target)), xyz);
  for (std::size_t i = 0; i < dome.samples.size(); i += 3) {
    const Column3 rgb = Times(m, {dome.samples[i], dome.samples[i + 1], dome.samples[i + 2]});
    for (std::size_t c = 0; c < 3; ++c) dome.samples[i + c] = scale * static_cast<float>(rgb[c]);
  }
  dome.xyz_from_rgb = XyzFromRgbMatrix(target);
}

OutputWriter DomeExr(const std::string& path, const MeasuredDome& measured,
                     const DomeColors& colors, const std::optional<CameraSettings>& plate,
                     std::size_t extracted) {
  return {path, [&measured, colors, plate, extracted](const std::string& temporary) {
            const Dome& dome = measured.input.dome;
            ExrPicture exr;
            exr.samples =
                View2d<const float>(dome.samples.data(), dome.width, dome.height, dome.channels);
            exr.channel_names = {"Y"};
            if (dome.channels == 3) {
              exr.channel_names = {"R", "G", "B"};
              exr.chromaticities = PrimariesOfOutput(measured, colors);
            }
            exr.white_luminance = Nits(1.0 / SamplesPerNit(plate));
            exr.environment_latlong = true;
            std::string files;
            for (const std::string& file : measured.input.files) {
              files += (files.empty() ? "" : " ") + file;
            }
            exr.attributes = {{"generator", GeneratorName()},
                              {"quantity", "luminance of a lat-long dome"},
                              {"frames", files},
                              {"scale_source", measured.scale_source},
                              {"lights_taken_out", std::to_string(extracted)}};
            if (measured.scale_u95_relative) {
              exr.attributes.emplace_back("scale_u95_relative",
                                          RoundedText(*measured.scale_u95_relative, 3));
            }
            if (plate) exr.attributes.emplace_back("plate_exposure", PlateText(*plate));
            return WriteExr(temporary, exr);
          }};
}

}  // namespace lightcal::app
