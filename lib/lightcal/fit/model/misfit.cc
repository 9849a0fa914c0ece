// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/misfit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units.h"
#include "lightcal/core/units_text.h"
#include "lightcal/fit/model/hypotheses.h"
#include "lightcal/fit/model/row_reports.h"
#include "lightcal/fit/model/starts.h"

namespace lightcal::fit {
namespace {

constexpr double kLeastProbability = 1e-3;
constexpr double kLeastProbabilityOfRest = 0.05;
constexpr double kMostRatio = 3.0;     // of scatter over sigma that an answer is worth having with
constexpr double kLeastMisfit = 0.04;  // rms in ln E, below which widening is answer enough
constexpr int kFewestDistances = 3;
constexpr double kNeverSd = 4.0;  // standard deviations of a fixture's offset
// Where a softbox starts, measured from its mount, and four standard deviations deeper (fixture.h).
constexpr double kSoftbox_m = 0.3, kDeepest_m = 0.6;
constexpr int kFewestRepeats = 3;  // degrees of freedom

// Chi-squared with the priors, and the degrees of freedom: each prior is a row and a parameter.
struct Contradiction {
  double chi_squared = 0.0;
  int dof = 0;

  [[nodiscard]] double Probability() const {
    return dof > 0 ? ChiSquaredTail(chi_squared, dof) : 1.0;
  }
  [[nodiscard]] double Ratio() const { return dof > 0 ? std::sqrt(chi_squared / dof) : 1.0; }
};
Contradiction ContradictionOf(const Estimation& estimation, const Theta& theta) {
  Contradiction out{2.0 * HalfChiSquared(estimation, theta), 0};
  for (const ReadingRow& row : estimation.rows) out.dof += row.form != RowForm::kCensored ? 1 : 0;
  for (const ParameterRule& rule : estimation.rules) {
    if (rule.free && !(rule.prior_sd > 0.0)) --out.dof;
  }
  return out;
}

struct ReadAt {
  double distance_m = 0.0;
  double residual = 0.0;
  int row = 0;
  bool rejected = false;
};
std::vector<ReadAt> ReadingsByDistance(const RobustEstimate& estimate, const Estimation& all,
                                       const Prepared& prepared, const Observations& observations) {
  std::vector<ReadAt> out;
  for (int i = 0; i < prepared.own_rows; ++i) {
    const ReadingRow& row = all.rows[static_cast<std::size_t>(i)];
    if (!(row.direct_gain > 0.0) || row.form == RowForm::kCensored) continue;
    const auto at = static_cast<std::size_t>(prepared.observation[static_cast<std::size_t>(i)]);
    out.push_back({observations.rows[at].distance_m, RowResidual(row, estimate.theta), i,
                   std::ranges::binary_search(estimate.rejected, i)});
  }
  std::ranges::stable_sort(out, {}, &ReadAt::distance_m);
  return out;
}

// How much repeated readings differ beyond their sigma: noise is no misfit.
double NoiseRatio(const std::vector<ReadAt>& places) {
  double squares = 0.0;
  int dof = 0;
  for (std::size_t first = 0; first < places.size();) {
    std::size_t last = first;
    double sum = 0.0;
    for (; last < places.size() && SameDistance(places[first].distance_m, places[last].distance_m);
         ++last) {
      sum += places[last].residual;
    }
    const double mean = sum / static_cast<double>(last - first);
    dof += static_cast<int>(last - first) - 1;
    for (; first < last; ++first) squares += std::pow(places[first].residual - mean, 2.0);
  }
  return dof >= kFewestRepeats ? std::max(1.0, std::sqrt(squares / dof)) : 1.0;
}

double RmsOf(const Estimation& kept, const Theta& theta) {
  double squares = 0.0;
  int count = 0;
  for (const ReadingRow& row : kept.rows) {
    if (row.form != RowForm::kLog || !(row.direct_gain > 0.0)) continue;
    squares += std::pow(RowResidual(row, theta) * row.sigma, 2.0);
    ++count;
  }
  return count > 0 ? std::sqrt(squares / count) : 0.0;
}

// Whether widening is answer enough to what a lamp leaves unexplained of its readings.
bool IsSmall(const Estimation& kept, const Theta& theta, double noise) {
  return ContradictionOf(kept, theta).Ratio() <= kMostRatio * noise ||
         RmsOf(kept, theta) < kLeastMisfit;
}

// The same where four readings were put on Huber's loss, which goes to one of two lamps by a hair
// of their sigmas: that no lamp gives them is said only where neither does.
bool IsSmallOfEither(const RobustEstimate& estimate, double noise) {
  if (IsSmall(estimate.kept, estimate.theta, noise)) return true;
  if (estimate.suspicious.empty()) return false;
  for (const Theta& start : {StartOf(estimate.kept), estimate.theta}) {
    Estimation kept = estimate.kept;
    const Result<Theta> theta = SolveSettledFrom(start, kept);
    if (theta && IsSmall(kept, *theta, noise)) return true;
  }
  return false;
}

// Blunders are few and fall anywhere: half of the readings, or neighbours that err together, are
// something else.
bool RejectedAsNoBlunders(const std::vector<ReadAt>& places) {
  int run = 0;
  int most = 0;
  int count = 0;
  const ReadAt* before = nullptr;
  for (const ReadAt& place : places) {
    count += place.rejected ? 1 : 0;
    const bool together = place.rejected && before != nullptr && before->rejected &&
                          (place.residual > 0.0) == (before->residual > 0.0);
    run = together ? run + 1 : (place.rejected ? 1 : 0);
    most = std::max(most, run);
    before = &place;
  }
  const auto all = static_cast<int>(places.size());
  return 2 * count >= all || (most >= 2 && most == count && 4 * count > all);
}

// The one reading without which the rest agree.
std::optional<std::string> OneReading(const Estimation& all, const Prepared& prepared,
                                      const Observations& observations) {
  if (all.rows.size() < 4 || all.rows.size() > 40) return std::nullopt;
  for (int i = 0; i < prepared.own_rows; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (!(all.rows[at].direct_gain > 0.0)) continue;
    Estimation rest = all;
    rest.rows = Without(all.rows, {i});
    const Result<Theta> theta = SolveSettled(rest);
    if (!theta || ContradictionOf(rest, *theta).Probability() < kLeastProbabilityOfRest) continue;
    const Observation& o = observations.rows[static_cast<std::size_t>(prepared.observation[at])];
    const double ratio = all.rows[at].measured / RowIlluminance(all.rows[at], theta->data());
    const double foot = std::abs(std::log(ratio / kLuxPerFootcandle));
    const std::string apart =
        NameOfReading(o) + " alone contradicts the others, by a factor of " + RoundedText(ratio, 3);
    if (foot < 0.1) return apart + ": was its distance read in feet?";
    return apart + ": read it again, or was it another lamp's?";
  }
  return std::nullopt;
}

// Readings beside the axis of a beam that was taken for a lamp shining alike all round, or of a
// table's lamp that hangs otherwise than was said.
std::optional<std::string> Beam(const std::vector<ReadAt>& places, const Prepared& prepared,
                                const Observations& observations) {
  constexpr double kAside = 5.0 * kRadiansPerDegree;
  double largest = 0.0;
  for (const ReadAt& a : places) {
    for (const ReadAt& b : places) {
      const auto& p = observations.rows[static_cast<std::size_t>(
          prepared.observation[static_cast<std::size_t>(a.row)])];
      const auto& q = observations.rows[static_cast<std::size_t>(
          prepared.observation[static_cast<std::size_t>(b.row)])];
      if (!p.position_m || !q.position_m || !p.normal || !q.normal) return std::nullopt;
      largest = std::max(largest, std::acos(std::clamp(Dot(*p.normal, *q.normal), -1.0, 1.0)));
    }
  }
  if (largest < kAside) return std::nullopt;
  const std::string apart = "readings " + RoundedText(DegreesFromRadians(Radians(largest)), 2) +
                            " degrees apart as seen from the lamp ";
  const bool by_table = std::ranges::any_of(
      observations.rows, [](const Observation& row) { return row.table_part != 1.0; });
  if (by_table) {
    return apart +
           "do not fall as its file says: does it aim elsewhere, is it turned about its aim "
           "({light.axis}, where C0 points), or is the file another lamp's?";
  }
  return apart +
         "fall faster than distance explains: it is a beam; describe it as kind = \"spot\" with "
         "its aim";
}

std::string CauseOf(const std::vector<ReadAt>& places, bool at_bound, const Estimation& all,
                    const Prepared& prepared, const Observations& observations) {
  if (auto beam = Beam(places, prepared, observations)) return *beam;
  if (auto apart = FirstUnrepeated(observations)) return *apart;
  if (auto one = OneReading(all, prepared, observations)) return *one;
  if (at_bound) {
    return "they fall faster with distance than any lamp's light: do the distances start where its "
           "light does, and did the meter stay on the axis of its beam?";
  }
  if (BetweenPlaces(observations)) return std::string(kAskForPlaces);
  for (std::size_t i = 1; i < places.size(); ++i) {
    const ReadingRow& near = all.rows[static_cast<std::size_t>(places[i - 1].row)];
    const ReadingRow& far = all.rows[static_cast<std::size_t>(places[i].row)];
    const bool brighter_from_here =
        std::all_of(places.begin() + static_cast<std::ptrdiff_t>(i), places.end(),
                    [](const ReadAt& place) { return place.residual > kMostRatio; });
    if (far.measured > near.measured || brighter_from_here) {
      const auto at =
          static_cast<std::size_t>(prepared.observation[static_cast<std::size_t>(places[i].row)]);
      return "from " + NameOfReading(observations.rows[at]) +
             " on there is more light than one lamp gives: does another shine too? Switch it off, "
             "or read the same places once with this lamp off";
    }
  }
  return "check that every reading is of this lamp, in lux, at its distance in metres";
}

// Of the parts that an offset may come from, the least standard deviations it lies from one.
double DeviationsFrom(std::span<const OffsetPart> parts, const FoundOffset& found) {
  double least = std::numeric_limits<double>::infinity();
  for (const OffsetPart& part : parts) {
    least =
        std::min(least, std::abs(found.metres - part.mean_m) / std::hypot(part.sd_m, found.sd_m));
  }
  return least;
}

bool OfAnyFixture(std::span<const OffsetPart> parts) {
  return std::ranges::equal(parts, OffsetParts(std::nullopt), {}, &OffsetPart::mean_m,
                            &OffsetPart::mean_m);
}

// The distance of one of two readings at which the other would be an ordinary lamp's: "; 12.5 lx
// at 2 m, or 200 lx at 0.25 m, would be".
std::string DistancesThatSuit(const Observations& observations, double usual_m) {
  const Observation* near = nullptr;
  const Observation* far = nullptr;
  for (const Observation& o : observations.rows) {
    if (!o.lit || o.over_range || !(o.measured_lx > 0.0)) continue;
    if (near == nullptr || o.distance_m < near->distance_m) near = &o;
    if (far == nullptr || o.distance_m > far->distance_m) far = &o;
  }
  if (near == nullptr || SameDistance(near->distance_m, far->distance_m)) return {};
  const auto told = [&](const Observation& wrong, const Observation& right) {
    const double metres =
        (right.distance_m + usual_m) * std::sqrt(right.measured_lx / wrong.measured_lx) - usual_m;
    return RoundedText(wrong.raw_lx, 4) + " lx at " + RoundedText(metres, 2) + " m";
  };
  return "; " + told(*far, *near) + ", or " + told(*near, *far) + ", would be an ordinary lamp's";
}

// Whether what is called a bulb starts where a globe does that is counted from its glass: at its
// centre.
bool StartsAsGlobe(const FoundOffset& found, const ForwardModel& model) {
  constexpr double kSmallest_m = 0.05, kLargest_m = 0.35;  // radius
  const auto a_point = [](const auto& one) { return one.width_m == 0.0; };
  const OffsetPart of_bulb = OffsetParts(Fixture::kBulb).front();
  const bool bulb = model.offsets.size() == 1 && model.offsets.front().mean_m == of_bulb.mean_m &&
                    model.offsets.front().sd_m == of_bulb.sd_m &&
                    model.shape.outline == AxialShape::Outline::kPoint &&
                    model.surface_radius_m == 0.0 && std::ranges::all_of(model.walls, a_point) &&
                    std::ranges::all_of(model.makes, a_point);
  return bulb && found.metres > kSmallest_m && found.metres < kLargest_m;
}

std::string WhereItStarts(double offset_m) {
  return RoundedText(std::abs(offset_m), 2) + " m " + (offset_m < 0.0 ? "before" : "behind") +
         " the point that distances are counted from";
}

}  // namespace

std::string NameOfReading(const Observation& o) {
  return "reading " + std::to_string(o.index) + " (" + RoundedText(o.raw_lx, 4) + " lx at " +
         RoundedText(o.distance_m, 4) + " m)";
}

bool BetweenPlaces(const Observations& observations) {
  return std::ranges::all_of(observations.rows, [](const Observation& o) {
    return !o.lit || (o.position_m && o.measured_from_center);
  });
}

double ChiSquaredTail(double chi_squared, double dof) {
  const double spread = 2.0 / (9.0 * dof);
  const double z = (std::cbrt(chi_squared / dof) - (1.0 - spread)) / std::sqrt(spread);
  return 0.5 * std::erfc(z / std::numbers::sqrt2);
}

Result<void> CheckMisfit(const RobustEstimate& estimate, const Estimation& all,
                         const Prepared& prepared, const Observations& observations,
                         const std::string& light, Warnings& warnings) {
  if (prepared.distances < kFewestDistances || estimate.bimodal) return {};
  const std::vector<ReadAt> places = ReadingsByDistance(estimate, all, prepared, observations);
  Contradiction left = ContradictionOf(estimate.kept, estimate.theta);
  const double noise = NoiseRatio(places);
  left.chi_squared /= noise * noise;
  const bool contradicted = left.Probability() < kLeastProbability;
  const bool at_bound = all.rules[kDistanceOffset].free &&
                        estimate.theta[kDistanceOffset] <= all.least_distance_offset * (1.0 - 1e-6);
  const bool no_blunders = RejectedAsNoBlunders(places);
  if (!no_blunders && !at_bound && !contradicted) return {};
  // Whose figures are printed cannot read again.
  const bool printed =
      std::ranges::all_of(observations.rows, [](const Observation& o) { return o.data_sheet; });
  if (printed && !contradicted) return {};
  if (printed || (!no_blunders && !at_bound && IsSmallOfEither(estimate, noise))) {
    warnings.push_back({"misfit", light,
                        "the readings contradict one another by " + RoundedText(left.Ratio(), 2) +
                            " times what their sigma allows; the interval is widened by it: check "
                            "the distances, and for other light"});
    return {};
  }
  return Refused(
      "model_misfit", light,
      "no lamp gives these readings: " + CauseOf(places, at_bound, all, prepared, observations));
}

Result<void> CheckOffset(const FoundOffset& found, const ForwardModel& model, int distances,
                         const Observations& observations, const std::string& light,
                         Warnings& warnings) {
  if (!model.fit_offset || model.offsets.empty() || distances < 2) return {};
  const bool printed =
      std::ranges::any_of(observations.rows, [](const Observation& o) { return o.data_sheet; });
  if (printed) return {};
  const std::span<const OffsetPart> parts = model.offsets;
  const double metres = std::abs(found.metres);
  const bool any = OfAnyFixture(parts);
  const double usual_m = any ? 0.0 : parts.front().mean_m;  // 0: the median of any
  const bool no_such_lamp = DeviationsFrom(parts, found) > kNeverSd;
  const bool unconfirmed = distances < kFewestDistances;
  const bool refused = unconfirmed ? no_such_lamp || (any && metres - 2.0 * found.sd_m > kSoftbox_m)
                                   : no_such_lamp && metres > kDeepest_m;
  const std::string softbox =
      any ? "; of a softbox or a lantern counted from its mount say so by {light.fixture}" : "";
  if (refused) {
    std::string cause = BetweenPlaces(observations)
                            ? std::string(kAskForPlaces)
                            : "is a distance wrong, or counted from elsewhere on the lamp?";
    if (StartsAsGlobe(found, model)) {
      cause +=
          " A globe counted from its glass starts there: describe it as kind = \"sphere\" with its "
          "diameter.";
    }
    if (unconfirmed) cause += " Read a third distance" + softbox;
    return Refused("model_misfit", light,
                   "no lamp gives these readings: their light would have to start " +
                       WhereItStarts(found.metres) +
                       (unconfirmed ? DistancesThatSuit(observations, usual_m) : "") + ": " +
                       cause);
  }
  // Most lamps of an unknown fixture.
  if (!any || !unconfirmed || DeviationsFrom(parts.first(1), found) <= kNeverSd) return {};
  warnings.push_back(
      {"prior_conflict", light,
       "the light starts " + WhereItStarts(found.metres) + ", if both distances are right" +
           DistancesThatSuit(observations, usual_m) + ": check them, or read a third" + softbox});
  return {};
}

}  // namespace lightcal::fit
