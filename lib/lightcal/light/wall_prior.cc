// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/wall_prior.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <span>

namespace lightcal {
namespace {

constexpr double kPi = std::numbers::pi;

// One family of lamps over the traced rooms.
struct Family {
  WallPrior prior;    // of an ordinary room
  double in_room;     // k, 1/(m^2 sr)
  double sd_in_room;  // of ln k
  double flux;        // over intensity, sr
  // Over open ground: a floor integrated under lamps .8 to 3 m above it that are read about level
  // (tests/app/open_ground.py), of reflectance .2 e^(+- .6): soil .1, lawn .2, sand .4; snow's .8
  // lies two deviations above. Panels and beams that hang above their meter light more of it.
  WallPrior over_ground;
};
const Family kBulb = {{std::log(0.122), 0.42, -1.00, 0.36, -0.27, 0.07, -0.5, 0.26},
                      0.0113,
                      0.27,
                      0.86 * 4 * kPi,
                      {-5.20, 0.75, -0.70, 0.50, -0.40, 0.10}};
const Family kPanel = {{std::log(0.037), 0.45, -0.45, 0.55, -0.37, 0.14, 0.25, 0.33},
                       0.0120,
                       0.31,
                       kPi,
                       {-6.40, 1.00, 0.30, 0.75, -0.80, 0.15}};
// Where those near walls are told by themselves: as unlike each other as in traced rooms.
const Family kBulbAwayFromWalls = [] {
  Family out = kBulb;
  out.prior.sd_ln_b = 0.39;
  out.prior.sd_slope = 0.30;
  return out;
}();
// Of unknown angle.
const Family kBeam = {{std::log(0.0033), 1.25, 0.60, 0.45, 0.0, 0.25, 1.0, 0.42},
                      0.0082,
                      0.63,
                      0.0,
                      {-8.20, 1.50, 1.00, 0.80, 0.0, 0.25}};
// ln b over flux/I of a beam whose angle is known.
constexpr double kBeamOverFlux = 0.0092;
constexpr double kSdOfBeam = 0.75;
constexpr double kRoomPower = 0.7;
// ln b of a place with hardly a wall, below an ordinary one's.
constexpr double kFarLess = 2.5;
constexpr double kSdOfFar = 1.2;
// A bulb's over a floor alone, which lies .8 to 2.5 m below it: - 1.22 to - .33 by integration.
constexpr double kSlopeOfFar = -0.65;
constexpr double kOrdinaryRoom = 0.0088;  // f, 1/m^2
// Ordinary rooms' largest: their surface, and what is read in them.
constexpr double kLargestRoom_m2 = 202.0, kFarthestInRoom_m = 6.0;
// Below these fluxes over intensity a lamp lights its room as a panel, as a beam does.
constexpr double kLeastOfBulb = 7.0;
constexpr double kLeastOfPanel = 2.0;

// What stands about the lamp.
struct Around {
  std::optional<StatedRoom> room;
  bool open = false;  // the ground alone
};

WallPrior InRoom(const Family& family, double flux, const StatedRoom& room) {
  const RoomPart part = PartOfRoom(room);
  WallPrior prior = family.prior;
  prior.ln_b = std::log(family.in_room * flux) + part.ln;
  prior.sd_ln_b = std::hypot(family.sd_in_room, part.sd);
  return prior;
}

WallPrior PriorOf(const Family& family, std::optional<double> flux, const Around& around) {
  const std::optional<StatedRoom>& room = around.room;
  const bool beam = family.flux == 0.0;
  if (around.open) {
    WallPrior prior = family.over_ground;
    if (flux && !beam) prior.ln_b += std::log(*flux / family.flux);
    return prior;
  }
  if (beam && !flux) {  // its angle is the larger doubt, which holds what is not known of the room
    WallPrior prior = family.prior;
    if (room) prior.ln_b += PartOfRoom(*room).ln;
    return prior;
  }
  if (room) return InRoom(family, flux.value_or(family.flux), *room);
  WallPrior prior = family.prior;
  if (beam) {
    prior.ln_b = std::log(kBeamOverFlux * *flux);
    prior.sd_ln_b = kSdOfBeam;
  } else if (flux) {
    prior.ln_b += std::log(*flux / family.flux);
  }
  return prior;
}

// Of a beam cos^n, n of its full angle at half the peak.
double FluxOfBeam(Radians beam) {
  const double half = std::min(0.5 * beam.value(), 1.5);
  return 2.0 * kPi / (std::log(0.5) / std::log(std::cos(half)) + 1.0);
}

const Family* FamilyOf(const LampSpread& lamp) {
  switch (lamp.kind) {
    case LightKind::kSphere:
    case LightKind::kTube:
      return &kBulb;
    case LightKind::kDisk:
    case LightKind::kRect:
      return &kPanel;
    case LightKind::kSpot:
      return &kBeam;
    default:
      break;
  }
  if (!lamp.fixture) return nullptr;
  switch (*lamp.fixture) {
    case Fixture::kBulb:
      return &kBulb;
    case Fixture::kCobBare:
    case Fixture::kPanel:
    case Fixture::kSoftbox:
      return &kPanel;
    case Fixture::kReflector:
    case Fixture::kFresnel:
      return &kBeam;
    case Fixture::kLuminaire:
      break;
  }
  return nullptr;
}

// Lamps near one wall and in a corner, whose walls' light has laws of its own.
struct PlaceShares {
  double near = 0.0, corner = 0.0;
};
// Of lamps that stand anywhere on a floor a third lies within half a metre of a wall (rooms of
// 3-8 x 3-7 m) and one part in thirty of two, where people rather put them; or they hang in the
// middle.
constexpr PlaceShares kAnyPlace{0.20, 0.05};
// Of lamps that nobody names every third stands by walls, and two in three of these have a second
// surface within half a metre: another wall, the ceiling, a table (the rooms by walls of
// traced_rooms: as many of two as of one). Near one alone a bulb is much as ordinary ones are, of
// which most hang under the ceiling.
constexpr PlaceShares kOfUnnamed{0.12, 0.22};

// Walls nearby are Lambertian images of the lamp, whose light adds most where the meter is nearest:
// more b3 and the slopes below are their integrals (tests/bench/rooms/near_wall.py), not figures of
// the rooms that judge. One room in twenty is not ordinary: a hall or a black studio, that nobody
// mentioned (no traced room is).
std::vector<WallHypothesis> PlacesOf(const Family& family, std::optional<double> flux,
                                     const Around& around, const PlaceShares& shares = kAnyPlace) {
  constexpr double kFar = 0.05;
  const WallPrior prior = PriorOf(family, flux, around);
  if (family.flux == 0.0 || around.open) return {{1.0, prior}};
  const bool bulb = family.flux > kLeastOfBulb;
  const auto beside_walls = [&](double more_ln_b, double slope) {
    WallPrior beside = prior;
    beside.ln_b += more_ln_b;
    beside.sd_ln_b = std::hypot(beside.sd_ln_b, 0.15);
    beside.slope = slope;
    beside.sd_slope = bulb ? 0.25 : 0.60;
    return beside;
  };
  const WallPrior near = bulb ? beside_walls(0.34, -1.51) : beside_walls(0.15, -0.96);
  const WallPrior corner = bulb ? beside_walls(0.55, -1.65) : beside_walls(0.28, -1.28);
  WallPrior far = prior;
  far.ln_b -= kFarLess;
  far.sd_ln_b = kSdOfFar;
  if (bulb) far.slope = kSlopeOfFar;
  constexpr double kOrdinary = 1.0 - kFar;
  return {{(1.0 - shares.near - shares.corner) * kOrdinary, prior},
          {kFar, far},
          {shares.near * kOrdinary, near},
          {shares.corner * kOrdinary, corner}};
}

// What a lamp of unstated size may measure; 0 = as small as a point.
struct PossibleSize {
  double weight, width_m, height_m;
};
// A film panel is 10 to 50 cm wide and high; an office's is 60 x 60 or 120 x 30.
constexpr std::array<PossibleSize, 5> kPanelSizes = {{{0.35, 0.30, 0.26},
                                                      {0.28, 0.16, 0.13},
                                                      {0.29, 0.46, 0.40},
                                                      {0.05, 0.60, 0.60},
                                                      {0.03, 1.20, 0.30}}};
// Boxes and cloths, of which small ones tell as points do.
constexpr std::array<PossibleSize, 5> kSoftboxSizes = {{{0.40, 0.0, 0.0},
                                                        {0.21, 0.45, 0.40},
                                                        {0.19, 0.65, 0.60},
                                                        {0.13, 0.90, 0.60},
                                                        {0.07, 1.25, 0.85}}};

// The likeliest place is weighed with each size, the others with the first.
std::vector<WallHypothesis> OfSomeSize(const std::vector<WallHypothesis>& places,
                                       std::span<const PossibleSize> sizes) {
  std::vector<WallHypothesis> out;
  for (const PossibleSize& size : sizes) {
    const WallHypothesis& place = places.front();
    out.push_back({size.weight * place.weight, place.prior, size.width_m, size.height_m});
  }
  for (const WallHypothesis& place : std::span(places).subspan(1)) {
    out.push_back({place.weight, place.prior, sizes[0].width_m, sizes[0].height_m});
  }
  return out;
}

// A lamp of which nobody said what it is. Where its light starts goes with where it sends it: a
// bare bulb's starts in its glass, a lantern's far within; a chip's behind its board, a softbox's
// behind its cloth; a reflector's before its rim, a lens's behind it. Weights by judgement;
// together the offsets lie where `OffsetParts` of no fixture do. No two weigh alike, so that an
// answer's list has one order.
std::vector<WallHypothesis> OfAnyMake(const Around& around) {
  const auto offset_of = [](Fixture fixture) { return OffsetParts(fixture).front(); };
  const auto shines_all_round = [&](double weight, Fixture fixture) {
    std::vector<WallHypothesis> places = PlacesOf(kBulbAwayFromWalls, {}, around, kOfUnnamed);
    for (WallHypothesis& one : places) {
      one.weight *= weight;
      one.offset = offset_of(fixture);
    }
    return places;
  };
  std::vector<WallHypothesis> any = shines_all_round(0.383, Fixture::kBulb);
  std::ranges::copy(shines_all_round(0.058, Fixture::kSoftbox), std::back_inserter(any));
  const WallPrior all_round = PriorOf(kBulb, {}, around);
  const WallPrior panel = PriorOf(kPanel, {}, around);
  const WallPrior beam = PriorOf(kBeam, {}, around);
  // A globe, from its glass; tubes, broadside.
  any.push_back({0.025, all_round, 0.0, 0.0, OffsetPart{1.0, 0.12, 0.05}});
  any.push_back({0.020, all_round, 1.20, 0.03, offset_of(Fixture::kBulb)});
  any.push_back({0.012, all_round, 0.60, 0.03, offset_of(Fixture::kBulb)});
  any.push_back({0.093, panel, 0.12, 0.09, offset_of(Fixture::kCobBare)});
  any.push_back({0.053, panel, 0.25, 0.19, offset_of(Fixture::kPanel)});
  any.push_back({0.038, panel, 0.42, 0.32, offset_of(Fixture::kPanel)});
  any.push_back({0.018, panel, 0.60, 0.60, offset_of(Fixture::kPanel)});
  any.push_back({0.033, panel, 0.0, 0.0, offset_of(Fixture::kSoftbox)});
  any.push_back({0.029, panel, 0.30, 0.24, offset_of(Fixture::kSoftbox)});
  any.push_back({0.015, panel, 0.90, 0.60, offset_of(Fixture::kPanel)});
  any.push_back({0.125, beam, 0.0, 0.0, offset_of(Fixture::kReflector)});
  any.push_back({0.098, beam, 0.0, 0.0, offset_of(Fixture::kFresnel)});
  return any;
}

double AreaOf(const StatedRoom& room) {
  const Vec3& s = room.size_m;
  return 2.0 * (s[0] * s[1] + s[1] * s[2] + s[2] * s[0]);
}

// How many times as large as an ordinary one the room is.
double ScaleOf(const std::optional<StatedRoom>& room, Metres farthest) {
  const double stated = room ? std::sqrt(AreaOf(*room) / kLargestRoom_m2) : 1.0;
  return std::max({1.0, stated, farthest.value() / kFarthestInRoom_m});
}

// At `farthest`, which tells most of its walls, it is as unsure as the ordinary room at farthest/s.
WallPrior Enlarged(WallPrior prior, double scale, Metres farthest) {
  const double ln = std::log(scale);
  const double x = std::log(std::max(farthest.value(), kFarthestInRoom_m) / kWallReference_m);
  prior.ln_b += ln * (prior.bend * ln - prior.slope - 2.0);
  prior.slope -= 2.0 * prior.bend * ln;
  prior.sd_slope *= std::min(1.0, std::abs(x - ln) / x);
  return prior;
}

// In an ordinary room, in the largest one of the stated room's shape, or over the ground.
std::vector<WallHypothesis> OrdinaryPriors(const LampSpread& lamp, const Around& around) {
  std::optional<double> flux = lamp.flux_over_intensity;
  if (lamp.beam && lamp.beam->value() > 0.0) flux = FluxOfBeam(*lamp.beam);
  if (flux) {
    const Family& family = *flux > kLeastOfBulb ? kBulb : (*flux > kLeastOfPanel ? kPanel : kBeam);
    return PlacesOf(family, flux, around);
  }
  if (lamp.kind == LightKind::kPoint && lamp.fixture == Fixture::kPanel) {
    return OfSomeSize(PlacesOf(kPanel, {}, around), kPanelSizes);
  }
  if (lamp.kind == LightKind::kPoint && lamp.fixture == Fixture::kSoftbox) {
    return OfSomeSize(PlacesOf(kPanel, {}, around), kSoftboxSizes);
  }
  if (const Family* family = FamilyOf(lamp)) {
    return PlacesOf(*family, {}, around);
  }
  return OfAnyMake(around);
}

}  // namespace

RoomPart PartOfRoom(const StatedRoom& room) {
  const double rho = std::clamp(room.reflectance, 0.02, 0.95);
  const double area = std::min(AreaOf(room), kLargestRoom_m2);
  return {kRoomPower * std::log(rho / (area * (1.0 - rho)) / kOrdinaryRoom),
          kRoomPower * room.reflectance_sigma / (rho * (1.0 - rho))};
}

std::vector<WallHypothesis> WallPriors(const LampSpread& lamp,
                                       const std::optional<StatedRoom>& room, Metres farthest) {
  if (lamp.kind == LightKind::kDirectional || lamp.kind == LightKind::kDome) return {};
  std::vector<WallHypothesis> walls = OrdinaryPriors(lamp, {room});
  const double scale = ScaleOf(room, farthest);
  if (scale > 1.0) {
    for (WallHypothesis& one : walls) one.prior = Enlarged(one.prior, scale, farthest);
  }
  return walls;
}

std::vector<WallHypothesis> GroundPriors(const LampSpread& lamp) {
  if (lamp.kind == LightKind::kDirectional || lamp.kind == LightKind::kDome) return {};
  return OrdinaryPriors(lamp, {.room = {}, .open = true});
}

std::vector<LampMake> PossibleMakes(const LampSpread& lamp) {
  // Smaller ones of an unknown make are as points to its offsets (OffsetParts of no fixture).
  constexpr double kTellsItself_m = 0.5;
  std::vector<LampMake> out;
  for (const WallHypothesis& one : WallPriors(lamp, {})) {
    const bool a_point = one.offset && one.width_m < kTellsItself_m;
    const LampMake make = a_point ? LampMake{one.weight}
                                  : LampMake{one.weight, one.width_m, one.height_m, one.offset};
    const auto same = std::ranges::find_if(out, [&](const LampMake& other) {
      return other.width_m == make.width_m && other.height_m == make.height_m;
    });
    if (same == out.end()) {
      out.push_back(make);
    } else {
      same->weight += make.weight;
    }
  }
  if (std::ranges::none_of(out, [](const LampMake& make) { return make.width_m > 0.0; })) out = {};
  return out;
}

std::optional<WallPrior> OneNormalOf(const std::vector<WallHypothesis>& walls) {
  if (walls.empty()) return std::nullopt;
  WallPrior out = walls.front().prior;
  double b = 0.0, bb = 0.0, s = 0.0, ss = 0.0;
  for (const WallHypothesis& one : walls) {
    const WallPrior& p = one.prior;
    b += one.weight * p.ln_b;
    bb += one.weight * (p.ln_b * p.ln_b + p.sd_ln_b * p.sd_ln_b);
    s += one.weight * p.slope;
    ss += one.weight * (p.slope * p.slope + p.sd_slope * p.sd_slope);
  }
  out.ln_b = b;
  out.sd_ln_b = std::sqrt(std::max(1e-6, bb - b * b));
  out.slope = s;
  out.sd_slope = std::sqrt(std::max(1e-6, ss - s * s));
  return out;
}

double WallsPerCandela(const WallPrior& prior, double distance_m, double deviates) {
  const double x = std::log(distance_m / kWallReference_m);
  const double sd = std::hypot(prior.sd_ln_b, prior.sd_slope * x);
  return std::exp(prior.ln_b + prior.slope * x + prior.bend * x * x + deviates * sd);
}

}  // namespace lightcal
