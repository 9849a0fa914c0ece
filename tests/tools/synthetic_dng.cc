// SPDX-License-Identifier: Apache-2.0
#include "synthetic_dng.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string_view>

namespace lightcal::test {
namespace {

// TIFF field types.
enum Type : std::uint16_t {
  kByte = 1,
  kAscii = 2,
  kShort = 3,
  kLong = 4,
  kRational = 5,
  kSignedRational = 10,
  kDouble = 12
};

void AppendLittle(std::string& out, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) out.push_back(static_cast<char>(value >> (8 * i) & 0xFF));
}
void Append16(std::string& out, std::uint64_t value) { AppendLittle(out, value, 2); }
void Append32(std::string& out, std::uint64_t value) { AppendLittle(out, value, 4); }

struct Entry {
  std::uint16_t tag = 0, type = 0;
  std::uint32_t count = 0;
  std::string data;
};

Entry Integers(std::uint16_t tag, Type type, const std::vector<std::uint32_t>& values) {
  Entry entry{tag, type, static_cast<std::uint32_t>(values.size()), {}};
  const int size = type == kByte ? 1 : type == kShort ? 2 : 4;
  for (const std::uint32_t v : values) AppendLittle(entry.data, v, size);
  return entry;
}

Entry Text(std::uint16_t tag, std::string text) {
  text.push_back('\0');
  return {tag, kAscii, static_cast<std::uint32_t>(text.size()), std::move(text)};
}

// Numbers as fractions: whole reciprocals (1/60) as such, others over a million.
Entry Fractions(std::uint16_t tag, Type type, const std::vector<double>& values) {
  Entry entry{tag, static_cast<std::uint16_t>(type), static_cast<std::uint32_t>(values.size()), {}};
  for (const double v : values) {
    const double reciprocal = v > 0.0 ? std::round(1.0 / v) : 0.0;
    const bool whole = reciprocal > 1.0 && std::abs(v * reciprocal - 1.0) < 1e-9;
    Append32(entry.data, whole ? 1U : static_cast<std::uint32_t>(std::lround(v * 1e6)));
    Append32(entry.data, whole ? static_cast<std::uint32_t>(reciprocal) : 1000000U);
  }
  return entry;
}

Entry Doubles(std::uint16_t tag, const std::vector<double>& values) {
  Entry entry{tag, kDouble, static_cast<std::uint32_t>(values.size()), {}};
  for (const double v : values) AppendLittle(entry.data, std::bit_cast<std::uint64_t>(v), 8);
  return entry;
}

// A directory of entries, larger data behind it; `at` is where it will stand.
std::string Directory(std::vector<Entry> entries, std::size_t at) {
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.tag < b.tag; });
  std::string head, tail;
  const std::size_t tail_at = at + 2 + 12 * entries.size() + 4;
  Append16(head, entries.size());
  for (const Entry& entry : entries) {
    Append16(head, entry.tag);
    Append16(head, entry.type);
    Append32(head, entry.count);
    if (entry.data.size() <= 4) {
      head += entry.data + std::string(4 - entry.data.size(), '\0');
    } else {
      Append32(head, tail_at + tail.size());
      tail += entry.data;
      if (tail.size() % 2 != 0) tail.push_back('\0');
    }
  }
  Append32(head, 0);
  return head + tail;
}

// Lossless JPEG: two interleaved components, predictor 1, one Huffman table.
// Source: ITU-T T.81, annexes C and H.
class LosslessJpeg {
 public:
  static std::string Encode(const std::vector<std::uint16_t>& picture, int width, int height) {
    LosslessJpeg jpeg;
    jpeg.Headers(width, height);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const std::size_t at = static_cast<std::size_t>(y) * width + x;
        const int first = y > 0 ? picture[at - width] : 1 << 15;
        const int predicted = x >= 2 ? picture[at - 2] : first;
        jpeg.Difference(static_cast<std::int16_t>(picture[at] - predicted));
      }
    }
    return jpeg.Finish();
  }

 private:
  // Symbols (bit lengths of differences) in order of their code lengths: 3 of 2 bits, 2 of 4, then
  // one of each up to 16.
  static constexpr std::array<int, 17> kSymbols = {6, 7, 5,  4,  8,  3,  9,  2, 10,
                                                   1, 0, 11, 12, 13, 14, 15, 16};
  static constexpr std::array<int, 16> kCodesOfLength = {0, 3, 0, 2, 1, 1, 1, 1,
                                                         1, 1, 1, 1, 1, 1, 1, 1};

  LosslessJpeg() {
    unsigned code = 0;
    std::size_t next = 0;
    for (std::size_t length = 1; length <= kCodesOfLength.size(); ++length) {
      for (int i = 0; i < kCodesOfLength[length - 1]; ++i) {
        codes_[kSymbols[next]] = code++;
        lengths_[kSymbols[next++]] = static_cast<int>(length);
      }
      code <<= 1;
    }
  }

  void Big16(int value) {
    out_.push_back(static_cast<char>(value >> 8));
    out_.push_back(static_cast<char>(value & 0xFF));
  }
  void Bytes(std::initializer_list<int> bytes) {
    for (const int b : bytes) out_.push_back(static_cast<char>(b));
  }
  void Headers(int width, int height) {
    Big16(0xFFD8);
    Big16(0xFFC4);
    Big16(2 + 1 + 16 + 17);
    Bytes({0});
    for (const int n : kCodesOfLength) Bytes({n});
    for (const int s : kSymbols) Bytes({s});
    Big16(0xFFC3);
    Big16(8 + 6);
    Bytes({16});
    Big16(height);
    Big16(width / 2);
    Bytes({2, 0, 0x11, 0, 1, 0x11, 0});
    Big16(0xFFDA);
    Big16(6 + 4);
    Bytes({2, 0, 0, 1, 0, 1, 0, 0});
  }
  void Difference(int difference) {
    const auto size = static_cast<int>(std::bit_width(static_cast<unsigned>(std::abs(difference))));
    Bits(codes_[size], lengths_[size]);
    if (size == 0 || size == 16) return;
    Bits(static_cast<unsigned>(difference < 0 ? difference - 1 : difference) & ((1U << size) - 1),
         size);
  }
  void Bits(unsigned bits, int count) {
    held_ = held_ << count | bits;
    held_bits_ += count;
    while (held_bits_ >= 8) {
      held_bits_ -= 8;
      const int byte = static_cast<int>(held_ >> held_bits_ & 0xFF);
      Bytes({byte});
      if (byte == 0xFF) Bytes({0});
    }
  }
  std::string Finish() {
    if (held_bits_ > 0) Bits((1U << (8 - held_bits_)) - 1, 8 - held_bits_);
    Big16(0xFFD9);
    return std::move(out_);
  }

  std::array<unsigned, 17> codes_{};
  std::array<int, 17> lengths_{};
  std::string out_;
  std::uint64_t held_ = 0;
  int held_bits_ = 0;
};

std::vector<double> Neutral(const SyntheticCamera& camera, const SyntheticDngOptions& options) {
  const SyntheticXyz white = XyzOf(1.0, options.white_x, options.white_y);
  std::vector<double> neutral;
  for (const auto& row : camera.camera_from_xyz) {
    neutral.push_back(row[0] * white.X + row[1] * white.Y + row[2] * white.Z);
  }
  const double largest = *std::max_element(neutral.begin(), neutral.end());
  for (double& v : neutral) v /= largest;
  return neutral;
}

// Var(x) = S x + O of x = (DN - black)/(white - black): one electron is 1/full_well.
std::vector<double> NoiseProfileOf(const SyntheticCamera& camera,
                                   const SyntheticExposure& exposure) {
  const double full_well = camera.full_well_e * camera.base_iso / exposure.iso;
  const double rounding = 1.0 / 12.0 / std::pow(camera.white_dn - camera.black_dn, 2);
  const double read = camera.read_noise_e / full_well;
  return {1.0 / full_well, read * read + rounding};
}

std::vector<Entry> ExifEntries(const SyntheticExposure& exposure,
                               const SyntheticDngOptions& options) {
  std::vector<Entry> exif = {
      Fractions(0x829A, kRational, {exposure.label_time_s}),
      Fractions(0x829D, kRational, {exposure.label_f_number}),
      Integers(0x8827, kShort, {static_cast<std::uint32_t>(std::lround(exposure.iso))}),
      Text(0x9003, options.time)};
  if (exposure.apex_tags) {
    const auto third = [](double stops) { return std::round(stops * 3.0) / 3.0; };
    exif.push_back(Fractions(0x9201, kSignedRational, {third(-std::log2(exposure.label_time_s))}));
    exif.push_back(Fractions(0x9202, kRational, {third(2.0 * std::log2(exposure.label_f_number))}));
  }
  if (options.subject_distance_m > 0.0) {
    exif.push_back(Fractions(0x9206, kRational, {options.subject_distance_m}));
  }
  if (options.focal_length_mm > 0.0) {
    exif.push_back(Fractions(0x920A, kRational, {options.focal_length_mm}));
  }
  return exif;
}

std::vector<Entry> PictureEntries(const SyntheticCamera& camera, const SyntheticExposure& exposure,
                                  const SyntheticDngOptions& options, std::size_t data_size) {
  const auto unsigned_of = [](double v) { return static_cast<std::uint32_t>(std::lround(v)); };
  const std::uint32_t width = camera.width, height = camera.height;
  constexpr std::uint32_t kCfa = 32803, kLinearRaw = 34892, kLosslessJpeg = 7;
  std::vector<Entry> entries = {
      Integers(254, kLong, {0}),
      Integers(256, kLong, {width}),
      Integers(257, kLong, {height}),
      Integers(258, kShort, {16}),
      Integers(259, kShort, {options.lossless_jpeg ? kLosslessJpeg : 1U}),
      Integers(262, kShort, {camera.monochrome ? kLinearRaw : kCfa}),
      Text(270, "SYNTHETIC picture of a test; no camera took it"),
      Text(271, "Synthetic"),
      Text(272, "Synthetic One"),
      Integers(273, kLong, {0}),
      Integers(274, kShort, {1}),
      Integers(277, kShort, {1}),
      Integers(278, kLong, {height}),
      Integers(279, kLong, {static_cast<std::uint32_t>(data_size)}),
      Integers(284, kShort, {1}),
      Text(305, "synthetic_dng"),
      Text(306, options.time),
      Integers(34665, kLong, {0}),
      Integers(50706, kByte, {1, 4, 0, 0}),
      Integers(50707, kByte, {1, 1, 0, 0}),
      Text(50708, "Synthetic One"),
      Integers(50714, kLong, {unsigned_of(camera.black_dn)}),
      Integers(50717, kLong, {unsigned_of(camera.white_dn)}),
  };
  if (!camera.monochrome) {
    std::vector<double> matrix;
    for (const auto& row : camera.camera_from_xyz)
      matrix.insert(matrix.end(), row.begin(), row.end());
    const std::uint32_t period = camera.x_trans ? 6 : 2;
    std::vector<std::uint32_t> filters;
    for (std::uint32_t i = 0; i < period * period; ++i) {
      filters.push_back(static_cast<std::uint32_t>(
          FilterAt(camera, static_cast<int>(i % period), static_cast<int>(i / period))));
    }
    entries.push_back(Integers(33421, kShort, {period, period}));
    entries.push_back(Integers(33422, kByte, filters));
    entries.push_back(Fractions(50728, kRational, Neutral(camera, options)));
    constexpr std::uint32_t kD65 = 21, kStandardA = 17;
    if (options.warm_matrix) {
      entries.push_back(Fractions(50722, kSignedRational, matrix));
      entries.push_back(Integers(50779, kShort, {kD65}));
      for (std::size_t i = 0; i < 9; ++i) matrix[i] *= 1.0 + 0.02 * static_cast<double>(i % 4);
    }
    entries.push_back(Fractions(50721, kSignedRational, matrix));
    entries.push_back(Integers(50778, kShort, {options.warm_matrix ? kStandardA : kD65}));
  }
  if (options.noise_profile) entries.push_back(Doubles(51041, NoiseProfileOf(camera, exposure)));
  return entries;
}

void SetOffset(std::vector<Entry>& entries, std::uint16_t tag, std::size_t offset) {
  for (Entry& entry : entries) {
    if (entry.tag != tag) continue;
    entry.data.clear();
    Append32(entry.data, offset);
  }
}

}  // namespace

std::string EncodeDng(const SyntheticCamera& camera, const SyntheticExposure& exposure,
                      const std::vector<std::uint16_t>& picture,
                      const SyntheticDngOptions& options) {
  std::string data;
  if (options.lossless_jpeg) {
    data = LosslessJpeg::Encode(picture, camera.width, camera.height);
  } else {
    data.reserve(picture.size() * 2);
    for (const std::uint16_t v : picture) Append16(data, v);
  }
  std::vector<Entry> entries = PictureEntries(camera, exposure, options, data.size());
  const std::vector<Entry> exif = ExifEntries(exposure, options);

  std::string file = "II";
  Append16(file, 42);
  constexpr std::size_t kFirst = 8;
  Append32(file, kFirst);
  const std::size_t exif_at = kFirst + Directory(entries, kFirst).size();
  const std::size_t data_at = (exif_at + Directory(exif, exif_at).size() + 15) / 16 * 16;
  SetOffset(entries, 34665, exif_at);
  SetOffset(entries, 273, data_at);
  file += Directory(entries, kFirst);
  file += Directory(exif, exif_at);
  file.resize(data_at, '\0');
  return file + data;
}

std::vector<std::string> WriteDngBracket(const std::string& directory, const std::string& stem,
                                         const SyntheticCamera& camera,
                                         const std::vector<SyntheticExposure>& series,
                                         const SyntheticScene& scene,
                                         const SyntheticDngOptions& options) {
  std::vector<std::string> paths;
  for (const SyntheticExposure& exposure : series) {
    paths.push_back(directory + "/" + stem + "_" + std::to_string(paths.size()) + ".dng");
    const std::string bytes = EncodeDng(camera, exposure, Expose(camera, exposure, scene), options);
    std::ofstream(paths.back(), std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  return paths;
}

}  // namespace lightcal::test
