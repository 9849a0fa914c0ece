// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/masked_picture.h"

#include <string>

namespace lightcal {

Warning WarningOfMasked(const MaskedPicture& picture) {
  const FrameInfo& info = picture.frame.info;
  const std::size_t count = picture.masked.size();
  const auto width = static_cast<std::size_t>(info.width);
  const std::size_t first = picture.masked.empty() ? 0 : picture.masked.front();
  return {"bad_samples", info.file,
          std::to_string(count) + (count == 1 ? " pixel that holds" : " pixels that hold") +
              " no number (not finite, or beyond 1e30), the first at " +
              std::to_string(first % width) + "," + std::to_string(first / width) +
              ": the nearest ones to both sides stand in"};
}

}  // namespace lightcal
