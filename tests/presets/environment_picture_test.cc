// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "lightcal/presets/environment_files.h"

namespace lightcal::test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr Vec3 kSides[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};

// Of a formula of the direction (Z up; the middle looks along +Y, the right side to +X).
EnvironmentPicture PictureFrom(int width, const std::function<Vec3(const Vec3&)>& rgb) {
  EnvironmentPicture picture;
  picture.width = width;
  picture.height = width / 2;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double azimuth = 2.0 * pi * ((x + 0.5) / width - 0.5);
      const double zenith = pi * (y + 0.5) / picture.height;
      const Vec3 out = rgb({std::sin(zenith) * std::sin(azimuth),
                            std::sin(zenith) * std::cos(azimuth), std::cos(zenith)});
      for (const double v : out) picture.rgb.push_back(static_cast<float>(v));
    }
  }
  picture.Reduce();
  return picture;
}

// Six soft sides, different in every channel.
Vec3 Sides(const Vec3& d) {
  const double v[] = {1000.0, 500.0, 200.0, 100.0, 800.0, 50.0};
  Vec3 out{};
  for (int i = 0; i < 6; ++i) {
    const double w = std::pow(std::max(0.0, Dot(d, kSides[i])), 2);
    for (std::size_t c = 0; c < 3; ++c) out[c] += w * v[(i + 2 * c) % 6];
  }
  return out;
}

// E = pi L under an even sky; of L = 1 + z, E = pi (1 + 2 z/3).
TEST(EnvironmentPicture, IrradianceHasItsClosedForms) {
  const auto picture = PictureFrom(512, [](const Vec3& d) {
    return Vec3{1.0, 1.0 + d[2], 1.0 + d[0]};
  });
  for (const Vec3& n : kSides) {
    const Vec3 e = IrradianceOn(picture, n);
    EXPECT_NEAR(e[0], pi, 1e-3);
    EXPECT_NEAR(e[1], pi * (1.0 + 2.0 / 3.0 * n[2]), 2e-3);
    EXPECT_NEAR(e[2], pi * (1.0 + 2.0 / 3.0 * n[0]), 2e-3);
  }
}

TEST(EnvironmentPicture, ItsHarmonicsGiveTheIrradianceOfSoftSides) {
  const auto picture = PictureFrom(256, Sides);
  const Harmonics h = RadianceHarmonics(picture, [](const Vec3& v) { return v; });
  const double band[] = {pi, 2.0 * pi / 3.0, pi / 4.0};
  for (const Vec3& n : kSides) {
    const double basis[] = {0.282095,
                            0.488603 * n[1],
                            0.488603 * n[2],
                            0.488603 * n[0],
                            1.092548 * n[0] * n[1],
                            1.092548 * n[1] * n[2],
                            0.315392 * (3.0 * n[2] * n[2] - 1.0),
                            1.092548 * n[0] * n[2],
                            0.546274 * (n[0] * n[0] - n[1] * n[1])};
    const Vec3 e = IrradianceOn(picture, n);
    for (std::size_t c = 0; c < 3; ++c) {
      double sum = 0.0;
      for (std::size_t i = 0; i < 9; ++i)
        sum += band[i == 0 ? 0 : i < 4 ? 1 : 2] * basis[i] * h[i][c];
      EXPECT_NEAR(sum / e[c], 1.0, 0.02);
    }
  }
}

// Clarberg's map the other way, from its definition: r = sqrt(1 - |z|) from the middle of the
// square (the corners for z < 0), the azimuth linear along the diamond.
std::array<double, 2> SquareOf(const Vec3& d) {
  const double x = std::abs(d[0]), y = std::abs(d[1]), z = std::abs(d[2]);
  const double r = std::sqrt(1.0 - z);
  double phi = std::atan2(y, x) * 2.0 / pi;
  double v = phi * r, u = r - v;
  if (d[2] < 0.0) {
    std::swap(u, v);
    u = 1.0 - u;
    v = 1.0 - v;
  }
  return {(std::copysign(u, d[0]) + 1.0) / 2.0, (std::copysign(v, d[1]) + 1.0) / 2.0};
}

TEST(EnvironmentPicture, TheSquareIsClarbergs) {
  for (double u = 0.03; u < 1.0; u += 0.09) {
    for (double v = 0.02; v < 1.0; v += 0.07) {
      const Vec3 d = DirectionOfSquare(u, v);
      EXPECT_NEAR(Length(d), 1.0, 1e-12);
      const auto back = SquareOf(d);
      EXPECT_NEAR(back[0], u, 1e-9);
      EXPECT_NEAR(back[1], v, 1e-9);
    }
  }
  EXPECT_NEAR(DirectionOfSquare(0.5, 0.5)[2], 1.0, 1e-12);  // its middle looks up
  EXPECT_NEAR(DirectionOfSquare(0.0, 0.0)[2], -1.0, 1e-12);
}

TEST(EnvironmentPicture, TheSquaresSidesBringWhatThePicturesDid) {
  const auto picture = PictureFrom(512, Sides);
  const EncodedPicture square = EqualAreaSquare(picture, {});
  ASSERT_EQ(square.bytes.substr(0, 3), "PF\n");
  const std::size_t start = square.bytes.find("-1.0\n") + 5;
  const int side = std::stoi(square.bytes.substr(3));
  ASSERT_EQ(square.bytes.size(), start + 12U * static_cast<std::size_t>(side * side));
  for (const Vec3& n : kSides) {
    Vec3 sum{};
    for (int j = 0; j < side; ++j) {  // the file begins with the lowest row
      for (int i = 0; i < side; ++i) {
        const Vec3 d = DirectionOfSquare((i + 0.5) / side, (j + 0.5) / side);
        const double cosine = Dot(d, n);
        if (cosine <= 0.0) continue;
        float rgb[3];
        std::memcpy(
            rgb,
            square.bytes.data() + start + 12 * static_cast<std::size_t>((side - 1 - j) * side + i),
            sizeof(rgb));
        for (std::size_t c = 0; c < 3; ++c) {
          sum[c] += 4.0 * pi / (side * side) * cosine * static_cast<double>(rgb[c]);
        }
      }
    }
    const Vec3 e = IrradianceOn(picture, n);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(sum[c] / e[c], 1.0, 0.005);
  }
}

// Scanlines of B, G and R behind a table of where each begins ("OpenEXR File Layout").
void ExpectExrHolds(const EnvironmentPicture& picture, std::size_t bytes_each) {
  const std::string bytes = ExrFile(picture, {}).bytes;
  const auto number = [&](std::size_t at, auto value) {
    std::memcpy(&value, bytes.data() + at, sizeof(value));
    return value;
  };
  const auto width = static_cast<std::size_t>(picture.width);
  const auto height = static_cast<std::size_t>(picture.height);
  const std::size_t row = 8 + width * 3 * bytes_each;
  const std::size_t table = bytes.size() - height * (8 + row);
  EXPECT_EQ(bytes.substr(0, 8), std::string("\x76\x2f\x31\x01\2\0\0\0", 8));
  EXPECT_EQ(bytes[table - 1], '\0');
  for (std::size_t y = 0; y < height; ++y) {
    const auto line = static_cast<std::size_t>(number(table + 8 * y, std::uint64_t{}));
    ASSERT_EQ(line, table + 8 * height + y * row);
    ASSERT_EQ(number(line, std::int32_t{}), static_cast<std::int32_t>(y));
    ASSERT_EQ(number(line + 4, std::int32_t{}), static_cast<std::int32_t>(row - 8));
    for (std::size_t i = 0; i < 3 * width; ++i) {
      const std::size_t at = line + 8 + i * bytes_each;
      double got = 0.0;
      if (bytes_each == 2) {
        const int bits = number(at, std::uint16_t{});
        const int power = bits >> 10, steps = bits & 1023;
        got = power == 0 ? std::ldexp(steps, -24) : std::ldexp(1024 + steps, power - 25);
      } else {
        got = static_cast<double>(number(at, float{}));
      }
      const auto was =
          static_cast<double>(picture.rgb[3 * (y * width + i % width) + 2 - i / width]);
      ASSERT_NEAR(got, was, bytes_each == 2 ? was / 2048.0 + 0x1p-25 : was * 1e-6);
    }
  }
}

TEST(EnvironmentPicture, TheExrHoldsEveryPixelInHalvesOrInFloats) {
  ExpectExrHolds(PictureFrom(64, Sides), 2);
  ExpectExrHolds(PictureFrom(64, [](const Vec3& d) { return Sides(d) * 1e-9; }), 2);
  ExpectExrHolds(PictureFrom(64, [](const Vec3& d) { return Sides(d) * 1e6; }), 4);
}

// Ward's runs, undone here.
TEST(EnvironmentPicture, TheRadianceFileHoldsEveryPixel) {
  const auto picture = PictureFrom(64, Sides);
  const std::string bytes = RadianceFile(picture, {}).bytes;
  std::size_t at = bytes.find("\n-Y 32 +X 64\n") + 13;
  std::size_t pixel = 0;
  for (int y = 0; y < 32; ++y) {
    const auto byte = [&] { return static_cast<int>(static_cast<unsigned char>(bytes[at++])); };
    ASSERT_EQ(byte(), 2);
    ASSERT_EQ(byte(), 2);
    ASSERT_EQ(byte() * 256 + byte(), 64);
    std::vector<int> row;
    while (row.size() < 4U * 64U) {
      const int count = byte();
      if (count > 128) {
        row.insert(row.end(), static_cast<std::size_t>(count - 128), byte());
      } else {
        for (int i = 0; i < count; ++i) row.push_back(byte());
      }
    }
    ASSERT_EQ(row.size(), 4U * 64U);
    for (std::size_t x = 0; x < 64; ++x, ++pixel) {
      const float* was = picture.rgb.data() + 3 * pixel;
      const double top = std::max({was[0], was[1], was[2]});
      for (std::size_t c = 0; c < 3; ++c) {
        const double got = std::ldexp(row[c * 64 + x], row[3 * 64 + x] - 136);
        EXPECT_NEAR(got, was[c], top / 250.0);
      }
    }
  }
  EXPECT_EQ(at, bytes.size());
}

}  // namespace
}  // namespace lightcal::test
