// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/plan/reading_trial.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "lightcal/core/stops.h"
#include "lightcal/fit/plan/expected_reading.h"
#include "lightcal/fit/plan/plan_readings.h"

namespace lightcal::fit {
namespace {

// What the fit of a session predicts for its last reading.
std::optional<double> PredictedOfLast(const FittedLight& light) {
  const int index = light.fit.readings - 1;
  for (const ResidualRow& row : light.residuals) {
    if (row.index == index && row.predicted_lx > 0.0) return row.predicted_lx;
  }
  return std::nullopt;
}

std::optional<ReadingTrial> TryAt(const KnownSoFar& known, PlannedReading planned, double lux) {
  if (!(lux >= 0.0)) return std::nullopt;
  const double step = known.display_step_lx;
  planned.expected = Lux(step > 0.0 ? std::round(lux / step) * step : lux);
  Session with = known.session;
  with.readings.push_back(PlannedRow(planned, known.like));
  const std::optional<FittedLight> light = FitAlone(with, known.settings);
  if (!light) return std::nullopt;
  planned.u95_relative = *RelativeUncertainty(*light);
  planned.u95_stops = StopsLeft(*light);
  planned.beam_u95_deg = BeamLeft(*light);
  ReadingTrial trial{std::move(planned)};
  if (trial.planned.action != PlannedAction::kRead || known.now == nullptr || !(lux > 0.0)) {
    return trial;
  }
  if (const auto predicted = PredictedOfLast(*light)) trial.ln_off = std::log(*predicted / lux);
  return trial;
}

}  // namespace

std::optional<double> BeamLeft(const FittedLight& light) {
  if (!light.beam || !light.beam->beam_deg) return std::nullopt;
  const Uncertain& beam = *light.beam->beam_deg;
  return beam.high ? std::max(*beam.high - beam.value, beam.u95) : beam.u95;
}

double StopsLeft(const FittedLight& light) {
  const auto& u = light.intensity_cd ? light.intensity_cd : light.illuminance_lx;
  return (u ? HalfWidthStops(*u) : std::nullopt).value_or(std::numeric_limits<double>::infinity());
}

SessionReading PlannedRow(const PlannedReading& planned, const Reading& like) {
  SessionReading row{like, "planned"};
  row.reading.distance = planned.distance;
  row.reading.position_m = planned.position_m;
  row.reading.normal = planned.normal;
  row.reading.off_axis = planned.off_axis.value_or(Radians(0.0));
  row.reading.shadow_card = planned.action == PlannedAction::kShadowCard;
  if (planned.action == PlannedAction::kLampOff) row.reading.lamp = LampState::kOff;
  row.reading.illuminance = planned.expected;
  return row;
}

std::optional<FittedLight> FitAlone(const Session& session, const FitSettings& settings) {
  auto fitted = FitSession(session, settings);
  if (!fitted || !RelativeUncertainty(fitted->lights.lights.front())) return std::nullopt;
  return std::move(fitted->lights.lights.front());
}

std::optional<ReadingTrial> TryExpected(const KnownSoFar& known, const PlannedReading& planned) {
  const auto likely = LikelyIlluminances(known.session, known.now, planned, known.like);
  const Lux expected =
      likely ? (*likely)[1] : ExpectedIlluminance(known.session, known.now, planned);
  auto trial = TryAt(known, planned, expected.value());
  if (trial) trial->likely = likely;
  return trial;
}

namespace {

// The interval of the three trials is the median one, by its stops; one that failed leaves all.
ReadingTrial MedianOf(const std::optional<ReadingTrial>& low, ReadingTrial middle,
                      const std::optional<ReadingTrial>& high) {
  constexpr double kAll = std::numeric_limits<double>::infinity();
  const auto widths = [&](const std::optional<ReadingTrial>& trial) {
    return trial ? std::pair(trial->planned.u95_stops, trial->planned.u95_relative)
                 : std::pair(kAll, kAll);
  };
  std::array<std::pair<double, double>, 3> all = {widths(low), widths(middle), widths(high)};
  std::ranges::sort(all);
  std::tie(middle.planned.u95_stops, middle.planned.u95_relative) = all[1];
  return middle;
}

}  // namespace

bool IsNearlySettled(const ReadingTrial& trial) {
  constexpr double kPredictsItself = 0.01;
  return std::abs(trial.ln_off) < kPredictsItself;
}

std::optional<ReadingTrial> Settle(const KnownSoFar& known, ReadingTrial first,
                                   const WorthAFit& worth) {
  constexpr double kSlowest = 0.97;
  constexpr int kMostFits = 2;
  if (first.likely) {
    const auto at = [&](std::size_t k) {
      return TryAt(known, first.planned, (*first.likely)[k].value());
    };
    const auto low = at(0);
    const PlannedReading& middle = first.planned;
    const PlannedReading& beside = low ? low->planned : middle;
    if (worth && !worth(std::min(middle.u95_relative, beside.u95_relative),
                        std::min(middle.u95_stops, beside.u95_stops))) {
      return std::nullopt;
    }
    return MedianOf(low, first, at(2));
  }
  std::optional<ReadingTrial> trial = std::move(first);
  double former_off = 0.0;
  for (int i = 0; i < kMostFits && trial && trial->ln_off != 0.0; ++i) {
    if (i > 0 && IsNearlySettled(*trial)) break;
    double step = trial->ln_off;
    const double slow = former_off != 0.0 ? step / former_off : 0.0;
    former_off = step;
    if (slow > 0.0 && slow < kSlowest) step /= 1.0 - slow;
    const double lux = trial->planned.expected.value() * std::exp(step);
    trial = TryAt(known, std::move(trial->planned), lux);
  }
  return trial;
}

}  // namespace lightcal::fit
