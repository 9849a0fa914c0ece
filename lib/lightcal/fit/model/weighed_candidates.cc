// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/weighed_candidates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

#include "lightcal/core/normal_mixture.h"
#include "lightcal/fit/model/robust.h"

namespace lightcal::fit {

void KeepComparable(std::vector<Candidate>& candidates) {
  const RobustEstimate& first = candidates.front().estimate;
  if (!first.suspicious.empty() || first.bimodal) candidates.resize(1);
  const std::vector<int> rejected = first.rejected;
  for (std::size_t i = 1; i < candidates.size(); ++i) {
    Candidate& one = candidates[i];
    one.estimate = {one.squared, one.estimation, rejected, {}, false};
    if (rejected.empty()) continue;
    one.estimate.kept.rows = Without(one.estimation.rows, rejected);
    const Result<Theta> theta = SolveSettled(one.estimate.kept);
    one.estimate.theta = theta ? *theta : one.squared;
    one.ln_probability = one.ln_prior + LnEvidence(one.estimate.kept, one.estimate.theta);
  }
}

std::vector<double> SharesOf(std::vector<Candidate>& candidates) {
  constexpr double kLeastLikelihood = 1e-4;
  double most = -std::numeric_limits<double>::infinity();
  for (const Candidate& one : candidates) most = std::max(most, one.ln_probability);
  const auto likelihood = [most](const Candidate& one) {
    return std::exp(one.ln_probability - most);
  };
  // The first stays: its rows were looked at.
  const auto gone = std::ranges::remove_if(
      candidates.begin() + 1, candidates.end(),
      [&](const Candidate& one) { return likelihood(one) < kLeastLikelihood; });
  candidates.erase(gone.begin(), gone.end());
  std::vector<double> shares;
  double whole = 0.0;
  for (const Candidate& one : candidates) whole += likelihood(one);
  for (const Candidate& one : candidates) shares.push_back(likelihood(one) / whole);
  return shares;
}

namespace {

// The candidate with ln I also N(ln_cd, sd), and the density of that value under it.
double TellIntensity(double ln_cd, double sd, Candidate& one) {
  const double variance = one.covariance[kLnIntensity] + sd * sd;
  const double off = ln_cd - one.estimate.theta[kLnIntensity];
  std::array<double, kParameters> gain{};
  for (int i = 0; i < kParameters; ++i) gain[i] = one.covariance[i * kParameters] / variance;
  for (int i = 0; i < kParameters; ++i) {
    one.estimate.theta[i] += gain[i] * off;
    for (int j = 0; j < kParameters; ++j) {
      one.covariance[i * kParameters + j] -= gain[i] * gain[j] * variance;
    }
  }
  one.estimate.theta[kAmbient] = std::max(0.0, one.estimate.theta[kAmbient]);
  return std::exp(-0.5 * off * off / variance) / std::sqrt(2.0 * std::numbers::pi * variance);
}

// How many lamps in one are farther off the sheet than its own sd tells. Readings that know less
// than the sheet does say nothing of that, and never widen what it says.
double FarOff(const SheetIntensity& sheet, const Candidate& one) {
  constexpr double kMost = 0.7;
  if (!(sheet.far_sd > 0.0)) return 0.0;
  const double known = sheet.sd * sheet.sd / (sheet.sd * sheet.sd + one.covariance[kLnIntensity]);
  return kMost * known * known;
}

}  // namespace

WeighedCandidates WithSheet(const SheetIntensity& sheet, const std::vector<Candidate>& candidates,
                            const std::vector<double>& shares) {
  constexpr double kHeld = 0.95;
  constexpr double kLeastWeight = 1e-4;
  static const double kLnReach = std::log(1.2 / 0.05);
  std::vector<std::pair<double, Candidate>> weighed;
  double whole = 0.0, held = 0.0;
  const auto add = [&](double weight, Candidate one) {
    weighed.emplace_back(weight, std::move(one));
    whole += weight;
    return weight;
  };
  const auto add_told = [&](const Candidate& one, double weight, double sd) {
    Candidate told = one;
    const double density = TellIntensity(sheet.ln_cd, sd, told);
    return add(weight * density, std::move(told));
  };
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Candidate& one = candidates[i];
    const double far_off = FarOff(sheet, one);
    held += add_told(one, shares[i] * kHeld * (1.0 - far_off), sheet.sd);
    if (far_off > 0.0) add_told(one, shares[i] * kHeld * far_off, sheet.far_sd);
    add(shares[i] * (1.0 - kHeld) / kLnReach, one);
  }
  std::ranges::stable_sort(weighed, std::ranges::greater(), &std::pair<double, Candidate>::first);
  WeighedCandidates out;
  out.held = held / whole;
  double kept = 0.0;
  for (auto& [weight, one] : weighed) {
    if (weight < kLeastWeight * whole) break;
    out.candidates.push_back(std::move(one));
    out.shares.push_back(weight);
    kept += weight;
  }
  for (double& share : out.shares) share /= kept;
  return out;
}

namespace {

std::array<double, std::size_t{LampInRoom::kCount} * LampInRoom::kCount> CovarianceInRoom(
    const Covariance& whole) {
  constexpr int n = LampInRoom::kCount;
  std::array<double, std::size_t{n} * n> out{};
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) out[i * n + j] = whole[i * kParameters + j];
  }
  return out;
}

}  // namespace

std::vector<LampInRoom> InRoom(const std::vector<Candidate>& candidates,
                               const std::vector<double>& shares) {
  constexpr double kLeastShareTold = 0.01;
  const auto sees_walls = [](const Candidate& one) {
    return one.hypothesis.walls.has_value() && one.estimation.rules[kLnWalls].free;
  };
  const bool walls_shine = sees_walls(candidates.front());
  if (!walls_shine && candidates.size() == 1) return {};
  std::vector<LampInRoom> out;
  double whole = 0.0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Candidate& one = candidates[i];
    if (sees_walls(one) != walls_shine) return {};
    if (shares[i] < kLeastShareTold) continue;
    const Theta& theta = one.estimate.theta;
    LampInRoom& told = out.emplace_back();
    told.weight = shares[i];
    told.ln_intensity = theta[kLnIntensity];
    told.distance_offset_m = theta[kDistanceOffset];
    told.ambient_lx = theta[kAmbient];
    told.covariance = CovarianceInRoom(one.covariance);
    whole += shares[i];
    told.width_m = one.hypothesis.width_m;
    told.height_m = one.hypothesis.height_m;
    if (!walls_shine) continue;
    told.ln_b = theta[kLnWalls];
    told.slope = theta[kWallsSlope];
    told.bend = one.hypothesis.walls->bend;
    told.scatter = one.hypothesis.walls->scatter;
  }
  for (LampInRoom& one : out) one.weight /= whole;
  return out;
}

void Mix(const std::vector<Candidate>& candidates, const std::vector<double>& shares,
         LightEstimate& out) {
  constexpr double kTail = 0.025;
  const auto marginal = [&](int k) {
    std::vector<NormalPart> parts;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const Candidate& one = candidates[i];
      parts.push_back({shares[i], one.estimate.theta[k],
                       std::sqrt(std::max(0.0, one.covariance[k * kParameters + k]))});
    }
    return parts;
  };
  const std::vector<NormalPart> ln = marginal(kLnIntensity);
  out.theta = candidates.front().estimate.theta;
  for (const Parameter k : {kLnIntensity, kDistanceOffset}) {
    out.theta[k] = QuantileOf(marginal(k), 0.5);
  }
  out.ln_interval = {QuantileOf(ln, kTail), QuantileOf(ln, 1.0 - kTail)};
  out.covariance = {};
  for (std::size_t n = 0; n < candidates.size(); ++n) {
    const Candidate& one = candidates[n];
    for (int i = 0; i < kParameters; ++i) {
      for (int j = 0; j < kParameters; ++j) {
        out.covariance[i * kParameters + j] +=
            shares[n] *
            (one.covariance[i * kParameters + j] +
             (one.estimate.theta[i] - out.theta[i]) * (one.estimate.theta[j] - out.theta[j]));
      }
    }
  }
  constexpr int kVariance = kLnIntensity * (kParameters + 1);
  const double between = out.covariance[kVariance] - candidates.front().covariance[kVariance];
  if (between > 0.0) out.variance_parts.push_back({"unknown_lamp", between});
}
}  // namespace lightcal::fit
