// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/monte_carlo.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include "lightcal/core/standard_normal.h"
#include "lightcal/core/statistics.h"
#include "lightcal/fit/model/least_squares.h"

namespace lightcal::fit {
namespace {

constexpr int kFigures = 4;  // mean, sd, low, high
constexpr int kFewestBlocks = 2;
constexpr double kTail = 0.025;
constexpr std::size_t kSamplesAFailure = 100;  // at least, for each draw without an optimum
// Standard deviations; what is left is about its square.
constexpr double kLastStepOfSample = 1e-2;

using Figures = std::array<double, kFigures>;

// FNV-1a over what was measured: the same readings, the same samples.
std::uint64_t SeedOf(const Estimation& estimation) {
  std::uint64_t hash = 14695981039346656037ULL;
  const auto add = [&hash](double x) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 1099511628211ULL;
  };
  for (const ReadingRow& row : estimation.rows) {
    add(row.distance);
    add(row.measured);
    add(row.sigma);
  }
  return hash;
}

// All by which the model tells a row from others, but what it measured and how surely.
auto KindOfRow(const ReadingRow& row) {
  const WallsOfRow walls = row.walls.value_or(WallsOfRow{});
  return std::tuple(row.form, row.distance, row.direct_gain, row.bounce, row.ambient_gain,
                    row.scale, row.instrument, row.calibration, row.data_sheet, row.picture,
                    row.shape.outline, row.shape.first, row.shape.second, row.walls.has_value(),
                    walls.x, walls.constant);
}

// Rows that are alike as one: their weighted mean holds all that they say of the parameters, as
//   sum w_i (y_i - f)^2 = W (y - f)^2 + constant,  y = sum w_i y_i/W,  W = sum w_i,
//   w_i = 1/sigma_i^2
// and is drawn by its own sigma, W^-1/2. Costs as many rows as there are places, not readings.
Estimation WithMeans(const Estimation& estimation) {
  Estimation out = estimation;
  std::vector<ReadingRow>& means = out.rows;
  means.clear();
  std::map<decltype(KindOfRow(ReadingRow{})), std::size_t> of_kind;
  for (const ReadingRow& row : estimation.rows) {
    // Off the axis a row's pose tells it apart too, and no mean is over range.
    const bool alone = row.off_axis || row.form == RowForm::kCensored;
    const auto [known, is_new] =
        alone ? std::pair(of_kind.end(), true) : of_kind.try_emplace(KindOfRow(row), means.size());
    if (is_new) {
      means.push_back(row);
      continue;
    }
    ReadingRow& mean = means[known->second];
    const double weight = 1.0 / (row.sigma * row.sigma);
    const double all = 1.0 / (mean.sigma * mean.sigma) + weight;
    const double part = weight / all;
    mean.measured = row.form == RowForm::kLinear
                        ? mean.measured + part * (row.measured - mean.measured)
                        : mean.measured * std::pow(row.measured / mean.measured, part);
    mean.sigma = 1.0 / std::sqrt(all);
  }
  return out;
}

// One draw after another of everything that is uncertain.
class Draws {
 public:
  explicit Draws(const UncertaintyInput& input)
      : input_(input), drawn_(*input.estimation), random_(SeedOf(*input.estimation)) {
    for (const ReadingRow& row : drawn_.rows) {
      instruments_ = std::max(instruments_, row.instrument + 1);
    }
    shared_.resize(static_cast<std::size_t>(instruments_) + input.considered.size());
    influence_.resize(drawn_.rows.size() * input.considered.size());
    const double intensity = std::exp(input.theta[kLnIntensity]);
    for (std::size_t i = 0; i < drawn_.rows.size(); ++i) {
      const ReadingRow& row = drawn_.rows[i];
      const bool log = row.form == ReadingRow::Form::kLog;
      for (std::size_t c = 0; c < input.considered.size(); ++c) {
        influence_[i * input.considered.size() + c] =
            log ? InfluenceOn(row, input.considered[c], intensity) : 0.0;
      }
    }
    const Linearised<Estimation> at = Linearise(*input.estimation, input.theta);
    const auto covariance = CovarianceAt(*input.estimation, at);
    moved_ = Eigen::VectorXd::Zero(at.residual.size());
    gain_ = -covariance.value_or(SquareOf<Estimation>::Zero()) * at.jacobian.transpose();
  }

  // The next draw's problem; `start` becomes the optimum's linear prediction.
  const Estimation& Next(Theta& start) {
    for (double& z : shared_) z = normal_(random_);
    const std::size_t influences = input_.considered.size();
    for (std::size_t i = 0; i < drawn_.rows.size(); ++i) {
      const ReadingRow& given = input_.estimation->rows[i];
      double relative = given.calibration * shared_[static_cast<std::size_t>(given.instrument)];
      for (std::size_t c = 0; c < influences; ++c) {
        relative +=
            influence_[i * influences + c] * shared_[static_cast<std::size_t>(instruments_) + c];
      }
      const double own = given.sigma * input_.row_scale * normal_(random_);
      drawn_.rows[i].measured = given.form == ReadingRow::Form::kLinear
                                    ? given.measured * (1.0 + relative) + own
                                    : given.measured * std::exp(relative + own);
      moved_[static_cast<Eigen::Index>(i)] =
          given.form == ReadingRow::Form::kLinear
              ? (drawn_.rows[i].measured - given.measured) / given.sigma
              : (relative + own) / given.sigma;
    }
    for (int k = 0; k < kParameters; ++k) {
      const ParameterRule& rule = input_.estimation->rules[k];
      if (!(rule.prior_sd > 0.0)) continue;
      const double value = rule.prior_mean + rule.prior_sd * normal_(random_);
      if (rule.free) {
        drawn_.rules[k].prior_mean = value;
        moved_[static_cast<Eigen::Index>(drawn_.rows.size()) + k] =
            (rule.prior_mean - value) / rule.prior_sd;
      } else {
        start[k] = k == kDistanceOffset ? std::max(value, drawn_.least_distance_offset) : value;
      }
    }
    const VectorOf<Estimation> step = gain_ * moved_;
    for (int k = 0; k < kParameters; ++k) start[k] += step[k];
    return drawn_;
  }

 private:
  const UncertaintyInput& input_;
  Estimation drawn_;
  std::mt19937_64 random_;
  StandardNormal normal_;
  int instruments_ = 0;
  std::vector<double> shared_;     // of each instrument, then of each considered influence
  std::vector<double> influence_;  // of each row and influence, relative
  Eigen::VectorXd moved_;          // what a draw adds to the whitened rows and priors
  Eigen::Matrix<double, kParameters, Eigen::Dynamic> gain_;  // d(optimum)/d(whitened rows)
};

Figures FiguresOf(std::vector<double>& samples) {
  const auto n = static_cast<double>(samples.size());
  double sum = 0.0;
  for (const double x : samples) sum += x;
  const double mean = sum / n;
  double squares = 0.0;
  for (const double x : samples) squares += (x - mean) * (x - mean);
  return {mean, std::sqrt(squares / (n - 1.0)), Quantile(samples, kTail),
          Quantile(samples, 1.0 - kTail)};
}

// Half of the last of `digits` significant digits of u.
double HalfDigit(double u, int digits) {
  return 0.5 * std::pow(10.0, std::floor(std::log10(u)) - (digits - 1));
}

// Mean over blocks and the standard deviation of that mean.
struct Spread {
  double mean = 0.0;
  double sd = 0.0;
};
Spread SpreadOf(const std::vector<Figures>& blocks, int figure) {
  const auto n = static_cast<double>(blocks.size());
  Spread out;
  for (const Figures& block : blocks) out.mean += block[figure] / n;
  double squares = 0.0;
  for (const Figures& block : blocks) squares += std::pow(block[figure] - out.mean, 2);
  out.sd = blocks.size() > 1 ? std::sqrt(squares / (n * (n - 1.0))) : 0.0;
  return out;
}

bool IsStable(const std::vector<Figures>& blocks, int digits) {
  const double u = SpreadOf(blocks, 1).mean;
  if (!(u > 0.0)) return true;
  for (int figure = 0; figure < kFigures; ++figure) {
    if (2.0 * SpreadOf(blocks, figure).sd > HalfDigit(u, digits)) return false;
  }
  return true;
}

// How many blocks will do, where the standard deviations of the means go on to fall by the root of
// their number.
double BlocksLikely(const std::vector<Figures>& blocks, int digits) {
  double needed = kFewestBlocks;
  const double u = SpreadOf(blocks, 1).mean;
  if (blocks.size() < kFewestBlocks || !(u > 0.0)) return needed;
  for (int figure = 0; figure < kFigures; ++figure) {
    const double over = 2.0 * SpreadOf(blocks, figure).sd / HalfDigit(u, digits);
    needed = std::max(needed, static_cast<double>(blocks.size()) * over * over);
  }
  return needed;
}

Result<std::array<Figures, kParameters>> SampleBlock(const UncertaintyInput& input,
                                                     std::size_t count, Draws& draws,
                                                     const Progress& progress) {
  constexpr std::size_t kDrawsTold = 64;  // a call of it costs less than a draw
  std::array<std::vector<double>, kParameters> samples;
  for (auto& one : samples) one.reserve(count);
  std::size_t failures = 0;
  while (samples.front().size() < count) {
    Theta start = input.theta;
    const Estimation& drawn = draws.Next(start);
    std::optional<Theta> theta = SolveCoarsely(drawn, start, kLastStepOfSample);
    if (!theta) {
      const Result<Theta> full = SolveInFull(drawn, start);
      if (full) theta = *full;
    }
    if (!theta) {
      if (++failures * kSamplesAFailure > count) {
        return Failed("no_convergence", "fit", "too many samples of the readings have no optimum");
      }
      continue;
    }
    for (int k = 0; k < kParameters; ++k) samples[k].push_back((*theta)[k]);
    if (progress && samples.front().size() % kDrawsTold == 0) {
      progress(static_cast<double>(samples.front().size()) / static_cast<double>(count));
    }
  }
  std::array<Figures, kParameters> out;
  for (int k = 0; k < kParameters; ++k) out[k] = FiguresOf(samples[k]);
  return out;
}

}  // namespace

SamplingRule JustSamples(int samples) {
  const SamplingRule usual;
  const int blocks = (samples + usual.block - 1) / usual.block;
  return {usual.digits, blocks, (samples + blocks - 1) / blocks, true};
}

Result<SampledEstimate> SampleEstimate(const UncertaintyInput& given, const SamplingRule& rule) {
  if (auto determined = EstimateCovariance(given); !determined) {
    return Propagate(std::move(determined));
  }
  const Estimation means = WithMeans(*given.estimation);
  UncertaintyInput input = given;
  input.estimation = &means;
  Draws draws(input);
  std::array<std::vector<Figures>, kParameters> blocks;
  SampledEstimate out;
  double done = 0.0;
  double likely = rule.all_blocks ? rule.largest_blocks : kFewestBlocks;
  for (int block = 0; block < rule.largest_blocks; ++block) {
    if (out.stable && !rule.all_blocks) break;
    const double end = std::max(done, std::min(1.0, (block + 1) / likely));
    const auto figures = SampleBlock(input, static_cast<std::size_t>(rule.block), draws,
                                     PartOf(rule.progress, done, end));
    if (!figures) return tl::unexpected(figures.error());
    done = end;
    out.stable = block + 1 >= kFewestBlocks;
    for (int k = 0; k < kParameters; ++k) {
      blocks[k].push_back((*figures)[k]);
      out.stable = out.stable && IsStable(blocks[k], rule.digits);
      if (rule.all_blocks) continue;
      likely = std::clamp(BlocksLikely(blocks[k], rule.digits), likely,
                          static_cast<double>(rule.largest_blocks));
    }
    out.samples += rule.block;
  }
  for (int k = 0; k < kParameters; ++k) {
    out.parameters[k] = {SpreadOf(blocks[k], 0).mean, SpreadOf(blocks[k], 1).mean,
                         SpreadOf(blocks[k], 2).mean, SpreadOf(blocks[k], 3).mean};
  }
  return out;
}

}  // namespace lightcal::fit
