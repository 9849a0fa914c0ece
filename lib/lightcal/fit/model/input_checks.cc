// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/input_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "lightcal/core/numbers_text.h"
#include "lightcal/fit/model/uneven_light.h"
#include "lightcal/light/scene.h"

namespace lightcal::fit {
namespace {

struct UnitSlip {
  double ln_ratio;   // of E d^2 in the two groups
  double tolerance;  // room for a distance offset, ambient light and the readings' own sigma
  std::string_view question_high;  // when the odd rows are too high
  std::string_view question_low;
};
constexpr std::array<UnitSlip, 6> kSlips = {{
    {2.375874, 0.22,
     "are their distances in feet, the others' in metres, or did a decimal point slip?",
     "is their illuminance in footcandles, the others' distance in feet, or did a decimal point "
     "slip?"},
    {4.605170, 0.35, "is their distance ten times too large?",
     "is their illuminance in a larger unit, or their distance ten times too small?"},
    {6.907755, 0.45, "is their illuminance in lx, the others' in klx?",
     "is their illuminance in klx?"},
    {7.345862, 0.2, "is their distance in inches?", "is the others' distance in inches?"},
    {9.210340, 0.6, "is their distance in cm?", "is the others' distance in cm?"},
    {13.815511, 0.7, "is their distance in mm?", "is the others' distance in mm?"},
}};

// Longer than what is lit with one lamp: a number in cm or inches taken for metres.
constexpr double kLargestLamp = 12.0;
constexpr double kLargestRoom = 150.0;
constexpr double kFarthestIndoors = 40.0;
constexpr double kFarthestPlace = 300.0;

double FarthestReading(Surroundings surroundings) {
  return surroundings == Surroundings::kOutdoors ? kFarthestPlace : kFarthestIndoors;
}
constexpr const char* kAtDistance = "a reading at a distance";

std::string SayOfLength(const std::string& what, double metres) {
  return what + " of " + RoundedText(metres, 3) + " m";
}
Warning UnitsSuspect(const std::string& light, const std::string& lengths) {
  return {
      "units_suspect", light,
      lengths + ": is that so? A number without a unit is metres; write 120cm or 20in for others"};
}

// Towards a beam's rim a degree of aim outweighs any unit: only its bright part is compared.
// Towards a grazing tilt a degree of it does, and so does the walls' light, which no cosine dims.
constexpr double kBrightPart = 0.3;

bool IsBright(const Observation& row) {
  return row.lit && !row.over_range && !(row.off_axis && row.emission < kBrightPart);
}

struct Strength {
  double ln_candela;  // ln(E d^2/cos tilt)
  int index;
};

std::vector<Strength> Strengths(const Observations& observations) {
  // Ambient light from lamp-off readings would otherwise look like a step of units.
  double ambient = 0.0;
  int count = 0;
  for (const Observation& row : observations.rows) {
    if (row.lit) continue;
    ambient += row.measured_lx;
    ++count;
  }
  if (count > 0) ambient /= count;
  std::vector<Strength> out;
  for (const Observation& row : observations.rows) {
    const double direct = row.measured_lx - (row.differenced ? 0.0 : ambient);
    if (std::cos(row.tilt_rad) < kBrightPart) continue;
    if (!IsBright(row) || !(direct > 2.0 * row.sigma_lx)) continue;
    out.push_back({std::log(direct * row.distance_m * row.distance_m /
                            (std::cos(row.tilt_rad) * row.emission * row.table_part)),
                   row.index});
  }
  std::sort(out.begin(), out.end(),
            [](const Strength& a, const Strength& b) { return a.ln_candela < b.ln_candela; });
  return out;
}

double Middle(const std::vector<Strength>& sorted, std::size_t begin, std::size_t end) {
  const std::size_t n = end - begin;
  return 0.5 * (sorted[begin + (n - 1) / 2].ln_candela + sorted[begin + n / 2].ln_candela);
}

std::string RowList(const std::vector<Strength>& sorted, std::size_t begin, std::size_t end) {
  std::vector<int> rows;
  for (std::size_t i = begin; i < end; ++i) rows.push_back(sorted[i].index);
  std::sort(rows.begin(), rows.end());
  std::string text = rows.size() == 1 ? "reading " : "readings ";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i > 0) text += i + 1 == rows.size() ? " and " : ", ";
    text += std::to_string(rows[i]);
  }
  return text;
}

// E goes as d^slope.
struct Power {
  double slope = 0.0;
  double sd = std::numeric_limits<double>::infinity();
};

// ln of a reading's light facing the lamp, were all of it the lamp's own, which falls on a turned
// meter by the cosine, or all of it from walls on every side.
double LnIfOfTheLamp(const Observation& row, double lux) {
  return std::log(lux / (std::cos(row.tilt_rad) * row.emission * row.table_part));
}
double LnIfOfWalls(const Observation& /*row*/, double lux) { return std::log(lux); }

Power PowerOfDistance(const Observations& observations, const LightDescription& light,
                      double (*ln_of)(const Observation&, double)) {
  const std::vector<double> uneven = UnevenTowards(observations, light);
  // Beside readings with the walls' light others have it too, whatever a card told of it.
  const bool some_open = std::ranges::any_of(
      observations.rows, [](const Observation& row) { return row.lit && !row.differenced; });
  double w = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  const auto for_each_lit = [&](auto&& visit) {
    for (std::size_t i = 0; i < observations.rows.size(); ++i) {
      const Observation& row = observations.rows[i];
      if (!IsBright(row) || !(row.measured_lx > 2.0 * row.sigma_lx)) continue;
      const double sigma =
          std::hypot(row.sigma_lx / row.measured_lx, uneven.empty() ? 0.0 : uneven[i]);
      const double card_lx = some_open && row.differenced ? LeftByCard_lx(row) : 0.0;
      visit(1.0 / (sigma * sigma), std::log(row.distance_m), ln_of(row, row.measured_lx + card_lx));
    }
  };
  for_each_lit([&](double weight, double ln_d, double ln_e) {
    w += weight;
    x += weight * ln_d;
    y += weight * ln_e;
  });
  if (!(w > 0.0)) return {};
  x /= w;
  y /= w;
  for_each_lit([&](double weight, double ln_d, double ln_e) {
    xx += weight * (ln_d - x) * (ln_d - x);
    xy += weight * (ln_d - x) * (ln_e - y);
  });
  if (!(xx > 0.0)) return {};
  return {xy / xx, 1.0 / std::sqrt(xx)};
}

}  // namespace

Result<void> CheckUnits(const Observations& observations, const std::string& light) {
  const std::vector<Strength> sorted = Strengths(observations);
  if (sorted.size() < 2) return {};
  std::size_t cut = 1;
  for (std::size_t i = 2; i < sorted.size(); ++i) {
    if (sorted[i].ln_candela - sorted[i - 1].ln_candela >
        sorted[cut].ln_candela - sorted[cut - 1].ln_candela) {
      cut = i;
    }
  }
  const double gap = sorted[cut].ln_candela - sorted[cut - 1].ln_candela;
  const double within = std::max(sorted[cut - 1].ln_candela - sorted.front().ln_candela,
                                 sorted.back().ln_candela - sorted[cut].ln_candela);
  if (within > 0.5 * gap) return {};
  const double apart = Middle(sorted, cut, sorted.size()) - Middle(sorted, 0, cut);
  for (const UnitSlip& slip : kSlips) {
    if (std::abs(apart - slip.ln_ratio) > slip.tolerance) continue;
    const bool high_is_odd = sorted.size() - cut <= cut;
    const std::string odd =
        high_is_odd ? RowList(sorted, cut, sorted.size()) : RowList(sorted, 0, cut);
    const std::string ratio = RoundedText(std::exp(apart), 3);
    if (CountDistinctDistances(observations.rows) == 1) {
      return Refused("units_ambiguous", light,
                     odd + " (counted from 0): about " +
                         (high_is_odd ? ratio + " times" : "1/" + ratio + " of") +
                         " what the others read at the same distance: was the lamp set otherwise, "
                         "or did a decimal point slip? Correct it, or take it back");
    }
    return Refused(
        "units_ambiguous", light,
        odd +
            (high_is_odd ? " (counted from 0): about " + ratio +
                               " times the E d^2 of the others: " + std::string(slip.question_high)
                         : " (counted from 0): about 1/" + ratio +
                               " of the E d^2 of the others: " + std::string(slip.question_low)) +
            " Write units, or correct the rows; if it is ambient light, add a lamp-off "
            "reading");
  }
  return {};
}

Result<void> CheckFalloff(const Observations& observations, const LightDescription& described,
                          Warnings& warnings) {
  const std::string& light = described.name;
  if (CountDistinctDistances(observations.rows) < 2) return {};
  // Which part of it is walls' light nobody knows yet: what both readings of it say.
  const Power lamp = PowerOfDistance(observations, described, &LnIfOfTheLamp);
  const Power walls = PowerOfDistance(observations, described, &LnIfOfWalls);
  const auto [slope, sd] = lamp.slope < walls.slope ? lamp : walls;
  if (!std::isfinite(sd)) return {};
  if (slope > 2.0 * sd) {
    return Refused("increasing_with_distance", light,
                   "illuminance grows with distance (as d^" + RoundedText(slope, 2) +
                       "); check that distances and readings belong together and that one lamp "
                       "alone was on");
  }
  if (slope - 2.0 * sd > -0.5) {
    warnings.push_back(
        {"slow_falloff", light,
         "illuminance falls only as d^" + RoundedText(slope, 2) +
             "; most of it is ambient light or bounce: add a shadow-card or lamp-off "
             "reading"});
  }
  return {};
}

void CheckRoom(const Session& session, const LightDescription& light, Warnings& warnings) {
  if (!session.room) return;
  const Vec3& size = session.room->size_m;
  std::string outside;
  const auto add = [&](const std::string& what) {
    outside += (outside.empty() ? "" : ", ") + what;
  };
  if (light.position_m && !IsInRoom(*light.position_m, size)) add("the lamp");
  int index = 0;  // over the light's readings
  for (const SessionReading& row : session.readings) {
    if (row.reading.light != light.name) continue;
    const auto& place = row.reading.position_m;
    if (place && !IsInRoom(*place, size)) add("reading " + std::to_string(index));
    const auto& distance = row.reading.distance;
    if (distance && distance->value() > Length(size)) {
      add("reading " + std::to_string(index) + " at " + RoundedText(distance->value(), 3) + " m");
    }
    ++index;
  }
  if (outside.empty()) return;
  warnings.push_back(
      {"outside_room", light.name,
       outside + " (counted from 0) stands outside the [room], which reaches from -" +
           RoundedText(0.5 * size[0], 3) + " to " + RoundedText(0.5 * size[0], 3) + " m in x, -" +
           RoundedText(0.5 * size[1], 3) + " to " + RoundedText(0.5 * size[1], 3) +
           " m in y, 0 to " + RoundedText(size[2], 3) +
           " m in z; its walls' light is a guess: correct the places, the distances or size_m"});
}

Result<void> CheckLengths(const Session& session, const LightDescription& light,
                          Warnings& warnings) {
  const bool no_rect = light.kind == LightKind::kRect && !(light.width && light.height);
  const bool no_disk = light.kind == LightKind::kDisk && !light.diameter;
  const bool no_tube = light.kind == LightKind::kTube && !light.length;
  const bool read = std::ranges::any_of(session.readings, [&](const SessionReading& row) {
    return row.reading.light == light.name && row.reading.illuminance &&
           row.reading.meter != kDataSheetMeter;
  });
  if (read && (no_rect || no_disk || no_tube)) {
    const std::string key = no_rect   ? "size_m = [width, height]"
                            : no_disk ? "diameter_m"
                                      : "length_m (and radius_m)";
    return Refused("size_missing", light.name,
                   "a " + std::string(LightKindName(light.kind)) +
                       " has a size, and near it light "
                       "falls otherwise than with the square: give " +
                       key + ", or kind = \"point\" where nobody knows it");
  }
  std::string suspect;
  const auto hold = [&](const std::string& what, double metres, double largest) {
    if (!(metres > largest)) return;
    suspect += (suspect.empty() ? "" : ", ") + SayOfLength(what, metres);
  };
  for (const auto& side : {light.diameter, light.width, light.height, light.length}) {
    if (side) hold("a lamp", side->value(), kLargestLamp);
  }
  if (light.position_m) hold("a lamp's place", Length(*light.position_m), kFarthestPlace);
  if (session.room) {
    const Vec3& size = session.room->size_m;
    hold("a room", std::max({size[0], size[1], size[2]}), kLargestRoom);
  }
  double most = 0.0;
  for (const SessionReading& row : session.readings) {
    const Reading& reading = row.reading;
    if (reading.light != light.name || light.kind == LightKind::kDirectional) continue;
    if (reading.distance) most = std::max(most, reading.distance->value());
  }
  hold(kAtDistance, most, FarthestReading(session.surroundings));
  if (!suspect.empty()) warnings.push_back(UnitsSuspect(light.name, suspect));
  return {};
}

std::optional<Warning> DoubtOfDistance(Surroundings surroundings, const std::string& light,
                                       Metres distance) {
  if (!(distance.value() > FarthestReading(surroundings))) return std::nullopt;
  return UnitsSuspect(light, SayOfLength(kAtDistance, distance.value()));
}

}  // namespace lightcal::fit
