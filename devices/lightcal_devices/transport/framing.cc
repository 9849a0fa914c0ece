// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/transport/framing.h"

#include <algorithm>
#include <string>

#include "lightcal_devices/transport/tape.h"

namespace lightcal::devices {
namespace {

constexpr std::size_t kDrainBytes = 256;

}  // namespace

Bytes StreamReader::Take(std::size_t count) {
  const auto end = held_.begin() + static_cast<std::ptrdiff_t>(count);
  Bytes message(held_.begin(), end);
  held_.erase(held_.begin(), end);
  return message;
}

Result<void> StreamReader::ReadPiece(std::size_t max, std::chrono::milliseconds timeout) {
  const auto piece = transport_.Read(max, held_.empty() ? timeout : between_);
  if (piece) {
    held_.insert(held_.end(), piece->begin(), piece->end());
    return {};
  }
  if (piece.error().code != fault::kTimeout || held_.empty()) {
    return tl::unexpected(piece.error());
  }
  const Bytes begun = Take(held_.size());
  return Failed(std::string(kBadReply), transport_.Name(),
                "the answer broke off after " + std::to_string(begun.size()) +
                    " bytes: " + EscapedBytes(begun));
}

Result<Bytes> StreamReader::ReadUntil(std::string_view terminator, std::size_t max,
                                      std::chrono::milliseconds timeout) {
  const auto end_mark = AsBytes(terminator);
  while (true) {
    const auto found = std::search(held_.begin(), held_.end(), end_mark.begin(), end_mark.end());
    const auto length =
        static_cast<std::size_t>(std::distance(held_.begin(), found)) + end_mark.size();
    if (found != held_.end() && length <= max) return Take(length);
    if (held_.size() >= max) {
      const Bytes begun = Take(held_.size());
      return Failed(std::string(kBadReply), transport_.Name(),
                    "no end of the answer within " + std::to_string(max) + " bytes; is the line " +
                        "set to another speed, or is this another instrument?");
    }
    if (auto more = ReadPiece(max - held_.size(), timeout); !more)
      return Propagate(std::move(more));
  }
}

Result<Bytes> StreamReader::ReadExactly(std::size_t count, std::chrono::milliseconds timeout) {
  while (held_.size() < count) {
    if (auto more = ReadPiece(count - held_.size(), timeout); !more) {
      return Propagate(std::move(more));
    }
  }
  return Take(count);
}

void StreamReader::Drain(std::chrono::milliseconds silence) {
  held_.clear();
  for (int i = 0; i < kLongestDrain; ++i) {
    if (!transport_.Read(kDrainBytes, silence)) return;
  }
}

}  // namespace lightcal::devices
