// SPDX-License-Identifier: Apache-2.0
// SYNTHETIC: writes the pictures of sample_data/sessions/lit_wall: a spot lights a wall on which a
// board hangs that `lightcal plan --board board.svg` printed.
//   make_wall_session BOARD.svg SESSION_DIRECTORY
#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "synthetic_wall.h"
#include "wall_picture_file.h"

namespace {

using namespace lightcal::test;  // NOLINT(google-build-using-namespace): a tool of the tests

// Few bits of mantissa pack better.
constexpr std::uint32_t kTenBits = 0xffffe000U, kSevenBits = 0xffff0000U;
float Rounded(float value, std::uint32_t kept) {
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) & kept);
}

bool Write(const std::string& path, const SyntheticWall& wall, std::uint32_t kept) {
  auto samples = PhotographWall(wall);
  for (float& sample : samples) sample = Rounded(sample, kept);
  return WriteWallPicture(path, wall, samples);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  std::ifstream svg(argv[1]);
  SyntheticWall wall;
  wall.board = RectanglesOfSvg({std::istreambuf_iterator<char>(svg), {}});
  wall.intensity = SpotInAGlow;
  wall.width = 800;
  wall.height = 600;
  wall.focal_px = 640.0;
  const std::filesystem::path session = argv[2];
  std::filesystem::create_directories(session / "captures");
  std::filesystem::create_directories(session / "views");
  bool good =
      !wall.board.empty() && Write((session / "captures/wall.exr").string(), wall, kTenBits);
  wall.looks_at = {0.13, 0.0, 0.09};
  wall.noise_relative = 0.0;
  int number = 0;
  for (const Point3& place :
       {Point3{-0.4, -0.5, 0.4}, Point3{0.6, -0.45, 0.1}, Point3{0.1, -0.5, -0.25}}) {
    wall.camera = place;
    const std::string name = "views/board_" + std::to_string(++number) + ".exr";
    good = good && Write((session / name).string(), wall, kSevenBits);
  }
  return good ? 0 : 1;
}
