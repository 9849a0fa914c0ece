// SPDX-License-Identifier: Apache-2.0
// What a Torch Bearer spectrometer sends, byte by byte. Written from the published description and
// on bytes, where the decoder works on words; it calls nothing of the driver.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "lightcal_devices/transport/transport.h"

namespace lightcal::test {

inline void AppendLittleEndian(devices::Bytes& bytes, std::uint64_t value, int count) {
  for (int i = 0; i < count; ++i) {
    bytes.push_back(static_cast<std::byte>(value & 0xFFU));
    value >>= 8U;
  }
}

// CC 81 length type data sum 0D 0A.
inline devices::Bytes TorchMessage(unsigned type, const devices::Bytes& data) {
  devices::Bytes message = {std::byte{0xCC}, std::byte{0x81}};
  AppendLittleEndian(message, 9 + data.size(), 3);
  message.push_back(static_cast<std::byte>(type));
  message.insert(message.end(), data.begin(), data.end());
  unsigned sum = 0;
  for (const std::byte byte : message) sum += std::to_integer<unsigned>(byte);
  message.push_back(static_cast<std::byte>(sum));
  message.push_back(std::byte{0x0D});
  message.push_back(std::byte{0x0A});
  return message;
}

struct TorchMeasurement {
  unsigned status = 0;
  std::uint32_t microseconds = 20000;
  unsigned exponent = 6;
  std::uint32_t number = 0x1234ABCD;
  std::uint64_t extra = 0x0102030405060708;
  std::vector<std::uint16_t> samples;  // irradiance times 10^exponent
};

// The two bytes, low and high, that mask the samples of a half.
struct TorchMask {
  unsigned low;
  unsigned high;
};

inline std::array<TorchMask, 2> TorchMasks(const TorchMeasurement& m) {
  const auto exposure_ms = static_cast<float>(m.microseconds / 1000.0);
  std::array<std::uint8_t, 4> f{};
  std::memcpy(f.data(), &exposure_ms, f.size());  // little-endian, as this machine is
  std::array<unsigned, 4> n{};
  std::array<unsigned, 8> x{};
  for (unsigned i = 0; i < n.size(); ++i) n[i] = (m.number >> (8U * i)) & 0xFFU;
  for (unsigned i = 0; i < x.size(); ++i) {
    x[i] = static_cast<unsigned>((m.extra >> (8U * i)) & 0xFFU);
  }
  // Reversing f's bytes puts f[3] lowest, then f[2], f[1], f[0].
  return {{{f[3] ^ x[2] ^ f[2] ^ n[2] ^ n[0] ^ x[0], f[2] ^ x[3] ^ f[3] ^ n[3] ^ n[1] ^ x[1]},
           {f[1] ^ x[4] ^ f[0] ^ n[0], f[0] ^ x[5] ^ f[1] ^ n[1]}}};
}

inline devices::Bytes TorchData(const TorchMeasurement& m) {
  devices::Bytes data;
  AppendLittleEndian(data, m.status, 1);
  AppendLittleEndian(data, m.microseconds, 4);
  // 8848 is 0x2290; the exponent's bytes go out high one first.
  data.push_back(std::byte{0x22});
  data.push_back(static_cast<std::byte>(0x90U ^ m.exponent));
  AppendLittleEndian(data, m.number, 4);
  AppendLittleEndian(data, m.extra, 8);
  const auto masks = TorchMasks(m);
  for (std::size_t i = 0; i < m.samples.size(); ++i) {
    const TorchMask& mask = masks[2 * i < m.samples.size() - m.samples.size() % 2 ? 0 : 1];
    data.push_back(static_cast<std::byte>((m.samples[i] & 0xFFU) ^ mask.low));
    data.push_back(static_cast<std::byte>((m.samples[i] >> 8U) ^ mask.high));
  }
  return data;
}

inline devices::Bytes TorchRange(unsigned start_nm, unsigned end_nm) {
  devices::Bytes data;
  AppendLittleEndian(data, start_nm, 2);
  AppendLittleEndian(data, end_nm, 2);
  return data;
}

}  // namespace lightcal::test
