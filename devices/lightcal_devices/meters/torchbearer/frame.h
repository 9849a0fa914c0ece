// SPDX-License-Identifier: Apache-2.0
// Bytes of the Torch Bearer Y21B7W spectrometer as values. Pure: no wire, no clock.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::devices::torchbearer {

enum class MessageType : std::uint8_t {
  kStop = 0x04,
  kDeviceId = 0x08,
  kSetExposureMode = 0x0A,
  kGetExposureMode = 0x0B,
  kRange = 0x0F,
  kData = 0x33,
};

// CC 01 length(3, little-endian) type data sum 0D 0A; the length is that of the whole message, the
// sum that of all bytes before it modulo 256.
[[nodiscard]] Bytes EncodeRequest(MessageType type, std::span<const std::byte> data = {});

// A message of the device: CC 81 length(3) type data sum 0D 0A.
inline constexpr std::size_t kHeaderBytes = 5;  // CC 81 and the length
inline constexpr std::size_t kLongestMessageBytes = 8192;
// Whether these, a header's length or fewer, could be the first bytes of a message.
[[nodiscard]] bool MayBeginMessage(std::span<const std::byte> bytes);
// The whole message's length, from its header.   Fails: bad_reply (not 9 .. kLongestMessageBytes).
[[nodiscard]] Result<std::size_t> MessageLength(std::span<const std::byte> header);

struct Message {
  unsigned type = 0;
  std::span<const std::byte> data;  // of the bytes given
};
// Fails: bad_reply (start, length, sum or end).
[[nodiscard]] Result<Message> DecodeMessage(std::span<const std::byte> bytes);

// What the messages' data say. Each fails as bad_reply.
[[nodiscard]] Result<std::string> DecodeDeviceId(std::span<const std::byte> data);
// 00 = done; anything else is a refusal, which fails as nak.
[[nodiscard]] Result<void> DecodeAccepted(std::span<const std::byte> data);
// Whether the exposure is automatic.
[[nodiscard]] Result<bool> DecodeExposureMode(std::span<const std::byte> data);

// From start_nm to end_nm inclusive in steps of 1 nm.
struct WavelengthRange {
  int start_nm = 0;
  int end_nm = 0;
  [[nodiscard]] std::size_t samples() const {
    return static_cast<std::size_t>(end_nm - start_nm) + 1;
  }
};
// Also refused: a range that is empty or not within 200 .. 2500 nm.
[[nodiscard]] Result<WavelengthRange> DecodeRange(std::span<const std::byte> data);

enum class Exposure { kOk, kOver, kUnder };

// A measurement. Little-endian: u8 status, u32 t_us, u16 p, u32 n, u64 x, then u16 masked[]. With
//   f = bits of float32(t_us / 1000), f' = f with its bytes reversed, c = f' ^ (x >> 16),
//   key of the first half  = (c ^ ((f ^ n) >> 16) ^ n ^ x) mod 2^16,
//   key of the second half = ((c >> 16) ^ f ^ n) mod 2^16,
//   value_i = (masked_i ^ key) / 10^(p with its bytes reversed ^ 8848)        [W m^-2 nm^-1]
// Source: README.md.
struct Measurement {
  Exposure exposure = Exposure::kOk;
  double exposure_ms = 0.0;
  std::vector<double> irradiance_W_m2_nm;  // one each nm of the range; finite, >= 0
};
// Also refused: another number of samples than the range has, an exponent above 18.
[[nodiscard]] Result<Measurement> DecodeMeasurement(std::span<const std::byte> data,
                                                    const WavelengthRange& range);

}  // namespace lightcal::devices::torchbearer
