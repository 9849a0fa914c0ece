// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/colour/shared_color.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "lightcal/fit/colour/fit_color.h"
#include "lightcal/light/wall_tint.h"

namespace lightcal::fit {
namespace {

constexpr double kScatter = 9.0;         // chi squared of one reading about its instrument's mean
constexpr double kDisagreement = 5.991;  // chi squared with two degrees of freedom at 95 %
// 1 sigma of how whites of 2200 to 7500 K differ, in x and in y, and how these go together.
constexpr double kAmbientX = 0.07, kAmbientY = 0.03, kAmbientCorrelation = 0.7;

// Readings of one instrument in light of one composition.
struct Bundle {
  Estimate2 seen;  // its own covariance alone
  std::size_t instrument = 0;
  OtherShares others{};
  bool lit = true;
};
struct Bundles {
  std::vector<Bundle> all;
  std::vector<Matrix2> instruments;  // the covariance of each one's own error
  bool tinted = false;
  bool scatters = false;
};

bool SameLight(const ColorReading& a, const ColorReading& b) {
  constexpr double kSameShare = 0.01;
  return a.lit == b.lit && a.instrument == b.instrument &&
         std::abs(a.others.walls - b.others.walls) < kSameShare &&
         std::abs(a.others.ambient - b.others.ambient) < kSameShare;
}

Bundle BundleOf(const std::vector<const ColorReading*>& group, bool tinted, bool& scatters) {
  const auto n = static_cast<double>(group.size());
  Bundle out;
  out.lit = group.front()->lit;
  for (const ColorReading* one : group) {
    out.seen.mean += one->in_xy.mean / n;
    out.seen.covariance += one->own / (n * n);
    out.others.walls += one->others.walls / n;
    out.others.common += one->others.common / n;
    out.others.own += one->others.own / n;
    out.others.ambient += one->others.ambient / n;
  }
  if (tinted) out.seen.covariance += kRepeatXy * kRepeatXy / n * Matrix2::Identity();
  if (group.size() < 2) return out;
  for (const ColorReading* one : group) {
    const Vector2 off = one->in_xy.mean - out.seen.mean;
    out.seen.covariance += off * off.transpose() / (n * (n - 1.0));
    scatters = scatters || off.dot(one->in_xy.covariance.inverse() * off) > kScatter;
  }
  return out;
}

Bundles BundlesOf(const std::vector<ColorReading>& readings) {
  Bundles out;
  out.tinted = std::ranges::any_of(readings, [](const auto& one) { return one.others.any(); });
  std::vector<std::vector<const ColorReading*>> groups;
  std::vector<std::pair<std::string, ColorSource>> names;
  std::vector<double> counts;
  for (const ColorReading& reading : readings) {
    const auto known = std::ranges::find_if(
        groups, [&](const auto& group) { return SameLight(*group.front(), reading); });
    if (known == groups.end()) {
      groups.push_back({&reading});
    } else {
      known->push_back(&reading);
    }
    const auto name = std::ranges::find(names, reading.instrument);
    const auto at = static_cast<std::size_t>(name - names.begin());
    if (name == names.end()) {
      names.push_back(reading.instrument);
      out.instruments.push_back(Matrix2::Zero());
      counts.push_back(0.0);
    }
    out.instruments[at] += reading.in_xy.covariance;
    counts[at] += 1.0;
  }
  for (std::size_t i = 0; i < counts.size(); ++i) out.instruments[i] /= counts[i];
  for (const auto& group : groups) {
    out.all.push_back(BundleOf(group, out.tinted, out.scatters));
    const auto name = std::ranges::find(names, group.front()->instrument);
    out.all.back().instrument = static_cast<std::size_t>(name - names.begin());
  }
  return out;
}

// The bundles in (mired, Duv); false where one has none.
bool TakeToMired(Bundles& bundles, CctMethod method) {
  std::vector<Matrix2> inverse(bundles.instruments.size(), Matrix2::Zero());
  Bundles out = bundles;
  for (Bundle& one : out.all) {
    Vector2 mired_duv;
    if (!MiredDuvOf(one.seen.mean, method, mired_duv)) return false;
    const Matrix2 by_xy = XyByMiredDuv(mired_duv).inverse();
    one.seen = {mired_duv, by_xy * one.seen.covariance * by_xy.transpose()};
    inverse[one.instrument] = by_xy;
  }
  for (std::size_t i = 0; i < inverse.size(); ++i) {
    out.instruments[i] = inverse[i] * out.instruments[i] * inverse[i].transpose();
  }
  bundles = std::move(out);
  return true;
}

// What a room does to a lamp of chromaticity xy.
struct TintAt {
  Vector2 mean;
  Matrix2 covariance, from_place;
};
TintAt TintOf(const Vector2& xy) {
  const Vector2 tinted = Tinted(xy, kTintOfRoom.ln_x, kTintOfRoom.ln_z);
  const Matrix2 by_tint = XyByTint(tinted);
  const Matrix2 place =
      Vector2(kRoomTintPlaceX * kRoomTintPlaceX, kRoomTintPlaceZ * kRoomTintPlaceZ).asDiagonal();
  return {tinted - xy, by_tint * CovarianceOf(kTintOfRoom) * by_tint.transpose(),
          by_tint * place * by_tint.transpose()};
}

Matrix2 CovarianceOfWhites() {
  Matrix2 out;
  const double cross = kAmbientCorrelation * kAmbientX * kAmbientY;
  out << kAmbientX * kAmbientX, cross, cross, kAmbientY * kAmbientY;
  return out;
}

enum Unknown { kColor = 0, kTint = 2, kAmbientColor = 4, kShareOfAll = 6, kInstruments = 7 };

class Problem {
 public:
  explicit Problem(const Bundles& bundles) : bundles_(bundles) {
    const Bundle* least = nullptr;
    for (const Bundle& one : bundles.all) {
      if (one.lit && (least == nullptr || one.others.walls < least->others.walls)) least = &one;
    }
    origin_ = color_ = least->seen.mean;
    if (bundles.tinted) tint_ = TintOf(color_).mean;
  }

  SharedColor Solve() {
    constexpr int kRounds = 4;  // shares and tint hang on the colours they tell
    for (int i = 0; i < (bundles_.tinted ? kRounds : 1); ++i) Round();
    SharedColor out;
    const Eigen::MatrixXd covariance = information_.inverse();
    out.color = {color_, covariance.topLeftCorner<2, 2>()};
    if (bundles_.tinted) out.by_others = out.color.covariance - CovarianceOfKnownOthers();
    out.scatters = bundles_.scatters;
    const double spare = static_cast<double>(bundles_.all.size()) - 1.0;
    if (spare > 0.0 && chi_squared_ > kDisagreement * spare) {
      out.disagrees = true;
      out.color.covariance *= chi_squared_ / (2.0 * spare);
    }
    return out;
  }

 private:
  [[nodiscard]] Eigen::Index count() const {
    return kInstruments + 2 * static_cast<Eigen::Index>(bundles_.instruments.size());
  }

  void Prior(Eigen::Index at, const Vector2& mean, const Matrix2& covariance) {
    const Matrix2 weight = covariance.inverse();
    information_.block<2, 2>(at, at) += weight;
    right_.segment<2>(at) += weight * mean;
    squares_ += mean.dot(weight * mean);
  }

  // Shares of illuminance weigh chromaticities by X + Y + Z, 1/y of a unit of Y.
  [[nodiscard]] Vector2 SharesOfXy(const OtherShares& others) const {
    constexpr double kLeastY = 0.05;
    const double walls = others.walls / std::max(kLeastY, color_[1] + tint_[1]);
    const double ambient = others.ambient / std::max(kLeastY, color_[1] + ambient_[1]);
    const double own = (1.0 - others.walls - others.ambient) / color_[1];
    return Vector2(walls, ambient) / (walls + ambient + own);
  }

  void Round() {
    information_ = Eigen::MatrixXd::Zero(count(), count());
    right_ = Eigen::VectorXd::Zero(count());
    squares_ = 0.0;
    for (std::size_t g = 0; g < bundles_.instruments.size(); ++g) {
      Prior(kInstruments + 2 * static_cast<Eigen::Index>(g), Vector2::Zero(),
            bundles_.instruments[g]);
    }
    TintAt tint{Vector2::Zero(), Matrix2::Identity(), Matrix2::Zero()};
    if (bundles_.tinted) tint = TintOf(color_);
    Prior(kTint, tint.mean, tint.covariance);
    Prior(kAmbientColor, Vector2::Zero(), CovarianceOfWhites());
    information_(kShareOfAll, kShareOfAll) += 1.0;
    for (const Bundle& one : bundles_.all) Add(one, tint.from_place);
    const Eigen::VectorXd solved = information_.ldlt().solve(right_);
    chi_squared_ = squares_ - right_.dot(solved);
    color_ = origin_ + solved.segment<2>(kColor);
    if (!bundles_.tinted) return;
    tint_ = solved.segment<2>(kTint);
    ambient_ = solved.segment<2>(kAmbientColor);
  }

  void Add(const Bundle& one, const Matrix2& from_place) {
    const Vector2 share = bundles_.tinted ? SharesOfXy(one.others) : Vector2::Zero();
    Matrix2 covariance = one.seen.covariance + kLeast * bundles_.instruments[one.instrument];
    covariance += share[0] * share[0] *
                  (from_place + one.others.own * one.others.own * tint_ * tint_.transpose());
    Eigen::MatrixXd by = Eigen::MatrixXd::Zero(2, count());
    by.middleCols<2>(kColor) = Matrix2::Identity();
    by.middleCols<2>(kTint) = share[0] * Matrix2::Identity();
    by.middleCols<2>(kAmbientColor) = share[1] * Matrix2::Identity();
    by.col(kShareOfAll) = share[0] * one.others.common * tint_;
    by.middleCols<2>(kInstruments + 2 * static_cast<Eigen::Index>(one.instrument)) =
        Matrix2::Identity();
    const Matrix2 weight = covariance.inverse();
    information_ += by.transpose() * weight * by;
    const Vector2 off = one.seen.mean - origin_;
    right_ += by.transpose() * weight * off;
    squares_ += off.dot(weight * off);
  }

  // Of the color, were walls and ambient light known.
  [[nodiscard]] Matrix2 CovarianceOfKnownOthers() const {
    std::vector<Eigen::Index> kept;
    for (Eigen::Index i = 0; i < count(); ++i) {
      if (i < kTint || i >= kInstruments) kept.push_back(i);
    }
    const Eigen::MatrixXd known = information_(kept, kept);
    return known.inverse().topLeftCorner<2, 2>();
  }

  static constexpr double kLeast = 1e-9;  // keeps one reading alone invertible
  const Bundles& bundles_;
  Vector2 origin_ = Vector2::Zero();  // small numbers square exactly
  Vector2 color_ = Vector2::Zero(), tint_ = Vector2::Zero(), ambient_ = Vector2::Zero();
  Eigen::MatrixXd information_;
  Eigen::VectorXd right_;
  double squares_ = 0.0, chi_squared_ = 0.0;
};

}  // namespace

SharedColor SolveSharedColor(const std::vector<ColorReading>& readings, CctMethod method) {
  Bundles bundles = BundlesOf(readings);
  const bool in_mired = !bundles.tinted && TakeToMired(bundles, method);
  SharedColor out = Problem(bundles).Solve();
  out.in_mired = in_mired;
  return out;
}

}  // namespace lightcal::fit
