// SPDX-License-Identifier: Apache-2.0
// Bytes as documents print them.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "lightcal_devices/transport/transport.h"

namespace lightcal::test {

// "87 83 11" -> those three bytes.
inline devices::Bytes FromHex(const std::string& text) {
  devices::Bytes bytes;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    bytes.push_back(static_cast<std::byte>(std::stoi(word, nullptr, 16)));
  }
  return bytes;
}

// With one byte replaced.
inline devices::Bytes Altered(devices::Bytes bytes, std::size_t at, unsigned value) {
  bytes.at(at) = static_cast<std::byte>(value);
  return bytes;
}

// The bytes as the characters a pseudo-terminal sends.
inline std::string AsText(const devices::Bytes& bytes) {
  std::string text;
  for (const std::byte byte : bytes) text += static_cast<char>(byte);
  return text;
}

inline devices::Bytes operator+(devices::Bytes left, const devices::Bytes& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

}  // namespace lightcal::test
