// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/other_light_taken.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "lightcal/core/joined.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/fit/model/rows_behind.h"

namespace lightcal::fit {
namespace {

// A meter's reading of nothing is known to half a percent of the dimmest reading that counts: its
// resolution and dark offset. Relative, so that the fit has no scale of its own.
constexpr double kDarkFloor = 0.005;
constexpr double kSwapped = 0.1;  // of the lit reading, below its shadow-card reading
constexpr double kApart = 4.0;    // standard deviations that no two readings of one light lie apart

class OtherLight : private RowsBehind {
 public:
  using RowsBehind::RowsBehind;

  Result<void> Take() {
    if (auto separated = SubtractOthers(); !separated) return separated;
    if (auto taken = SubtractShadows(); !taken) return taken;
    if (auto off = CheckOff(); !off) return off;
    FindDrift();
    SubtractOff();
    FillSigmas();
    return {};
  }

 private:
  // Readings with other lamps lit become differences; what they were subtracted from goes.
  Result<void> SubtractOthers() {
    std::vector<bool> gone(out_.rows.size(), false);
    const std::vector<std::size_t> off =
        RowsWhere([&](std::size_t j) { return !out_.rows[j].lit; });
    int separated = 0;
    int mixed = 0;
    for (std::size_t i = 0; i < out_.rows.size(); ++i) {
      const std::vector<std::string>& others = behind_[i].source->others_lit;
      if (others.empty()) continue;
      if (!out_.rows[i].lit) {
        gone[i] = true;
        continue;
      }
      ++mixed;
      const auto lamp_off = [&](std::size_t j) {
        const SessionReading& reading = *behind_[j].source;
        return reading.others_lit == others && reading.place == behind_[i].source->place;
      };
      gone[i] = out_.rows[i].over_range || !(Subtract(i, off, lamp_off) || SubtractParts(i, off));
      if (!gone[i]) {
        if (auto more = CheckAdds(out_.rows[i], others); !more) return more;
      }
      out_.rows[i].ambient_subtracted = !gone[i];
      separated += gone[i] ? 0 : 1;
    }
    const bool alone = std::any_of(out_.rows.begin(), out_.rows.end(), [&](const Observation& o) {
      return o.lit && behind_[&o - out_.rows.data()].source->others_lit.empty();
    });
    if (mixed > 0 && separated == 0 && !alone) {
      return Refused("not_separated", light_.name,
                     "other lamps were lit in every reading of this one; read the same place once "
                     "more with it off and the same others lit");
    }
    Keep(gone);
    return {};
  }

  // The others lit were read there too, without this lamp, in parts that make them all: their light
  // adds up, and each part holds once what shines with none of them.
  bool SubtractParts(std::size_t i, const std::vector<std::size_t>& off) {
    const SessionReading& lit = *behind_[i].source;
    std::vector<std::string> left = lit.others_lit;
    const auto others_at = [&](std::size_t j) -> const std::vector<std::string>& {
      static const std::vector<std::string> kNone;
      const SessionReading& reading = *behind_[j].source;
      const bool here = lit.place >= 0 && reading.place == lit.place && !out_.rows[j].over_range;
      return here ? reading.others_lit : kNone;
    };
    MeanLux parts;
    int count = 0;
    for (; !left.empty(); ++count) {
      std::vector<std::string> part;
      for (const std::size_t j : off) {
        const std::vector<std::string>& those = others_at(j);
        if (those.size() > part.size() && std::ranges::includes(left, those)) part = those;
      }
      if (part.empty()) return false;
      const auto mean = MeanOf(i, off, [&](std::size_t j) { return others_at(j) == part; });
      parts.lux += mean->lux;
      parts.sigma_lx = std::hypot(parts.sigma_lx, mean->sigma_lx);
      std::erase_if(left, [&](const std::string& name) {
        return std::ranges::find(part, name) != part.end();
      });
    }
    std::vector<std::size_t> none = RowsOff();
    std::erase_if(none, [&](std::size_t j) { return !behind_[j].source->others_lit.empty(); });
    if (!none.empty()) {
      const auto here = [&](std::size_t j) { return SamePlace(out_.rows[i], j); };
      const MeanLux each = MeanOf(i, none, here).value_or(Elsewhere(none));
      parts.lux -= (count - 1) * each.lux;
      parts.sigma_lx = std::hypot(parts.sigma_lx, (count - 1) * each.sigma_lx);
    }
    TakeFrom(i, parts);
    return true;
  }

  // A lamp only adds, whatever else is lit.
  Result<void> CheckAdds(const Observation& row, const std::vector<std::string>& others) const {
    if (row.measured_lx >= -std::max(kSwapped * row.raw_lx, kApart * row.sigma_lx)) return {};
    return Refused("dark_above_lit", light_.name,
                   "reading " + std::to_string(row.index) + ": with " + Joined(others, ", ") +
                       " lit and this lamp off the meter showed " + RoundedText(row.card_lx, 4) +
                       " lx, with this one on too " + RoundedText(row.raw_lx, 4) +
                       ": a lamp only adds light. Were the two taken for one another, or did a "
                       "lamp change between them? Read both again");
  }

  Result<void> SubtractShadows() {
    if (out_.shadow_readings == 0) return {};
    std::vector<bool> consumed(out_.rows.size(), false);
    const std::vector<std::size_t> shadows =
        RowsWhere([&](std::size_t j) { return behind_[j].shadow; });
    for (std::size_t i = 0; i < out_.rows.size(); ++i) {
      const Observation& row = out_.rows[i];
      if (!row.lit || row.over_range || row.ambient_subtracted) continue;
      const auto shadow = [&](std::size_t j) {
        const bool here = SamePlace(row, j);
        if (here) consumed[j] = true;
        return here;
      };
      if (!Subtract(i, shadows, shadow)) continue;
      behind_[i].drift_lx = PartByOthers(row) * row.card_lx * DriftOf(i, shadows, shadow);
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
      if (!behind_[i].shadow) continue;
      out_.warnings.push_back({"shadow_unmatched", light_.name,
                               "a shadow-card reading has no lamp-on reading at its distance; it "
                               "counts as ambient light, within 30 %"});
      out_.rows[i].behind_card = !behind_[i].no_place;
      behind_[i].sigma = std::hypot(behind_[i].sigma, kSigmaElsewhere);
    }
    Keep(consumed);
    return {};
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
    const std::vector<std::size_t> off = RowsOff();
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

  // What a card left is others' light or what walls send back of the lamp's own, which does not
  // drift: from none of it to all.
  [[nodiscard]] static double PartByOthers(const Observation& row) {
    return row.sees_walls ? 1.0 / std::sqrt(3.0) : 1.0;
  }

  // With the lamp off it is read how much of it all is others'. Named lamps do not drift.
  void FindDrift() {
    const std::vector<std::size_t> off =
        RowsWhere([&](std::size_t j) { return !out_.rows[j].lit && !behind_[j].shadow; });
    if (off.empty()) return;
    const double mean_lx = Elsewhere(off).lux;
    const auto any = [](std::size_t) { return true; };
    for (std::size_t i = 0; i < out_.rows.size(); ++i) {
      const Observation& row = out_.rows[i];
      if (!row.lit || row.ambient_subtracted || !SeesOtherLight(row)) continue;
      const auto here = [&](std::size_t j) { return SamePlace(row, j); };
      const std::optional<MeanLux> there = MeanOf(i, off, here);
      const double other_lx = there ? there->lux : mean_lx;
      if (row.differenced) {
        const double all = PartByOthers(row) * row.card_lx;
        if (all > 0.0) behind_[i].drift_lx *= std::min(other_lx, row.card_lx) / all;
        continue;
      }
      behind_[i].drift_lx = other_lx * (there ? DriftOf(i, off, here) : DriftOf(i, off, any));
      for (const std::size_t j : off) {
        const double lux = Drift(i, j) * out_.rows[j].raw_lx;
        double& least = behind_[j].drift_lx;
        least = least == 0.0 ? lux : std::min(least, lux);
      }
    }
  }

  // Other light that is one everywhere is a parameter. Where it differs from place to place, what
  // was read with the lamp off at a reading's own place is taken from that and from what was read
  // behind a card there; from readings that have none, what places differ by. One that shows more
  // than the lamp's reading is left to the checks.
  void SubtractOff() {
    const std::vector<std::size_t> off = RowsOff();
    if (off.empty()) return;
    const bool differ = Differ(off);
    const MeanLux elsewhere = Elsewhere(off);
    for (std::size_t i = 0; i < out_.rows.size(); ++i) {
      Observation& row = out_.rows[i];
      const bool card = !row.lit && behind_[i].shadow;
      if ((!row.lit && !card) || row.ambient_subtracted || !SeesOtherLight(row)) continue;
      const auto off_here = [&](std::size_t j) {
        return (card || out_.rows[j].raw_lx < row.raw_lx) && SamePlace(row, j);
      };
      const MeanLux other = MeanOf(i, off, off_here).value_or(elsewhere);
      if (row.differenced) {
        row.card_other_lx = other.lux;
        if (differ) row.card_sigma_lx = std::hypot(row.card_sigma_lx, other.sigma_lx);
      } else if (differ) {
        TakeFrom(i, other);
      }
      row.ambient_subtracted = differ;
    }
    if (!differ) return;
    std::vector<bool> gone(out_.rows.size(), false);
    for (const std::size_t j : off) {
      gone[j] = true;
      out_.subtracted.push_back(out_.rows[j].index);
    }
    Keep(gone);
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
      if (row.differenced || row.ambient_subtracted) {
        row.sigma_lx = std::hypot(row.sigma_lx, behind_[i].drift_lx);
        continue;
      }
      // Half the variance of a pair's drift is either reading's.
      const double own = std::hypot(SigmaLx(i), behind_[i].drift_lx / std::numbers::sqrt2);
      row.sigma_lx = row.lit && row.raw_lx > 0.0 ? own : std::hypot(own, floor);
    }
  }
};

}  // namespace

Result<void> TakeOtherLight(const LightDescription& light, std::vector<ReadingBehind> behind,
                            Observations& observations) {
  return OtherLight(light, observations, std::move(behind)).Take();
}

}  // namespace lightcal::fit
