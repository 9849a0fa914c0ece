// SPDX-License-Identifier: Apache-2.0
// A reading that nobody has taken yet, tried in thought: what a fit with it would leave open.
#pragma once

#include <array>
#include <functional>
#include <optional>

#include "lightcal/fit/fit_light.h"
#include "lightcal/records/reading_plan.h"
#include "lightcal/records/session.h"

namespace lightcal::fit {

// What is known before the reading: a session of one light, a reading by the meter that would take
// the next, the light as the session's readings give it (null: not at all), and the step by
// which that meter will show the next (0: none that counts).
struct KnownSoFar {
  const Session& session;
  const FitSettings& settings;
  const Reading& like;
  const FittedLight* now = nullptr;
  double display_step_lx = 0.0;
};

// A reading at an illuminance (planned.expected), and what a fit with it makes of both: u95 of the
// intensity, of the beam's angle and in stops.
struct ReadingTrial {
  PlannedReading planned;
  double ln_off = 0.0;  // of what the fit predicts for it over what it was taken at; 0: not told
  std::optional<std::array<Lux, 3>> likely{};  // what it may show (LikelyIlluminances)
};

// 95 % of a beam's full angle, degrees, the larger side; none where there is no beam to be known.
[[nodiscard]] std::optional<double> BeamLeft(const FittedLight& light);

// Half of the interval of the intensity, or of the illuminance where that is the answer, in stops;
// infinity where it reaches down to nothing.
[[nodiscard]] double StopsLeft(const FittedLight& light);

// The row that a planned reading would be.
[[nodiscard]] SessionReading PlannedRow(const PlannedReading& planned, const Reading& like);

// The light as a session of it alone gives it; none where the fit fails or has no interval.
[[nodiscard]] std::optional<FittedLight> FitAlone(const Session& session,
                                                  const FitSettings& settings);

// At what the fit so far expects, the middle one of what it may show. None where that is nothing,
// or the fit with it fails.
[[nodiscard]] std::optional<ReadingTrial> TryExpected(const KnownSoFar& known,
                                                      const PlannedReading& planned);

// Within 1 % of what a fit with it predicts for it.
[[nodiscard]] bool IsNearlySettled(const ReadingTrial& trial);

// What settling adds at most to the logarithm by which a nearly settled reading shortens the
// interval: .139 among 865 that were tried, .4 of a lamp whose start one reading tells; those
// further off, up to .69.
inline constexpr double kMostBySettling = 0.45;

// What the reading leaves open, whatever it shows: the median of what each of `likely` leaves, one
// that no fit explains leaving all. Of a lamp that one normal says, at the illuminance at which the
// reading would change nothing: what a fit with it predicts for it, and again. Where it tells much,
// the second answer is still drawn to the first guess, and the limit of the series is taken
// (Aitken, in logarithms). None where a fit fails.
// Where not even an interval of those widths, the least that it may still be, is `worth` a further
// fit: none too.
using WorthAFit = std::function<bool(double u95_relative, double u95_stops)>;
[[nodiscard]] std::optional<ReadingTrial> Settle(const KnownSoFar& known, ReadingTrial trial,
                                                 const WorthAFit& worth = {});

}  // namespace lightcal::fit
