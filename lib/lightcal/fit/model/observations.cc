// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/observations.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/fit/model/reading_geometry.h"
#include "lightcal/records/display_step.h"

namespace lightcal::fit {
namespace {

// A meter's reading of nothing is known to half a percent of the dimmest reading that counts: its
// resolution and dark offset. Relative, so that the fit has no scale of its own.
constexpr double kDarkFloor = 0.005;
// No meter repeats better than this; keeps a sigma of 0 from deciding alone.
constexpr double kLeastSigma = 1e-4;
// A shadow-card reading with no lamp-on reading at its distance still tells the ambient light, but
// bounce differs from place to place.
constexpr double kSigmaElsewhere = 0.3;
// Readings within this many metres of each other stand in one place.
constexpr double kSamePlace = 0.005;
// People point a meter within a degree, 1 sigma, once they mean a tilt.
constexpr double kTiltSigma = std::numbers::pi / 180.0;
// A reading under range lies anywhere from 0 to its limit L: mean L/2, sigma L/sqrt(12).
constexpr double kUnderRangeMean = 0.5;
const double kUnderRangeSigma = 1.0 / std::sqrt(3.0);  // relative to the mean

std::string RowName(const SessionReading& row, int index) {
  return row.where.empty() ? "reading " + std::to_string(index) : row.where;
}

constexpr double kSwapped = 0.1;  // of the lit reading, below its shadow-card reading
constexpr double kApart = 4.0;    // standard deviations that no two readings of one light lie apart

// Nothing else shines in a picture of the lamp itself; a meter beside the camera sees the room.
bool ShowsTheLampAlone(const Reading& reading) {
  return reading.of_luminance && ByOwnScale(reading);
}

class Collector {
 public:
  Collector(const Session& session, const LightDescription& light)
      : session_(session), light_(light) {}

  Result<Observations> Collect() {
    for (const SessionReading& row : session_.readings) {
      if (row.reading.light != light_.name) continue;
      if (row.reading.illuminance) (void)InstrumentIndex(row.reading);
    }
    for (const SessionReading& row : session_.readings) {
      if (row.reading.light != light_.name) continue;
      const int index = out_.readings++;
      if (auto added = Add(row, index); !added) return tl::unexpected(std::move(added).error());
    }
    if (auto separated = SubtractOthers(); !separated) return Propagate(std::move(separated));
    if (auto taken = SubtractShadows(); !taken) return Propagate(std::move(taken));
    if (auto off = CheckOff(); !off) return Propagate(std::move(off));
    SubtractOff();
    FillSigmas();
    out_.by_camera = instruments_.size() == 1 && !out_.rows.empty() && out_.rows[0].picture;
    std::sort(out_.rejected.begin(), out_.rejected.end());
    return std::move(out_);
  }

 private:
  Result<void> Reject(const SessionReading& row, int index, const std::string& fault) {
    out_.rejected.push_back(index);
    out_.warnings.push_back({"row_rejected", RowName(row, index), fault});
    return {};
  }

  Result<void> Add(const SessionReading& row, int index) {
    const Reading& reading = row.reading;
    if (!row.fault.empty()) return Reject(row, index, row.fault);
    if (!reading.illuminance) return {};  // a colour reading
    const bool lit = reading.lamp == LampState::kOn && !reading.shadow_card;
    auto geometry = GeometryOfReading(light_, reading, RowName(row, index), lit);
    if (!geometry) return tl::unexpected(std::move(geometry).error());
    const std::string fault = FaultOfReading(light_, reading, *geometry, lit);
    if (!fault.empty()) return Reject(row, index, fault);
    if (reading.shadow_card) ++out_.shadow_readings;
    Observation observation;
    observation.index = index;
    observation.lit = lit;
    observation.behind_card = reading.shadow_card;
    observation.placed = reading.distance || reading.position_m;
    observation.measured_lx = observation.raw_lx =
        (reading.under_range ? kUnderRangeMean : 1.0) * reading.illuminance->value();
    observation.over_range = reading.over_range;
    observation.data_sheet = reading.meter == kDataSheetMeter;
    observation.picture = ByOwnScale(reading);
    observation.sees_walls = HoldsWallLight(session_, light_, reading);
    observation.of_luminance = ShowsTheLampAlone(reading);
    StandMeter(light_, reading, *geometry, observation);
    observation.calibration = CalibrationRelative(session_, reading);
    observation.instrument = InstrumentIndex(reading);
    const double sigma = SigmaOf(reading);
    relative_.push_back({lit ? std::hypot(sigma, std::tan(geometry->tilt_rad) * kTiltSigma) : sigma,
                         LastDigitOf(observation.instrument, reading, lit), reading.shadow_card,
                         !lit && !observation.placed, &row});
    out_.rows.push_back(observation);
    return {};
  }

  // Where several instruments speak, what sets them apart belongs to each reading's sigma.
  [[nodiscard]] double SigmaOf(const Reading& reading) const {
    if (reading.under_range) return kUnderRangeSigma;
    return std::max(kLeastSigma, instruments_.size() == 1 ? RepeatabilityRelative(session_, reading)
                                                          : SigmaRelative(session_, reading));
  }

  // 1 sigma of a display's last digit, absolute; behind a card what that hides holds it.
  double LastDigitOf(int instrument, const Reading& reading, bool lit) {
    if (!lit || reading.under_range || reading.over_range) return 0.0;
    const auto [known, fresh] = display_step_lx_.try_emplace(instrument, 0.0);
    if (fresh) known->second = DisplayStepOf(session_, reading);
    const double step = known->second;
    return reading.illuminance->value() < kStepsEnough * step ? SigmaOfDisplay(step) : 0.0;
  }

  // Of what row i shows.
  [[nodiscard]] double SigmaLx(std::size_t i) const {
    return std::hypot(out_.rows[i].raw_lx * relative_[i].sigma, relative_[i].last_digit_lx);
  }

  int InstrumentIndex(const Reading& reading) {
    const std::string& name = InstrumentOf(reading);
    const auto known = std::find(instruments_.begin(), instruments_.end(), name);
    const auto index = static_cast<int>(known - instruments_.begin());
    if (known == instruments_.end()) instruments_.push_back(name);
    return index;
  }

  // Readings with other lamps lit become differences; what they were subtracted from goes.
  Result<void> SubtractOthers() {
    std::vector<bool> gone(out_.rows.size(), false);
    const std::vector<std::size_t> off =
        RowsWhere([&](std::size_t j) { return !out_.rows[j].lit; });
    int separated = 0;
    int mixed = 0;
    for (std::size_t i = 0; i < out_.rows.size(); ++i) {
      const std::vector<std::string>& others = relative_[i].source->others_lit;
      if (others.empty()) continue;
      if (!out_.rows[i].lit) {
        gone[i] = true;
        continue;
      }
      ++mixed;
      const auto lamp_off = [&](std::size_t j) {
        const SessionReading& reading = *relative_[j].source;
        return reading.others_lit == others && reading.place == relative_[i].source->place;
      };
      gone[i] = out_.rows[i].over_range || !Subtract(i, off, lamp_off);
      out_.rows[i].ambient_subtracted = !gone[i];
      separated += gone[i] ? 0 : 1;
    }
    const bool alone = std::any_of(out_.rows.begin(), out_.rows.end(), [&](const Observation& o) {
      return o.lit && relative_[&o - out_.rows.data()].source->others_lit.empty();
    });
    if (mixed > 0 && separated == 0 && !alone) {
      return Refused("not_separated", light_.name,
                     "other lamps were lit in every reading of this one; read the same place once "
                     "more with it off and the same others lit");
    }
    Keep(gone);
    return {};
  }

  void Keep(const std::vector<bool>& gone) {
    std::vector<Observation> kept;
    std::vector<Extra> kept_extra;
    for (std::size_t i = 0; i < out_.rows.size(); ++i) {
      if (gone[i]) continue;
      kept.push_back(out_.rows[i]);
      kept_extra.push_back(relative_[i]);
    }
    out_.rows = std::move(kept);
    relative_ = std::move(kept_extra);
  }

  template <class Where>
  [[nodiscard]] std::vector<std::size_t> RowsWhere(const Where& where) const {
    std::vector<std::size_t> rows;
    for (std::size_t j = 0; j < out_.rows.size(); ++j) {
      if (where(j)) rows.push_back(j);
    }
    return rows;
  }

  // Takes the mean of those readings among `candidates` that are `of` row i, weighted by their
  // sigmas, from it. False: there is none.
  template <class Of>
  bool Subtract(std::size_t i, const std::vector<std::size_t>& candidates, const Of& of) {
    Observation& row = out_.rows[i];
    double weights = 0.0;
    double sum = 0.0;
    for (const std::size_t j : candidates) {
      if (!of(j)) continue;
      const Observation& other = out_.rows[j];
      const double scales =
          other.instrument != row.instrument ? other.raw_lx * other.calibration : 0.0;
      constexpr double kSquarable_lx = 1e-150;
      const double sigma = std::max(
          {std::hypot(SigmaLx(j), scales), kLeastSigma * std::abs(row.raw_lx), kSquarable_lx});
      weights += 1.0 / (sigma * sigma);
      sum += other.raw_lx / (sigma * sigma);
    }
    if (!(weights > 0.0)) return false;
    row.measured_lx = row.raw_lx - sum / weights;
    row.card_lx = sum / weights;
    row.card_sigma_lx = 1.0 / std::sqrt(weights);
    row.sigma_lx = std::hypot(SigmaLx(i), row.card_sigma_lx);
    return true;
  }

  Result<void> SubtractShadows() {
    if (out_.shadow_readings == 0) return {};
    std::vector<bool> consumed(out_.rows.size(), false);
    const std::vector<std::size_t> shadows =
        RowsWhere([&](std::size_t j) { return relative_[j].shadow; });
    for (std::size_t i = 0; i < out_.rows.size(); ++i) {
      const Observation& row = out_.rows[i];
      if (!row.lit || row.over_range || row.ambient_subtracted) continue;
      const auto shadow = [&](std::size_t j) {
        const bool here = SamePlace(row, j);
        if (here) consumed[j] = true;
        return here;
      };
      if (!Subtract(i, shadows, shadow)) continue;
      out_.rows[i].differenced = out_.rows[i].behind_card = true;
      // One meter, one place, seconds apart: no repeatability explains so much.
      if (row.measured_lx < -std::max(kSwapped * row.raw_lx, row.sigma_lx)) {
        return Refused("dark_above_lit", light_.name,
                       "reading " + std::to_string(row.index) +
                           ": behind the card the meter showed " +
                           RoundedText(row.raw_lx - row.measured_lx, 4) + " lx, without it " +
                           RoundedText(row.raw_lx, 4) + ": were the two taken for one another?");
      }
      if (row.measured_lx < 0.0) WarnOfNegative(row);
    }
    for (std::size_t i = 0; i < out_.rows.size(); ++i) {
      if (consumed[i]) {
        out_.subtracted.push_back(out_.rows[i].index);
        continue;
      }
      if (!relative_[i].shadow) continue;
      out_.warnings.push_back({"shadow_unmatched", light_.name,
                               "a shadow-card reading has no lamp-on reading at its distance; it "
                               "counts as ambient light, within 30 %"});
      out_.rows[i].behind_card = !relative_[i].no_place;
      relative_[i].sigma = std::hypot(relative_[i].sigma, kSigmaElsewhere);
    }
    Keep(consumed);
    return {};
  }

  [[nodiscard]] static bool SeesOtherLight(const Observation& row) {
    return !row.data_sheet && !row.of_luminance;
  }

  // The least that the lamp gives at reading i by what it gives nearer: a quarter of it by the
  // square of the distance, as offsets and walls leave more.
  [[nodiscard]] double LeastByNearer(std::size_t i, double most_off_lx) const {
    constexpr double kLeastPart = 0.25;
    const Observation& row = out_.rows[i];
    const auto alike = [&](const Observation& o) {
      return o.lit && !o.over_range && SeesOtherLight(o) && !o.position_m && o.tilt_rad == 0.0 &&
             o.off_axis_rad == row.off_axis_rad;
    };
    double least = 0.0;
    if (!alike(row)) return least;
    for (std::size_t k = 0; k < out_.rows.size(); ++k) {
      const Observation& nearer = out_.rows[k];
      if (!alike(nearer) || !(nearer.distance_m < row.distance_m)) continue;
      const double lux = nearer.raw_lx - kApart * SigmaLx(k) - most_off_lx;
      const double square = std::pow(nearer.distance_m / row.distance_m, 2.0);
      least = std::max(least, kLeastPart * square * lux);
    }
    return least;
  }

  // A lamp only adds: with it off a meter shows no more at a reading's own place.
  Result<void> CheckOff() const {
    if (!HasDistanceLaw(light_.kind)) return {};
    const std::vector<std::size_t> off = RowsWhere([&](std::size_t j) {
      return !out_.rows[j].lit && !relative_[j].shadow && !relative_[j].no_place;
    });
    double most_off_lx = 0.0;
    for (const std::size_t j : off) most_off_lx = std::max(most_off_lx, out_.rows[j].raw_lx);
    for (std::size_t i = 0; i < out_.rows.size(); ++i) {
      const Observation& row = out_.rows[i];
      if (!row.lit || row.over_range || row.ambient_subtracted || !SeesOtherLight(row)) continue;
      for (const std::size_t j : off) {
        const Observation& dark = out_.rows[j];
        if (dark.instrument != row.instrument || !SamePlace(row, j)) continue;
        const double apart = kApart * std::hypot(SigmaLx(i), SigmaLx(j));
        const double lamp_lx = row.raw_lx - dark.raw_lx;
        if (lamp_lx >= -apart && lamp_lx + apart >= LeastByNearer(i, most_off_lx)) continue;
        return Refused("dark_above_lit", light_.name,
                       "reading " + std::to_string(dark.index) +
                           ": with the lamp off the meter "
                           "showed " +
                           RoundedText(dark.raw_lx, 4) + " lx, with it on at the same place " +
                           RoundedText(row.raw_lx, 4) + ", which leaves " +
                           (lamp_lx > 0.0 ? "less than the lamp gives there by its nearer reading"
                                          : "nothing for the lamp") +
                           ": were the two taken for one another, or did daylight change between "
                           "them? Read both again, one after the other");
      }
    }
    return {};
  }

  // Whether what was read with the lamp off differs from place to place, beyond three standard
  // deviations of each reading.
  [[nodiscard]] bool Differ(const std::vector<std::size_t>& off) const {
    constexpr double kDiffer = 3.0;
    double least = std::numeric_limits<double>::infinity();
    double most = 0.0;
    for (const std::size_t j : off) {
      const double lux = out_.rows[j].raw_lx;
      least = std::min(least, lux + kDiffer * SigmaLx(j));
      most = std::max(most, lux - kDiffer * SigmaLx(j));
    }
    return most > least;
  }

  // Other light that is one everywhere is a parameter. Where it differs from place to place, what
  // was read with the lamp off at a reading's own place is taken from that, and tells of one light
  // everywhere only for readings that have none. One that shows more than the lamp's reading is
  // left to the checks.
  void SubtractOff() {
    const std::vector<std::size_t> off = RowsWhere([&](std::size_t j) {
      return !out_.rows[j].lit && !relative_[j].shadow && !relative_[j].no_place;
    });
    if (!Differ(off)) return;
    std::vector<bool> consumed(out_.rows.size(), false);
    bool some_open = false;
    for (std::size_t i = 0; i < out_.rows.size(); ++i) {
      Observation& row = out_.rows[i];
      if (!row.lit) continue;
      const auto off_here = [&](std::size_t j) {
        const bool here = out_.rows[j].raw_lx < row.raw_lx && SamePlace(row, j);
        if (here) consumed[j] = true;
        return here;
      };
      if (row.differenced || row.ambient_subtracted) {
        std::ranges::for_each(off, off_here);
      } else if (!row.over_range) {
        row.ambient_subtracted = Subtract(i, off, off_here);
      }
      some_open = some_open || !(row.differenced || row.ambient_subtracted);
    }
    if (some_open) return;
    for (std::size_t j = 0; j < consumed.size(); ++j) {
      if (consumed[j]) out_.subtracted.push_back(out_.rows[j].index);
    }
    Keep(consumed);
  }

  // Cutting it at 0 would make the lamp brighter than it is.
  void WarnOfNegative(const Observation& row) {
    out_.warnings.push_back(
        {"negative_difference", light_.name,
         "reading " + std::to_string(row.index) + " (" + RoundedText(row.raw_lx, 4) +
             " lx) shows less than its shadow-card reading; the difference of " +
             RoundedText(row.measured_lx, 3) +
             " lx is kept with its sign: read again where the lamp is brighter"});
  }

  [[nodiscard]] bool SamePlace(const Observation& row, std::size_t j) const {
    if (!HasDistanceLaw(light_.kind)) return true;
    const std::optional<Vec3>& there = out_.rows[j].position_m;
    if (row.position_m && there) return Length(*row.position_m - *there) < kSamePlace;
    return !relative_[j].no_place && SameDistance(row.distance_m, out_.rows[j].distance_m) &&
           row.off_axis_rad == out_.rows[j].off_axis_rad;
  }

  void FillSigmas() {
    double dimmest = std::numeric_limits<double>::infinity();
    double brightest = 0.0;
    for (const Observation& row : out_.rows) {
      if (row.lit && row.raw_lx > 0.0) dimmest = std::min(dimmest, row.raw_lx);
      brightest = std::max(brightest, std::abs(row.raw_lx));
    }
    // With no positive reading at all, the meter's last digit: 0.1 lx.
    const double floor =
        std::isfinite(dimmest) ? kDarkFloor * dimmest : std::max(brightest, 0.1 / std::sqrt(12.0));
    for (std::size_t i = 0; i < out_.rows.size(); ++i) {
      Observation& row = out_.rows[i];
      if (row.differenced || row.ambient_subtracted) continue;
      const double own = SigmaLx(i);
      row.sigma_lx = row.lit && row.raw_lx > 0.0 ? own : std::hypot(own, floor);
    }
  }

  struct Extra {
    double sigma = 0.0;          // relative
    double last_digit_lx = 0.0;  // 1 sigma
    bool shadow = false;
    bool no_place = false;  // an off or shadow reading without a distance
    const SessionReading* source = nullptr;
  };

  const Session& session_;
  const LightDescription& light_;
  Observations out_;
  std::vector<Extra> relative_;            // beside out_.rows
  std::map<int, double> display_step_lx_;  // of each instrument
  std::vector<std::string> instruments_;
};

}  // namespace

void StandMeter(const LightDescription& light, const Reading& reading,
                const ReadingGeometry& geometry, Observation& row) {
  row.distance_m = geometry.distance_m;
  row.tilt_rad = geometry.tilt_rad;
  row.measured_from_center = geometry.from_center;
  row.off_axis_rad = reading.off_axis.value();
  row.position_m = reading.position_m;
  if (reading.normal) row.normal = *reading.normal * (1.0 / Length(*reading.normal));
  row.table_part = TablePartTowards(light, reading);
}

bool HasDistanceLaw(LightKind kind) {
  return kind != LightKind::kDirectional && kind != LightKind::kDome;
}

bool SameDistance(double a_m, double b_m) {
  return std::abs(a_m - b_m) <= 1e-3 * std::max(std::abs(a_m), std::abs(b_m));
}

bool SamePlace(const Reading& a, const Reading& b) {
  constexpr double kSameAngle_rad = 1e-3;
  if (a.position_m && b.position_m) {
    const bool turned = a.normal && b.normal &&
                        Dot(*a.normal, *b.normal) <
                            std::cos(kSameAngle_rad) * Length(*a.normal) * Length(*b.normal);
    return !turned && Length(*a.position_m - *b.position_m) < kSamePlace;
  }
  if (a.distance && b.distance) {
    return SameDistance(a.distance->value(), b.distance->value()) &&
           std::abs(a.tilt.value() - b.tilt.value()) < kSameAngle_rad &&
           std::abs(a.off_axis.value() - b.off_axis.value()) < kSameAngle_rad;
  }
  return !a.distance && !b.distance && !a.position_m && !b.position_m;
}

bool IsCardOf(const SessionReading& row, const Reading& reading) {
  const Reading& card = row.reading;
  return card.shadow_card && card.illuminance && card.light == reading.light &&
         row.others_lit.empty() && SameState(card.state, reading.state) && SamePlace(card, reading);
}

int CountDistinctDistances(const std::vector<Observation>& rows) {
  std::vector<double> distances;
  for (const Observation& row : rows) {
    if (row.lit && !row.over_range) distances.push_back(row.distance_m);
  }
  std::sort(distances.begin(), distances.end());
  int count = 0;
  std::optional<double> last;
  for (const double d : distances) {
    if (last && SameDistance(*last, d)) continue;
    last = d;
    ++count;
  }
  return count;
}

bool HoldsWallLight(const Session& session, const LightDescription& light, const Reading& reading) {
  if (session.surroundings != Surroundings::kIndoors || reading.meter == kDataSheetMeter ||
      !HasDistanceLaw(light.kind)) {
    return false;
  }
  return !ShowsTheLampAlone(reading);
}

Result<Observations> CollectObservations(const Session& session, const LightDescription& light) {
  return Collector(session, light).Collect();
}

}  // namespace lightcal::fit
