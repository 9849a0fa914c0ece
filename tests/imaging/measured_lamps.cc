// SPDX-License-Identifier: Apache-2.0
#include "measured_lamps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

#include "lightcal/colorimetry/illuminants.h"
#include "lightcal_devices/files/import_file.h"

namespace lightcal::test {
namespace {

namespace fs = std::filesystem;

fs::path Samples() { return fs::path(LIGHTCAL_SOURCE_DIR) / "sample_data"; }

struct Source {
  const char* name;  // of the CIE's table, or a file under sample_data/spectra
  LampClass lamp;
};
// Classes by how the lamp is made, white LEDs by their R9 (the test asks for it): LED-BH1 is a blue
// LED with phosphor and a red LED beside it; mbp_std is the white of a display, phosphor LEDs
// behind red, green and blue filters; the gas mantle glows.
constexpr std::array kTables = {
    Source{"LED-B1", LampClass::kWhiteLed},  Source{"LED-B2", LampClass::kWhiteLed},
    Source{"LED-B3", LampClass::kWhiteLed},  Source{"LED-B4", LampClass::kWhiteLed},
    Source{"LED-B5", LampClass::kWhiteLed},  Source{"LED-BH1", LampClass::kUnknown},
    Source{"LED-RGB1", LampClass::kRgbLed},  Source{"LED-V1", LampClass::kHighCriLed},
    Source{"LED-V2", LampClass::kHighCriLed}};
constexpr std::array kFiles = {
    Source{"uprtek_cv600/Bridgelux Thrive 3000K.xls", LampClass::kHighCriLed},
    Source{"uprtek_cv600/Casper Glow High.xls", LampClass::kWhiteLed},
    Source{"uprtek_cv600/EStar 97CRI 5000K.xls", LampClass::kHighCriLed},
    Source{"uprtek_cv600/GasMantle_High.xls", LampClass::kTungsten},
    Source{"uprtek_cv600/Lumileds PC Amber.xls", LampClass::kUnknown},
    Source{"uprtek_cv600/Nichia 80 CRI.xls", LampClass::kWhiteLed},
    Source{"uprtek_cv600/Osram Osconiq 3000K.xls", LampClass::kWhiteLed},
    Source{"uprtek_cv600/Philips Warm Glow 2200K.xls", LampClass::kWhiteLed},
    Source{"uprtek_cv600/Yuji 5000K.xls", LampClass::kHighCriLed},
    Source{"uprtek_cv600/mbp_std.xls", LampClass::kUnknown},
    Source{"colour_science/Fluorescent.spdx", LampClass::kUnknown},
    Source{"colour_science/sekonic_RANDOM_001_02deg_3262K.csv", LampClass::kWhiteLed},
    Source{"colour_science/uprtek_ESPD2021_0104_231446.xls", LampClass::kHighCriLed}};

}  // namespace

std::vector<MeasuredLamp> MeasuredLamps() {
  std::vector<MeasuredLamp> lamps;
  for (const Source& table : kTables) {
    auto spectrum = IlluminantSpectrum(table.name);
    EXPECT_TRUE(spectrum) << table.name;
    if (spectrum) lamps.push_back({table.name, table.lamp, std::move(*spectrum)});
  }
  for (const Source& file : kFiles) {
    auto imported = devices::ImportFile((Samples() / "spectra" / file.name).string());
    EXPECT_TRUE(imported && imported->spectra.size() == 1) << file.name;
    if (!imported || imported->spectra.empty()) continue;
    lamps.push_back({fs::path(file.name).stem().string(), file.lamp,
                     std::move(imported->spectra.front().spectrum)});
  }
  return lamps;
}

std::vector<CameraSensitivities> MeasuredCameras() {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(Samples() / "camera_sensitivities")) {
    if (entry.path().extension() == ".json") paths.push_back(entry.path());
  }
  std::ranges::sort(paths);
  std::vector<CameraSensitivities> cameras;
  for (const fs::path& path : paths) {
    std::ifstream stream(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    auto camera = CameraSensitivitiesFromJson(text, path.filename().string());
    EXPECT_TRUE(camera) << path << (camera ? "" : camera.error().message);
    if (camera) cameras.push_back(std::move(*camera));
  }
  return cameras;
}

}  // namespace lightcal::test
