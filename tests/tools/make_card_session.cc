// SPDX-License-Identifier: Apache-2.0
// SYNTHETIC: writes the brackets of sample_data/sessions/grey_card_dng and grey_card_exr: a grey
// card and a white sheet on black cloth, 0.8 m in front of a lamp of 300 cd and 3000 K,
// photographed by a camera that never existed and is 15 % less sensitive than its ISO speed says.
//   make_card_session SESSIONS_DIRECTORY
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "lightcal_devices/captures/picture.h"
#include "synthetic_dng.h"

namespace {

using namespace lightcal::test;  // NOLINT(google-build-using-namespace): a tool of the tests

constexpr double kIntensityCd = 300.0, kDistanceM = 0.8;
constexpr double kLampX = 0.4369, kLampY = 0.4041;  // black body of 3000 K
constexpr double kCard = 0.18, kSheet = 0.9, kCloth = 0.03;
constexpr int kBin = 4;  // pixels of the mosaic to one of the EXR, each way

SyntheticCamera Camera() {
  SyntheticCamera camera;
  camera.sensitivity = 0.85;
  camera.prnu_relative = 0.005;
  camera.row_noise_e = 0.5;
  return camera;
}

bool Inside(int x, int y, int left, int top, int width, int height) {
  return x >= left && x < left + width && y >= top && y < top + height;
}

SyntheticXyz Scene(int x, int y) {
  const double lux = kIntensityCd / (kDistanceM * kDistanceM);
  double reflectance = kCloth;
  if (Inside(x, y, 200, 100, 240, 200)) reflectance = kCard;
  if (Inside(x, y, 470, 140, 80, 120)) reflectance = kSheet;
  return XyzOf(reflectance * lux / std::numbers::pi, kLampX, kLampY);
}

// Adjugate over determinant.
std::array<std::array<double, 3>, 3> Inverse(const std::array<std::array<double, 3>, 3>& m) {
  std::array<std::array<double, 3>, 3> out{};
  double determinant = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
    determinant += m[0][i] * (m[1][a] * m[2][b] - m[1][b] * m[2][a]);
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t c = (j + 1) % 3, d = (j + 2) % 3;
      out[i][j] = m[c][a] * m[d][b] - m[c][b] * m[d][a];
    }
  }
  for (auto& row : out) {
    for (double& value : row) value /= determinant;
  }
  return out;
}

// Raw channels of the lamp's white a little below where the first of them saturates: there a
// developer clips.
std::array<double, 3> ClippedWhite(const SyntheticCamera& camera) {
  const SyntheticXyz white = XyzOf(1.0, kLampX, kLampY);
  std::array<double, 3> raw{};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto& row = camera.camera_from_xyz[c];
    raw[c] = row[0] * white.X + row[1] * white.Y + row[2] * white.Z;
  }
  const double most = *std::max_element(raw.begin(), raw.end());
  for (double& value : raw) value *= 0.97 / most;
  return raw;
}

// The mosaic developed without any rendering: binned, clipped white, to XYZ, to Rec. 709; 1 is the
// luminance that saturates in daylight.
std::vector<float> Develop(const SyntheticCamera& camera,
                           const std::vector<std::uint16_t>& mosaic) {
  // Rec. ITU-R BT.709-6, item 1.4 inverted by IEC 61966-2-1.
  constexpr std::array<std::array<double, 3>, 3> kRec709 = {{{3.2406255, -1.5372080, -0.4986286},
                                                             {-0.9689307, 1.8757561, 0.0415175},
                                                             {0.0557101, -0.2040211, 1.0569959}}};
  const auto xyz_from_camera = Inverse(camera.camera_from_xyz);
  const auto white = ClippedWhite(camera);
  std::vector<float> out;
  for (int y = 0; y < camera.height; y += kBin) {
    for (int x = 0; x < camera.width; x += kBin) {
      std::array<double, 3> raw{}, count{};
      for (int j = y; j < y + kBin; ++j) {
        for (int i = x; i < x + kBin; ++i) {
          const auto channel = static_cast<std::size_t>((i & 1) + (j & 1));
          raw[channel] += mosaic[static_cast<std::size_t>(j) * camera.width + i] - camera.black_dn;
          count[channel] += camera.white_dn - camera.black_dn;
        }
      }
      for (std::size_t c = 0; c < 3; ++c) raw[c] = std::min(raw[c] / count[c], white[c]);
      for (const auto& rgb : kRec709) {
        double value = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
          double xyz = 0.0;
          for (std::size_t c = 0; c < 3; ++c) xyz += xyz_from_camera[k][c] * raw[c];
          value += rgb[k] * xyz;
        }
        out.push_back(static_cast<float>(value));
      }
    }
  }
  return out;
}

bool WriteFrame(const std::string& path, const SyntheticCamera& camera,
                const std::vector<float>& samples) {
  lightcal::devices::ExrPicture picture;
  picture.samples =
      lightcal::View2d<const float>(samples.data(), camera.width / kBin, camera.height / kBin, 3);
  picture.channel_names = {"R", "G", "B"};
  picture.chromaticities = lightcal::PrimariesOf(lightcal::RgbSpace::kSrgb);
  picture.attributes = {{"note", "SYNTHETIC: no camera took this picture"}};
  const auto written = lightcal::devices::WriteExr(path, picture);
  if (!written) std::fprintf(stderr, "%s\n", written.error().message.c_str());
  return written.has_value();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::filesystem::path sessions = argv[1];
  const std::filesystem::path dng = sessions / "grey_card_dng" / "captures";
  const std::filesystem::path exr = sessions / "grey_card_exr" / "captures";
  std::filesystem::create_directories(dng);
  std::filesystem::create_directories(exr);
  const SyntheticCamera camera = Camera();
  const auto series = ExposureSeries(1.0 / 64.0, 5, 1.0, 4.0, 0.01, 11);
  SyntheticDngOptions options;
  options.lossless_jpeg = true;
  options.white_x = kLampX;
  options.white_y = kLampY;
  WriteDngBracket(dng.string(), "card", camera, series, Scene, options);
  for (std::size_t i = 0; i < series.size(); ++i) {
    const auto mosaic = Expose(camera, series[i], Scene);
    const std::string name = "card_" + std::to_string(i) + ".exr";
    if (!WriteFrame((exr / name).string(), camera, Develop(camera, mosaic))) return 1;
  }
  return 0;
}
