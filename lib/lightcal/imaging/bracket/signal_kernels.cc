// SPDX-License-Identifier: Apache-2.0
#include "signal_kernels.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lightcal/core/every_processor.h"

// Of the loop that follows: what one pointer writes no other one reads. GCC gives up on vectorising
// where it would have to check more than ten pairs of pointers.
#if defined(__GNUC__) && !defined(__clang__)
#define LIGHTCAL_INDEPENDENT _Pragma("GCC ivdep")
#else
#define LIGHTCAL_INDEPENDENT
#endif

namespace lightcal::kernels {
namespace {

// Below every signal. Loops choose between two numbers and never branch: a branch is not
// vectorised.
constexpr float kNever = -std::numeric_limits<float>::infinity();

// Chi-square of n degrees of freedom beyond which frames contradict each other: five standard
// deviations above its mean.
inline float ContradictionAt(float degrees) { return degrees + 5.0F * std::sqrt(2.0F * degrees); }

}  // namespace

LIGHTCAL_EVERY_CPU
void SignalFromCodes(const std::uint16_t* in, std::size_t count, const Lanes& black,
                     const Lanes& scale, float* out) {
  const std::size_t whole = count / kLanes * kLanes;
  for (std::size_t i = 0; i < whole; i += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      out[i + lane] = (static_cast<float>(in[i + lane]) - black[lane]) * scale[lane];
    }
  }
  for (std::size_t i = whole; i < count; ++i) {
    out[i] = (static_cast<float>(in[i]) - black[i - whole]) * scale[i - whole];
  }
}

LIGHTCAL_EVERY_CPU
void SignalFromFloats(const float* in, std::size_t count, const Lanes& black, const Lanes& scale,
                      float* out) {
  const std::size_t whole = count / kLanes * kLanes;
  for (std::size_t i = 0; i < whole; i += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      out[i + lane] = (in[i + lane] - black[lane]) * scale[lane];
    }
  }
  for (std::size_t i = whole; i < count; ++i) {
    out[i] = (in[i] - black[i - whole]) * scale[i - whole];
  }
}

namespace {

// A block's numbers between the passes, each of kBlock samples.
struct Scratch {
  float* sum;
  float* predicted;  // X
  float* weights;    // sum of t^2/Var
  float* degrees;    // frames that count, less one
  float* noise;      // Var of sum; of the likelihood sum w^2 / sum w, w = t^2/Var
  float* limit;
  float* clip;
};

// Pass 1, X from frames 0..i for the last i whose predicted signal t_i X is believed. X_i =
// sum c y / sum c t is the sufficient statistic of Poisson noise, so that choosing by it does not
// bias what is chosen; and a clipped frame can never pass, because every X_k t_i >= y_k t_i / t_k.
// (The mean of a block that holds one clipped sample can, so it is at the clip by itself.)
LIGHTCAL_EVERY_CPU
void Predict(const BlockIn& in, const BlockOut& out, const Scratch& scratch) {
  const std::size_t count = in.count;
  float* sum = scratch.sum;
  float* predicted = scratch.predicted;
  float* used = out.used;
  const float* limit = scratch.limit;
  const float* clip = scratch.clip;
  LIGHTCAL_INDEPENDENT
  for (std::size_t i = 0; i < count; ++i) {
    sum[i] = 0.0F;
    used[i] = -1.0F;
    predicted[i] = in.signals[i] / in.frames[0].exposure;
  }
  for (std::size_t k = 0; k < in.frames.size(); ++k) {
    const FrameConstants frame = in.frames[k];
    const float* y = in.signals + k * kBlock;
    const float index = static_cast<float>(k);
    LIGHTCAL_INDEPENDENT
    for (std::size_t i = 0; i < count; ++i) {
      sum[i] += frame.poisson_weight * y[i];
      const float x = sum[i] * frame.prefix_reciprocal;
      // Both at once: how far below its limit the one that is farthest above it lies.
      const float above = std::max(x * frame.exposure - limit[i], y[i] - clip[i]);
      const bool believed = above < 0.0F;
      predicted[i] = believed ? x : predicted[i];
      used[i] = believed ? index : used[i];
    }
  }
}

// 1 where frame `index` counts for a sample whose predicted signal in it is tX, else 0.
inline float Counts(float index, float used, float predicted_signal, float floor) {
  const float least = used == index ? kNever : floor;
  const float seen = predicted_signal >= least ? 1.0F : 0.0F;
  return index <= used ? seen : 0.0F;
}

// X of what Weigh summed up.
LIGHTCAL_EVERY_CPU
void Mean(const BlockIn& in, const BlockOut& out, const Scratch& scratch) {
  const std::size_t count = in.count;
  const float* sum = scratch.sum;
  const float* weights = scratch.weights;
  const float* predicted = scratch.predicted;
  const float* used = out.used;
  float* value = out.value;
  LIGHTCAL_INDEPENDENT
  for (std::size_t i = 0; i < count; ++i) {
    // Clipped samples have neither sum nor weights.
    const float clipped = used[i] < 0.0F ? 1.0F : 0.0F;
    value[i] = (sum[i] + clipped * predicted[i]) / (weights[i] + clipped);
  }
}

// Pass 2: weights from the predicted signal, not from the noisy sample.
LIGHTCAL_EVERY_CPU
void Weigh(const BlockIn& in, const BlockOut& out, const Scratch& scratch) {
  const std::size_t count = in.count;
  float* sum = scratch.sum;
  float* weights = scratch.weights;
  float* degrees = scratch.degrees;
  const float* predicted = scratch.predicted;
  const float* used = out.used;
  LIGHTCAL_INDEPENDENT
  for (std::size_t i = 0; i < count; ++i) {
    sum[i] = 0.0F;
    weights[i] = 0.0F;
    degrees[i] = -1.0F;
  }
  for (std::size_t k = 0; k < in.frames.size(); ++k) {
    const FrameConstants frame = in.frames[k];
    const float* y = in.signals + k * kBlock;
    float* precision = in.precisions + k * kBlock;
    const float index = static_cast<float>(k);
    LIGHTCAL_INDEPENDENT
    for (std::size_t i = 0; i < count; ++i) {
      const float x = std::max(predicted[i], 0.0F);
      const float inverse = 1.0F / (frame.shot * x + frame.read);
      const float counts = Counts(index, used[i], x * frame.exposure, frame.floor);
      precision[i] = counts * inverse;
      degrees[i] += counts;
      const float weight = precision[i] * frame.exposure;
      sum[i] += weight * y[i];
      weights[i] += weight * frame.exposure;
    }
  }
  Mean(in, out, scratch);
}

// The same of frames that were interpolated: less noise is left here than there.
LIGHTCAL_EVERY_CPU
void WeighShares(const BlockIn& in, const BlockOut& out, const Scratch& scratch) {
  const std::size_t count = in.count;
  const float* predicted = scratch.predicted;
  for (float* zeroed : {scratch.sum, scratch.weights}) std::fill_n(zeroed, count, 0.0F);
  std::fill_n(scratch.degrees, count, -1.0F);
  for (std::size_t k = 0; k < in.frames.size(); ++k) {
    const FrameConstants frame = in.frames[k];
    const float* y = in.signals + k * kBlock;
    const float* share = in.shares + k * kBlock;
    float* precision = in.precisions + k * kBlock;
    for (std::size_t i = 0; i < count; ++i) {
      const float x = std::max(predicted[i], 0.0F);
      const float counts =
          Counts(static_cast<float>(k), out.used[i], x * frame.exposure, frame.floor);
      precision[i] = counts / ((frame.shot * x + frame.read) * share[i]);
      scratch.degrees[i] += counts;
      scratch.sum[i] += precision[i] * frame.exposure * y[i];
      scratch.weights[i] += precision[i] * frame.exposure * frame.exposure;
    }
  }
  Mean(in, out, scratch);
}

// Pass 3: chi-square of the frames about their mean, into scratch.sum; scratch.noise.
LIGHTCAL_EVERY_CPU
void Contradict(const BlockIn& in, const BlockOut& out, const Scratch& scratch) {
  float* sum = scratch.sum;
  float* noise = scratch.noise;
  const float* weights = scratch.weights;
  const float* value = out.value;
  constexpr float kTiny = std::numeric_limits<float>::min();
  for (std::size_t i = 0; i < in.count; ++i) {
    sum[i] = 0.0F;
    noise[i] = 0.0F;
  }
  for (std::size_t k = 0; k < in.frames.size(); ++k) {
    const FrameConstants frame = in.frames[k];
    const float* y = in.signals + k * kBlock;
    const float* precision = in.precisions + k * kBlock;
    LIGHTCAL_INDEPENDENT
    for (std::size_t i = 0; i < in.count; ++i) {
      const float residual = y[i] - frame.exposure * value[i];
      sum[i] += precision[i] * residual * residual;
      const float weight = precision[i] * frame.exposure * frame.exposure;
      noise[i] += weight * (weight / std::max(weights[i], kTiny));
    }
  }
}

// Frames that contradict each other widen by chi2/n, which takes all their noises for too small by
// one factor. Farther apart than chance (chi2 of 25 above n: 5 standard deviations of one frame)
// something else was there: each errs by tau besides, the one with the largest weight as likely as
// another. With W = sum w, S = sum w^2 / W:
//   tau^2 = (chi2 - n)/(W - S),   Var X = 1/W + tau^2 S/W        [chi2/(n W) of equal weights]
// Source: DerSimonian, Laird, Meta-analysis in clinical trials, 1986.
LIGHTCAL_EVERY_CPU
void Vary(const BlockIn& in, const BlockOut& out, const Scratch& scratch) {
  constexpr float kTiny = std::numeric_limits<float>::min();
  constexpr float kBeyondChance = 25.0F;
  const float* chi2 = scratch.sum;
  const float* squares = scratch.noise;
  const float* weights = scratch.weights;
  const float* degrees = scratch.degrees;
  const float* value = out.value;
  const float* used = out.used;
  float* variance = out.variance;
  const float pattern2 = in.fixed_pattern2;
  LIGHTCAL_INDEPENDENT
  for (std::size_t i = 0; i < in.count; ++i) {
    const float clipped = used[i] < 0.0F ? 1.0F : 0.0F;
    const float n = std::max(degrees[i], 1.0F);
    const float apart = (chi2[i] - n) / std::max(weights[i] - squares[i], kTiny);
    const float contradicted =
        chi2[i] > n + kBeyondChance ? 1.0F + apart * squares[i] : chi2[i] / n;
    const float widening = chi2[i] > ContradictionAt(n) ? contradicted : 1.0F;
    const float square = value[i] * value[i];
    const float noise = widening / (weights[i] + clipped);
    variance[i] = (used[i] < 0.0F ? square : noise) + pattern2 * square;
  }
}

// The same where frames scatter otherwise than their noise says.
LIGHTCAL_EVERY_CPU
void VaryPlaces(const BlockIn& in, const BlockOut& out, const Scratch& scratch) {
  for (std::size_t i = 0; i < in.count; ++i) {
    const bool clipped = out.used[i] < 0.0F;
    const float n = std::max(scratch.degrees[i], 1.0F);
    const bool contradict = scratch.sum[i] > ContradictionAt(n);
    const float widening = contradict ? std::max(scratch.sum[i] / n, in.places[i]) : in.places[i];
    const float square = out.value[i] * out.value[i];
    const float noise = clipped ? square : widening / scratch.weights[i];
    out.variance[i] = noise + in.fixed_pattern2 * square;
  }
}

void Tell(const BlockIn& in, const BlockOut& out, const Scratch& scratch) {
  if (out.chi2 == nullptr) return;
  for (std::size_t i = 0; i < in.count; ++i) {
    out.degrees[i] = scratch.degrees[i];
    out.chi2[i] = std::min(scratch.sum[i], ContradictionAt(std::max(scratch.degrees[i], 1.0F)));
  }
}

// sum c y, sum c t and sum c^2 Var y of the frames that count.
LIGHTCAL_EVERY_CPU
void AddUp(const BlockIn& in, const BlockOut& out, const Scratch& scratch) {
  float* sum = scratch.sum;
  float* weights = scratch.weights;
  float* noise = scratch.noise;
  const float* predicted = scratch.predicted;
  const float* used = out.used;
  for (std::size_t k = 0; k < in.frames.size(); ++k) {
    const FrameConstants frame = in.frames[k];
    const float* y = in.signals + k * kBlock;
    const float index = static_cast<float>(k);
    LIGHTCAL_INDEPENDENT
    for (std::size_t i = 0; i < in.count; ++i) {
      const float x = std::max(predicted[i], 0.0F);
      const float counts = Counts(index, used[i], x * frame.exposure, frame.floor);
      const float weight = counts * frame.poisson_weight;
      sum[i] += weight * y[i];
      weights[i] += weight * frame.exposure;
      noise[i] += weight * weight * (frame.shot * x + frame.read);
    }
  }
}

// The same of the one frame that out.used names.
LIGHTCAL_EVERY_CPU
void TakeLongest(const BlockIn& in, const BlockOut& out, const Scratch& scratch) {
  float* sum = scratch.sum;
  float* weights = scratch.weights;
  float* noise = scratch.noise;
  const float* predicted = scratch.predicted;
  const float* used = out.used;
  for (std::size_t k = 0; k < in.frames.size(); ++k) {
    const FrameConstants frame = in.frames[k];
    const float* y = in.signals + k * kBlock;
    const float index = static_cast<float>(k);
    LIGHTCAL_INDEPENDENT
    for (std::size_t i = 0; i < in.count; ++i) {
      const float taken = index == used[i] ? 1.0F : 0.0F;
      sum[i] += taken * y[i];
      weights[i] += taken * frame.exposure;
      noise[i] += taken * (frame.shot * std::max(predicted[i], 0.0F) + frame.read);
    }
  }
}

// X and its variance from what AddUp or TakeLongest left.
LIGHTCAL_EVERY_CPU
void Divide(const BlockIn& in, const BlockOut& out, const Scratch& scratch) {
  const float* sum = scratch.sum;
  const float* weights = scratch.weights;
  const float* noise = scratch.noise;
  const float* predicted = scratch.predicted;
  const float* used = out.used;
  float* value = out.value;
  float* variance = out.variance;
  const float pattern2 = in.fixed_pattern2;
  LIGHTCAL_INDEPENDENT
  for (std::size_t i = 0; i < in.count; ++i) {
    // Clipped samples have neither sum nor weights nor noise.
    const float clipped = used[i] < 0.0F ? 1.0F : 0.0F;
    const float weight = weights[i] + clipped;
    const float x = (sum[i] + clipped * predicted[i]) / weight;
    value[i] = x;
    variance[i] = noise[i] / (weight * weight) + (clipped + pattern2) * x * x;
  }
}

}  // namespace

void MergeBlock(const BlockIn& in, const BlockOut& out) {
  alignas(64) float sum[kBlock];
  alignas(64) float predicted[kBlock];
  alignas(64) float weights[kBlock];
  alignas(64) float degrees[kBlock];
  alignas(64) float limit[kBlock];
  alignas(64) float clip[kBlock];
  for (std::size_t i = 0; i < kBlock; ++i) {
    limit[i] = (*in.limit)[i % kLanes];
    clip[i] = (*in.clip)[i % kLanes];
  }
  alignas(64) float noise[kBlock];
  const Scratch scratch{sum, predicted, weights, degrees, noise, limit, clip};
  Predict(in, out, scratch);
  if (in.estimator == MergeEstimator::kLikelihood) {
    in.shares == nullptr ? Weigh(in, out, scratch) : WeighShares(in, out, scratch);
    Contradict(in, out, scratch);
    Tell(in, out, scratch);
    return in.places == nullptr ? Vary(in, out, scratch) : VaryPlaces(in, out, scratch);
  }
  for (float* zeroed : {sum, weights, noise}) std::fill_n(zeroed, kBlock, 0.0F);
  if (in.estimator == MergeEstimator::kSums) {
    AddUp(in, out, scratch);
  } else {
    TakeLongest(in, out, scratch);
  }
  for (std::size_t i = 0; in.places != nullptr && i < in.count; ++i) noise[i] *= in.places[i];
  Divide(in, out, scratch);
}

LIGHTCAL_EVERY_CPU
void AddProducts(const float* in, const Lanes& coefficient, std::size_t count, float* out) {
  const std::size_t whole = count / kLanes * kLanes;
  for (std::size_t i = 0; i < whole; i += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      out[i + lane] += coefficient[lane] * in[i + lane];
    }
  }
  for (std::size_t i = whole; i < count; ++i) out[i] += coefficient[i - whole] * in[i];
}

LIGHTCAL_EVERY_CPU
void SquareRoots(const float* in, std::size_t count, float* out) {
  for (std::size_t i = 0; i < count; ++i) out[i] = std::sqrt(in[i]);
}

}  // namespace lightcal::kernels
