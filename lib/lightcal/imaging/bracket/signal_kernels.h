// SPDX-License-Identifier: Apache-2.0
// The loops that touch every sample. Compiled for several instruction sets, chosen at load time;
// no contraction of a*b+c, so that every processor writes the same bytes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "lightcal/imaging/bracket/signal.h"
#include "lightcal/records/accuracy_profile.h"

namespace lightcal::kernels {

using Lanes = std::array<float, kLanes>;

// out = (in - black) * scale; sample i belongs to lane i % kLanes.
void SignalFromCodes(const std::uint16_t* in, std::size_t count, const Lanes& black,
                     const Lanes& scale, float* out);
void SignalFromFloats(const float* in, std::size_t count, const Lanes& black, const Lanes& scale,
                      float* out);

// Samples a block holds: a few kB a frame, so that all frames of a block stay in the L1/L2 cache.
inline constexpr std::size_t kBlock = 16 * kLanes;

// What the merge knows of one frame; frames stand in order of exposure, shortest first.
struct FrameConstants {
  float exposure;           // t: signal = t X
  float poisson_weight;     // c = 1 / scale, relative to the first frame's
  float prefix_reciprocal;  // 1 / sum_{k <= i} c_k t_k
  float shot;               // g t: variance a unit of X
  float read;               // sigma_r^2
  float floor;              // signal below which the frame says nothing (codes clip at black)
};

struct BlockIn {
  std::span<const FrameConstants> frames;
  const float* signals;  // frame i's at signals + i * kBlock
  float* precisions;     // scratch of the same size
  const float* shares;   // of interpolated frames: what is left of each sample's variance, as
                         // signals lie; null: all of it
  const float* places;   // factor of each sample's variance; null: 1
  std::size_t count;     // of samples, at most kBlock
  const Lanes* limit;    // signal up to which a sensor is believed, per lane
  const Lanes* clip;     // signal from which a sample says nothing but that, per lane
  float fixed_pattern2;  // p^2
  MergeEstimator estimator;
};
struct BlockOut {
  float* value;     // X
  float* variance;  // of X
  float* used;      // index of the longest exposure used; -1 = clipped in every frame
  // Chi-square up to where frames contradict each other, and its degrees of freedom; null: not
  // wanted.
  float* chi2 = nullptr;
  float* degrees = nullptr;
};
void MergeBlock(const BlockIn& in, const BlockOut& out);

// out[i] += sum over the kernel's taps: coefficient of lane i % kLanes times in[i + shift].
void AddProducts(const float* in, const Lanes& coefficient, std::size_t count, float* out);
// out = sqrt(in), in >= 0.
void SquareRoots(const float* in, std::size_t count, float* out);

}  // namespace lightcal::kernels
