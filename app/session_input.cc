// SPDX-License-Identifier: Apache-2.0
#include "session_input.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

#include "calibrate_measured.h"
#include "captures/ball_capture.h"
#include "captures/capture_readings.h"
#include "captures/wall_capture.h"
#include "clock.h"
#include "lightcal/calibrate/session_files.h"
#include "lightcal/colorimetry/resample.h"
#include "lightcal/colorimetry/spectrum.h"
#include "lightcal/core/units_text.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/records/session_codec.h"
#include "lightcal_devices/disk_sources.h"
#include "output_files.h"
#include "session_distributions.h"

namespace lightcal::app {
namespace {

namespace fs = std::filesystem;

// The spectrum at a wider step, where it has a finer one.
Spectrum ThinnedTo(const Spectrum& spectrum, double step_nm) {
  if (!(step_nm > 0.0) || spectrum.wavelengths_nm.size() < 2) return spectrum;
  const std::vector<double> edges = BinEdgesNm(spectrum);
  const int count = static_cast<int>((edges.back() - edges.front()) / step_nm * (1.0 + 1e-12));
  if (static_cast<std::size_t>(count) >= spectrum.wavelengths_nm.size()) return spectrum;
  auto wider = ResampleByArea(spectrum, Nanometres(edges.front() + 0.5 * step_nm),
                              Nanometres(step_nm), count);
  return wider ? *std::move(wider) : spectrum;
}

// Leaves every n-th of each light's readings with the lamp on; what they are compared with stays.
void ThinReadings(int n, Session& session) {
  if (n <= 1) return;
  std::map<std::string, int> seen;
  std::erase_if(session.readings, [&](const SessionReading& row) {
    const Reading& reading = row.reading;
    if (reading.lamp == LampState::kOff || reading.shadow_card) return false;
    return seen[reading.light]++ % n != 0;
  });
}

FitSettings FitSettingsOf(const CalibrationRequest& request) {
  const AccuracyProfile& profile = request.profile;
  return {profile.tolerance_relative, profile.effects, request.monte_carlo, profile.estimator,
          profile.cct_method};
}

void Lap(const CalibrationRequest& request, tradeoff::Stage stage) {
  if (request.clock != nullptr) request.clock->Lap(stage);
}

// A spectrum answers for the colour of its reading, and for its illuminance where the reading gives
// none and the file's unit is an irradiance.
Result<void> ResolveSpectrum(Session& session, SessionReading& row, double step_nm,
                             Console& console) {
  Reading& reading = row.reading;
  if (reading.spectrum_file.empty()) return {};
  const std::string path = PathInSession(session, reading.spectrum_file);
  const auto one = ReadTheOneSpectrum(DiskSources(), path, row.where);
  if (!one) return tl::unexpected(one.error());
  console.Warn(one->warnings);
  const Spectrum spectrum = ThinnedTo(one->imported.spectrum, step_nm);
  const auto xyz = XyzFromSpectrum(spectrum);
  if (!xyz) return tl::unexpected(xyz.error());
  reading.xy = XyFromXyz(*xyz);
  if (reading.color_source == ColorSource::kUnknown) {
    reading.color_source = ColorSource::kSpectrometer;
  }
  const bool absolute = spectrum.quantity == SpectralQuantity::kIrradiance;
  if (!reading.illuminance && absolute) reading.illuminance = Lux(xyz->Y);
  NoteInputFile(path, session);
  return {};
}

Result<void> AddDistributions(double step_deg, Session& session, Console& console) {
  Warnings warnings;
  auto added = ResolveDistributions(step_deg, session, warnings);
  console.Warn(warnings);
  return added;
}

// Warnings come even where a capture is refused: they may say why.
Result<std::vector<BallPlacement>> AddCaptures(Session& session, Console& console) {
  Warnings warnings;
  auto placed = PlaceByBalls(session, warnings);
  auto added = placed ? AddCaptureReadings(session, warnings) : Result<void>{};
  console.Warn(warnings);
  if (!added) return Propagate(std::move(added));
  return placed;
}

// Lights that walls measured, and all others fitted to their readings, in the session's order.
Result<LightFile> FitLights(Session& session, const CalibrationRequest& request, Console& console) {
  Warnings warnings;
  auto walls = MeasureWalls(session, warnings);
  Lap(request, tradeoff::Stage::kPictures);
  console.Warn(warnings);
  if (!walls) return Propagate(std::move(walls));
  const auto by_wall = [&](const std::string& name) {
    return std::ranges::find(*walls, name, &FittedLight::name);
  };
  Session others = session;
  std::erase_if(others.lights,
                [&](const LightDescription& light) { return by_wall(light.name) != walls->end(); });
  const auto unused = std::erase_if(others.readings, [&](const SessionReading& row) {
    return by_wall(row.reading.light) != walls->end();
  });
  if (unused > 0) {
    console.Warn({{"readings_not_used", session.name,
                   std::to_string(unused) +
                       " readings of lights that a wall measured are not used; give one as "
                       "anchor_illuminance_lx with wall.anchor_rect to set the scale"}});
  }
  if (others.lights.empty()) return LightFile{*std::move(walls), {}};
  auto fitted = FitSession(others, FitSettingsOf(request));
  if (!fitted) return Propagate(std::move(fitted));
  console.Warn(fitted->warnings);
  for (const std::string& note : fitted->notes) console.Note(note);
  LightFile all;
  for (const LightDescription& light : session.lights) {
    const auto wall = by_wall(light.name);
    const auto read = std::ranges::find(fitted->lights.lights, light.name, &FittedLight::name);
    if (wall != walls->end()) all.lights.push_back(*wall);
    if (read != fitted->lights.lights.end()) all.lights.push_back(*read);
  }
  return all;
}

}  // namespace

Result<Provenance> ProvenanceOf(const Session& session) {
  Provenance provenance;
  provenance.generator = GeneratorName();
  for (const std::string& path : session.input_files) {
    auto bytes = ReadWholeFile(path);
    if (!bytes) return Propagate(std::move(bytes));
    const fs::path relative = fs::path(path).lexically_proximate(session.directory);
    provenance.inputs.push_back({relative.generic_string(), Sha256Hex(*bytes)});
  }
  for (const SessionReading& row : session.readings) {
    const std::string& device = row.reading.device;
    const bool new_one = std::ranges::find(provenance.devices, device) == provenance.devices.end();
    if (!device.empty() && new_one) provenance.devices.push_back(device);
  }
  if (const auto fixed = SourceDateIso8601()) {
    provenance.time = *fixed;
    return provenance;
  }
  for (const SessionReading& row : session.readings) {
    provenance.time = std::max(provenance.time, row.reading.time);
  }
  return provenance;
}

void StageClock::Lap(tradeoff::Stage stage) {
  const auto now = std::chrono::steady_clock::now();
  seconds_[static_cast<std::size_t>(stage)] += std::chrono::duration<double>(now - last_).count();
  last_ = now;
}

Result<MeasuredSession> LoadMeasuredSession(const std::string& path,
                                            const CalibrationRequest& request, Console& console) {
  const AccuracyProfile& profile = request.profile;
  auto loaded = LoadSession(path);
  if (!loaded) return Propagate(std::move(loaded));
  console.Warn(loaded->warnings);
  MeasuredSession measured{std::move(loaded->session), {}};
  Session& session = measured.session;
  for (LightDescription& light : session.lights) {
    if (request.full_angles && light.inner) light.inner = *light.inner * 0.5;
    if (request.full_angles && light.outer) light.outer = *light.outer * 0.5;
  }
  ThinReadings(profile.reading_stride, session);
  for (CaptureDescription& capture : session.captures) capture.work = profile.pictures;
  Lap(request, tradeoff::Stage::kLoad);
  for (SessionReading& row : session.readings) {
    const double step = profile.spectral_step_nm;
    if (auto resolved = ResolveSpectrum(session, row, step, console); !resolved) {
      return Propagate(std::move(resolved));
    }
  }
  if (auto tables = AddDistributions(profile.table_step_deg, session, console); !tables) {
    return Propagate(std::move(tables));
  }
  Lap(request, tradeoff::Stage::kSpectra);
  auto placed = AddCaptures(session, console);
  if (!placed) return Propagate(std::move(placed));
  measured.placed = *std::move(placed);
  Lap(request, tradeoff::Stage::kPictures);
  return measured;
}

Result<CalibratedSession> CalibrateSession(const std::string& path,
                                           const CalibrationRequest& request, Console& console) {
  auto measured = LoadMeasuredSession(path, request, console);
  if (!measured) return Propagate(std::move(measured));
  return CalibrateMeasured(*std::move(measured), request, console);
}

Result<CalibratedSession> CalibrateMeasured(MeasuredSession measured,
                                            const CalibrationRequest& request, Console& console) {
  CalibratedSession calibrated;
  calibrated.session = std::move(measured.session);
  const std::vector<BallPlacement>& placed = measured.placed;
  auto lights = FitLights(calibrated.session, request, console);
  Lap(request, tradeoff::Stage::kFit);
  if (!lights) return Propagate(std::move(lights));
  calibrated.lights = *std::move(lights);
  for (FittedLight& light : calibrated.lights.lights) {
    const auto ball = std::ranges::find(placed, light.name, &BallPlacement::light);
    if (ball != placed.end() && light.position_m == ball->position_m) {
      light.position_u95_m = ball->u95_m;
    }
    if (RestsOnCameraScale(calibrated.session, light.name)) {
      light.fit.prior.emplace_back(kCameraScalePrior);
    }
  }
  auto provenance = ProvenanceOf(calibrated.session);
  if (!provenance) return Propagate(std::move(provenance));
  calibrated.lights.provenance = std::move(*provenance);
  Lap(request, tradeoff::Stage::kLoad);
  return calibrated;
}

std::string DefaultOutputDirectory(const Session& session) {
  return (fs::path(session.directory) / "out").string();
}

Result<double> ParseTolerance(const std::string& text) {
  const auto split = SplitNumberAndUnit(text);
  if (!split) return tl::unexpected(split.error());
  const double tolerance = split->unit == "%" ? split->number / 100.0 : split->number;
  const bool known_unit = split->unit.empty() || split->unit == "%";
  if (!known_unit || !(tolerance > 0.0) || tolerance >= 1.0) {
    return WrongUsage(text, "a tolerance is a part of one above 0 and below 1, e.g. 1% or 0.01");
  }
  return tolerance;
}

}  // namespace lightcal::app
