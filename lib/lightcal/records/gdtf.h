// SPDX-License-Identifier: Apache-2.0
// A fixture as a GDTF archive describes it: what it emits, its beam, and what DMX makes of it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/colorimetry/chromaticity.h"

namespace lightcal {

// A share of what can be said in DIN SPEC 15800 (GDTF 1.2): wheels, models, macros and protocols
// are left out.
struct GdtfMeasurement {
  double physical_percent = 100.0;  // DMX per cent that drives the emitter, above 0
  double luminous_intensity_cd = 0.0;
  std::vector<double> wavelengths_nm{}, energy{};  // W m^-2 nm^-1 or relative; may be empty
  bool operator==(const GdtfMeasurement&) const = default;
};

struct GdtfEmitter {
  std::string name;
  std::optional<Xy> xy{};
  double Y_percent = 0.0;  // of the beam's flux
  std::vector<GdtfMeasurement> measurements{};
  bool operator==(const GdtfEmitter& o) const {
    const bool color =
        xy.has_value() == o.xy.has_value() && (!xy || (xy->x == o.xy->x && xy->y == o.xy->y));
    return name == o.name && color && Y_percent == o.Y_percent && measurements == o.measurements;
  }
};

// What no file says stays absent; GDTF's own defaults (10,000 lm, 6000 K, 25 degrees) are no
// figures of any lamp.
struct GdtfBeam {
  std::string name;
  std::string type = "Wash";
  std::optional<double> flux_lm{}, cct_K{}, beam_deg{}, field_deg{}, radius_m{}, power_W{};
  std::string emitter{};  // whose spectrum it has
  bool operator==(const GdtfBeam&) const = default;
};

// Output(x) = CFC0 + CFC1 t + CFC2 t^2 + CFC3 t^3, t = x - from_percent of the last point at or
// below x, x the channel's DMX in per cent.   Source: GDTF specification, "DMX Profile".
struct GdtfProfile {
  struct Point {
    double from_percent = 0.0;
    double c0 = 0.0, c1 = 0.0, c2 = 0.0, c3 = 0.0;
    bool operator==(const Point&) const = default;
  };
  std::string name;
  std::vector<Point> points{};
  bool operator==(const GdtfProfile&) const = default;
};
// 0 below the first point.
[[nodiscard]] double GdtfOutput(const GdtfProfile& profile, double percent);

struct GdtfChannel {
  std::string attribute;      // "Dimmer", "CTC"
  std::string geometry{};     // the beam it acts on
  std::vector<int> offset{};  // slots from 1, coarse first
  std::optional<double> physical_from{}, physical_to{};
  std::string profile{}, emitter{};
  bool operator==(const GdtfChannel&) const = default;
};

struct GdtfMode {
  std::string name;
  std::vector<GdtfChannel> channels{};
  bool operator==(const GdtfMode&) const = default;
};

struct GdtfFixture {
  std::string name, manufacturer, description, id;
  std::vector<GdtfEmitter> emitters{};
  std::vector<GdtfBeam> beams{};
  std::vector<GdtfProfile> profiles{};
  std::vector<GdtfMode> modes{};
  bool operator==(const GdtfFixture&) const = default;
};

// description.xml, valid by the official schema where each profile has one point (that schema
// allows no more). Names keep what GDTF allows in them, the rest becomes _.
[[nodiscard]] std::string GdtfDescription(const GdtfFixture& fixture);
// As names are written: letters, digits, # % ( ) * + - / : ; < = > @ _ ` " ' and blanks.
[[nodiscard]] std::string GdtfName(std::string_view name);

}  // namespace lightcal
