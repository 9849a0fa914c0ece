// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/states/emitters.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace lightcal::fit {
namespace {

constexpr double kFirst_nm = 378.0, kLast_nm = 782.0;  // of the spectra, what is looked at
constexpr Eigen::Index kMostEmitters = 8;
constexpr double kRepeats = 0.005, kMostNoise = 0.03, kNoises = 1.5;
constexpr int kDescentRounds = 200, kRoundsBetweenLooks = 10;

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

double LinearAt(const Spectrum& spectrum, double nm) {
  const std::vector<double>& at = spectrum.wavelengths_nm;
  const auto above = std::ranges::lower_bound(at, nm);
  if (above == at.end()) return 0.0;
  const auto i = static_cast<std::size_t>(above - at.begin());
  if (*above == nm) return spectrum.values[i];
  if (i == 0) return 0.0;
  const double share = (nm - at[i - 1]) / (at[i] - at[i - 1]);
  return spectrum.values[i - 1] + share * (spectrum.values[i] - spectrum.values[i - 1]);
}

Rows AmountsOf(const Rows& readings, const Rows& emitters) {
  const Rows gram = emitters * emitters.transpose();
  const Rows products = readings * emitters.transpose();
  const std::vector<double> g(gram.data(), gram.data() + gram.size());
  Rows out(readings.rows(), emitters.rows());
  for (Eigen::Index i = 0; i < readings.rows(); ++i) {
    const double* const row = products.data() + i * products.cols();
    const std::vector<double> x =
        NonNegativeLeastSquares(g, {row, row + static_cast<std::size_t>(products.cols())});
    for (Eigen::Index k = 0; k < emitters.rows(); ++k) {
      out(i, k) = x[static_cast<std::size_t>(k)];
    }
  }
  return out;
}

// Of readings whose rms is 1.
double RootMeanSquare(const Eigen::Ref<const Eigen::RowVectorXd>& left) {
  return std::sqrt(left.squaredNorm() / static_cast<double>(left.size()));
}

// What differs from sample to sample: second differences of white noise have 6 times its variance.
double NoiseIn(const Eigen::Ref<const Eigen::RowVectorXd>& left) {
  const Eigen::Index inner = left.size() - 2;
  if (inner < 1) return 0.0;
  const Eigen::RowVectorXd bend =
      left.head(inner) - 2.0 * left.segment(1, inner) + left.tail(inner);
  return std::sqrt(bend.squaredNorm() / (6.0 * static_cast<double>(inner)));
}

bool WithinNoise(const Rows& left) {
  for (Eigen::Index i = 0; i < left.rows(); ++i) {
    const double noise = std::clamp(kNoises * NoiseIn(left.row(i)), kRepeats, kMostNoise);
    if (RootMeanSquare(left.row(i)) > noise) return false;
  }
  return true;
}

// The reading that is least like some other: of all readings an end, and no mixture between.
Eigen::Index LeastMixed(const Rows& readings) {
  Eigen::Index row = 0;
  Eigen::Index column = 0;
  (readings * readings.transpose()).minCoeff(&row, &column);
  return row;
}

Eigen::Index FarthestOf(const Rows& left) {
  Eigen::Index farthest = 0;
  left.rowwise().squaredNorm().maxCoeff(&farthest);
  return farthest;
}

// What no mixtures of any so many emitters, and of none fewer, would leave: below 0 or not.
Rows LeftOfRank(const Rows& readings, const Eigen::MatrixXd& directions, Eigen::Index rank) {
  const auto kept = directions.rightCols(rank);  // eigenvalues rise
  return readings - (readings * kept) * kept.transpose();
}

struct Factors {
  Rows emitters, amounts;
};

// One round of hierarchical alternating least squares, emitters first.
void Alternate(const Rows& readings, Factors& factors) {
  const auto update = [](const Rows& gram, const Rows& product, Rows& rows) {
    for (Eigen::Index k = 0; k < rows.rows(); ++k) {
      if (!(gram(k, k) > 0.0)) continue;
      const Eigen::RowVectorXd step = (product.row(k) - gram.row(k) * rows) / gram(k, k);
      rows.row(k) = (rows.row(k) + step).cwiseMax(0.0);
    }
  };
  const Rows across = factors.amounts.transpose();
  update(across * factors.amounts, across * readings, factors.emitters);
  Rows amounts = across;
  update(factors.emitters * factors.emitters.transpose(), factors.emitters * readings.transpose(),
         amounts);
  factors.amounts = amounts.transpose();
}

// These emitters as far as the readings ask for; whether their mixtures give every reading.
bool Grow(const Rows& readings, Factors& factors) {
  const auto gives = [&] {
    factors.amounts = AmountsOf(readings, factors.emitters);
    return WithinNoise(readings - factors.amounts * factors.emitters);
  };
  bool within = gives();
  // A reading that stands for an emitter has noise of its own, which one look takes off.
  for (int round = 0; round < kDescentRounds; round += kRoundsBetweenLooks) {
    if (within && round > 0) return true;
    for (int i = 0; i < kRoundsBetweenLooks; ++i) Alternate(readings, factors);
    within = gives();
  }
  return within;
}

std::vector<std::vector<double>> Listed(const Rows& rows) {
  std::vector<std::vector<double>> out;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const double* const row = rows.data() + i * rows.cols();
    out.emplace_back(row, row + rows.cols());
  }
  return out;
}

}  // namespace

std::vector<double> NonNegativeLeastSquares(const std::vector<double>& gram,
                                            const std::vector<double>& product) {
  const auto n = static_cast<Eigen::Index>(product.size());
  const Eigen::Map<const Rows> g(gram.data(), n, n);
  const Eigen::Map<const Eigen::VectorXd> b(product.data(), n);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
  std::vector<Eigen::Index> set;
  const double slack =
      1e-12 * std::max(b.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
  const auto solved = [&] {
    const auto count = static_cast<Eigen::Index>(set.size());
    Eigen::MatrixXd part(count, count);
    Eigen::VectorXd wanted(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      wanted[i] = b[set[static_cast<std::size_t>(i)]];
      for (Eigen::Index j = 0; j < count; ++j) {
        part(i, j) = g(set[static_cast<std::size_t>(i)], set[static_cast<std::size_t>(j)]);
      }
    }
    return Eigen::VectorXd(part.ldlt().solve(wanted));
  };
  for (Eigen::Index round = 0; round < 3 * n; ++round) {
    const Eigen::VectorXd slope = b - g * x;
    Eigen::Index steepest = -1;
    for (Eigen::Index k = 0; k < n; ++k) {
      const bool held = std::ranges::find(set, k) == set.end() && slope[k] > slack;
      if (held && (steepest < 0 || slope[k] > slope[steepest])) steepest = k;
    }
    if (steepest < 0) break;
    set.push_back(steepest);
    while (!set.empty()) {
      const Eigen::VectorXd to = solved();
      // As far towards it as all stay above 0; what reaches 0 first is held there.
      double step = 1.0;
      std::size_t first = set.size();
      for (std::size_t i = 0; i < set.size(); ++i) {
        const double wanted = to[static_cast<Eigen::Index>(i)];
        const double from = x[set[i]];
        if (wanted > 0.0) continue;
        const double part = from > 0.0 ? from / (from - wanted) : 0.0;
        if (first == set.size() || part < step) {
          step = part;
          first = i;
        }
      }
      for (std::size_t i = 0; i < set.size(); ++i) {
        x[set[i]] += step * (to[static_cast<Eigen::Index>(i)] - x[set[i]]);
      }
      if (first == set.size()) break;
      x[set[first]] = 0.0;
      set.erase(set.begin() + static_cast<std::ptrdiff_t>(first));
    }
  }
  return {x.data(), x.data() + n};
}

EmitterMixtures EmitterMixturesOf(const std::vector<std::vector<double>>& readings) {
  const auto n = static_cast<Eigen::Index>(readings.size());
  if (n < 2 || readings.front().empty()) return {};
  const auto samples = static_cast<Eigen::Index>(readings.front().size());
  Rows rows(n, samples);
  Eigen::VectorXd scales(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::vector<double>& reading = readings[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j < samples; ++j) rows(i, j) = reading[static_cast<std::size_t>(j)];
    scales[i] = RootMeanSquare(rows.row(i));
    if (!(scales[i] > 0.0)) return {};
    rows.row(i) /= scales[i];
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> directions(rows.transpose() * rows);
  Factors factors;
  std::vector<Eigen::Index> purest = {LeastMixed(rows)};
  bool within = false;
  while (!within && static_cast<Eigen::Index>(purest.size()) < std::min(kMostEmitters + 1, n)) {
    factors.emitters.resize(static_cast<Eigen::Index>(purest.size()), samples);
    for (std::size_t k = 0; k < purest.size(); ++k) {
      factors.emitters.row(static_cast<Eigen::Index>(k)) = rows.row(purest[k]);
    }
    const Rows inside = rows - AmountsOf(rows, factors.emitters) * factors.emitters;
    const auto rank = std::min(static_cast<Eigen::Index>(purest.size()), samples);
    within = WithinNoise(LeftOfRank(rows, directions.eigenvectors(), rank)) && Grow(rows, factors);
    if (!within) purest.push_back(FarthestOf(inside));
  }
  if (!within) return {};
  EmitterMixtures out;
  const Rows left = rows - factors.amounts * factors.emitters;
  out.residual = std::sqrt(left.squaredNorm() / static_cast<double>(left.size()));
  for (Eigen::Index k = 0; k < factors.emitters.rows(); ++k) {
    const double peak = factors.emitters.row(k).maxCoeff();
    if (!(peak > 0.0)) return {};
    factors.emitters.row(k) /= peak;
    factors.amounts.col(k) = factors.amounts.col(k).cwiseProduct(scales) * peak;
  }
  out.emitters = Listed(factors.emitters);
  out.amounts = Listed(factors.amounts);
  return out;
}

void FindEmitters(FittedLight& light) {
  light.emitters.reset();
  std::vector<MeasuredState*> with;
  for (MeasuredState& state : light.states) {
    state.emitter_amounts.clear();
    if (state.spectrum && state.relative.value > 0.0) with.push_back(&state);
  }
  if (with.size() < 2) return;
  FixtureEmitters out;
  for (const double nm : with.front()->spectrum->wavelengths_nm) {
    if (nm >= kFirst_nm && nm <= kLast_nm) out.wavelengths_nm.push_back(nm);
  }
  std::vector<std::vector<double>> rows;
  for (const MeasuredState* const state : with) {
    Spectrum of_light = *state->spectrum;
    of_light.quantity = SpectralQuantity::kIrradiance;
    const auto xyz = XyzFromSpectrum(of_light);
    if (!xyz || !(xyz->Y > 0.0)) return;
    std::vector<double> row;
    for (const double nm : out.wavelengths_nm) {
      row.push_back(std::max(0.0, LinearAt(of_light, nm)) * state->relative.value / xyz->Y);
    }
    rows.push_back(std::move(row));
  }
  EmitterMixtures mixtures = EmitterMixturesOf(rows);
  if (mixtures.emitters.empty()) return;
  out.spectra = static_cast<int>(with.size());
  out.residual = mixtures.residual;
  std::vector<double> power;
  for (const std::vector<double>& values : mixtures.emitters) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    power.push_back(sum);
    const auto xyz = XyzFromSpectrum({out.wavelengths_nm, values, SpectralQuantity::kRelative});
    out.found.push_back({values, xyz ? std::optional(XyFromXyz(*xyz)) : std::nullopt, {}, 0.0});
  }
  for (std::size_t i = 0; i < with.size(); ++i) {
    with[i]->emitter_amounts = mixtures.amounts[i];
    double whole = 0.0;
    for (std::size_t k = 0; k < power.size(); ++k) whole += mixtures.amounts[i][k] * power[k];
    for (std::size_t k = 0; k < power.size() && whole > 0.0; ++k) {
      const double share = mixtures.amounts[i][k] * power[k] / whole;
      if (share <= out.found[k].purest_share) continue;
      out.found[k].purest = with[i]->state;
      out.found[k].purest_share = share;
    }
  }
  light.emitters = std::move(out);
}

}  // namespace lightcal::fit
