// SPDX-License-Identifier: Apache-2.0
// What a camera profile changes of merged samples, before colours are interpolated.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "lightcal/imaging/bracket/signal.h"
#include "lightcal/imaging/bracket/thin_frame.h"
#include "lightcal/records/camera_profile.h"

namespace lightcal {

class SampleCorrections {
 public:
  SampleCorrections() = default;

  // For pictures that show the part from (x, y) on of the camera's whole picture.
  SampleCorrections(int whole_width, int whole_height, int x, int y)
      : whole_width_(whole_width), whole_height_(whole_height), x_(x), y_(y) {}

  //   X <- X / v,   Var <- (Var + black_sd^2) / v^2 + (sigma_flat X)^2
  // black_sd: how far the black level may be off in units of X, alike everywhere.
  enum class FlatSource : std::uint8_t { kMeasured, kCosineFourth };
  void SetFlat(const CameraFlat& flat, FlatSource source = FlatSource::kMeasured) {
    flat_ = flat;
    flat_source_ = source;
  }
  void SetBlackSd(double black_sd) { black_sd_ = black_sd; }
  // x, y, x, y, ...: their samples become the mean of the nearest ones of their colour in the row,
  // Var that of the mean and a quarter of their difference squared; on the picture's edge, where
  // one stands alone, twice its Var. Where more than two lie together it is as large as the mean
  // itself besides: what a hole would show nobody saw.
  void AddHotPixels(std::span<const int> hot_pixels);

  // For pictures made smaller: hot pixels that they do not show go, a mean with a hot pixel among
  // its samples counts as one. After AddHotPixels.
  void SetThinning(const Thinning& thinning);

  [[nodiscard]] bool empty() const { return !flat_ && black_sd_ == 0.0 && hot_.empty(); }
  [[nodiscard]] std::size_t hot_pixels() const { return hot_.size(); }
  [[nodiscard]] double black_sd() const { return black_sd_; }
  [[nodiscard]] const std::optional<CameraFlat>& flat() const { return flat_; }
  [[nodiscard]] FlatSource flat_source() const { return flat_source_; }

  // Row y of the merged picture of frames like `frame`: row_samples() values and variances.
  void Apply(const SignalFrame& frame, int y, float* value, float* variance) const;

 private:
  void ReplaceHot(const SignalFrame& frame, int y, float* value, float* variance) const;
  void Flatten(const SignalFrame& frame, int y, float* value, float* variance) const;

  int whole_width_ = 0, whole_height_ = 0, x_ = 0, y_ = 0;
  std::optional<CameraFlat> flat_;
  FlatSource flat_source_ = FlatSource::kMeasured;
  double black_sd_ = 0.0;
  std::vector<std::pair<int, int>> hot_;  // y, x; sorted
  Thinning thinning_{};
};

}  // namespace lightcal
