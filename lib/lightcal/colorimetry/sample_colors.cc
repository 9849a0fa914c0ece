// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/sample_colors.h"

#include <algorithm>
#include <tuple>

#include "lightcal/colorimetry/cie_tables/samples.h"
#include "lightcal/core/every_processor.h"

namespace lightcal {
namespace {

using Lanes = SampleSet::Lanes;
constexpr std::size_t kLanes = std::tuple_size_v<Lanes>;
constexpr std::size_t kChannels = 6;  // X, Y, Z of the test light, then of the reference
using ChannelWeights = std::array<double, kChannels>;

// The values two and one step before the first of six, by Sprague's end formulae; the values beyond
// a table's last are these of the reversed table.
struct EndValues {
  double two_before, one_before;
};
EndValues BeforeFirst(const std::array<double, 6>& y) {
  return {(884 * y[0] - 1960 * y[1] + 3033 * y[2] - 2648 * y[3] + 1080 * y[4] - 180 * y[5]) / 209,
          (508 * y[0] - 540 * y[1] + 488 * y[2] - 367 * y[3] + 144 * y[4] - 24 * y[5]) / 209};
}

// One reflectance, with the two extrapolated values at each end.
std::vector<double> WithEnds(const std::vector<double>& y) {
  const std::size_t n = y.size();
  const EndValues before = BeforeFirst({y[0], y[1], y[2], y[3], y[4], y[5]});
  const EndValues after = BeforeFirst({y[n - 1], y[n - 2], y[n - 3], y[n - 4], y[n - 5], y[n - 6]});
  std::vector<double> all = {before.two_before, before.one_before};
  all.insert(all.end(), y.begin(), y.end());
  all.insert(all.end(), {after.one_before, after.two_before});
  return all;
}

// Between r[2] and r[3] of six equally spaced values, 0 <= t < 1.
double Sprague(const double* r, double t) {
  const double a1 = (2 * r[0] - 16 * r[1] + 16 * r[3] - 2 * r[4]) / 24;
  const double a2 = (-r[0] + 16 * r[1] - 30 * r[2] + 16 * r[3] - r[4]) / 24;
  const double a3 = (-9 * r[0] + 39 * r[1] - 70 * r[2] + 66 * r[3] - 33 * r[4] + 7 * r[5]) / 24;
  const double a4 = (13 * r[0] - 64 * r[1] + 126 * r[2] - 124 * r[3] + 61 * r[4] - 12 * r[5]) / 24;
  const double a5 = (-5 * r[0] + 25 * r[1] - 50 * r[2] + 50 * r[3] - 25 * r[4] + 5 * r[5]) / 24;
  return r[2] + t * (a1 + t * (a2 + t * (a3 + t * (a4 + t * a5))));
}

// A table's column at nanometre `nm`; columns carry their two end values.
double At(const std::vector<double>& column, int first_nm, int nm) {
  const auto row = static_cast<std::size_t>((nm - first_nm) / kSampleStepNm);
  const int rest = (nm - first_nm) % kSampleStepNm;
  if (rest == 0) return column[row + 2];
  return Sprague(&column[row], static_cast<double>(rest) / kSampleStepNm);
}

// The nanometres where a light has power, and there the power times each matching function.
struct Weights {
  std::vector<std::size_t> nanometre;
  std::vector<ChannelWeights> weight;
  ChannelWeights white{};
};

Weights WeightsOf(const NanometrePowers& test, const NanometrePowers& reference,
                  const std::array<CmfRow, kCmfCount>& cmf) {
  Weights weights;
  weights.nanometre.reserve(kRenderingCount);
  weights.weight.reserve(kRenderingCount);
  for (std::size_t k = 0; k < kRenderingCount; ++k) {
    if (test[k] == 0.0 && reference[k] == 0.0) continue;
    const CmfRow& c = cmf[k + (kRenderingFirstNm - kCmfFirstNm)];
    weights.nanometre.push_back(k);
    weights.weight.push_back({test[k] * c.x_bar, test[k] * c.y_bar, test[k] * c.z_bar,
                              reference[k] * c.x_bar, reference[k] * c.y_bar,
                              reference[k] * c.z_bar});
    for (std::size_t j = 0; j < kChannels; ++j) weights.white[j] += weights.weight.back()[j];
  }
  return weights;
}

// sum[j][lane] = sum over the weighted nanometres of weight_j times the reflectance of one sample
// in each lane.
LIGHTCAL_EVERY_CPU
void Accumulate(const Weights& w, const Lanes* block, std::array<Lanes, kChannels>& sum) {
  std::array<Lanes, kChannels> total{};
  for (std::size_t i = 0; i < w.weight.size(); ++i) {
    const Lanes& rho = block[w.nanometre[i]];
    for (std::size_t j = 0; j < kChannels; ++j) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        total[j][lane] += w.weight[i][j] * rho[lane];
      }
    }
  }
  sum = total;
}

Xyz Scaled(double x, double y, double z, double k) { return {k * x, k * y, k * z}; }

}  // namespace

SampleSet::SampleSet(std::span<const double> rows, int first_nm, std::size_t count)
    : count_(count), reflectance_((count + kLanes - 1) / kLanes * kRenderingCount) {
  for (std::size_t sample = 0; sample < count; ++sample) {
    std::vector<double> column;
    for (std::size_t i = sample; i < rows.size(); i += count) column.push_back(rows[i]);
    column = WithEnds(column);
    Lanes* block = &reflectance_[sample / kLanes * kRenderingCount];
    for (int k = 0; k < kRenderingCount; ++k) {
      block[k][sample % kLanes] = At(column, first_nm, kRenderingFirstNm + k);
    }
  }
}

double SampleSet::Reflectance(std::size_t sample, std::size_t nanometre) const {
  return reflectance_[sample / kLanes * kRenderingCount + nanometre][sample % kLanes];
}

std::array<SampleColors, 2> SampleSet::Under(const NanometrePowers& test,
                                             const NanometrePowers& reference,
                                             const std::array<CmfRow, kCmfCount>& cmf) const {
  const Weights w = WeightsOf(test, reference, cmf);
  std::array<SampleColors, 2> colors;
  std::array<double, 2> scale{};
  for (std::size_t light = 0; light < 2; ++light) {
    const double* white = &w.white[3 * light];
    scale[light] = 100.0 / white[1];
    colors[light].white = Scaled(white[0], white[1], white[2], scale[light]);
    colors[light].samples.resize(count_);
  }
  for (std::size_t first = 0; first < count_; first += kLanes) {
    const Lanes* block = &reflectance_[first / kLanes * kRenderingCount];
    std::array<Lanes, kChannels> sum{};
    Accumulate(w, block, sum);
    for (std::size_t lane = 0; lane < std::min(kLanes, count_ - first); ++lane) {
      for (std::size_t light = 0; light < 2; ++light) {
        colors[light].samples[first + lane] = Scaled(sum[3 * light][lane], sum[3 * light + 1][lane],
                                                     sum[3 * light + 2][lane], scale[light]);
      }
    }
  }
  return colors;
}

}  // namespace lightcal
