// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/calibrate_session.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "lightcal/calibrate/captures/capture_readings.h"
#include "lightcal/calibrate/captures/wall_capture.h"
#include "lightcal/calibrate/distributions.h"
#include "lightcal/calibrate/lamp_spectra.h"
#include "lightcal/calibrate/session_files.h"
#include "lightcal/calibrate/session_spectra.h"
#include "lightcal/core/as_one.h"
#include "lightcal/core/did_you_mean.h"
#include "lightcal/core/generator_name.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/records/keep_lights.h"
#include "lightcal/records/session_reader.h"

namespace lightcal {
namespace {

namespace fs = std::filesystem;

// Every n-th of each light's readings with the lamp on; what they are compared with stays.
std::vector<SessionReading> ThinnedReadings(int n, std::vector<SessionReading> readings) {
  if (n <= 1) return readings;
  std::map<std::string, int> seen;
  std::erase_if(readings, [&](const SessionReading& row) {
    const Reading& reading = row.reading;
    if (reading.lamp == LampState::kOff || reading.shadow_card) return false;
    return seen[reading.light]++ % n != 0;
  });
  return readings;
}

// Takes away the lights that are not asked for, with all that is told of them.
Result<void> KeepAsked(const CalibrationSettings& settings, Session& session) {
  for (const auto* const names : {&settings.lights, &settings.without}) {
    for (const std::string& name : *names) {
      if (FindLight(session, name) != nullptr) continue;
      return Refused("unknown_light", name,
                     "the session has no such light" + DidYouMean(name, session.lights));
    }
  }
  KeepLights(
      [&](const std::string& name) { return IsAsked(name, settings.lights, settings.without); },
      session);
  return {};
}

// The session as the settings have it, before any file that it names is opened.
Session AsSet(Session session, const CalibrationSettings& settings) {
  for (LightDescription& light : session.lights) {
    if (settings.full_angles && light.inner) light.inner = *light.inner * 0.5;
    if (settings.full_angles && light.outer) light.outer = *light.outer * 0.5;
  }
  NameOnlyMeter(session);
  session.readings = ThinnedReadings(settings.profile.reading_stride, std::move(session.readings));
  for (CaptureDescription& capture : session.captures) capture.work = settings.profile.pictures;
  return session;
}

FitSettings FitSettingsOf(const CalibrationSettings& settings) {
  const AccuracyProfile& profile = settings.profile;
  return {profile.tolerance_relative, profile.effects,    settings.monte_carlo,
          profile.estimator,          profile.cct_method, settings.time_effects,
          settings.progress};
}

void Lap(const CalibrationSettings& settings, tradeoff::Stage stage) {
  if (settings.clock != nullptr) settings.clock->Lap(stage);
}

// What is wrong with a session's files: the others are looked at all the same, but nothing of
// lights of which something is missing.
struct Faults {
  std::vector<Error> all;
  std::vector<std::string> lights;

  [[nodiscard]] bool Of(const std::string& light) const {
    return std::ranges::find(lights, light) != lights.end();
  }
};

// What files beyond those that failed would be refused for, as one.
Error AllFaults(Faults faults, const Session& sound, const Sources& sources,
                const CalibrationSettings& settings, Evidence& evidence) {
  auto walls = MeasureWalls(sound, sources, FitSettingsOf(settings), evidence);
  if (!walls) faults.all.push_back(std::move(walls).error());
  return AsOne(std::move(faults.all));
}

Result<MeasuredSession> Measure(const std::string& path, const Sources& sources,
                                const CalibrationSettings& settings, Evidence& evidence) {
  auto loaded = LoadSession(path, sources.read_text);
  if (!loaded) return Propagate(std::move(loaded));
  evidence.AddWarnings(loaded->warnings);
  if (auto kept = KeepAsked(settings, loaded->session); !kept) return Propagate(std::move(kept));
  MeasuredSession measured;
  Session& session = measured.session;
  session = AsSet(std::move(loaded->session), settings);
  evidence.files = std::move(session.input_files);
  Lap(settings, tradeoff::Stage::kLoad);
  Faults faults;
  std::vector<ReadSpectrum> read;
  for (auto* const rows : {&session.readings, &session.state_readings}) {
    for (SessionReading& row : *rows) {
      auto resolved =
          WithSpectrum(session, row, settings.profile.spectral_step_nm, sources, evidence, read);
      if (resolved) {
        row.reading = *std::move(resolved);
      } else {
        faults.all.push_back(std::move(resolved).error());
      }
    }
  }
  evidence.spectra = LampSpectra(read);
  for (LightDescription& light : session.lights) {
    auto described =
        WithDistribution(session, light, settings.profile.table_step_deg, sources, evidence);
    if (described) {
      light = *std::move(described);
    } else {
      faults.all.push_back(std::move(described).error());
      faults.lights.push_back(light.name);
    }
  }
  Lap(settings, tradeoff::Stage::kSpectra);
  auto placed = PlaceByBalls(session, sources, evidence);
  if (placed) {
    measured.placed = *std::move(placed);
  } else {
    faults.all.push_back(std::move(placed).error());
    for (const CaptureDescription& capture : session.captures) {
      if (capture.use == CaptureUse::kBall) faults.lights.push_back(capture.light);
    }
  }
  for (const BallPlacement& ball : measured.placed) {
    auto light = std::ranges::find(session.lights, ball.light, &LightDescription::name);
    if (!light->position_m) light->position_m = ball.position_m;
  }
  std::optional<Session> of_sound;  // where some lights are not
  if (!faults.lights.empty()) {
    of_sound = session;
    KeepLights([&](const std::string& light) { return !faults.Of(light); }, *of_sound);
  }
  const Session& sound = of_sound ? *of_sound : session;
  auto captured = ReadCaptures(sound, sources, evidence);
  if (!captured) faults.all.push_back(std::move(captured).error());
  if (!faults.all.empty()) {
    return tl::unexpected(AllFaults(std::move(faults), sound, sources, settings, evidence));
  }
  session.lights = std::move(captured->lights);
  session.captures = std::move(captured->captures);
  std::ranges::move(captured->readings, std::back_inserter(session.readings));
  AddSpectraOfCaptures(session, sources, evidence);
  Lap(settings, tradeoff::Stage::kPictures);
  return measured;
}

// A ball's own picture says where its distance ends: at the surface, from which its size was taken.
// Beside a meter's reading, of which nobody says it, that stays open.
bool ReachTheSurface(const Session& session) {
  const auto by_own_picture = [&](const LightDescription& light) {
    if (light.kind != LightKind::kSphere || light.position_m) return false;
    bool any = false;
    for (const SessionReading& row : session.readings) {
      const Reading& reading = row.reading;
      if (reading.light != light.name || !reading.illuminance || !IsLit(reading)) continue;
      if (!reading.of_luminance) return false;
      any = true;
    }
    return any;
  };
  return !session.lights.empty() && std::ranges::all_of(session.lights, by_own_picture);
}

FitSettings FitSettingsFor(const Session& session, const CalibrationSettings& settings) {
  FitSettings fit = FitSettingsOf(settings);
  if (!ReachTheSurface(session)) return fit;
  const std::string surface = "+sphere_surface";
  if (fit.effects.empty() || fit.effects == "auto") {
    fit.effects = surface;
  } else if (fit.effects != "all" && fit.effects != "none") {
    fit.effects = surface + "," + fit.effects;
  }
  return fit;
}

struct FoundLights {
  LightFile file;
  std::vector<std::string> notes;
};

Result<FoundLights> FindLights(const Session& session, const Sources& sources,
                               const CalibrationSettings& settings, Evidence& evidence) {
  auto walls = MeasureWalls(session, sources, FitSettingsOf(settings), evidence);
  Lap(settings, tradeoff::Stage::kPictures);
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
    evidence.warnings.push_back(
        {"readings_not_used", session.name,
         std::to_string(unused) +
             " readings of lights that a wall measured are not used; give one as "
             "anchor_illuminance_lx with wall.anchor_rect to set the scale"});
  }
  FoundLights found;
  if (others.lights.empty()) {
    found.file.lights = *std::move(walls);
    return found;
  }
  auto fitted = FitSession(others, FitSettingsFor(others, settings));
  if (!fitted) return Propagate(std::move(fitted));
  evidence.AddWarnings(fitted->warnings);
  found.notes = std::move(fitted->notes);
  for (const LightDescription& light : session.lights) {
    const auto wall = by_wall(light.name);
    const auto read = std::ranges::find(fitted->lights.lights, light.name, &FittedLight::name);
    if (wall != walls->end()) found.file.lights.push_back(*wall);
    if (read != fitted->lights.lights.end()) found.file.lights.push_back(*read);
  }
  return found;
}

// What measured a light beside its readings, where that counts for how sure it is.
void AddPriors(const Session& session, const std::vector<BallPlacement>& placed,
               FittedLight& light) {
  const auto ball = std::ranges::find(placed, light.name, &BallPlacement::light);
  if (ball != placed.end() && light.position_m == ball->position_m) {
    light.position_u95_m = ball->u95_m;
  }
  if (RestsOnCameraScale(session, light.name)) light.fit.prior.emplace_back(kCameraScale);
}

Result<FoundLights> FindLightsWithProvenance(MeasuredSession& measured, const Sources& sources,
                                             const CalibrationSettings& settings,
                                             Evidence& evidence) {
  auto found = FindLights(measured.session, sources, settings, evidence);
  Lap(settings, tradeoff::Stage::kFit);
  if (!found) return found;
  for (FittedLight& light : found->file.lights) {
    AddPriors(measured.session, measured.placed, light);
    TakeSpectra(evidence.spectra, light);
  }
  measured.session.input_files = evidence.files;
  auto provenance = ProvenanceOf(measured.session, sources, settings.time);
  if (!provenance) return Propagate(std::move(provenance));
  found->file.provenance = *std::move(provenance);
  Lap(settings, tradeoff::Stage::kLoad);
  return found;
}

CalibrationRefusal RefusedWith(Error error, Evidence evidence) {
  return {std::move(error), Remarks{std::move(evidence.warnings), {}}};
}

// Empty where the error is of none of the lights.
std::vector<std::string> LightsBeside(const Error& error, const Session& session) {
  std::vector<std::string> names;
  for (const LightDescription& light : session.lights) {
    const bool meant =
        light.name == error.subject ||
        std::ranges::find(error.others, light.name, &Error::subject) != error.others.end();
    if (!meant) names.push_back(light.name);
  }
  if (names.size() == session.lights.size()) names.clear();
  return names;
}

}  // namespace

Calibrated<MeasuredSession> MeasureSession(const std::string& path, const Sources& sources,
                                           const CalibrationSettings& settings) {
  Evidence evidence;
  auto measured = Measure(path, sources, settings, evidence);
  if (!measured) {
    return tl::unexpected(RefusedWith(std::move(measured).error(), std::move(evidence)));
  }
  measured->session.input_files = std::move(evidence.files);
  measured->spectra = std::move(evidence.spectra);
  measured->pictures = std::move(evidence.pictures);
  measured->remarks.warnings = std::move(evidence.warnings);
  return *std::move(measured);
}

Calibrated<CalibratedSession> FitMeasured(MeasuredSession measured, const Sources& sources,
                                          const CalibrationSettings& settings) {
  Evidence evidence{std::move(measured.session.input_files), std::move(measured.spectra),
                    std::move(measured.pictures), std::move(measured.remarks.warnings)};
  auto found = FindLightsWithProvenance(measured, sources, settings, evidence);
  if (!found) {
    CalibrationRefusal refusal = RefusedWith(std::move(found).error(), std::move(evidence));
    refusal.sound = LightsBeside(refusal, measured.session);
    return tl::unexpected(std::move(refusal));
  }
  return CalibratedSession{std::move(measured.session), std::move(found->file),
                           std::move(evidence.spectra), std::move(evidence.pictures),
                           Remarks{std::move(evidence.warnings), std::move(found->notes)}};
}

Calibrated<CalibratedSession> CalibrateSession(const std::string& path, const Sources& sources,
                                               const CalibrationSettings& settings) {
  auto measured = MeasureSession(path, sources, settings);
  if (!measured) return tl::unexpected(std::move(measured).error());
  return FitMeasured(*std::move(measured), sources, settings);
}

Result<Provenance> ProvenanceOf(const Session& session, const Sources& sources,
                                const std::string& time) {
  Provenance provenance;
  provenance.generator = GeneratorName();
  for (const std::string& path : session.input_files) {
    auto hash = sources.sha256(path);
    if (!hash) return Propagate(std::move(hash));
    const fs::path relative = fs::path(path).lexically_proximate(session.directory);
    provenance.inputs.push_back({relative.generic_string(), *std::move(hash)});
  }
  VisitReadings(session, [&](const SessionReading& row) {
    const std::string& device = row.reading.device;
    const bool new_one = std::ranges::find(provenance.devices, device) == provenance.devices.end();
    if (!device.empty() && new_one) provenance.devices.push_back(device);
  });
  provenance.time = time;
  if (!time.empty()) return provenance;
  VisitReadings(session, [&](const SessionReading& row) {
    provenance.time = std::max(provenance.time, row.reading.time);
  });
  return provenance;
}

void StageClock::Lap(tradeoff::Stage stage) {
  const double now = ProcessorSeconds();
  seconds_[static_cast<std::size_t>(stage)] += now - last_;
  last_ = now;
}

}  // namespace lightcal
