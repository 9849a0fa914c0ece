// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/captures/radiance_pixels.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/captures/memory_at_hand.h"

namespace lightcal::devices {
namespace {

constexpr double kMostRadianceSamples = 1 << 29;
constexpr std::size_t kLeastRunWidth = 8, kMostRunWidth = 0x7FFF;  // of rows in new run lengths
constexpr int kExponentBias = 136;                                 // 128, and 8 bits of mantissa

using Rgbe = std::array<std::uint8_t, 4>;

tl::unexpected<Error> DamagedRadiance(std::string_view name) {
  return Refused("bad_picture", std::string(name),
                 "the file is damaged or cut short; copy it again");
}

// "-Y 512 +X 1024": rows first unless x_major; each axis may run backwards.
struct ScanOrder {
  int rows = 0, columns = 0;  // as they lie in the file
  bool x_major = false, y_up = false, x_left = false;
};

std::string_view NextWord(std::string_view& line) {
  line = TrimBlanks(line);
  const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
  const std::string_view word = line.substr(0, end);
  line.remove_prefix(end);
  return word;
}

std::optional<ScanOrder> ReadScanOrder(std::string_view line) {
  ScanOrder order;
  std::string axes;
  for (int* const length : {&order.rows, &order.columns}) {
    const std::string_view axis = NextWord(line);
    const auto number = ParseNumber(NextWord(line));
    if (axis.size() != 2 || (axis[0] != '+' && axis[0] != '-') || !number) return std::nullopt;
    if (!(*number >= 1.0 && *number <= 1e6) || std::floor(*number) != *number) return std::nullopt;
    *length = static_cast<int>(*number);
    axes += axis[1];
    if (axis[1] == 'Y') order.y_up = axis[0] == '+';
    if (axis[1] == 'X') order.x_left = axis[0] == '-';
  }
  if (axes != "YX" && axes != "XY") return std::nullopt;
  order.x_major = axes == "XY";
  return order;
}

class RowReader {
 public:
  explicit RowReader(std::string_view bytes) : bytes_(bytes) {}

  // False: cut short, or runs that leave the row.
  bool Read(std::vector<Rgbe>& row) {
    const std::size_t n = row.size();
    const bool runs = n >= kLeastRunWidth && n <= kMostRunWidth && bytes_.size() >= 4 &&
                      Byte(0) == 2 && Byte(1) == 2 && (Byte(2) & 0x80) == 0;
    if (!runs) return ReadOld(row);
    if (((static_cast<std::size_t>(Byte(2)) << 8) | Byte(3)) != n) return false;
    bytes_.remove_prefix(4);
    for (std::size_t c = 0; c < 4; ++c) {
      for (std::size_t x = 0; x < n;) {
        if (bytes_.size() < 2) return false;
        const std::size_t code = Byte(0);
        const bool repeat = code > 128;
        const std::size_t count = repeat ? code & 127U : code;
        if (count == 0 || x + count > n || bytes_.size() < (repeat ? 2 : 1 + count)) return false;
        for (std::size_t i = 0; i < count; ++i) row[x++][c] = Byte(repeat ? 1 : 1 + i);
        bytes_.remove_prefix(repeat ? 2 : 1 + count);
      }
    }
    return true;
  }

 private:
  [[nodiscard]] std::uint8_t Byte(std::size_t i) const {
    return static_cast<std::uint8_t>(bytes_[i]);
  }

  // Pixels one by one; 1 1 1 n repeats the one before n times, a second such n << 8 times more.
  bool ReadOld(std::vector<Rgbe>& row) {
    unsigned shift = 0;
    for (std::size_t x = 0; x < row.size();) {
      if (bytes_.size() < 4) return false;
      const Rgbe pixel = {Byte(0), Byte(1), Byte(2), Byte(3)};
      bytes_.remove_prefix(4);
      if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
        row[x++] = pixel;
        shift = 0;
        continue;
      }
      if (shift > 16 || x == 0) return false;
      const std::size_t count = static_cast<std::size_t>(pixel[3]) << shift;
      if (count > row.size() - x) return false;
      for (std::size_t i = 0; i < count; ++i, ++x) row[x] = row[x - 1];
      shift += 8;
    }
    return true;
  }

  std::string_view bytes_;
};

// What stands behind the header's empty line.
std::optional<std::string_view> BehindHeader(std::string_view bytes) {
  while (true) {
    const std::size_t end = bytes.find('\n');
    if (end == std::string_view::npos) return std::nullopt;
    const std::string_view line = bytes.substr(0, end);
    bytes.remove_prefix(end + 1);
    if (line.empty() || line == "\r") return bytes;
  }
}

// One half of the mantissa's last place, times the power of two: what an exponent stands for.
std::array<float, 256> PowersOfTwo() {
  std::array<float, 256> powers{};
  for (int e = 1; e < 256; ++e) {
    powers[static_cast<std::size_t>(e)] = static_cast<float>(std::ldexp(1.0, e - kExponentBias));
  }
  return powers;
}

}  // namespace

Result<RadiancePixels> ReadRadiancePixels(std::string_view bytes, std::string_view name,
                                          bool with_samples) {
  const auto behind = BehindHeader(bytes);
  const std::size_t end = behind ? behind->find('\n') : std::string_view::npos;
  if (end == std::string_view::npos) return DamagedRadiance(name);
  const auto order = ReadScanOrder(behind->substr(0, end));
  if (!order) {
    return Refused("bad_picture", std::string(name),
                   "the line behind its header is no size such as \"-Y 512 +X 1024\"");
  }
  RadiancePixels pixels;
  pixels.width = order->x_major ? order->rows : order->columns;
  pixels.height = order->x_major ? order->columns : order->rows;
  if (3.0 * pixels.width * pixels.height > kMostRadianceSamples) {
    return Refused("too_large", std::string(name), "it has more than 5e8 samples");
  }
  if (!with_samples) return pixels;
  const std::array<float, 256> powers = PowersOfTwo();
  // A row costs at least a few bytes: a size that the file cannot hold is found before memory is.
  if (static_cast<std::size_t>(order->rows) * 4 > behind->size()) return DamagedRadiance(name);
  const double held = 3.0 * sizeof(float) * pixels.width * pixels.height;
  if (auto ok = CheckFitsMemory(held, std::string(name)); !ok) return Propagate(std::move(ok));
  pixels.samples.resize(static_cast<std::size_t>(pixels.width) * pixels.height * 3);
  std::vector<Rgbe> row(static_cast<std::size_t>(order->columns));
  RowReader reader(behind->substr(end + 1));
  for (int r = 0; r < order->rows; ++r) {
    if (!reader.Read(row)) return DamagedRadiance(name);
    for (int c = 0; c < order->columns; ++c) {
      const int file_x = order->x_major ? r : c, file_y = order->x_major ? c : r;
      const int x = order->x_left ? pixels.width - 1 - file_x : file_x;
      const int y = order->y_up ? pixels.height - 1 - file_y : file_y;
      const Rgbe& in = row[static_cast<std::size_t>(c)];
      float* const out = &pixels.samples[3 * (static_cast<std::size_t>(y) * pixels.width + x)];
      const float power = powers[in[3]];
      for (std::size_t i = 0; i < 3; ++i) out[i] = (static_cast<float>(in[i]) + 0.5F) * power;
    }
  }
  return pixels;
}

}  // namespace lightcal::devices
