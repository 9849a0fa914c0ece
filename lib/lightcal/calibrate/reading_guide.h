// SPDX-License-Identifier: Apache-2.0
// What to measure next of one lamp, and when it is enough. Asks nobody, prints nothing.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/fit/plan/plan_readings.h"
#include "lightcal/records/session.h"

namespace lightcal {

struct GuideAdvice {
  enum class Kind : std::uint8_t {
    kMeasure,
    kReached,  // the wanted uncertainty
    kNoGain,   // no step would help enough to be worth its minutes
  };
  Kind kind = Kind::kMeasure;
  PlannedReading step{};
};

class ReadingGuide {
 public:
  // until_relative: half of the 95 % interval wanted, over the value.
  ReadingGuide(const Session& session, const std::string& light, double until_relative,
               bool shadow_cards);

  // The step that AdviseNext names, which quick, run and plan name too; before any reading the
  // first of PlanMinutes.
  // Refused: as PlanMinutes.
  [[nodiscard]] Result<GuideAdvice> Next() const;

  // The lamp as the readings so far and this one say.  Refused: as FitSession, no_readings.
  [[nodiscard]] Result<FittedLight> FitWith(const Reading& reading) const;
  // Why this reading looks like a mistake, "" where it does not.
  [[nodiscard]] std::string DoubtAbout(const Reading& reading) const;
  void Add(const Reading& reading);
  // The last reading added counts no more; false where none was added.
  bool TakeBack();
  // This step is not advised again; a card skipped once is not asked for again anywhere.
  void Skip(const PlannedReading& step);

  // What the readings so far say; absent before the first, and where they say nothing.
  [[nodiscard]] const std::optional<FittedLight>& light() const { return fitted_; }
  [[nodiscard]] std::optional<double> u95_relative() const;
  // What the meter's calibration leaves of it however often it reads; 0 where nobody says.
  [[nodiscard]] double meter_u95_relative() const { return MeterU95Relative(session_); }
  // What that fit warns of.
  [[nodiscard]] const Warnings& warnings() const { return warnings_; }
  // Of the last pair: what the card left over what the meter saw without it.
  [[nodiscard]] std::optional<double> other_light_share() const { return other_share_; }

 private:
  [[nodiscard]] Result<FittedSession> FitOf(const std::vector<SessionReading>& readings) const;
  void FitAll();
  // The lit reading of the same place, the newest; null = none.
  [[nodiscard]] const Reading* LitAtPlaceOf(const Reading& card) const;
  // What was skipped, and where cards are not wanted those of every reading.
  [[nodiscard]] std::vector<PlannedReading> Skipped() const;

  Session session_;  // this light only
  double until_relative_;
  bool shadow_cards_;
  std::vector<PlannedReading> skipped_;
  std::size_t given_ = 0;  // readings that the session came with
  std::optional<FittedLight> fitted_;
  Warnings warnings_;
  std::optional<double> other_share_;
};

}  // namespace lightcal
