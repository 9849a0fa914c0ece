// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/light_view.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "lightcal/colorimetry/cie_tables/samples.h"
#include "lightcal/colorimetry/sample_colors.h"
#include "lightcal/core/every_processor.h"

namespace lightcal {
namespace {

constexpr std::size_t kCieSkin = 12;       // sample 13 of CIE 13.3
constexpr std::size_t kJapaneseSkin = 14;  // sample 15 of JIS Z 8726
// Samples 15 and 18 of CIE 224, then the two of older tables, counted from 0 without the white.
constexpr std::array<std::size_t, 4> kSkinTones = {14, 17, 99, 100};

using Reflectances = std::array<NanometrePowers, kViewedCount>;

Reflectances MakeReflectances() {
  const SampleSet fidelity({CfiSamples().front().data(), kCfiRowCount * kCfiSampleCount},
                           kCfiFirstNm, kCfiSampleCount);
  const SampleSet older({CriSamples().front().data(), kCriRowCount * kCriSampleCount}, kCriFirstNm,
                        kCriSampleCount);
  Reflectances all{};
  all[0].fill(1.0);
  for (std::size_t k = 0; k < kRenderingCount; ++k) {
    for (std::size_t i = 0; i < kCfiSampleCount; ++i) all[i + 1][k] = fidelity.Reflectance(i, k);
    all[kCfiSampleCount + 1][k] = older.Reflectance(kCieSkin, k);
    all[kCfiSampleCount + 2][k] = older.Reflectance(kJapaneseSkin, k);
  }
  return all;
}
const Reflectances& ViewedReflectances() {
  static const Reflectances reflectances = MakeReflectances();
  return reflectances;
}

// What stands at a place of the weights: the white, then the samples in strides over the circle of
// hues they are listed along, so that the first few foretell the mean of all.
constexpr std::size_t kStride = 37;  // no divisor of 101
constexpr std::size_t ViewedAt(std::size_t place) {
  return place == 0 ? 0 : (place - 1) * kStride % kViewedSamples + 1;
}

double Distance(const Cam02Ucs& a, const Cam02Ucs& b) {
  const double dJ = a.J - b.J;
  const double da = a.a - b.a;
  const double db = a.b - b.b;
  return std::sqrt(dJ * dJ + da * da + db * db);
}

constexpr NodeValues Ones() {
  NodeValues ones{};
  ones.fill(1.0);
  return ones;
}
constexpr NodeValues kOnes = Ones();

// sum[channel][sample] = sum over the nodes of the channel's factor times the weight.
using NodeBlock = std::array<std::array<double, 4>, 3>;
LIGHTCAL_EVERY_CPU
void SumOverNodes(const NodeBlock* weights, const double* red, const double* green,
                  const double* blue, NodeBlock& sum) {
  NodeBlock total{};
  for (std::size_t k = 0; k < kNodeCount; ++k) {
    const NodeBlock& w = weights[k];
    for (std::size_t lane = 0; lane < w[0].size(); ++lane) total[0][lane] += red[k] * w[0][lane];
    for (std::size_t lane = 0; lane < w[1].size(); ++lane) total[1][lane] += green[k] * w[1][lane];
    for (std::size_t lane = 0; lane < w[2].size(); ++lane) total[2][lane] += blue[k] * w[2][lane];
  }
  sum = total;
}

NodeValues Product(const NodeValues& a, const NodeValues& b) {
  return StackOf(a, b, SheetGap::kNone);
}

}  // namespace

ViewChannels ObserverChannels(ObserverAngle angle) {
  const bool two = angle == ObserverAngle::kTwoDegrees;
  const auto& table = two ? Cie1931Cmf() : Cie1964Cmf();
  ViewChannels view;
  view.name = two ? "CIE 1931 2 degree observer" : "CIE 1964 10 degree observer";
  for (std::size_t k = 0; k < kRenderingCount; ++k) {
    const CmfRow& row = table[k + (kRenderingFirstNm - kCmfFirstNm)];
    view.channels[0][k] = row.x_bar;
    view.channels[1][k] = row.y_bar;
    view.channels[2][k] = row.z_bar;
  }
  return view;
}

LightView::Weights LightView::WeightsOf(const ViewChannels& view, const NanometrePowers& light) {
  Weights weights(kBlocks * kNodeCount);
  for (std::size_t place = 0; place < kViewedCount; ++place) {
    const NanometrePowers& reflectance = ViewedReflectances()[ViewedAt(place)];
    Block* const block = &weights[place / kLanes * kNodeCount];
    const std::size_t lane = place % kLanes;
    for (std::size_t k = 0; k < kRenderingCount; ++k) {
      const double power = light[k] * reflectance[k];
      if (power == 0.0) continue;
      const std::size_t node = std::min(k / kNodeStepNm, std::size_t{kNodeCount - 2});
      const double t = static_cast<double>(k - node * kNodeStepNm) / kNodeStepNm;
      for (std::size_t c = 0; c < 3; ++c) {
        block[node][c][lane] += (1.0 - t) * power * view.channels[c][k];
        block[node + 1][c][lane] += t * power * view.channels[c][k];
      }
    }
  }
  return weights;
}

void LightView::Sum(const Block* weights, const Factors& factors, Block& sum) {
  SumOverNodes(weights, factors.red, factors.green, factors.blue, sum);
}

Xyz LightView::ColorOf(const Block& sum, std::size_t lane, const Column3& balance,
                       double level) const {
  const Column3 xyz = Times(xyz_from_balanced_,
                            {level * balance[0] * sum[0][lane], level * balance[1] * sum[1][lane],
                             level * balance[2] * sum[2][lane]});
  return {xyz[0], xyz[1], xyz[2]};
}

// Row by row: sum of the row = the white's component, so two coefficients are free.
Result<void> LightView::FitMatrix(const std::vector<Xyz>& wanted) {
  double aa = 0.0, ab = 0.0, bb = 0.0;
  std::array<double, 3> ay{}, by{};
  const Column3 white = {white_.X, white_.Y, white_.Z};
  for (std::size_t block = 0; block < kBlocks; ++block) {
    Block sum{};
    Sum(&target_[block * kNodeCount], {kOnes.data(), kOnes.data(), kOnes.data()}, sum);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::size_t place = block * kLanes + lane;
      if (place == 0 || place >= kViewedCount) continue;
      const double red = balance_[0] * sum[0][lane];
      const double green = balance_[1] * sum[1][lane];
      const double blue = balance_[2] * sum[2][lane];
      const double a = red - blue;
      const double b = green - blue;
      aa += a * a;
      ab += a * b;
      bb += b * b;
      const Xyz& w = wanted[ViewedAt(place)];
      const Column3 component = {w.X, w.Y, w.Z};
      for (std::size_t row = 0; row < 3; ++row) {
        const double rest = component[row] - white[row] * blue;
        ay[row] += a * rest;
        by[row] += b * rest;
      }
    }
  }
  const double determinant = aa * bb - ab * ab;
  constexpr double kSingular = 1e-9;
  if (!(determinant > kSingular * aa * bb)) {
    return Refused("blind_view", name_, "its channels cannot tell colours apart under this target");
  }
  for (std::size_t row = 0; row < 3; ++row) {
    const double a = (ay[row] * bb - by[row] * ab) / determinant;
    const double b = (by[row] * aa - ay[row] * ab) / determinant;
    xyz_from_balanced_[row] = {a, b, white[row] - a - b};
  }
  return {};
}

Result<LightView> LightView::Make(const ViewChannels& view, const NanometrePowers& lamp,
                                  const NanometrePowers& target, ObserverAngle angle) {
  const ViewChannels observer = ObserverChannels(angle);
  std::vector<Xyz> wanted(kViewedCount);
  for (std::size_t i = 0; i < kViewedCount; ++i) {
    Column3 xyz{};
    for (std::size_t k = 0; k < kRenderingCount; ++k) {
      const double power = target[k] * ViewedReflectances()[i][k];
      for (std::size_t c = 0; c < 3; ++c) xyz[c] += power * observer.channels[c][k];
    }
    wanted[i] = {xyz[0], xyz[1], xyz[2]};
  }
  const double scale = 100.0 / wanted[0].Y;
  for (Xyz& each : wanted) each = {scale * each.X, scale * each.Y, scale * each.Z};
  LightView made(wanted[0]);
  made.name_ = view.name;
  made.lamp_ = WeightsOf(view, lamp);
  made.target_ = WeightsOf(view, target);
  Block white{};
  Block lamp_white{};
  const Factors plain = {kOnes.data(), kOnes.data(), kOnes.data()};
  Sum(made.target_.data(), plain, white);
  Sum(made.lamp_.data(), plain, lamp_white);
  for (std::size_t c = 0; c < 3; ++c) {
    if (!(white[c][0] > 0.0) || !(lamp_white[c][0] >= 0.0)) {
      return Refused("blind_view", view.name, "one of its channels does not see the light at all");
    }
    made.balance_[c] = 1.0 / white[c][0];
  }
  if (auto fitted = made.FitMatrix(wanted); !fitted) return Propagate(std::move(fitted));
  made.target_ucs_.resize(kViewedCount);
  for (std::size_t block = 0; block < kBlocks; ++block) {
    Block sum{};
    Sum(&made.target_[block * kNodeCount], plain, sum);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::size_t place = block * kLanes + lane;
      if (place >= kViewedCount) continue;
      made.target_ucs_[place] = made.ucs_.Of(made.ColorOf(sum, lane, made.balance_, 1.0));
    }
  }
  return made;
}

double LightView::Difference(const NodeValues& transmittance, double give_up) const {
  const Factors factors = {transmittance.data(), transmittance.data(), transmittance.data()};
  const double enough = give_up * kViewedSamples;
  double level = 0.0;
  double total = 0.0;
  for (std::size_t block = 0; block < kBlocks; ++block) {
    Block sum{};
    Sum(&lamp_[block * kNodeCount], factors, sum);
    if (block == 0) {
      const double seen = ColorOf(sum, 0, balance_, 1.0).Y;
      if (!(seen > 0.0)) return std::numeric_limits<double>::infinity();
      level = white_.Y / seen;
    }
    for (std::size_t lane = block == 0 ? 1 : 0; lane < kLanes; ++lane) {
      const std::size_t place = block * kLanes + lane;
      if (place >= kViewedCount) break;
      total += Distance(ucs_.Of(ColorOf(sum, lane, balance_, level)), target_ucs_[place]);
    }
    if (total > enough) return total / kViewedSamples;
  }
  return total / kViewedSamples;
}

double LightView::Difference(const ViewFactors& factors) const {
  const auto with = [&](const NodeValues& light) {
    std::array<NodeValues, 3> all{};
    for (std::size_t c = 0; c < 3; ++c) all[c] = Product(light, factors.channel[c]);
    return all;
  };
  const auto lamp = with(factors.lamp);
  const auto target = with(factors.target);
  Column3 balance{};
  double level = 0.0;
  double target_level = 0.0;
  double total = 0.0;
  for (std::size_t block = 0; block < kBlocks; ++block) {
    Block of_lamp{};
    Block of_target{};
    Sum(&lamp_[block * kNodeCount], {lamp[0].data(), lamp[1].data(), lamp[2].data()}, of_lamp);
    Sum(&target_[block * kNodeCount], {target[0].data(), target[1].data(), target[2].data()},
        of_target);
    if (block == 0) {
      for (std::size_t c = 0; c < 3; ++c) balance[c] = 1.0 / of_target[c][0];
      const double seen = ColorOf(of_lamp, 0, balance, 1.0).Y;
      if (!(seen > 0.0)) return std::numeric_limits<double>::infinity();
      level = white_.Y / seen;
      target_level = white_.Y / ColorOf(of_target, 0, balance, 1.0).Y;
    }
    for (std::size_t lane = block == 0 ? 1 : 0; lane < kLanes; ++lane) {
      if (block * kLanes + lane >= kViewedCount) break;
      total += Distance(ucs_.Of(ColorOf(of_lamp, lane, balance, level)),
                        ucs_.Of(ColorOf(of_target, lane, balance, target_level)));
    }
  }
  return total / kViewedSamples;
}

LightView::Seen LightView::See(const NodeValues& transmittance) const {
  Seen seen;
  seen.samples.resize(kViewedCount);
  seen.difference.resize(kViewedCount);
  double level = 0.0;
  for (std::size_t block = 0; block < kBlocks; ++block) {
    Block sum{};
    Sum(&lamp_[block * kNodeCount],
        {transmittance.data(), transmittance.data(), transmittance.data()}, sum);
    if (block == 0) level = white_.Y / ColorOf(sum, 0, balance_, 1.0).Y;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::size_t place = block * kLanes + lane;
      if (place >= kViewedCount) break;
      const Xyz color = ColorOf(sum, lane, balance_, level);
      seen.samples[ViewedAt(place)] = color;
      seen.difference[ViewedAt(place)] = Distance(ucs_.Of(color), target_ucs_[place]);
    }
  }
  for (std::size_t i = 1; i < kViewedCount; ++i) {
    seen.mean += seen.difference[i] / kViewedSamples;
    seen.worst = std::max(seen.worst, seen.difference[i]);
  }
  for (const std::size_t tone : kSkinTones) {
    seen.skin += seen.difference[tone + 1] / static_cast<double>(kSkinTones.size());
  }
  return seen;
}

std::vector<Xyz> LightView::Target() const {
  std::vector<Xyz> samples(kViewedCount);
  for (std::size_t block = 0; block < kBlocks; ++block) {
    Block sum{};
    Sum(&target_[block * kNodeCount], {kOnes.data(), kOnes.data(), kOnes.data()}, sum);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::size_t place = block * kLanes + lane;
      if (place < kViewedCount) samples[ViewedAt(place)] = ColorOf(sum, lane, balance_, 1.0);
    }
  }
  return samples;
}

}  // namespace lightcal
