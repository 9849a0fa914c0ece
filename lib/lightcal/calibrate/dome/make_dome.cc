// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/dome/make_dome.h"

#include <algorithm>
#include <utility>

#include "lightcal/calibrate/dome/dome_light_file.h"
#include "lightcal/colorimetry/cct.h"
#include "lightcal/core/generator_name.h"
#include "lightcal/core/matrix3.h"
#include "lightcal/imaging/panorama/reduce_dome.h"
#include "lightcal/imaging/panorama/turn_north.h"

namespace lightcal {
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

Result<void> CheckSettings(const DomeSettings& settings) {
  if (settings.plate && !IsPossible(*settings.plate)) {
    return Refused("not_positive", "plate", "f-number, time and ISO speed are above 0");
  }
  if (settings.white && CctFromXy(*settings.white).status == CctStatus::kNotAChromaticity) {
    return Refused("bad_chromaticity", "white", "no light has this chromaticity");
  }
  return {};
}

double SamplesPerNit(const std::optional<CameraSettings>& plate) {
  return plate ? ExposureScale(*plate) : 1.0;
}

std::optional<Xy> ColorInOutput(const MeasuredDome& measured, const DomeSettings& settings,
                                std::optional<Xy> xy) {
  if (!xy || !settings.white) return xy;
  const Xy white = PrimariesOfOutput(measured, settings).white;
  return XyFromXyz(AdaptBradford(XyzFromXyAtUnitY(*xy), *settings.white, white));
}

void FinishDome(std::size_t extracted, const DomeSettings& settings, MeasuredDome& measured) {
  Dome& dome = measured.input.dome;
  for (std::size_t i = 0; i < extracted; ++i) TakeOut(measured.lights[i], dome);
  TurnNorth(measured.north, dome);
  const auto scale = static_cast<float>(SamplesPerNit(settings.plate));
  if (dome.channels != 3) {
    for (float& v : dome.samples) v *= scale;
    return;
  }
  const RgbPrimaries target = PrimariesOfOutput(measured, settings);
  Matrix3 xyz = dome.xyz_from_rgb;
  if (settings.white) xyz = Adapted(xyz, *settings.white, target.white);
  const Matrix3 m = Product(Inverse(XyzFromRgbMatrix(target)), xyz);
  for (std::size_t i = 0; i < dome.samples.size(); i += 3) {
    const Column3 rgb = Times(m, {dome.samples[i], dome.samples[i + 1], dome.samples[i + 2]});
    for (std::size_t c = 0; c < 3; ++c) dome.samples[i + c] = scale * static_cast<float>(rgb[c]);
  }
  dome.xyz_from_rgb = XyzFromRgbMatrix(target);
}

std::vector<DomePlane> PlanesOf(const DomeRequest& request) {
  std::vector<DomePlane> planes = {{"up", {0.0, 0.0, 1.0}},    {"down", {0.0, 0.0, -1.0}},
                                   {"front", {0.0, 1.0, 0.0}}, {"right", {1.0, 0.0, 0.0}},
                                   {"back", {0.0, -1.0, 0.0}}, {"left", {-1.0, 0.0, 0.0}}};
  if (request.reading) planes.push_back({"reading", request.reading->normal});
  return planes;
}

void CountLights(const MeasuredDome& measured, std::size_t extracted,
                 std::vector<DomePlane>& planes) {
  for (DomePlane& plane : planes) {
    for (std::size_t i = 0; i < extracted; ++i) {
      plane.lights +=
          std::max(0.0, Dot(TurnedNorth(measured.lights[i].flow, measured.north), plane.normal));
    }
  }
}

Uncertain LuxThatRemains(const MeasuredDome& measured, double lux) {
  return LuxOfDome(measured, lux, measured.scale_u95_relative.value_or(0.0) / kZ95);
}

// With all that lights left in the dome may give. Where these leave the scale open, they give most
// where it is least.
std::optional<double> MostThatRemains(const MeasuredDome& measured, std::size_t extracted,
                                      const DomePlane& plane) {
  if (!measured.unit_known) return std::nullopt;
  double lacking = 0.0;
  for (std::size_t i = extracted; i < measured.lights.size(); ++i) {
    const DomeLight& light = measured.lights[i];
    if (!light.at_most) continue;
    const double shown = light.inferred ? 0.0 : light.illuminance.value();
    const Vec3 direction = TurnedNorth(light.direction, measured.north);
    lacking += (light.at_most->value() - shown) * std::max(0.0, Dot(direction, plane.normal));
  }
  if (!(lacking > 0.0)) return std::nullopt;
  const Uncertain lux = LuxThatRemains(measured, plane.remaining);
  if (!(measured.scale.range_ln > 0.0)) return HighEnd(lux) + lacking;
  return std::max(HighEnd(lux), LowEnd(lux) + lacking);
}

// After the dome was finished: its luminances are those of the answer's frame.
void CountDome(const MeasuredDome& measured, std::size_t extracted,
               std::vector<DomePlane>& planes) {
  const Dome& dome = measured.input.dome;
  for (DomePlane& plane : planes) {
    plane.remaining = IlluminanceOn(dome.luminance(), dome.grid(), plane.normal).value();
    plane.total = plane.lights + plane.remaining;
    plane.most = MostThatRemains(measured, extracted, plane);
  }
}

Result<Provenance> ProvenanceOf(const std::vector<std::string>& files, const Sources& sources,
                                const std::string& time) {
  Provenance provenance;
  provenance.generator = GeneratorName();
  for (const std::string& file : files) {
    auto hash = sources.sha256(file);
    if (!hash) return Propagate(std::move(hash));
    provenance.inputs.push_back({file, *std::move(hash)});
  }
  provenance.time = time;
  return provenance;
}

FittedLight EnvironmentOf(const MadeDome& made) {
  FittedLight light;
  light.name = "environment";
  light.kind = LightKind::kDome;
  const DomePlane& up = made.planes.front();
  Uncertain lux = LuxThatRemains(made.measured, up.remaining);
  if (up.most) lux = {lux.value, 0.5 * (*up.most - LowEnd(lux)), LowEnd(lux), *up.most};
  light.illuminance_lx = lux;
  light.color.xy = XyFromAbove(made.measured.input.dome);
  light.environment = EnvironmentFile{kDomePicture, "latlong", made.white_luminance.value()};
  return light;
}

Result<LightFile> LightsTakenOut(const MadeDome& made, const Sources& sources,
                                 const std::string& time, Warnings& warnings) {
  Result<LightFile> lights = LightFile{};
  if (made.extracted > 0) lights = LightFileOfDome(made.measured, made.extracted, warnings);
  if (!lights) return lights;
  auto provenance = ProvenanceOf(made.measured.input.files, sources, time);
  if (!provenance) return Propagate(std::move(provenance));
  lights->provenance = *std::move(provenance);
  return lights;
}

}  // namespace

RgbPrimaries PrimariesOfOutput(const MeasuredDome& measured, const DomeSettings& settings) {
  if (settings.space) return PrimariesOf(*settings.space);
  return measured.input.primaries.value_or(PrimariesOf(RgbSpace::kSrgb));
}

Result<MadeDome> MakeDome(MeasuredDome measured, const DomeRequest& request, const Sources& sources,
                          const DomeSettings& settings) {
  if (auto ok = CheckSettings(settings); !ok) return Propagate(std::move(ok));
  MadeDome made;
  const std::size_t found = measured.lights.size();
  made.extracted =
      std::min(settings.extract == kEveryLight ? kMostDomeLights : settings.extract, found);
  if (settings.extract != kEveryLight && settings.extract > found) {
    made.warnings.push_back({"fewer_lights", request.input.files.front(),
                             std::to_string(settings.extract) + " lights asked for, " +
                                 std::to_string(found) + " stand out of their surroundings"});
  }
  for (DomeLight& light : measured.lights) {
    light.xy = ColorInOutput(measured, settings, light.xy);
  }
  made.names = NamesOfLights(measured, std::max(made.extracted, kMostDomeLights));
  made.measured = std::move(measured);
  auto lights = LightsTakenOut(made, sources, settings.time, made.warnings);
  if (!lights) return Propagate(std::move(lights));
  made.light_file = *std::move(lights);
  const Dome& whole = made.measured.input.dome;
  made.preview = ReducedDome(whole, std::max(1, whole.width / kPreviewWidth));
  TurnNorth(made.measured.north, made.preview);
  made.planes = PlanesOf(request);
  CountLights(made.measured, made.extracted, made.planes);
  FinishDome(made.extracted, settings, made.measured);
  CountDome(made.measured, made.extracted, made.planes);
  if (settings.plate) made.white_luminance = Nits(1.0 / SamplesPerNit(settings.plate));
  if (made.planes.front().remaining > 0.0) made.light_file.lights.push_back(EnvironmentOf(made));
  return made;
}

Result<MadeDome> MakeDome(const std::vector<std::string>& files, const Sources& sources,
                          const DomeSettings& settings) {
  DomeRequest request;
  request.input.files = files;
  auto measured = MeasureDome(request, sources);
  if (!measured) return Propagate(std::move(measured));
  return MakeDome(*std::move(measured), request, sources, settings);
}

}  // namespace lightcal
