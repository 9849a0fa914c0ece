// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/distribution/other_wall_light.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <utility>

#include "lightcal/core/standard_normal.h"
#include "lightcal/core/statistics.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/fit/plan/scene_of_session.h"
#include "lightcal/light/effects/ambient.h"
#include "lightcal/light/effects/veiling_glare.h"
#include "lightcal/light/lamp_axes.h"
#include "lightcal/light/wall_prior.h"

namespace lightcal {
namespace {

using Vector4 = Eigen::Vector4d;  // lux, by_x, by_z, by_r2
struct Drawn {
  Vector4 other;
  double room_lx = 0.0, ambient_lx = 0.0;  // of its lux
};
using Matrix4 = Eigen::Matrix4d;

constexpr double kPi = std::numbers::pi;
// Of 600 path-traced ordinary rooms (tests/tools/traced_rooms: lit walls). E_room at the middle
// over what the lamp lets loose in the room: bulbs, panels and beams alike .0146, .0179, .0184 with
// sd of ln .42, .54, .50; in a stated room, over its part (PartOfRoom), .32 to .44.
constexpr double kLooseToRoom = 0.0175, kSdOfAnyRoom = 0.62;
constexpr double kSdOfStatedRoom = 0.48;
// 1 sigma of its slopes across the wall, and mean and 1 sigma of its bend.
constexpr double kSlope = 0.40, kBend = -0.12, kSdBend = 0.33;
// 1 sigma of a shadow's light: what the card hides of the room's, and what the shape leaves over.
constexpr double kShadow = 0.09;
// What leaves beyond the seen cone, over a Lambertian lamp's: a bulb shines backwards too.
constexpr double kBeyondBulb = 1.4, kBeyondAny = 0.7, kSdBeyondAny = 0.7, kSdBeyondKnown = 0.3;
constexpr double kLeastGlare = 0.005;
constexpr int kDraws = 4000;

OtherLightPrior::Room PriorOfRoom(const Session& session) {
  OtherLightPrior::Room prior{std::log(kLooseToRoom), kSdOfAnyRoom};
  if (const auto room = fit::StatedRoomOf(session)) {
    const RoomPart part = PartOfRoom(*room);
    prior.ln_k += part.ln;
    prior.sd = std::min(kSdOfAnyRoom, std::hypot(kSdOfStatedRoom, part.sd));
  }
  return prior;
}

// Share of the standard normal distribution below z, and its inverse.
double ShareBelow(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }
double StandardNormalBelow(double share) {
  double low = -9.0, high = 9.0;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (ShareBelow(middle) < share ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// A prior's other light of one draw, as far as what was seen leaves it room.
class Draws {
 public:
  Draws(const OtherLightPrior& prior, const LampAsSeen& seen, double reflectance)
      : prior_(prior), seen_(seen), reflectance_(reflectance) {}

  // E_other = room + ambient + glare given that it is at most `most`.
  struct Parts {
    double room_lx = 0.0, ambient_lx = 0.0, glare_lx = 0.0;
  };
  Parts PartsBelow(double most) {
    const double glare = std::min(most, Between(prior_.least_glare_lx, prior_.most_glare_lx));
    const double ambient = Between(0.0, std::min(prior_.most_ambient_lx, most - glare));
    return {Room(most, glare + ambient), ambient, glare};
  }
  double Normal() { return normal_(random_); }

 private:
  double Between(double low, double high) {
    return low + (high - low) * static_cast<double>(random_()) * 0x1p-64;
  }
  // Beside `others`.
  double Room(double most, double others) {
    const double beyond = std::exp(prior_.ln_beyond + prior_.sd_beyond * normal_(random_)) * kPi *
                          std::cos(seen_.half_angle_rad);
    const double share = Between(0.0, 1.0);
    const double room_most = most - others;
    if (!prior_.room || !(room_most > 0.0)) return 0.0;
    // E = k (loose - E loose_per_lx) + others, both of the lamp without that light.
    const double loose = Loose(seen_.flux_lm, seen_.edge_cd, beyond);
    const double per_lx = Loose(seen_.flux_lm_per_lx, seen_.edge_cd_per_lx, beyond);
    const double left = std::max(0.0, loose - others * per_lx);
    const double highest = left > room_most * per_lx
                               ? std::log(room_most / (left - room_most * per_lx))
                               : std::numeric_limits<double>::infinity();
    const double z = (highest - prior_.room->ln_k) / prior_.room->sd;
    const double drawn = std::min(z, StandardNormalBelow(share * ShareBelow(z)));
    const double k = std::exp(prior_.room->ln_k + prior_.room->sd * drawn);
    return k * left / (1.0 + k * per_lx);
  }
  [[nodiscard]] double Loose(double flux, double edge, double beyond) const {
    return reflectance_ * flux + beyond * edge;
  }

  const OtherLightPrior& prior_;
  const LampAsSeen& seen_;
  double reflectance_;
  std::mt19937_64 random_{20261128};
  StandardNormal normal_;
};

OtherWallLight With(OtherWallLight about, const Vector4& of) {
  about.lux = std::max(0.0, of[0]);
  about.by_x = of[1];
  about.by_z = of[2];
  about.by_r2 = of[3];
  return about;
}

OtherLightFound FoundOf(const OtherWallLight& about, const Vector4& mean, Matrix4 covariance) {
  OtherLightFound out;
  out.mean = With(about, mean);
  out.sd_lx = std::sqrt(covariance(0, 0));
  if (!(out.mean.lux > 0.0)) return out;
  // The columns of the Cholesky factor; a level that is known exactly keeps its shape in doubt.
  constexpr double kLeastPart = 1e-6;
  covariance(0, 0) += std::pow(kLeastPart * mean[0], 2);
  const Matrix4 factor = covariance.llt().matrixL();
  for (Eigen::Index i = 0; i < 4; ++i) out.shifts.push_back(With(about, mean + factor.col(i)));
  return out;
}

// The darkest of each of 8 x 8 parts of what was seen, three sigma above it: no light is above.
std::vector<SeenPlace> Darkest(const std::vector<SeenPlace>& lit) {
  constexpr int kParts = 8;
  constexpr double kLeast_m = 1e-6;
  if (lit.empty()) return {};
  const auto [left, right] = std::ranges::minmax(lit, {}, &SeenPlace::x_m);
  const auto [low, high] = std::ranges::minmax(lit, {}, &SeenPlace::z_m);
  const auto part = [&](double value, double from, double to) {
    return std::clamp(static_cast<int>(kParts * (value - from) / std::max(kLeast_m, to - from)), 0,
                      kParts - 1);
  };
  std::vector<SeenPlace> out(std::size_t{kParts} * kParts,
                             {0.0, 0.0, std::numeric_limits<double>::infinity(), 0.0});
  for (SeenPlace place : lit) {
    place.lux = std::max(0.0, place.lux + 3.0 * place.sigma_lx);
    const int column = part(place.x_m, left.x_m, right.x_m);
    const int row = part(place.z_m, low.z_m, high.z_m);
    SeenPlace& kept = out[static_cast<std::size_t>(row * kParts + column)];
    if (place.lux < kept.lux) kept = place;
  }
  std::erase_if(out, [](const SeenPlace& place) { return !std::isfinite(place.lux); });
  return out;
}

std::vector<Drawn> Draw(const OtherLightPrior& prior, const LampAsSeen& seen, double reflectance,
                        const OtherWallLight& about, const std::vector<SeenPlace>& lit) {
  const std::vector<SeenPlace> darkest = Darkest(lit);
  Draws draws(prior, seen, reflectance);
  std::vector<Drawn> out;
  out.reserve(kDraws);
  for (int i = 0; i < kDraws; ++i) {
    Vector4 one(1.0, kSlope * draws.Normal(), kSlope * draws.Normal(),
                kBend + kSdBend * draws.Normal());
    const OtherWallLight shape = With(about, one);
    double most = std::numeric_limits<double>::infinity();
    for (const SeenPlace& place : darkest) {
      most = std::min(most, place.lux / shape.At(place.x_m, place.z_m));
    }
    const Draws::Parts parts = draws.PartsBelow(most);
    one[0] = parts.glare_lx + parts.ambient_lx + parts.room_lx;
    out.push_back({one, parts.room_lx, parts.ambient_lx});
  }
  return out;
}

struct Moments {
  Vector4 mean = Vector4::Zero();
  Matrix4 covariance = Matrix4::Zero();
};
Moments MomentsOf(const std::vector<Drawn>& draws) {
  const auto n = static_cast<double>(draws.size());
  Moments out;
  for (const Drawn& one : draws) out.mean += one.other / n;
  for (const Drawn& one : draws) {
    const Vector4 off = one.other - out.mean;
    out.covariance += off * off.transpose() / n;
  }
  return out;
}

OtherLightFound FromDraws(const OtherWallLight& about, const std::vector<Drawn>& draws) {
  const Moments moments = MomentsOf(draws);
  OtherLightFound out = FoundOf(about, moments.mean, moments.covariance);
  std::vector<double> lux;
  lux.reserve(draws.size());
  for (const Drawn& one : draws) lux.push_back(one.other[0]);
  constexpr double kAbove = 0.975;
  out.most_lx = Quantile(lux, kAbove);
  return out;
}

// ln E of a shadow is linear in ln lux and the shape, whose draws are the prior of both.
OtherLightFound FromShadows(const OtherWallLight& about, std::vector<Drawn> draws,
                            const std::vector<SeenPlace>& shadows) {
  constexpr double kLeastLux = 1e-6, kLeastVariance = 1e-4, kConflict = 9.0;
  for (Drawn& one : draws) one.other[0] = std::log(std::max(kLeastLux, one.other[0]));
  Moments prior = MomentsOf(draws);
  // What the session denies, a shadow may show all the same.
  double& variance = prior.covariance(0, 0);
  variance += kLeastVariance;
  const double off = std::log(std::max(kLeastLux, shadows.front().lux)) - prior.mean[0];
  if (off * off > kConflict * variance) variance = off * off;
  Matrix4 information = prior.covariance.inverse();
  Vector4 right = information * prior.mean;
  for (const SeenPlace& place : shadows) {
    const auto shape = about.ShapeAt(place.x_m, place.z_m);
    const Vector4 by(1.0, shape[0], shape[1], shape[2]);
    // One as dark as the noise says at least that no more is there than that.
    const double lux = std::max({kLeastLux, place.sigma_lx, place.lux});
    const double sd = std::hypot(kShadow, place.sigma_lx / lux);
    information += by * by.transpose() / (sd * sd);
    right += by * std::log(lux) / (sd * sd);
  }
  Matrix4 covariance = information.inverse();
  Vector4 mean = covariance * right;
  mean[0] = std::exp(mean[0]);
  const double sd_ln = std::sqrt(covariance(0, 0));
  const Vector4 by_lux(mean[0], 1.0, 1.0, 1.0);
  covariance = by_lux.asDiagonal() * covariance * by_lux.asDiagonal();
  OtherLightFound out = FoundOf(about, mean, covariance);
  out.most_lx = mean[0] * std::exp(kZ95 * sd_ln);
  return out;
}

}  // namespace

LampAsSeen LampOf(const std::vector<IntensitySample>& samples, const Vec3& aim, Metres distance) {
  constexpr int kOctants = 8, kRings = 80;
  constexpr double kRing = kPi / 180.0;
  struct Cell {
    double candela = 0.0, per_lx = 0.0, count = 0.0;
  };
  std::array<std::array<Cell, kOctants>, kRings> cells{};
  const LampAxes axes = AxesOfAim(aim);
  for (const IntensitySample& sample : samples) {
    if (!(sample.sigma_cd > 0.0)) continue;
    const double right = Dot(axes.c0, sample.direction), up = Dot(axes.c90, sample.direction);
    const double gamma = std::acos(std::clamp(Dot(axes.aim, sample.direction), -1.0, 1.0));
    const auto ring = static_cast<std::size_t>(gamma / kRing);
    const double turn = (std::atan2(up, right) + kPi) / (2.0 * kPi) * kOctants;
    const auto octant = static_cast<std::size_t>(std::min(turn, kOctants - 1.0));
    if (ring >= kRings) continue;
    Cell& cell = cells[ring][octant];
    const double cosine = sample.direction[1], d = distance.value();
    cell.candela += sample.intensity_cd;
    cell.per_lx += d * d / (cosine * cosine * cosine);
    cell.count += 1.0;
  }
  LampAsSeen out;
  // The rim: the first ring with fewer octants seen than an obstacle takes.
  constexpr int kFewest = 5;
  for (std::size_t ring = 0; ring < kRings; ++ring) {
    Cell mean;
    for (const Cell& cell : cells[ring]) {
      if (!(cell.count > 0.0)) continue;
      mean.candela += cell.candela / cell.count;
      mean.per_lx += cell.per_lx / cell.count;
      mean.count += 1.0;
    }
    const bool middle = ring < 3;  // hardly a sample falls into the first rings
    if (mean.count < kFewest && !middle) break;
    out.half_angle_rad = kRing * static_cast<double>(ring + 1);
    if (!(mean.count > 0.0)) continue;
    const double solid_angle =
        2.0 * kPi * (std::cos(out.half_angle_rad - kRing) - std::cos(out.half_angle_rad));
    out.edge_cd = mean.candela / mean.count;
    out.edge_cd_per_lx = mean.per_lx / mean.count;
    out.flux_lm += solid_angle * out.edge_cd;
    out.flux_lm_per_lx += solid_angle * out.edge_cd_per_lx;
  }
  return out;
}

OtherLightPrior PriorOfOtherLight(const Session& session, const LightDescription& light,
                                  const CaptureDescription& capture, double mean_lx) {
  OtherLightPrior out;
  if (session.surroundings == Surroundings::kIndoors) out.room = PriorOfRoom(session);
  out.ln_beyond = kBeyondAny;
  out.sd_beyond = kSdBeyondAny;
  if (light.fixture) {
    out.ln_beyond = *light.fixture == Fixture::kBulb ? kBeyondBulb : 0.0;
    out.sd_beyond = kSdBeyondKnown;
  }
  const bool told =
      session.surroundings == Surroundings::kDark || !capture.wall->off_frames.empty();
  if (!told) out.most_ambient_lx = effects::kAmbientDefault * mean_lx;
  out.least_glare_lx = capture.lens_glare.value_or(kLeastGlare) * mean_lx;
  out.most_glare_lx = capture.lens_glare.value_or(effects::kGlareDefault) * mean_lx;
  return out;
}

OtherLightFound FindOtherLight(const OtherLightPrior& prior, const LampAsSeen& seen,
                               double reflectance, const OtherWallLight& about,
                               const std::vector<SeenPlace>& lit,
                               const std::vector<SeenPlace>& shadows) {
  std::vector<Drawn> draws = Draw(prior, seen, reflectance, about, lit);
  double all_lx = 0.0, room_lx = 0.0, ambient_lx = 0.0;
  for (const Drawn& one : draws) {
    all_lx += one.other[0];
    room_lx += one.room_lx;
    ambient_lx += one.ambient_lx;
  }
  OtherLightFound out =
      shadows.empty() ? FromDraws(about, draws) : FromShadows(about, std::move(draws), shadows);
  if (!(all_lx > 0.0)) return out;
  out.of_room = room_lx / all_lx;
  out.of_ambient = ambient_lx / all_lx;
  return out;
}

}  // namespace lightcal
