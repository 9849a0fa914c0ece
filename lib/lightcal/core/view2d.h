// SPDX-License-Identifier: Apache-2.0
// A rectangle of samples somebody else owns: rows of `width` pixels with `channels` interleaved
// samples each, row y starting at data + y * row_stride.
#pragma once

#include <cstddef>
#include <span>
#include <type_traits>

namespace lightcal {

// Holds while the owner lives. Indices are not checked: 0 <= x < width, 0 <= y < height.
template <class T>
class View2d {
 public:
  constexpr View2d() = default;
  // row_stride counts samples, not bytes; 0 = rows follow each other without gaps.
  constexpr View2d(T* data, int width, int height, int channels = 1, std::ptrdiff_t row_stride = 0)
      : data_(data),
        width_(width),
        height_(height),
        channels_(channels),
        row_stride_(row_stride != 0 ? row_stride : std::ptrdiff_t{width} * channels) {}
  // A writable view serves where a reading one is asked for.
  template <class U>
    requires(std::is_same_v<T, const U>)
  constexpr View2d(const View2d<U>& other)  // NOLINT(google-explicit-constructor): const view of it
      : View2d(other.data(), other.width(), other.height(), other.channels(), other.row_stride()) {}

  [[nodiscard]] constexpr T* data() const { return data_; }
  [[nodiscard]] constexpr int width() const { return width_; }
  [[nodiscard]] constexpr int height() const { return height_; }
  [[nodiscard]] constexpr int channels() const { return channels_; }
  [[nodiscard]] constexpr std::ptrdiff_t row_stride() const { return row_stride_; }
  [[nodiscard]] constexpr bool empty() const { return width_ == 0 || height_ == 0; }

  // width * channels samples.
  [[nodiscard]] constexpr std::span<T> row(int y) const {
    return {data_ + y * row_stride_, static_cast<std::size_t>(width_) * channels_};
  }
  [[nodiscard]] constexpr T& operator()(int x, int y, int channel = 0) const {
    return data_[y * row_stride_ + std::ptrdiff_t{x} * channels_ + channel];
  }
  // The part with its corner at (x, y); the caller keeps it inside.
  [[nodiscard]] constexpr View2d Crop(int x, int y, int width, int height) const {
    return View2d(data_ + y * row_stride_ + std::ptrdiff_t{x} * channels_, width, height, channels_,
                  row_stride_);
  }

 private:
  T* data_ = nullptr;
  int width_ = 0;
  int height_ = 0;
  int channels_ = 1;
  std::ptrdiff_t row_stride_ = 0;
};

}  // namespace lightcal
