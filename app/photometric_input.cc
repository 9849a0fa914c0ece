// SPDX-License-Identifier: Apache-2.0
#include "photometric_input.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>
#include <vector>

namespace lightcal::app {
namespace {

namespace fs = std::filesystem;

Result<std::string> ReadBounded(const std::string& path) {
  std::error_code error;
  if (!fs::exists(path, error)) return Failed("not_found", path, "there is no such file");
  std::ifstream stream(path, std::ios::binary);
  std::string bytes;
  std::array<char, 1 << 16> chunk{};
  while (stream.read(chunk.data(), chunk.size()) || stream.gcount() > 0) {
    bytes.append(chunk.data(), static_cast<std::size_t>(stream.gcount()));
    if (bytes.size() > kMaxPhotometricBytes) {
      return Refused("too_large", path, "is larger than 32 MiB, which no lamp's file is");
    }
  }
  if (!stream.eof())
    return Failed("unreadable", path, "cannot be read; is it a file you may open?");
  return bytes;
}

double FinestStep(const std::vector<double>& angles, double coarsest) {
  double step = coarsest;
  for (std::size_t i = 1; i < angles.size(); ++i) step = std::min(step, angles[i] - angles[i - 1]);
  return step;
}

std::vector<double> EvenAngles(double to, double step) {
  const int count = static_cast<int>(to / step + 0.5);
  std::vector<double> out;
  for (int i = 0; i <= count; ++i) out.push_back(to * i / count);
  return out;
}

}  // namespace

Result<ReadPhotometric> ReadPhotometricFile(const std::string& path) {
  const auto text = ReadBounded(path);
  if (!text) return tl::unexpected(text.error());
  const fs::path folder = fs::path(path).parent_path();
  return PhotometricFromText(*text, fs::path(path).filename().string(),
                             [&](const std::string& name) { return ReadBounded(folder / name); });
}

Result<PhotometricFile> AsTypeC(PhotometricFile file) {
  constexpr double kLeastStep = 0.5;  // a finer sampling is larger than it is worth
  const IntensityGrid& grid = file.table.grid();
  if (grid.type == GoniometerType::kC) return file;
  const double c_step = std::max(kLeastStep, FinestStep(grid.horizontal_deg, 2.5));
  const double gamma_step = std::max(kLeastStep, FinestStep(grid.vertical_deg, 1.0));
  auto table = SampledAsTypeC(file.table, EvenAngles(360.0, c_step), EvenAngles(180.0, gamma_step),
                              TableInterpolation::kLinear);
  if (!table) return Propagate(std::move(table));
  return PhotometricFile{std::move(file.header), std::move(*table)};
}

}  // namespace lightcal::app
