// SPDX-License-Identifier: Apache-2.0
// SYNTHETIC: writes the bracket that merge_side_by_side feeds to every program: a step wedge of 48
// patches, 0.05 to 1e5 cd/m^2, 7 frames 2 EV apart, shutters labelled in rounded thirds of a stop
// and off by 3 %; as DNG, and as 8 bit linear PGM for OpenCV, which reads no more.
//
//   lightcal_bench_bracket DIRECTORY WIDTH HEIGHT
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "synthetic_dng.h"

namespace lightcal::test {
namespace {

void WritePgm(const std::string& path, const SyntheticCamera& camera,
              const std::vector<std::uint16_t>& picture) {
  std::string bytes =
      "P5\n" + std::to_string(camera.width) + " " + std::to_string(camera.height) + "\n255\n";
  for (const std::uint16_t dn : picture) {
    const double signal = (dn - camera.black_dn) / (camera.white_dn - camera.black_dn);
    bytes +=
        static_cast<char>(static_cast<unsigned char>(std::clamp(255.0 * signal + 0.5, 0.0, 255.0)));
  }
  std::ofstream(path, std::ios::binary) << bytes;
}

int Write(const std::string& directory, int width, int height) {
  const SyntheticCamera camera = FlawedCamera(width, height);
  const StepWedge wedge{LogSteps(0.05, 1e5, 48), 8, width, height};
  std::ofstream truth(directory + "/truth.txt");
  for (const double nits : wedge.nits) truth << nits << '\n';
  std::ofstream times(directory + "/times.txt");
  const auto series = ExposureSeries(1.0 / 2048, 7, 2.0, 8.0, 0.03, 3);
  for (std::size_t i = 0; i < series.size(); ++i) {
    const auto picture = Expose(camera, series[i], wedge.Scene());
    const std::string stem = directory + "/f" + std::to_string(i);
    SyntheticDngOptions options;
    options.noise_profile = false;
    std::ofstream(stem + ".dng", std::ios::binary)
        << EncodeDng(camera, series[i], picture, options);
    WritePgm(stem + ".pgm", camera, picture);
    times << series[i].label_time_s << '\n';
  }
  return truth && times ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace lightcal::test

int main(int count, char** words) {
  if (count != 4) {
    std::fputs("lightcal_bench_bracket DIRECTORY WIDTH HEIGHT\n", stderr);
    return EXIT_FAILURE;
  }
  return lightcal::test::Write(words[1], std::atoi(words[2]), std::atoi(words[3]));
}
