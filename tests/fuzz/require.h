// SPDX-License-Identifier: Apache-2.0
// What a fuzz program claims about every input.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "lightcal/core/result.h"

namespace lightcal::fuzz {

inline std::string_view TextOf(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

inline void Require(bool claim) {
  if (!claim) std::abort();
}

// A refusal says what and where, in few words.
inline void RequireGoodError(const Error& error) {
  constexpr std::size_t kLongest = 2000;
  Require(error.kind == ErrorKind::kRefused);
  Require(!error.code.empty() && !error.subject.empty() && !error.message.empty());
  Require(error.message.size() < kLongest);
}

}  // namespace lightcal::fuzz
