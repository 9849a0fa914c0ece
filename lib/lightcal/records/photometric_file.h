// SPDX-License-Identifier: Apache-2.0
// A lamp as a photometric file (IES LM-63, EULUMDAT) describes it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/units.h"
#include "lightcal/light/intensity_table.h"

namespace lightcal {

enum class PhotometricFormat : std::uint8_t { kIes, kEulumdat };
inline constexpr std::array<std::string_view, 2> kPhotometricFormatWords = {"ies", "ldt"};

// What of the lamp shines.
enum class OpeningShape : std::uint8_t { kPoint, kRect, kRound, kSphere };
inline constexpr std::array<std::string_view, 4> kOpeningShapeWords = {"point", "rect", "round",
                                                                       "sphere"};
// along_c0 is IES's length and EULUMDAT's width: IES puts its 0 plane along the lamp, EULUMDAT
// across it, and the planes keep their numbers.
struct LuminousOpening {
  OpeningShape shape = OpeningShape::kPoint;
  Metres along_c0{0.0}, along_c90{0.0}, height{0.0};
};

struct LampSet {
  int count = 1;
  std::string type;
  Lumens flux{0.0};  // of all lamps of the set
  std::string color, rendering;
  Watts power{0.0};
};

// How the lamp's output changes when the luminaire is tilted (LM-63, TILT). Not applied: the
// intensities are those of the tested position.
struct LampTilt {
  int geometry = 1;
  std::vector<double> angle_deg, factor;
};

struct PhotometricHeader {
  PhotometricFormat format = PhotometricFormat::kIes;
  std::string version;  // "LM-63-2002", "EULUMDAT"
  std::string manufacturer, luminaire, catalogue, report, laboratory, date;
  std::vector<LampSet> lamps;       // at least one
  std::optional<Lumens> lamp_flux;  // rated, of all lamps; absent where the file gives none
  bool absolute = false;            // measured as a whole, not relative to bare lamps
  Watts power{0.0};                 // of the whole luminaire
  LuminousOpening opening;
  std::optional<double> output_ratio;  // as the file states it, 1 = all the lamps' flux comes out
  std::optional<LampTilt> tilt;
  std::string generation;  // LM-63-2019: how the data came to be, "" = not said
};

struct PhotometricFile {
  PhotometricHeader header;
  IntensityTable table;  // candela: the file's multipliers, ballast factors and lumens are in it
};

}  // namespace lightcal
