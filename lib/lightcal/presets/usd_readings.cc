// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/usd_readings.h"

#include <array>

namespace lightcal {
namespace {

constexpr std::array kReadings = {
    UsdReadingRow{
        UsdReading::kSpec, "spec",
        "documented: UsdLux as its schema says, intensity in nits, suns normalised to lux"},
    UsdReadingRow{
        UsdReading::kKarma, "karma",
        "from pictures of others: suns in nits without normalize; the rest as the schema; "
        "cones and domes not verified"},
    UsdReadingRow{
        UsdReading::kArnold, "arnold",
        "documented by arnold-usd's source: tubes normalised, nothing treated as a point; "
        "suns in lux from pictures of others; its law between the cone's two angles not "
        "verified"},
    UsdReadingRow{
        UsdReading::kRtx, "rtx",
        "documented by NVIDIA ovrtx as the schema says; softness and the turn of domes not "
        "verified"},
    UsdReadingRow{UsdReading::kRtx2024, "rtx_2024",
                  "from pictures of others: USD Composer of 2024 shows suns pi brighter whatever "
                  "normalize says; the rest as the schema"},
};

}  // namespace

std::span<const UsdReadingRow> UsdReadings() { return kReadings; }

}  // namespace lightcal
