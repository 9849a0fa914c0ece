// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/plan/reading_candidates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numbers>

#include "lightcal/core/units.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/light/models/receiver.h"
#include "lightcal/light/scene.h"

namespace lightcal::fit {
namespace {

constexpr double kNearest = 0.25;             // metres a person holds a meter from a lamp
constexpr double kNearestUnknown = 0.5;       // from one of unknown make and size, and a panel
constexpr double kNearestSoftbox = 1.0;       // of unknown size
constexpr double kStep = 2.8284271247461903;  // sqrt(8): three of them span 8 : 1
constexpr int kPlaneSteps = 2;                // to each side
constexpr double kPlaceSpread = 1.25;
constexpr double kPlaceRounding_m = 0.01;
constexpr std::size_t kMostCards = 9;  // places that a shadow card is tried at

// Length of what a meter must stay clear of.
double SizeOf(const LightDescription& light) {
  double size = 0.0;
  for (const auto& length : {light.diameter, light.width, light.height, light.length}) {
    if (length) size = std::max(size, length->value());
  }
  return size;
}

double UnitOfLength(double metres) { return metres < 1.0 ? 0.01 : 0.1; }
double RoundedLength(double metres) {
  const double unit = UnitOfLength(metres);
  return std::round(metres / unit) * unit;
}
// Rounded, but no longer than `most`.
double RoundedWithin(double metres, double most) {
  const double rounded = RoundedLength(std::min(metres, most));
  const double unit = UnitOfLength(metres);
  return rounded > most * (1.0 + 1e-9) ? std::floor(most / unit + 1e-9) * unit : rounded;
}

// How far a meter can stand from a lamp in that room: along its aim where both are known.
double ReachIn(const Vec3& size_m, const LightDescription& light) {
  const auto& from = light.position_m;
  if (!from || !IsInRoom(*from, size_m)) return Length(size_m);
  const Vec3 low{-0.5 * size_m[0], -0.5 * size_m[1], 0.0};
  const Vec3 high = low + size_m;
  double along = std::numeric_limits<double>::infinity();
  Vec3 farthest{};
  for (std::size_t k = 0; k < 3; ++k) {
    farthest[k] = std::max((*from)[k] - low[k], high[k] - (*from)[k]);
    if (!light.aim || (*light.aim)[k] == 0.0) continue;
    const double wall = (*light.aim)[k] > 0.0 ? high[k] : low[k];
    along = std::min(along, (wall - (*from)[k]) / (*light.aim)[k]);
  }
  return light.aim ? along * Length(*light.aim) : Length(farthest);
}

// What readings of one light could come next.
class Candidates {
 public:
  Candidates(const Session& session, const LightDescription& light, const FittedLight* fitted,
             double reach_m)
      : light_(light),
        fitted_(fitted),
        room_(session.room),
        dark_(session.surroundings == Surroundings::kDark),
        reach_(reach_m) {
    for (const SessionReading& row : session.readings) Note(row.reading);
    if (room_) reach_ = std::min(reach_, ReachIn(room_->size_m, light));
    for (const double d : distances_) reach_ = std::max(reach_, d);
    for (const Place& place : places_) {
      floor_m_ = std::min(floor_m_.value_or(0.0), place.position[2]);
    }
    const bool large = light.fixture == Fixture::kPanel || light.fixture == Fixture::kSoftbox;
    const bool sized = light.kind != LightKind::kPoint || SizeOf(light) > 0.0;
    if (sized || (light.fixture && !large)) return;
    nearest_ = light.fixture == Fixture::kSoftbox ? kNearestSoftbox : kNearestUnknown;
    for (const double d : distances_) nearest_ = std::min(nearest_, d);
  }

  [[nodiscard]] std::vector<PlannedReading> List() const {
    std::vector<PlannedReading> out;
    if (!dark_) AddShadowCards(out);
    if (!dark_ && !off_) out.push_back({PlannedAction::kLampOff, {}, {}, {}});
    if (!HasDistanceLaw(light_.kind)) {
      out.push_back({});
      return out;
    }
    const bool places = !places_.empty() || (distances_.empty() && light_.position_m && light_.aim);
    if (places) {
      AddPlaces(out);
    } else {
      AddDistances(out);
      AddAngles(out);
    }
    return out;
  }

 private:
  struct Place {
    Vec3 position;
    std::optional<Vec3> normal;
  };

  void Note(const Reading& reading) {
    if (!reading.illuminance) return;
    off_ = off_ || (reading.lamp == LampState::kOff);
    if (reading.shadow_card) {
      carded_.push_back(reading);
      return;
    }
    if (!IsLit(reading)) return;
    if (reading.distance && reading.distance->value() > 0.0) {
      distances_.push_back(reading.distance->value());
      angles_.push_back(std::abs(DegreesFromRadians(reading.off_axis)));
    }
    if (reading.position_m) places_.push_back({*reading.position_m, reading.normal});
    lit_.push_back(reading);
  }

  // At each place that was read; of many, evenly from the brightest to the dimmest, both with them:
  // what a card tells changes with the walls' share of the light, and that steadily with distance.
  void AddShadowCards(std::vector<PlannedReading>& out) const {
    std::vector<const Reading*> open;
    for (const Reading& lit : lit_) {
      const auto here = [&](const Reading& other) {
        return other.distance == lit.distance && other.position_m == lit.position_m &&
               other.off_axis == lit.off_axis;
      };
      const bool listed = std::ranges::any_of(open, [&](const Reading* one) { return here(*one); });
      if (listed || std::ranges::any_of(carded_, here) || lit.meter == kDataSheetMeter) continue;
      open.push_back(&lit);
    }
    if (open.size() > kMostCards) open = Spread(std::move(open));
    for (const Reading* lit : open) {
      out.push_back({PlannedAction::kShadowCard, lit->distance, lit->position_m, lit->normal});
      if (lit->off_axis.value() != 0.0) out.back().off_axis = lit->off_axis;
    }
  }

  [[nodiscard]] static std::vector<const Reading*> Spread(std::vector<const Reading*> readings) {
    std::ranges::stable_sort(readings, std::ranges::greater(),
                             [](const Reading* reading) { return reading->illuminance->value(); });
    std::vector<const Reading*> out;
    for (std::size_t i = 0; i < kMostCards; ++i) {
      out.push_back(readings[i * (readings.size() - 1) / (kMostCards - 1)]);
    }
    return out;
  }

  void AddDistances(std::vector<PlannedReading>& out) const {
    const double clear = std::max(nearest_, 0.5 * SizeOf(light_));
    std::vector<double> distances;
    if (distances_.empty()) {
      const double near = std::max(0.5, 2.0 * SizeOf(light_));
      distances = {near, 2.0 * near, 4.0 * near, 0.5 * near};
    } else {
      const auto [low, high] = std::minmax_element(distances_.begin(), distances_.end());
      for (const double d : {*low, *high, *low * kStep, *high * kStep, *low / kStep, *high / kStep,
                             *high * 2.0, *low / 2.0, std::sqrt(*low * *high)}) {
        distances.push_back(d);
      }
    }
    for (double d : distances) {
      const bool taken = std::find(distances_.begin(), distances_.end(), d) != distances_.end();
      if (!taken && clear > reach_) continue;
      if (!taken) d = RoundedWithin(std::max(d, clear), reach_);
      const bool listed = std::any_of(out.begin(), out.end(), [d](const PlannedReading& other) {
        return other.action == PlannedAction::kRead && other.distance &&
               SameDistance(other.distance->value(), d);
      });
      if (!listed) out.push_back({PlannedAction::kRead, Metres(d), {}, {}});
    }
  }

  // In and around a beam that was read off its axis, at the middle of the distances taken.
  void AddAngles(std::vector<PlannedReading>& out) const {
    if (fitted_ == nullptr || !fitted_->beam || !fitted_->beam->beam_deg) return;
    if (std::ranges::all_of(angles_, [](double angle) { return angle == 0.0; })) return;
    double ln = 0.0;
    for (const double d : distances_) ln += std::log(d);
    const double distance = RoundedLength(std::exp(ln / static_cast<double>(distances_.size())));
    const double half = 0.5 * fitted_->beam->beam_deg->value;
    const double edge = fitted_->beam->field_deg ? 0.5 * fitted_->beam->field_deg->value : 2 * half;
    for (const double wished : {0.0, 0.5 * half, 0.8 * half, half, 1.25 * half, 0.5 * (half + edge),
                                edge, 1.3 * edge, 2.0 * edge}) {
      const double step = wished < 10.0 ? 1.0 : 5.0;
      const double angle = std::round(wished / step) * step;
      const auto near = [&](double other) { return std::abs(other - angle) < 0.5 * step; };
      const bool listed = std::ranges::any_of(out, [&](const PlannedReading& other) {
        return other.off_axis && near(DegreesFromRadians(*other.off_axis));
      });
      if (listed || angle > 85.0 || std::ranges::any_of(angles_, near)) continue;
      out.push_back({PlannedAction::kRead, Metres(distance), {}, {}});
      out.back().off_axis = RadiansFromDegrees(angle);
    }
  }

  [[nodiscard]] std::optional<Vec3> LampPlace() const {
    return fitted_ != nullptr && fitted_->position_m ? fitted_->position_m : light_.position_m;
  }
  [[nodiscard]] std::optional<Vec3> Aim() const {
    return fitted_ != nullptr && fitted_->aim ? fitted_->aim : light_.aim;
  }

  // The normal the readings share, if any do.
  [[nodiscard]] std::optional<Vec3> CommonNormal() const {
    std::optional<Vec3> common;
    for (const Place& place : places_) {
      if (!place.normal) return std::nullopt;
      const Vec3 normal = *place.normal * (1.0 / Length(*place.normal));
      if (common && Dot(*common, normal) < 0.999) return std::nullopt;
      if (!common) common = normal;
    }
    return common;
  }

  void AddPlace(const Vec3& at, std::vector<PlannedReading>& out) const {
    const auto round = [](double x) { return std::round(x * 100.0) / 100.0; };
    const Vec3 place{round(at[0]), round(at[1]), round(at[2])};
    if (room_ && !IsInRoom(place, room_->size_m)) return;
    if (floor_m_ && place[2] < *floor_m_ - kPlaceRounding_m) return;
    const std::optional<Vec3> lamp = LampPlace();
    std::optional<Vec3> normal = CommonNormal();
    if (lamp) {
      const Vec3 to_lamp = *lamp - place;
      const double distance = Length(to_lamp);
      if (!(distance > std::max(nearest_, 0.5 * SizeOf(light_)))) return;
      if (!normal) normal = to_lamp * (1.0 / distance);
      if (!(Dot(*normal, to_lamp) > 0.1 * distance)) return;
    }
    const bool listed = std::any_of(out.begin(), out.end(), [&](const PlannedReading& other) {
      return other.action == PlannedAction::kRead && other.position_m == place;
    });
    if (!listed) out.push_back({PlannedAction::kRead, {}, place, normal});
  }

  void AddPlaces(std::vector<PlannedReading>& out) const {
    AddRound(out);
    AddOnBeam(out);
  }

  // A box about the places taken, somewhat larger; flat where they are.
  void AddRound(std::vector<PlannedReading>& out) const {
    if (places_.empty() || light_.kind == LightKind::kSpot) return;
    Vec3 low = places_.front().position;
    Vec3 high = low;
    for (const Place& place : places_) {
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], place.position[k]);
        high[k] = std::max(high[k], place.position[k]);
      }
    }
    const Vec3 middle = (low + high) * 0.5;
    const double reach = 0.5 * std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
    if (!(reach > 0.0)) return AddPlace(middle, out);
    std::array<int, 3> steps{};
    for (std::size_t k = 0; k < 3; ++k) {
      steps[k] = high[k] - low[k] > 0.02 * reach ? kPlaneSteps : 0;
    }
    for (int i = -steps[0]; i <= steps[0]; ++i) {
      for (int j = -steps[1]; j <= steps[1]; ++j) {
        for (int k = -steps[2]; k <= steps[2]; ++k) {
          const Vec3 offset{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
          AddPlace(middle + offset * (kPlaceSpread * reach / kPlaneSteps), out);
        }
      }
    }
  }

  // So far from the lamp, or where that way meets the floor.
  void AddAlong(const Vec3& lamp, const Vec3& way, double distance,
                std::vector<PlannedReading>& out) const {
    if (floor_m_ && lamp[2] + way[2] * distance < *floor_m_ && lamp[2] > *floor_m_) {
      distance = (*floor_m_ - lamp[2]) / way[2];
    }
    AddPlace(lamp + way * distance, out);
  }

  // On the axis and, of a spot, across its cone's edge, at the distance of those taken.
  void AddOnBeam(std::vector<PlannedReading>& out) const {
    const auto lamp = LampPlace();
    const auto aim = Aim();
    if (!lamp || !aim) return;
    double distance = 0.0;
    for (const Place& place : places_) distance += Length(place.position - *lamp);
    distance = places_.empty() ? std::max(1.0, 2.0 * SizeOf(light_))
                               : distance / static_cast<double>(places_.size());
    for (const double factor : {0.5, 1.0, 2.0}) {
      AddAlong(*lamp, *aim, std::min(std::max(reach_, distance), factor * distance), out);
    }
    if (light_.kind != LightKind::kSpot || fitted_ == nullptr || !fitted_->outer_deg) return;
    const double inner = fitted_->inner_deg.value_or(0.0);
    const SourceFrame frame = SourceFrame::Facing(*aim);
    for (const double part : {0.0, 0.5, 0.85}) {
      const double angle = (inner + part * (*fitted_->outer_deg - inner)) * kRadiansPerDegree;
      for (int q = 0; q < 4; ++q) {
        const double f = 0.5 * std::numbers::pi * q;
        const Vec3 way = *aim * std::cos(angle) +
                         (frame.x * std::cos(f) + frame.y * std::sin(f)) * std::sin(angle);
        AddAlong(*lamp, way, distance, out);
      }
    }
  }

  const LightDescription& light_;
  const FittedLight* fitted_;
  std::optional<Room> room_;
  const bool dark_;  // nothing but the lamp shines, and nothing sends its light back
  double reach_;
  double nearest_ = kNearest;
  std::optional<double> floor_m_;  // Z is up: as low as a meter has lain, or 0
  std::vector<double> distances_, angles_;
  std::vector<Place> places_;
  std::vector<Reading> lit_, carded_;
  bool off_ = false;
};

}  // namespace

std::vector<PlannedReading> ReadingCandidates(const Session& session, const FittedLight* fitted,
                                              double reach_m) {
  return Candidates(session, session.lights.front(), fitted, reach_m).List();
}

std::optional<double> DistanceSpan(const Session& session) {
  double low = 0.0;
  double high = 0.0;
  for (const SessionReading& row : session.readings) {
    if (!IsLit(row.reading) || !row.reading.distance) continue;
    const double d = row.reading.distance->value();
    low = low > 0.0 ? std::min(low, d) : d;
    high = std::max(high, d);
  }
  if (!(low > 0.0)) return std::nullopt;
  return high / low;
}

}  // namespace lightcal::fit
