// SPDX-License-Identifier: Apache-2.0
// What a process that decodes a RAW leaves in a file of memory: this, then the samples.
#pragma once

#include <libraw/libraw_types.h>

#include <array>
#include <cstdint>
#include <type_traits>

#include "lightcal/core/result.h"
#include "lightcal_devices/captures/raw_tags.h"

namespace lightcal::devices {

// Plain data, that one process may write and another read.
struct RawAnswer {
  enum class Samples : std::uint8_t { kNone, kUint16, kFloat };

  bool is_error = false;
  ErrorKind error_kind = ErrorKind::kFailed;
  std::array<char, 32> code{};
  std::array<char, 512> message{};

  // LibRaw's own. The pointers inside mean nothing here.
  libraw_image_sizes_t sizes;
  libraw_iparams_t camera;
  libraw_colordata_t color;
  libraw_imgother_t other;
  RawTags tags;

  // Rows of the active area stand behind the answer, from kSamplesAt on.
  Samples samples = Samples::kNone;
  int channels = 1;
  std::int64_t row_bytes = 0;   // from row to row
  std::int64_t left_bytes = 0;  // before the first pixel of a row
};
static_assert(std::is_trivially_copyable_v<RawAnswer>);

inline constexpr std::size_t kSamplesAt = (sizeof(RawAnswer) + 4095) / 4096 * 4096;

}  // namespace lightcal::devices
