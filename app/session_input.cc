// SPDX-License-Identifier: Apache-2.0
#include "session_input.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

#include "captures/capture_readings.h"
#include "captures/wall_capture.h"
#include "clock.h"
#include "lightcal/colorimetry/resample.h"
#include "lightcal/colorimetry/spectrum.h"
#include "lightcal/core/units_text.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/records/session_codec.h"
#include "output_files.h"
#include "session_distributions.h"
#include "session_files.h"

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

FitSettings FitSettingsOf(const AccuracyProfile& profile) {
  return {profile.tolerance_relative, profile.effects, profile.estimator, profile.cct_method};
}

// A spectrum answers for the colour of its reading, and for its illuminance where the reading gives
// none and the file's unit is an irradiance.
Result<void> ResolveSpectrum(Session& session, SessionReading& row, double step_nm,
                             Console& console) {
  Reading& reading = row.reading;
  if (reading.spectrum_file.empty()) return {};
  const std::string path = PathInSession(session, reading.spectrum_file);
  const auto one = ReadTheOneSpectrum(path, row.where);
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

Result<void> AddDistributions(Session& session, Console& console) {
  Warnings warnings;
  auto added = ResolveDistributions(session, warnings);
  console.Warn(warnings);
  return added;
}

// Warnings come even where a capture is refused: they may say why.
Result<void> AddCaptures(Session& session, Console& console) {
  Warnings warnings;
  auto added = AddCaptureReadings(session, warnings);
  console.Warn(warnings);
  return added;
}

// Lights that walls measured, and all others fitted to their readings, in the session's order.
Result<LightFile> FitLights(Session& session, const FitSettings& settings, Console& console,
                            StageClock& clock) {
  Warnings warnings;
  auto walls = MeasureWalls(session, warnings);
  clock.Lap(tradeoff::Stage::kPictures);
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
  auto fitted = FitSession(others, settings);
  if (!fitted) return Propagate(std::move(fitted));
  console.Warn(fitted->warnings);
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

Result<CalibratedSession> CalibrateSession(const std::string& path, const AccuracyProfile& profile,
                                           Console& console, StageClock* clock) {
  StageClock unheard;
  StageClock& laps = clock != nullptr ? *clock : unheard;
  auto loaded = LoadSession(path);
  if (!loaded) return Propagate(std::move(loaded));
  console.Warn(loaded->warnings);
  CalibratedSession calibrated;
  calibrated.session = std::move(loaded->session);
  ThinReadings(profile.reading_stride, calibrated.session);
  for (CaptureDescription& capture : calibrated.session.captures) capture.work = profile.pictures;
  laps.Lap(tradeoff::Stage::kLoad);
  for (SessionReading& row : calibrated.session.readings) {
    const double step = profile.spectral_step_nm;
    if (auto resolved = ResolveSpectrum(calibrated.session, row, step, console); !resolved) {
      return Propagate(std::move(resolved));
    }
  }
  if (auto tables = AddDistributions(calibrated.session, console); !tables) {
    return Propagate(std::move(tables));
  }
  laps.Lap(tradeoff::Stage::kSpectra);
  if (auto added = AddCaptures(calibrated.session, console); !added) {
    return Propagate(std::move(added));
  }
  laps.Lap(tradeoff::Stage::kPictures);
  auto lights = FitLights(calibrated.session, FitSettingsOf(profile), console, laps);
  laps.Lap(tradeoff::Stage::kFit);
  if (!lights) return Propagate(std::move(lights));
  calibrated.lights = *std::move(lights);
  for (FittedLight& light : calibrated.lights.lights) {
    if (RestsOnCameraScale(calibrated.session, light.name)) {
      light.fit.prior.emplace_back(kCameraScalePrior);
    }
  }
  auto provenance = ProvenanceOf(calibrated.session);
  if (!provenance) return Propagate(std::move(provenance));
  calibrated.lights.provenance = std::move(*provenance);
  laps.Lap(tradeoff::Stage::kLoad);
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
