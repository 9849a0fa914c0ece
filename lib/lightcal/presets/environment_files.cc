// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/environment_files.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "lightcal/core/matrix3.h"
#include "lightcal/photometry/half_range.h"

namespace lightcal {
namespace {

// ---- colour ----

Matrix3 FromRec709(const ColorTarget& color) {
  const Matrix3 xyz = XyzFromRgbMatrix(RgbSpace::kSrgb);
  const Matrix3 back = RgbFromXyzMatrix(color.space);
  Matrix3 out{};
  for (std::size_t c = 0; c < 3; ++c) {
    Xyz column{xyz[0][c], xyz[1][c], xyz[2][c]};
    const Xyz adapted = AdaptedToSpace(column, color.SceneWhite(), color.space);
    column = {adapted.X, column.Y, adapted.Z};
    const Column3 rgb = Times(back, {column.X, column.Y, column.Z});
    for (std::size_t row = 0; row < 3; ++row) out[row][c] = rgb[row];
  }
  return out;
}

// A sample as the engine gets it, and what was cut.
class PictureColor {
 public:
  explicit PictureColor(const ColorTarget& color)
      : matrix_(FromRec709(color)), weights_(XyzFromRgbMatrix(color.space)[1]) {}

  [[nodiscard]] Column3 Of(const Column3& rec709, double weight) {
    Column3 rgb = Times(matrix_, rec709);
    for (std::size_t c = 0; c < 3; ++c) {
      total_ += weight * weights_[c] * rgb[c];
      if (rgb[c] >= 0.0) continue;
      below_ -= weight * weights_[c] * rgb[c];
      rgb[c] = 0.0;
    }
    most_ = std::max(most_, weights_[0] * rgb[0] + weights_[1] * rgb[1] + weights_[2] * rgb[2]);
    return rgb;
  }
  void Report(EncodedPicture& out) const {
    out.cut_below = total_ > 0.0 ? below_ / total_ : 0.0;
    out.most_nits = most_;
  }

 private:
  Matrix3 matrix_;
  Column3 weights_;
  double total_ = 0.0, below_ = 0.0, most_ = 0.0;
};

// ---- Radiance ----

std::array<std::uint8_t, 4> RgbeOf(const Column3& rgb) {
  const double largest = std::max({rgb[0], rgb[1], rgb[2]});
  if (!(largest > 1e-32)) return {0, 0, 0, 0};
  int exponent = 0;
  std::frexp(largest, &exponent);
  // A mantissa that rounds up to 256 belongs to the next exponent.
  if (std::lround(std::ldexp(largest, 8 - exponent)) > 255) ++exponent;
  std::array<std::uint8_t, 4> out{};
  for (std::size_t c = 0; c < 3; ++c) {
    out[c] = static_cast<std::uint8_t>(std::lround(std::ldexp(rgb[c], 8 - exponent)));
  }
  out[3] = static_cast<std::uint8_t>(exponent + 128);
  return out;
}

// One component of a row: runs of three and more, the rest as it is.
void AppendRuns(const std::vector<std::uint8_t>& row, std::string& out) {
  constexpr std::size_t kLongest = 127, kWorthARun = 3;
  std::size_t at = 0;
  const auto run_at = [&](std::size_t i) {
    std::size_t end = i;
    while (end < row.size() && row[end] == row[i] && end - i < kLongest) ++end;
    return end - i;
  };
  while (at < row.size()) {
    if (const std::size_t run = run_at(at); run >= kWorthARun) {
      out += static_cast<char>(128 + run);
      out += static_cast<char>(row[at]);
      at += run;
      continue;
    }
    std::size_t end = at;
    while (end < row.size() && end - at < kLongest && run_at(end) < kWorthARun) ++end;
    out += static_cast<char>(end - at);
    out.append(row.begin() + static_cast<std::ptrdiff_t>(at),
               row.begin() + static_cast<std::ptrdiff_t>(end));
    at = end;
  }
}

// ---- the octahedral square ----

// What of our axes' +Z hemisphere lies inside the diamond.
double SignOf(double v) { return std::signbit(v) ? -1.0 : 1.0; }

void AppendFloat(std::string& bytes, double value) {
  static_assert(std::endian::native == std::endian::little);
  const auto narrow = static_cast<float>(value);
  bytes.append(reinterpret_cast<const char*>(&narrow), sizeof(narrow));
}

}  // namespace

EncodedPicture RadianceFile(const EnvironmentPicture& picture, const ColorTarget& color) {
  EncodedPicture out;
  PictureColor convert(color);
  out.bytes = "#?RADIANCE\n# written by lightcal: cd/m2\nFORMAT=32-bit_rle_rgbe\n\n-Y " +
              std::to_string(picture.height) + " +X " + std::to_string(picture.width) + "\n";
  constexpr int kLeastRuns = 8, kMostRuns = 32767;
  const bool runs = picture.width >= kLeastRuns && picture.width <= kMostRuns;
  std::array<std::vector<std::uint8_t>, 4> row;
  for (auto& part : row) part.resize(static_cast<std::size_t>(picture.width));
  const float* at = picture.rgb.data();
  for (int y = 0; y < picture.height; ++y) {
    const double omega = PixelSolidAngle(y, picture.width, picture.height);
    for (int x = 0; x < picture.width; ++x, at += 3) {
      const auto rgbe = RgbeOf(convert.Of({at[0], at[1], at[2]}, omega));
      for (std::size_t c = 0; c < 4; ++c) row[c][static_cast<std::size_t>(x)] = rgbe[c];
      if (!runs) out.bytes.append(rgbe.begin(), rgbe.end());
    }
    if (!runs) continue;
    out.bytes += {'\2', '\2', static_cast<char>(picture.width >> 8),
                  static_cast<char>(picture.width & 0xFF)};
    for (const auto& part : row) AppendRuns(part, out.bytes);
  }
  convert.Report(out);
  return out;
}

Vec3 DirectionOfSquare(double u, double v) {
  const double a = 2.0 * u - 1.0, b = 2.0 * v - 1.0;
  const double up = std::abs(a), vp = std::abs(b);
  const double signed_distance = 1.0 - (up + vp);
  const double r = 1.0 - std::abs(signed_distance);
  const double phi = (r == 0.0 ? 1.0 : (vp - up) / r + 1.0) * std::numbers::pi / 4.0;
  const double z = SignOf(signed_distance) * (1.0 - r * r);
  const double s = r * std::sqrt(std::max(0.0, 2.0 - r * r));
  return {SignOf(a) * std::cos(phi) * s, SignOf(b) * std::sin(phi) * s, z};
}

void AppendHalf(double value, std::string& bytes) {
  const double v = std::clamp(value, 0.0, kLargestHalf);
  // Below 2^-14 steps of 2^-24; each power of two above has 1024 steps.
  int exponent = 0;
  (void)std::frexp(v, &exponent);
  const int power = v > 0.0 ? std::max(exponent - 1, -14) : -14;
  const auto steps = static_cast<std::uint32_t>(std::lround(std::ldexp(v, 10 - power)));
  const std::uint32_t bits =
      std::min(steps + (static_cast<std::uint32_t>(power + 14) << 10U), std::uint32_t{0x7BFF});
  bytes.push_back(static_cast<char>(bits & 0xFFU));
  bytes.push_back(static_cast<char>(bits >> 8U));
}

EncodedPicture ExrFile(const EnvironmentPicture& picture, const ColorTarget& color) {
  EncodedPicture out;
  PictureColor convert(color);
  const auto width = static_cast<std::size_t>(picture.width);
  const auto height = static_cast<std::size_t>(picture.height);
  PictureColor look(color);
  bool half = true;
  for (std::size_t i = 0; i < picture.rgb.size() && half; i += 3) {
    const float* at = picture.rgb.data() + i;
    const Column3 rgb = look.Of({at[0], at[1], at[2]}, 0.0);
    half = std::max({rgb[0], rgb[1], rgb[2]}) <= kLargestHalf;
  }
  const auto number = [&](auto value) {
    out.bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  const auto attribute = [&](const char* name, const char* type, std::int32_t size) {
    out.bytes.append(name).push_back('\0');
    out.bytes.append(type).push_back('\0');
    number(size);
  };
  number(std::int32_t{20000630});
  number(std::int32_t{2});
  attribute("channels", "chlist", 3 * 18 + 1);
  for (const char* channel : {"B", "G", "R"}) {
    out.bytes.append(channel).push_back('\0');
    for (const std::int32_t word : {half ? 1 : 2, 0, 1, 1}) number(word);
  }
  out.bytes.push_back('\0');
  attribute("compression", "compression", 1);
  out.bytes.push_back('\0');
  for (const char* window : {"dataWindow", "displayWindow"}) {
    attribute(window, "box2i", 16);
    for (const std::int32_t word : {0, 0, picture.width - 1, picture.height - 1}) number(word);
  }
  attribute("lineOrder", "lineOrder", 1);
  out.bytes.push_back('\0');
  attribute("pixelAspectRatio", "float", 4);
  number(1.0F);
  attribute("screenWindowCenter", "v2f", 8);
  number(0.0F);
  number(0.0F);
  attribute("screenWindowWidth", "float", 4);
  number(1.0F);
  attribute("whiteLuminance", "float", 4);  // cd/m2 of an RGB of 1, 1, 1
  number(1.0F);
  out.bytes.push_back('\0');
  const std::size_t row = width * 3 * (half ? 2 : 4);
  const std::size_t first = out.bytes.size() + 8 * height;
  out.bytes.reserve(first + height * (8 + row));
  std::vector<Column3> line(width);
  for (std::size_t y = 0; y < height; ++y) number(std::uint64_t{first + y * (8 + row)});
  for (std::size_t y = 0; y < height; ++y) {
    number(static_cast<std::int32_t>(y));
    number(static_cast<std::int32_t>(row));
    const double omega = PixelSolidAngle(static_cast<int>(y), picture.width, picture.height);
    for (std::size_t x = 0; x < width; ++x) {
      const float* at = picture.rgb.data() + 3 * (y * width + x);
      line[x] = convert.Of({at[0], at[1], at[2]}, omega);
    }
    for (const std::size_t c : {2U, 1U, 0U}) {
      for (const Column3& rgb : line) {
        if (half) {
          AppendHalf(rgb[c], out.bytes);
        } else {
          AppendFloat(out.bytes, rgb[c]);
        }
      }
    }
  }
  convert.Report(out);
  return out;
}

EncodedPicture EqualAreaSquare(const EnvironmentPicture& picture, const ColorTarget& color) {
  constexpr int kSubsamples = 3, kMostSide = 4096;
  EncodedPicture out;
  PictureColor convert(color);
  int side = 64;
  while (side < picture.height && side < kMostSide) side *= 2;
  out.bytes = "PF\n" + std::to_string(side) + " " + std::to_string(side) + "\n-1.0\n";
  // From the lowest row up, as the format has it; pbrt turns it over.
  for (int row = side - 1; row >= 0; --row) {
    for (int column = 0; column < side; ++column) {
      Column3 sum{};
      for (int i = 0; i < kSubsamples * kSubsamples; ++i) {
        const double u = (column + (i % kSubsamples + 0.5) / kSubsamples) / side;
        const double v = (row + (i / kSubsamples + 0.5) / kSubsamples) / side;
        const Column3 sample = RadianceTowards(picture, DirectionOfSquare(u, v));
        for (std::size_t c = 0; c < 3; ++c) sum[c] += sample[c] / (kSubsamples * kSubsamples);
      }
      const Column3 rgb = convert.Of(sum, 1.0);
      for (const double value : rgb) AppendFloat(out.bytes, value);
    }
  }
  convert.Report(out);
  return out;
}

}  // namespace lightcal
