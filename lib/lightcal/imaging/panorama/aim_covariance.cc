// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/panorama/aim_covariance.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "lightcal/core/statistics.h"
#include "lightcal/core/units.h"

namespace lightcal {
namespace {

constexpr double kField = 6.0 * kRadiansPerDegree;  // on a side, of common errors
constexpr double kUnseenBend = 1e-4;  // rims, of a term of ExtraBend that nothing shows
constexpr int kExtraBends = 6, kBendRounds = 30;
constexpr double kAimSd = 10.0 * kRadiansPerDegree;  // of a view that one field alone holds

// What a lens and a sensor may do beside f, a and b, at the place (u, v) as a share of the rim:
// sides that differ or lean, Brown's decentring, and an axis that is not in the middle, less the
// turn that this looks like.
std::array<double, 2> ExtraBend(int term, double u, double v) {
  switch (term) {
    case 0:
      return {u, -v};
    case 1:
      return {v, u};
    case 2:
      return {3.0 * u * u + v * v, 2.0 * u * v};
    case 3:
      return {2.0 * u * v, u * u + 3.0 * v * v};
    case 4:
      return {u * u, u * v};
    default:
      return {u * v, v * v};
  }
}

// How the rows change with each term, in rims.
AimMatrix ExtraColumns(const AimBundle& bundle, const AimVector& at) {
  constexpr double kStep = 1e-3;
  const double rim = RimPixels(bundle.view);
  const auto bent = [&](const std::array<double, 2>& point, int term) {
    const auto [x, y] = ExtraBend(term, (point[0] - bundle.view.width / 2.0) / rim,
                                  (bundle.view.height / 2.0 - point[1]) / rim);
    return std::array{point[0] + kStep * rim * x, point[1] - kStep * rim * y};
  };
  AimMatrix columns = AimMatrix::Zero(bundle.Rows(), kExtraBends);
  Eigen::Index row = 0;
  for (const AimMatch& match : bundle.matches) {
    const auto before = AimMisfit(bundle, match, at);
    const double scale = std::sqrt(match.weight) / bundle.sd_px / kStep;
    for (int term = 0; term < kExtraBends; ++term) {
      AimMatch moved = match;
      moved.at_a = bent(match.at_a, term);
      moved.at_b = bent(match.at_b, term);
      const auto after = AimMisfit(bundle, moved, at);
      columns(row, term) = scale * (after[0] - before[0]);
      columns(row + 1, term) = scale * (after[1] - before[1]);
    }
    row += 2;
  }
  return columns;
}

struct ExtraBends {
  AimVector mean;
  AimMatrix covariance;
};

// Their terms c given rows r = B c + errors of sd 1: normal about 0, all of one sd, which is the
// likeliest (expectation and maximisation), with one more term of kUnseenBend.
ExtraBends LikelyBends(const AimMatrix& columns, const AimVector& rows) {
  const AimMatrix normal = columns.transpose() * columns;
  const AimVector right = columns.transpose() * rows;
  const AimMatrix unit = AimMatrix::Identity(kExtraBends, kExtraBends);
  ExtraBends bends;
  double variance = 1e-6;
  for (int round = 0; round < kBendRounds; ++round) {
    bends.covariance = (normal + unit / variance).ldlt().solve(unit);
    bends.mean = bends.covariance * right;
    variance = (bends.mean.squaredNorm() + bends.covariance.trace() + kUnseenBend * kUnseenBend) /
               (kExtraBends + 1);
  }
  return bends;
}

// The matches of each field of 6 degrees, whose errors are taken to be one.
std::vector<std::vector<Eigen::Index>> FieldsOf(const AimBundle& bundle, const AimVector& at) {
  std::map<std::pair<int, int>, std::vector<Eigen::Index>> fields;
  for (std::size_t i = 0; i < bundle.matches.size(); ++i) {
    const AimMatch& match = bundle.matches[i];
    const Eigen::Vector3d d = AimDirection(bundle, match, at);
    const double height = std::asin(std::clamp(d[2], -1.0, 1.0));
    const std::pair field{
        static_cast<int>(std::floor(height / kField)),
        static_cast<int>(std::floor(std::atan2(d[0], d[1]) * std::cos(height) / kField))};
    fields[field].push_back(static_cast<Eigen::Index>(i));
  }
  std::vector<std::vector<Eigen::Index>> matches;
  for (auto& [field, of_it] : fields) matches.push_back(std::move(of_it));
  return matches;
}

// The second derivative of the matches' loss, Cauchy's:
//   J^T J - 2/c^2 sum (J^T r)(J^T r)^T.
AimMatrix CurvatureOf(const std::vector<Eigen::Index>& matches, const AimMatrix& jacobian,
                      const AimVector& residual) {
  const auto count = static_cast<Eigen::Index>(matches.size());
  AimMatrix rows(2 * count, jacobian.cols()), scores(jacobian.cols(), count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Index row = 2 * matches[static_cast<std::size_t>(i)];
    rows.middleRows<2>(2 * i) = jacobian.middleRows<2>(row);
    scores.col(i) = jacobian.middleRows<2>(row).transpose() * residual.segment<2>(row);
  }
  return rows.transpose() * rows -
         2.0 / (kCauchyScale * kCauchyScale) * (scores * scores.transpose());
}

// By how much leaving out one field after the other moves the parameters: the sum of squares. The
// scatter of few fields, of which some carry a view alone, is too small without (CR3).
// Source: Bell & McCaffrey, Survey Methodology 28 (2002) 169.
AimMatrix ScatterOfFields(const std::vector<std::vector<Eigen::Index>>& fields,
                          const AimMatrix& jacobian, const AimVector& residual,
                          const AimVector& rest, const AimMatrix& curvature) {
  AimMatrix scatter = AimMatrix::Zero(jacobian.cols(), jacobian.cols());
  for (const auto& field : fields) {
    const AimMatrix without = curvature - CurvatureOf(field, jacobian, residual);
    AimVector score = AimVector::Zero(jacobian.cols());
    for (const Eigen::Index match : field) {
      score += jacobian.middleRows<2>(2 * match).transpose() * rest.segment<2>(2 * match);
    }
    const AimVector moved = without.ldlt().solve(score);
    scatter += moved * moved.transpose();
  }
  return scatter;
}

}  // namespace

AimMatrix CovarianceOfAims(const AimBundle& bundle, const AimVector& at) {
  const AimRows rows{bundle};
  AimVector residual(rows.NumResiduals());
  AimMatrix jacobian(rows.NumResiduals(), rows.NumParameters());
  rows(at.data(), residual.data(), jacobian.data());
  const AimMatrix unit = AimMatrix::Identity(jacobian.cols(), jacobian.cols());

  const AimMatrix extra = ExtraColumns(bundle, at);
  // What a term of the lens moves the parameters by, and what it leaves in the rows beside that.
  const AimMatrix moved =
      (jacobian.transpose() * jacobian).ldlt().solve(jacobian.transpose() * extra);
  const AimMatrix left = extra - jacobian * moved;
  const ExtraBends bends = LikelyBends(left, residual);
  const AimMatrix bent = bends.mean * bends.mean.transpose() + bends.covariance;

  const auto fields = FieldsOf(bundle, at);
  const auto of_matches = 2 * static_cast<Eigen::Index>(bundle.matches.size());
  const auto beside = jacobian.bottomRows(jacobian.rows() - of_matches);
  AimMatrix curvature = beside.transpose() * beside;
  curvature.diagonal().head(bundle.Lens()).array() += 1.0 / (kAimSd * kAimSd);
  for (const auto& field : fields) curvature += CurvatureOf(field, jacobian, residual);
  const auto of_priors = jacobian.middleRows<kAimLensParameters>(of_matches);
  const AimMatrix priors = of_priors.transpose() * of_priors;
  const AimMatrix inverse = curvature.ldlt().solve(unit);
  return ScatterOfFields(fields, jacobian, residual, residual - left * bends.mean, curvature) +
         inverse * priors * inverse.transpose() + moved * bent * moved.transpose();
}

}  // namespace lightcal
