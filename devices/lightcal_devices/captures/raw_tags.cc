// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/captures/raw_tags.h"

#include <libraw/libraw.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <tuple>

#include "lightcal_devices/captures/exposure_tags.h"

namespace lightcal::devices {
namespace {

constexpr std::size_t kMostNumbers = std::tuple_size_v<decltype(RawTags::noise_profile)>;
constexpr std::size_t kMostStrips = 1 << 20;
constexpr std::size_t kMostDeltas = 65536;       // as many as LibRaw reads
constexpr std::size_t kMostOpcodeBytes = 65536;  // a gain map's header stands at the front

// EXIF 2.32 and DNG 1.6 tag numbers.
enum Tag : int {
  kStripOffsets = 0x0111,
  kStripByteCounts = 0x0117,
  kDateTime = 0x0132,
  kTileOffsets = 0x0144,
  kTileByteCounts = 0x0145,
  kExposureTime = 0x829A,
  kFNumber = 0x829D,
  kIso = 0x8827,
  kSensitivityType = 0x8830,
  kStandardOutputSensitivity = 0x8831,
  kRecommendedExposureIndex = 0x8832,
  kIsoSpeed = 0x8833,
  kDateTimeOriginal = 0x9003,
  kShutterSpeedValue = 0x9201,
  kApertureValue = 0x9202,
  kSubjectDistance = 0x9206,
  kBlackLevelDeltaH = 0xC61B,
  kBlackLevelDeltaV = 0xC61C,
  kWhiteLevel = 0xC61D,
  kOpcodeList2 = 0xC741,
  kOpcodeList3 = 0xC74E,
  kNoiseProfile = 0xC761,
};

std::size_t BytesOfType(int type) {
  switch (type) {
    case 3:  // SHORT
    case 8:  // SSHORT
      return 2;
    case 4:   // LONG
    case 9:   // SLONG
    case 11:  // FLOAT
      return 4;
    case 5:   // RATIONAL
    case 10:  // SRATIONAL
    case 12:  // DOUBLE
      return 8;
    default:  // BYTE, ASCII, UNDEFINED
      return 1;
  }
}

std::uint64_t Integer(std::span<const unsigned char> bytes, bool little_endian) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    value = value << 8 | bytes[little_endian ? bytes.size() - 1 - i : i];
  }
  return value;
}

double Number(std::span<const unsigned char> bytes, int type, bool little_endian) {
  const auto part = [&](std::size_t first, std::size_t size) {
    return Integer(bytes.subspan(first, size), little_endian);
  };
  const auto as_signed = [](std::uint64_t v) {
    return static_cast<double>(static_cast<std::int32_t>(static_cast<std::uint32_t>(v)));
  };
  switch (type) {
    case 5:
      return static_cast<double>(part(0, 4)) / static_cast<double>(part(4, 4));
    case 10:
      return as_signed(part(0, 4)) / as_signed(part(4, 4));
    case 8:
      return static_cast<std::int16_t>(static_cast<std::uint16_t>(part(0, 2)));
    case 9:
      return as_signed(part(0, 4));
    case 11:
      return std::bit_cast<float>(static_cast<std::uint32_t>(part(0, 4)));
    case 12:
      return std::bit_cast<double>(part(0, 8));
    default:
      return static_cast<double>(part(0, bytes.size()));
  }
}

// One tag as LibRaw's callback hands it over; the stream stands at its data.
struct TagData {
  int type, count;
  bool little_endian;
  LibRaw_abstract_datastream& stream;

  [[nodiscard]] std::vector<unsigned char> Bytes(std::size_t most) const {
    const auto wanted = static_cast<std::size_t>(std::max(count, 0)) * BytesOfType(type);
    std::vector<unsigned char> bytes(std::min(wanted, most));
    const int got = bytes.empty() ? 0 : stream.read(bytes.data(), 1, bytes.size());
    bytes.resize(static_cast<std::size_t>(std::max(got, 0)));
    return bytes;
  }
  // Those that are finite numbers up to the first that is not (x/0).
  [[nodiscard]] std::vector<double> Numbers(std::size_t most = kMostNumbers) const {
    const std::size_t size = BytesOfType(type);
    const std::vector<unsigned char> bytes = Bytes(most * size);
    std::vector<double> numbers;
    for (std::size_t at = 0; at + size <= bytes.size(); at += size) {
      const double number = Number(std::span(bytes).subspan(at, size), type, little_endian);
      if (!std::isfinite(number)) break;
      numbers.push_back(number);
    }
    return numbers;
  }
  [[nodiscard]] std::optional<double> First() const {
    const std::vector<double> numbers = Numbers();
    return numbers.empty() ? std::nullopt : std::optional(numbers.front());
  }
  [[nodiscard]] std::array<char, 32> Text() const {
    std::array<char, 32> text{};
    const std::vector<unsigned char> bytes = Bytes(text.size() - 1);
    std::copy(bytes.begin(), std::find(bytes.begin(), bytes.end(), 0), text.begin());
    return text;
  }
};

// DNG 1.6, chapter 7: a count, then for each opcode its id, version, flags, size and data, all big
// endian whatever the file is.
bool HoldsGainMap(const std::vector<unsigned char>& list) {
  constexpr std::size_t kHead = 16;
  constexpr std::uint64_t kGainMap = 9;
  if (list.size() < 4) return false;
  const std::span<const unsigned char> bytes(list);
  std::uint64_t left = Integer(bytes.first(4), false);
  for (std::size_t at = 4; left > 0 && at + kHead <= bytes.size(); --left) {
    if (Integer(bytes.subspan(at, 4), false) == kGainMap) return true;
    at += kHead + Integer(bytes.subspan(at + 12, 4), false);
  }
  return false;
}

template <class T>
void KeepFirst(std::optional<T>& kept, std::optional<T> value) {
  if (!kept) kept = value;
}

void Append(std::vector<double>& all, const std::vector<double>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

void TakeNoise(const std::vector<double>& numbers, RawTags& tags) {
  tags.noise_numbers = static_cast<int>(numbers.size());
  std::copy(numbers.begin(), numbers.end(), tags.noise_profile.begin());
}

// LibRaw 0.20 adds the mean of each list to its black, to the nearest whole number.
void TakeDeltas(const std::vector<double>& deltas, std::vector<double>& kept, RawTags& tags) {
  if (deltas.empty() || !kept.empty()) return;
  kept = deltas;
  const double sum = std::accumulate(deltas.begin(), deltas.end(), 0.0);
  tags.black_of_deltas += std::floor(sum / static_cast<double>(deltas.size()) + 0.5);
}

void TakeIso(RawTagWalk& walk, std::optional<double> IsoTags::* tag, const TagData& data) {
  KeepFirst(walk.iso.*tag, data.First());
  walk.tags.exposure.iso = IsoOfTags(walk.iso);
}

void Take(RawTagWalk& walk, int tag, const TagData& data) {
  RawTags& tags = walk.tags;
  switch (tag) {
    case kExposureTime:
      return KeepFirst(tags.exposure.exposure_time_s, data.First());
    case kShutterSpeedValue:
      return KeepFirst(tags.exposure.shutter_apex, data.First());
    case kFNumber:
      return KeepFirst(tags.exposure.f_number, data.First());
    case kApertureValue:
      return KeepFirst(tags.exposure.aperture_apex, data.First());
    case kIso:
      return TakeIso(walk, &IsoTags::photographic, data);
    case kSensitivityType:
      return TakeIso(walk, &IsoTags::type, data);
    case kStandardOutputSensitivity:
      return TakeIso(walk, &IsoTags::standard_output, data);
    case kRecommendedExposureIndex:
      return TakeIso(walk, &IsoTags::recommended, data);
    case kIsoSpeed:
      return TakeIso(walk, &IsoTags::iso_speed, data);
    case kSubjectDistance:
      return KeepFirst(tags.subject_distance_m, data.First());
    case kDateTimeOriginal:
      tags.time = data.Text();
      return;
    case kDateTime:
      if (tags.time[0] == '\0') tags.time = data.Text();
      return;
    case kStripOffsets:
    case kTileOffsets:
      return Append(walk.data_offsets, data.Numbers(kMostStrips));
    case kStripByteCounts:
    case kTileByteCounts:
      return Append(walk.data_sizes, data.Numbers(kMostStrips));
    case kNoiseProfile:
      if (tags.noise_numbers == 0) TakeNoise(data.Numbers(), tags);
      return;
    case kBlackLevelDeltaH:
      return TakeDeltas(data.Numbers(kMostDeltas), walk.black_of_columns, tags);
    case kBlackLevelDeltaV:
      return TakeDeltas(data.Numbers(kMostDeltas), walk.black_of_rows, tags);
    case kWhiteLevel:
      walk.has_white_level = true;
      return;
    case kOpcodeList2:
    case kOpcodeList3:
      tags.has_gain_map = tags.has_gain_map || HoldsGainMap(data.Bytes(kMostOpcodeBytes));
      return;
    default:
      return;
  }
}

// LibRaw's exif_parser_callback. Tags of the EXIF directory come bare, those of a TIFF directory
// with its number from bit 20 on; maker notes and GPS tags carry other high bits.
void OnTag(void* context, int tag, int type, int count, unsigned order, void* stream, INT64) {
  if ((tag >> 16) != 0 && (tag >> 20) == 0) return;
  constexpr unsigned kLittleEndian = 0x4949;
  const TagData data{type, count, order == kLittleEndian,
                     *static_cast<LibRaw_abstract_datastream*>(stream)};
  auto& walk = *static_cast<RawTagWalk*>(context);
  ++walk.count;
  Take(walk, tag & 0xFFFF, data);
}

}  // namespace

double RawTagWalk::EndOfData() const {
  double end = 0.0;
  const std::size_t pairs = std::min(data_offsets.size(), data_sizes.size());
  for (std::size_t i = 0; i < pairs; ++i) end = std::max(end, data_offsets[i] + data_sizes[i]);
  return end;
}

void CollectTags(LibRaw& raw, RawTagWalk& walk) { raw.set_exifparser_handler(OnTag, &walk); }

}  // namespace lightcal::devices
