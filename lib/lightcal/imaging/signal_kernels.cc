// SPDX-License-Identifier: Apache-2.0
#include "signal_kernels.h"

#include <algorithm>
#include <cmath>

#if defined(__x86_64__)
#define LIGHTCAL_EVERY_CPU \
  __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define LIGHTCAL_EVERY_CPU
#endif

namespace lightcal::kernels {
namespace {

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

// A block's numbers between the passes.
struct Scratch {
  float* sum;
  float* predicted;  // X
  float* weights;    // sum of t^2/Var
  float* degrees;    // frames that count, less one
  float* noise;      // Var of sum
  const float* limit;
  const float* clip;
};

// Pass 1, X from frames 0..i for the last i whose predicted signal t_i X is believed. X_i =
// sum c y / sum c t is the sufficient statistic of Poisson noise, so that choosing by it does not
// bias what is chosen; and a clipped frame can never pass, because every X_k t_i >= y_k t_i / t_k.
// (The mean of a block that holds one clipped sample can, so it is at the clip by itself.)
LIGHTCAL_EVERY_CPU
void Predict(const BlockIn& in, const BlockOut& out, const Scratch& scratch) {
  const std::size_t count = in.count;
  for (std::size_t i = 0; i < count; ++i) {
    scratch.sum[i] = 0.0F;
    out.used[i] = -1.0F;
    scratch.predicted[i] = in.signals[i] / in.frames[0].exposure;
  }
  for (std::size_t k = 0; k < in.frames.size(); ++k) {
    const FrameConstants frame = in.frames[k];
    const float* y = in.signals + k * kBlock;
    const float index = static_cast<float>(k);
    for (std::size_t i = 0; i < count; ++i) {
      scratch.sum[i] += frame.poisson_weight * y[i];
      const float x = scratch.sum[i] * frame.prefix_reciprocal;
      const bool believed = x * frame.exposure < scratch.limit[i] && y[i] < scratch.clip[i];
      scratch.predicted[i] = believed ? x : scratch.predicted[i];
      out.used[i] = believed ? index : out.used[i];
    }
  }
}

// Whether frame `index` counts for a sample whose predicted signal in it is tX.
inline bool Counts(float index, float used, float predicted_signal, float floor) {
  return index <= used && (predicted_signal >= floor || used == index);
}

// Pass 2: weights from the predicted signal, not from the noisy sample.
LIGHTCAL_EVERY_CPU
void Weigh(const BlockIn& in, const BlockOut& out, const Scratch& scratch) {
  const std::size_t count = in.count;
  for (std::size_t i = 0; i < count; ++i) {
    scratch.sum[i] = 0.0F;
    scratch.weights[i] = 0.0F;
    scratch.degrees[i] = -1.0F;
  }
  for (std::size_t k = 0; k < in.frames.size(); ++k) {
    const FrameConstants frame = in.frames[k];
    const float* y = in.signals + k * kBlock;
    float* precision = in.precisions + k * kBlock;
    const float index = static_cast<float>(k);
    for (std::size_t i = 0; i < count; ++i) {
      const float x = scratch.predicted[i] > 0.0F ? scratch.predicted[i] : 0.0F;
      const float inverse = 1.0F / (frame.shot * x + frame.read);
      const bool counts = Counts(index, out.used[i], x * frame.exposure, frame.floor);
      precision[i] = counts ? inverse : 0.0F;
      scratch.degrees[i] += counts ? 1.0F : 0.0F;
      const float weight = precision[i] * frame.exposure;
      scratch.sum[i] += weight * y[i];
      scratch.weights[i] += weight * frame.exposure;
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    const bool clipped = out.used[i] < 0.0F;
    out.value[i] = clipped ? scratch.predicted[i] : scratch.sum[i] / scratch.weights[i];
  }
}

// Pass 3: chi-square of the frames about their mean, into scratch.sum.
LIGHTCAL_EVERY_CPU
void Contradict(const BlockIn& in, const BlockOut& out, const Scratch& scratch) {
  for (std::size_t i = 0; i < in.count; ++i) scratch.sum[i] = 0.0F;
  for (std::size_t k = 0; k < in.frames.size(); ++k) {
    const FrameConstants frame = in.frames[k];
    const float* y = in.signals + k * kBlock;
    const float* precision = in.precisions + k * kBlock;
    for (std::size_t i = 0; i < in.count; ++i) {
      const float residual = y[i] - frame.exposure * out.value[i];
      scratch.sum[i] += precision[i] * residual * residual;
    }
  }
}

LIGHTCAL_EVERY_CPU
void Vary(const BlockIn& in, const BlockOut& out, const Scratch& scratch) {
  for (std::size_t i = 0; i < in.count; ++i) {
    const bool clipped = out.used[i] < 0.0F;
    const float n = scratch.degrees[i] > 1.0F ? scratch.degrees[i] : 1.0F;
    const float chi2 = scratch.sum[i];
    const float widening = chi2 > ContradictionAt(n) ? chi2 / n : 1.0F;
    const float square = out.value[i] * out.value[i];
    const float noise = clipped ? square : widening / scratch.weights[i];
    out.variance[i] = noise + in.fixed_pattern2 * square;
  }
}

// sum c y, sum c t and sum c^2 Var y of the frames that count.
LIGHTCAL_EVERY_CPU
void AddUp(const BlockIn& in, const BlockOut& out, const Scratch& scratch) {
  for (std::size_t k = 0; k < in.frames.size(); ++k) {
    const FrameConstants frame = in.frames[k];
    const float* y = in.signals + k * kBlock;
    const float index = static_cast<float>(k);
    for (std::size_t i = 0; i < in.count; ++i) {
      const float x = scratch.predicted[i] > 0.0F ? scratch.predicted[i] : 0.0F;
      const bool counts = Counts(index, out.used[i], x * frame.exposure, frame.floor);
      const float weight = counts ? frame.poisson_weight : 0.0F;
      scratch.sum[i] += weight * y[i];
      scratch.weights[i] += weight * frame.exposure;
      scratch.noise[i] += weight * weight * (frame.shot * x + frame.read);
    }
  }
}

// The same of the one frame that out.used names.
LIGHTCAL_EVERY_CPU
void TakeLongest(const BlockIn& in, const BlockOut& out, const Scratch& scratch) {
  for (std::size_t k = 0; k < in.frames.size(); ++k) {
    const FrameConstants frame = in.frames[k];
    const float* y = in.signals + k * kBlock;
    const float index = static_cast<float>(k);
    for (std::size_t i = 0; i < in.count; ++i) {
      const float x = scratch.predicted[i] > 0.0F ? scratch.predicted[i] : 0.0F;
      const bool taken = index == out.used[i];
      scratch.sum[i] = taken ? y[i] : scratch.sum[i];
      scratch.weights[i] = taken ? frame.exposure : scratch.weights[i];
      scratch.noise[i] = taken ? frame.shot * x + frame.read : scratch.noise[i];
    }
  }
}

// X and its variance from what AddUp or TakeLongest left.
LIGHTCAL_EVERY_CPU
void Divide(const BlockIn& in, const BlockOut& out, const Scratch& scratch) {
  for (std::size_t i = 0; i < in.count; ++i) {
    const bool clipped = out.used[i] < 0.0F;
    const float value = clipped ? scratch.predicted[i] : scratch.sum[i] / scratch.weights[i];
    const float noise =
        clipped ? value * value : scratch.noise[i] / (scratch.weights[i] * scratch.weights[i]);
    out.value[i] = value;
    out.variance[i] = noise + in.fixed_pattern2 * value * value;
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
    Weigh(in, out, scratch);
    Contradict(in, out, scratch);
    return Vary(in, out, scratch);
  }
  for (float* zeroed : {sum, weights, noise}) std::fill_n(zeroed, kBlock, 0.0F);
  if (in.estimator == MergeEstimator::kSums) {
    AddUp(in, out, scratch);
  } else {
    TakeLongest(in, out, scratch);
  }
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
