// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/session_twin.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <set>
#include <utility>

#include "lightcal/calibrate/calibrate_session.h"
#include "lightcal/calibrate/export_presets.h"
#include "lightcal/core/standard_normal.h"
#include "lightcal/tradeoff/knobs.h"

namespace lightcal {
namespace {

constexpr std::uint64_t kSeed = 20261122;  // one twin, the same every time it is asked for

// What the lamps of the fit give where each reading of one light was taken, over what was read.
void ExpectReadings(const Session& session, const FittedLight& light, SessionTwin& twin) {
  int index = 0;
  for (const SessionReading& row : session.readings) {
    if (row.reading.light != light.name) continue;
    const int own = index++;
    if (!row.reading.illuminance || row.reading.over_range || row.reading.under_range) continue;
    TwinReading made;
    made.repeatability = RepeatabilityRelative(session, row.reading);
    made.calibration = CalibrationRelative(session, row.reading);
    made.instrument = InstrumentOf(row.reading);
    const auto fitted = std::ranges::find(light.residuals, own, &ResidualRow::index);
    const bool lit = row.reading.lamp == LampState::kOn && !row.reading.shadow_card;
    if (lit && fitted == light.residuals.end()) continue;
    // What was subtracted of it (the lamp off, a shadow card) stays.
    if (lit) {
      made.expected +=
          (fitted->predicted_lx - fitted->measured_lx) / row.reading.illuminance->value();
    }
    twin.readings.emplace(row.where, made);
  }
}

// Factors of one replica's readings, the same whichever of them a profile leaves out.
std::map<std::string, double> FactorsOf(const SessionTwin& twin, int replica) {
  std::seed_seq seed{kSeed, static_cast<std::uint64_t>(replica)};
  std::mt19937_64 random(seed);
  StandardNormal normal;
  std::map<std::string, double> gains, factors;
  for (const auto& [where, made] : twin.readings) {
    if (!gains.contains(made.instrument)) gains[made.instrument] = normal(random);
  }
  for (const auto& [where, made] : twin.readings) {
    factors[where] = made.expected * std::exp(made.calibration * gains[made.instrument] +
                                              made.repeatability * normal(random));
  }
  return factors;
}

void ReadAnew(const std::map<std::string, double>& factors, Session& session) {
  for (SessionReading& row : session.readings) {
    const auto factor = factors.find(row.where);
    if (factor == factors.end() || !row.reading.illuminance) continue;
    row.reading.illuminance = Lux(row.reading.illuminance->value() * factor->second);
  }
}

CalibrationSettings SettingsOf(const AccuracyProfile& profile, StageClock* clock) {
  CalibrationSettings settings;
  settings.profile = profile;
  settings.clock = clock;
  return settings;
}

// Fits, and exports presets of every engine: what was found, and what each stage took.
Result<tradeoff::Outcome> OutcomeOf(MeasuredSession measured, const Sources& sources,
                                    const CalibrationSettings& settings) {
  const auto calibrated = FitMeasured(std::move(measured), sources, settings);
  if (!calibrated) return tl::unexpected<Error>(calibrated.error());
  const auto presets = ExportPresets(calibrated->lights, {}, calibrated->session.stem);
  if (!presets) return tl::unexpected(presets.error());
  settings.clock->Lap(tradeoff::Stage::kExport);
  return tradeoff::Outcome{tradeoff::FiguresOf(calibrated->lights), settings.clock->seconds()};
}

// `change` is what becomes of the session between its measuring and its fit.
template <class Change>
tradeoff::Runner RunnerOf(const std::string& session, const OpenSources& open, Change change) {
  return [session, open, change](const AccuracyProfile& profile) -> Result<tradeoff::Outcome> {
    StageClock clock;
    const CalibrationSettings settings = SettingsOf(profile, &clock);
    const Sources sources = open();
    auto measured = MeasureSession(session, sources, settings);
    if (!measured) return tl::unexpected<Error>(measured.error());
    change(measured->session);
    return OutcomeOf(*std::move(measured), sources, settings);
  };
}

}  // namespace

tradeoff::Runner SessionRunner(const std::string& session, const OpenSources& open) {
  return RunnerOf(session, open, [](const Session& as_it_is) { static_cast<void>(as_it_is); });
}

Result<SessionTwin> TwinOf(const std::string& session, const Sources& sources,
                           double tolerance_relative) {
  const auto calibrated = CalibrateSession(
      session, sources, SettingsOf(tradeoff::StrictProfile(tolerance_relative), nullptr));
  if (!calibrated) return tl::unexpected<Error>(calibrated.error());
  const Session& read = calibrated->session;
  if (!read.lit_readings.empty()) {
    return Refused("no_twin", read.stem,
                   "readings that name several lit lamps cannot be made anew; leave "
                   "{study.synthetic} out");
  }
  SessionTwin twin;
  twin.path = session;
  const auto figures = tradeoff::FiguresOf(calibrated->lights);
  for (std::size_t i = 0; i < figures.size(); ++i) {
    const std::size_t before = twin.readings.size();
    ExpectReadings(read, calibrated->lights.lights[i], twin);
    if (twin.readings.size() > before) twin.truth.push_back(figures[i]);
  }
  if (twin.truth.empty()) {
    return Refused("no_twin", read.stem,
                   "no light was fitted to readings that could be made anew; leave "
                   "{study.synthetic} out");
  }
  return twin;
}

tradeoff::Runner TwinRunner(const SessionTwin& twin, const OpenSources& open) {
  return RunnerOf(twin.path, open,
                  [factors = FactorsOf(twin, 0)](Session& session) { ReadAnew(factors, session); });
}

tradeoff::ReplicaRunner TwinReplicas(const SessionTwin& twin, const Sources& sources) {
  struct Loaded {
    std::map<std::string, MeasuredSession> sessions;  // by profile
    int replica = -1;
    std::map<std::string, double> factors;
  };
  return [&twin, sources, loaded = std::make_shared<Loaded>()](
             const AccuracyProfile& profile,
             int replica) -> Result<std::vector<tradeoff::LightFigures>> {
    const CalibrationSettings settings = SettingsOf(profile, nullptr);
    const auto key = AccuracyProfileToJson(profile);
    if (!key) return tl::unexpected(key.error());
    auto at = loaded->sessions.find(*key);
    if (at == loaded->sessions.end()) {
      auto measured = MeasureSession(twin.path, sources, settings);
      if (!measured) return tl::unexpected<Error>(measured.error());
      at = loaded->sessions.emplace(*key, *std::move(measured)).first;
    }
    if (loaded->replica != replica) {
      loaded->factors = FactorsOf(twin, replica);
      loaded->replica = replica;
    }
    MeasuredSession measured = at->second;
    ReadAnew(loaded->factors, measured.session);
    const auto calibrated = FitMeasured(std::move(measured), sources, settings);
    if (!calibrated) return tl::unexpected<Error>(calibrated.error());
    return tradeoff::FiguresOf(calibrated->lights);
  };
}

}  // namespace lightcal
