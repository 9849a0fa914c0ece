// SPDX-License-Identifier: Apache-2.0
#include "simulate/effect_rows.h"

#include <array>
#include <numeric>
#include <utility>
#include <variant>

#include "lamp_words.h"
#include "lightcal/core/numbers_text.h"

namespace lightcal::app {
namespace {

using records::Node;

constexpr std::array<const char*, kMapForms> kFormWords = {
    "dark", "point", "cone", "2x2", "3x3", "4x4", "exact", "even", "at_point", "interpolated"};
// ns a point on one processor, by form (tests/bench/simulate_bench.cc); kExact by kind.
constexpr std::array<double, kMapForms> kPrice_ns = {0.0,  2.0, 3.0, 6.0, 12.0,
                                                     20.0, 0.0, 0.5, 0.0, 1.5};
constexpr double kWalls_ns = 24000.0;  // WallLight::At
constexpr double kDisk_ns = 17.0, kRect_ns = 80.0, kTube_ns = 440.0, kTable_ns = 60.0,
                 kSphere_ns = 6.0;

double ExactPrice_ns(const LampSource& source) {
  if (std::holds_alternative<DiskSource>(source)) return kDisk_ns;
  if (std::holds_alternative<RectSource>(source)) return kRect_ns;
  if (std::holds_alternative<TubeSource>(source)) return kTube_ns;
  return std::holds_alternative<TableSource>(source) ? kTable_ns : kSphere_ns;
}

std::int64_t Count(const LampAccount& account, MapForm form) {
  return account.points[static_cast<std::size_t>(form)];
}
std::int64_t DirectPoints(const LampAccount& account) {
  return std::accumulate(account.points.begin(),
                         account.points.begin() + static_cast<int>(MapForm::kBounce),
                         std::int64_t{0});
}

// Declared price of what was evaluated for one lamp, nanoseconds of one processor.
double DirectCost_ns(const PlacedLamp& lamp, const LampAccount& account) {
  double cost = static_cast<double>(Count(account, MapForm::kExact)) * ExactPrice_ns(lamp.source);
  for (std::size_t k = 0; k < static_cast<std::size_t>(MapForm::kBounce); ++k) {
    cost += static_cast<double>(account.points[k]) * kPrice_ns[k];
  }
  return cost;
}

double BounceCost_ns(const LampAccount& account) {
  return static_cast<double>(account.bounce_evaluated) * kWalls_ns +
         static_cast<double>(Count(account, MapForm::kBounceBetween)) *
             kPrice_ns[static_cast<std::size_t>(MapForm::kBounceBetween)];
}

std::string PercentOf(std::int64_t part, std::int64_t whole) {
  return RoundedText(100.0 * static_cast<double>(part) / static_cast<double>(whole), 3) + " %";
}

EffectRow SourceRow(const MapSettings& settings, const PlacedLamp& lamp,
                    const LampAccount& account) {
  EffectRow row{lamp.name, "finite_source", "off", "", "", DirectCost_ns(lamp, account),
                {},        Node::Table(),   0};
  const std::int64_t all = DirectPoints(account);
  std::int64_t sized = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(MapForm::kBounce); ++k) {
    const std::int64_t n = account.points[k];
    if (n == 0) continue;
    row.where +=
        (row.where.empty() ? "" : ", ") + std::string(kFormWords[k]) + " " + PercentOf(n, all);
    row.points.Put(kFormWords[k], n);
    const auto form = static_cast<MapForm>(k);
    if (form == MapForm::kGauss2 || form == MapForm::kGauss3 || form == MapForm::kGauss4 ||
        form == MapForm::kExact) {
      sized += n;
    }
  }
  const bool has_size = std::holds_alternative<SphereSource>(lamp.source) ||
                        std::holds_alternative<DiskSource>(lamp.source) ||
                        std::holds_alternative<RectSource>(lamp.source) ||
                        std::holds_alternative<TubeSource>(lamp.source);
  row.evaluations = all - Count(account, MapForm::kDark);
  if (!has_size) {
    row.reason = "no size is known of it; one of 6 cm is held in u95";
    if (IsEverywhere(lamp.source)) row.reason = "has no distance law";
    if (std::holds_alternative<TableSource>(lamp.source)) {
      row.reason = "its table, read at every point";
    }
  } else if (settings.finite_source == EffectChoice::kNever) {
    row.reason = "switched off by name";
  } else {
    row.state = sized > 0 ? "on" : "off";
    row.reason = sized > 0 ? "the ladder's cheapest level within the tolerance, by region"
                           : "a point of its kind is within the tolerance everywhere";
  }
  return row;
}

const char* WhyNoWalls(std::optional<Surroundings> surroundings) {
  switch (surroundings.value_or(Surroundings::kIndoors)) {
    case Surroundings::kDark:
      return "no walls: [room] says dark";
    case Surroundings::kOutdoors:
      return "no walls outdoors: the lamp alone, without the light of the ground";
    case Surroundings::kIndoors:
      break;
  }
  return "no [room] or --room given: the lamp alone; indoors walls add 25 % in the median";
}

EffectRow BounceRow(const MapSettings& settings, const PlacedLamp& lamp, const LampAccount& account,
                    std::optional<Surroundings> surroundings) {
  EffectRow row{lamp.name, "room_bounce", "off", "", "", BounceCost_ns(account),
                {},        Node::Table(), 0};
  const std::int64_t all = DirectPoints(account);
  const std::int64_t between = Count(account, MapForm::kBounceBetween);
  const std::int64_t each = Count(account, MapForm::kBounce);
  row.evaluations = account.bounce_evaluated;
  if (IsEverywhere(lamp.source)) {
    row.reason = "part of what this kind of light is";
  } else if (!settings.room) {
    row.reason = WhyNoWalls(surroundings);
  } else if (settings.room_bounce == EffectChoice::kNever) {
    row.reason = "switched off by name";
  } else {
    row.bound = account.bounce_left_off;
    if (each + between > 0) {
      row.state = "on";
      row.where = PercentOf(each + between, all);
      if (each > 0) row.points.Put("at_point", each);
      if (between > 0) row.points.Put("interpolated", between);
      row.reason = "all bounces at " + std::to_string(account.bounce_evaluated) + " points" +
                   (between > 0 ? ", interpolated between" : "");
    } else {
      row.reason =
          "at most " + PercentText(account.bounce_left_off) + " of its direct light anywhere";
    }
  }
  return row;
}

}  // namespace

std::vector<EffectRow> EffectRowsOf(const std::vector<PlacedLamp>& lamps,
                                    const std::vector<LampAccount>& accounts,
                                    const MapSettings& settings,
                                    std::optional<Surroundings> surroundings) {
  std::vector<EffectRow> rows;
  for (std::size_t k = 0; k < lamps.size(); ++k) {
    rows.push_back(SourceRow(settings, lamps[k], accounts[k]));
    rows.push_back(BounceRow(settings, lamps[k], accounts[k], surroundings));
  }
  return rows;
}

}  // namespace lightcal::app
