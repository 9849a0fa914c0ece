// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/session_twin.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <set>
#include <utility>

#include "calibrate_measured.h"
#include "lightcal/tradeoff/knobs.h"
#include "tradeoff/session_runner.h"

namespace lightcal::app {
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
  std::normal_distribution<double> normal;
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

}  // namespace

Result<SessionTwin> TwinOf(const std::string& session, double tolerance_relative) {
  Console silent = MutedConsole();
  const CalibrationRequest strict{tradeoff::StrictProfile(tolerance_relative), false, false,
                                  nullptr};
  auto calibrated = CalibrateSession(session, strict, silent);
  if (!calibrated) return Propagate(std::move(calibrated));
  const Session& read = calibrated->session;
  if (!read.lit_readings.empty()) {
    return Refused("no_twin", read.stem,
                   "readings that name several lit lamps cannot be made anew; leave --synthetic "
                   "out");
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
                   "no light was fitted to readings that could be made anew; leave --synthetic "
                   "out");
  }
  return twin;
}

tradeoff::Runner TwinRunner(const SessionTwin& twin) {
  return [&twin, factors = FactorsOf(twin, 0)](
             const AccuracyProfile& profile) -> Result<tradeoff::Outcome> {
    Console silent = MutedConsole();
    StageClock clock;
    const CalibrationRequest request{profile, false, false, &clock};
    auto measured = LoadMeasuredSession(twin.path, request, silent);
    if (!measured) return Propagate(std::move(measured));
    ReadAnew(factors, measured->session);
    auto calibrated = CalibrateMeasured(*std::move(measured), request, silent);
    if (!calibrated) return Propagate(std::move(calibrated));
    return OutcomeOf(*calibrated, clock);
  };
}

tradeoff::ReplicaRunner TwinReplicas(const SessionTwin& twin) {
  struct Loaded {
    std::map<std::string, MeasuredSession> sessions;  // by profile
    int replica = -1;
    std::map<std::string, double> factors;
  };
  return [&twin, loaded = std::make_shared<Loaded>()](
             const AccuracyProfile& profile,
             int replica) -> Result<std::vector<tradeoff::LightFigures>> {
    Console silent = MutedConsole();
    const CalibrationRequest request{profile, false, false, nullptr};
    const auto key = AccuracyProfileToJson(profile);
    if (!key) return tl::unexpected(key.error());
    auto at = loaded->sessions.find(*key);
    if (at == loaded->sessions.end()) {
      auto measured = LoadMeasuredSession(twin.path, request, silent);
      if (!measured) return Propagate(std::move(measured));
      at = loaded->sessions.emplace(*key, *std::move(measured)).first;
    }
    if (loaded->replica != replica) {
      loaded->factors = FactorsOf(twin, replica);
      loaded->replica = replica;
    }
    MeasuredSession measured = at->second;
    ReadAnew(loaded->factors, measured.session);
    auto calibrated = CalibrateMeasured(std::move(measured), request, silent);
    if (!calibrated) return Propagate(std::move(calibrated));
    return tradeoff::FiguresOf(calibrated->lights);
  };
}

}  // namespace lightcal::app
