// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/torchbearer/frame.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "lightcal_devices/transport/framing.h"

namespace lightcal::devices::torchbearer {
namespace {

using ByteSpan = std::span<const std::byte>;

constexpr std::byte kStart{0xCC};
constexpr std::byte kToDevice{0x01};
constexpr std::byte kFromDevice{0x81};
constexpr std::array kEnd = {std::byte{0x0D}, std::byte{0x0A}};
constexpr std::size_t kTypeAt = 5;
constexpr std::size_t kDataAt = 6;
constexpr std::size_t kAfterData = 3;                    // sum and end
constexpr std::size_t kEnvelope = kDataAt + kAfterData;  // a message without data

// Where the values of a measurement stand.
constexpr std::size_t kStatusAt = 0;
constexpr std::size_t kMicrosecondsAt = 1;
constexpr std::size_t kExponentAt = 5;
constexpr std::size_t kNumberAt = 7;
constexpr std::size_t kExtraAt = 11;
constexpr std::size_t kSamplesAt = 19;
constexpr unsigned kExponentMask = 8848;
constexpr unsigned kHighestExponent = 18;

constexpr int kShortestNm = 200;
constexpr int kLongestNm = 2500;

tl::unexpected<Error> BadMessage(std::string what) {
  return Failed(std::string(kBadReply), "torchbearer",
                std::move(what) + "; is this a Torch Bearer spectrometer, and is its cable firm?");
}

template <class Unsigned>
Unsigned LittleEndian(ByteSpan bytes, std::size_t at, std::size_t count = sizeof(Unsigned)) {
  Unsigned value = 0;
  for (std::size_t i = count; i > 0; --i) {
    value = static_cast<Unsigned>(value << 8U) | std::to_integer<Unsigned>(bytes[at + i - 1]);
  }
  return value;
}

std::uint32_t BytesReversed(std::uint32_t v) {
  return (v >> 24U) | ((v >> 8U) & 0xFF00U) | ((v << 8U) & 0xFF0000U) | (v << 24U);
}

unsigned BytesReversed(std::uint16_t v) {
  return ((v >> 8U) | (static_cast<unsigned>(v) << 8U)) & 0xFFFFU;
}

std::byte Sum(ByteSpan bytes) {
  unsigned sum = 0;
  for (const std::byte byte : bytes) sum += std::to_integer<unsigned>(byte);
  return static_cast<std::byte>(sum);
}

struct Keys {
  std::uint16_t first_half;
  std::uint16_t second_half;
};

Keys KeysOf(std::uint32_t microseconds, std::uint32_t number, std::uint64_t extra) {
  const auto milliseconds = static_cast<float>(microseconds / 1000.0);
  const auto bits = std::bit_cast<std::uint32_t>(milliseconds);
  const std::uint64_t common = BytesReversed(bits) ^ (extra >> 16U);
  return {static_cast<std::uint16_t>(common ^ ((bits ^ number) >> 16U) ^ number ^ extra),
          static_cast<std::uint16_t>((common >> 16U) ^ bits ^ number)};
}

}  // namespace

Bytes EncodeRequest(MessageType type, ByteSpan data) {
  const std::size_t length = kEnvelope + data.size();
  Bytes message = {kStart, kToDevice};
  for (unsigned shift = 0; shift < 24; shift += 8) {
    message.push_back(static_cast<std::byte>(length >> shift));
  }
  message.push_back(static_cast<std::byte>(type));
  message.insert(message.end(), data.begin(), data.end());
  message.push_back(Sum(message));
  message.insert(message.end(), kEnd.begin(), kEnd.end());
  return message;
}

bool MayBeginMessage(ByteSpan bytes) {
  if (bytes.size() > kHeaderBytes) return false;
  return (bytes.empty() || bytes[0] == kStart) && (bytes.size() < 2 || bytes[1] == kFromDevice);
}

Result<std::size_t> MessageLength(ByteSpan header) {
  if (header.size() != kHeaderBytes || !MayBeginMessage(header)) {
    return BadMessage("a message does not begin with CC 81");
  }
  const std::size_t length = LittleEndian<std::uint32_t>(header, 2, 3);
  if (length < kEnvelope || length > kLongestMessageBytes) {
    return BadMessage("a message claims " + std::to_string(length) + " bytes");
  }
  return length;
}

Result<Message> DecodeMessage(ByteSpan bytes) {
  if (bytes.size() < kEnvelope) return BadMessage("a message broke off");
  const auto length = MessageLength(bytes.first(kHeaderBytes));
  if (!length) return tl::unexpected(length.error());
  if (*length != bytes.size()) {
    return BadMessage("a message of " + std::to_string(*length) + " bytes came with " +
                      std::to_string(bytes.size()));
  }
  if (!std::ranges::equal(bytes.last(kEnd.size()), kEnd)) {
    return BadMessage("a message does not end with 0D 0A");
  }
  const std::size_t sum_at = bytes.size() - kAfterData;
  if (bytes[sum_at] != Sum(bytes.first(sum_at))) return BadMessage("a message's sum is wrong");
  return Message{std::to_integer<unsigned>(bytes[kTypeAt]),
                 bytes.subspan(kDataAt, bytes.size() - kEnvelope)};
}

Result<std::string> DecodeDeviceId(ByteSpan data) {
  std::string id;
  for (const std::byte byte : data) {
    const char c = std::to_integer<char>(byte);
    if (c == '\0') break;
    if (c < '!' || c > '~') return BadMessage("the device's id is no text");
    id += c;
  }
  if (id.empty()) return BadMessage("the device's id is empty");
  return id;
}

Result<void> DecodeAccepted(ByteSpan data) {
  if (data.size() != 1) return BadMessage("the answer to an order is not one byte");
  if (data[0] == std::byte{0}) return {};
  return Failed("nak", "torchbearer", "the device refused an order; plug it in anew and try again");
}

Result<bool> DecodeExposureMode(ByteSpan data) {
  if (data.size() != 1 || std::to_integer<unsigned>(data[0]) > 1) {
    return BadMessage("the exposure mode is neither manual nor automatic");
  }
  return data[0] == std::byte{1};
}

Result<WavelengthRange> DecodeRange(ByteSpan data) {
  if (data.size() != 4) return BadMessage("the wavelength range is not two numbers");
  const WavelengthRange range{LittleEndian<std::uint16_t>(data, 0),
                              LittleEndian<std::uint16_t>(data, 2)};
  if (range.start_nm < kShortestNm || range.end_nm > kLongestNm || range.end_nm <= range.start_nm) {
    return BadMessage("the wavelength range is " + std::to_string(range.start_nm) + " to " +
                      std::to_string(range.end_nm) + " nm");
  }
  return range;
}

Result<Measurement> DecodeMeasurement(ByteSpan data, const WavelengthRange& range) {
  const std::size_t samples = range.samples();
  if (data.size() != kSamplesAt + 2 * samples) {
    return BadMessage("the measurement has " + std::to_string(data.size()) + " bytes, not " +
                      std::to_string(kSamplesAt + 2 * samples));
  }
  const auto status = std::to_integer<unsigned>(data[kStatusAt]);
  if (status > 2) return BadMessage("the exposure's status is " + std::to_string(status));
  const auto microseconds = LittleEndian<std::uint32_t>(data, kMicrosecondsAt);
  const unsigned exponent =
      BytesReversed(LittleEndian<std::uint16_t>(data, kExponentAt)) ^ kExponentMask;
  if (exponent > kHighestExponent) {
    return BadMessage("the measurement's exponent is " + std::to_string(exponent));
  }
  const Keys keys = KeysOf(microseconds, LittleEndian<std::uint32_t>(data, kNumberAt),
                           LittleEndian<std::uint64_t>(data, kExtraAt));
  const double scale = std::pow(10.0, exponent);
  Measurement measurement;
  measurement.exposure = static_cast<Exposure>(status);
  measurement.exposure_ms = microseconds / 1000.0;
  measurement.irradiance_W_m2_nm.reserve(samples);
  for (std::size_t i = 0; i < samples; ++i) {
    const std::uint16_t key = i < samples / 2 ? keys.first_half : keys.second_half;
    const auto masked = LittleEndian<std::uint16_t>(data, kSamplesAt + 2 * i);
    measurement.irradiance_W_m2_nm.push_back((masked ^ key) / scale);
  }
  return measurement;
}

}  // namespace lightcal::devices::torchbearer
