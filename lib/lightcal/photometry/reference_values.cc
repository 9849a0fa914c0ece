// SPDX-License-Identifier: Apache-2.0
#include "lightcal/photometry/reference_values.h"

#include <array>
#include <cstddef>

namespace lightcal {
namespace {

using Q = ReferenceQuantity;
using B = ReferenceBasis;

// Where figures come from, and how firm that is.
struct Origin {
  ReferenceBasis basis;
  std::string_view source;
};
constexpr Origin kEc244{B::kStandard, "Commission Regulation (EC) 244/2009, annex II, table 6"};
constexpr Origin kEnergyStar{B::kStandard, "ENERGY STAR Program Requirements for Lamps, V2.1"};
constexpr Origin kCatalogues{B::kRuleOfThumb, "engineering rule of thumb from lamp catalogues"};
constexpr Origin kRca{B::kPublished, "RCA Electro-Optics Handbook (1974), natural illuminance"};
constexpr Origin kEn12464{B::kStandard, "EN 12464-1:2011, maintained illuminance"};
constexpr Origin kEn1838{B::kStandard, "EN 1838:2013"};
constexpr Origin kCie157{B::kStandard, "CIE 157:2004"};
constexpr Origin kRule{B::kRuleOfThumb, "engineering rule of thumb"};
constexpr Origin kIesHandbook{
    B::kPublished, "IES Lighting Handbook, approximate luminance of various light sources"};
constexpr Origin kEn13201{B::kStandard, "EN 13201-2:2015"};
constexpr Origin kPlanck{B::kDerived, "Planck's law with CIE 018:2019 V(lambda) and 683.002 lm/W"};
constexpr Origin kEc245{B::kStandard, "Commission Regulation (EC) 245/2009, annex III, table 1"};

constexpr ReferenceValue Range(Q quantity, double low, double high, std::string_view what,
                               const Origin& origin, std::optional<double> seed_value = {},
                               std::string_view seed_note = "") {
  return {quantity, low, high, what, origin.basis, origin.source, seed_value, seed_note};
}
constexpr ReferenceValue One(Q quantity, double value, std::string_view what, const Origin& origin,
                             std::optional<double> seed_value = {},
                             std::string_view seed_note = "") {
  return Range(quantity, value, value, what, origin, seed_value, seed_note);
}

constexpr ReferenceValue kValues[] = {
    One(Q::kFlux, 136.0, "LED lamp sold as 15 W equivalent (least allowed)", kEc244),
    One(Q::kFlux, 249.0, "LED lamp sold as 25 W equivalent (least allowed)", kEc244),
    One(Q::kFlux, 470.0, "LED lamp sold as 40 W equivalent (least allowed)", kEc244),
    One(Q::kFlux, 806.0, "LED lamp sold as 60 W equivalent (least allowed)", kEc244),
    One(Q::kFlux, 1055.0, "LED lamp sold as 75 W equivalent (least allowed)", kEc244),
    One(Q::kFlux, 1521.0, "LED lamp sold as 100 W equivalent (least allowed)", kEc244),
    One(Q::kFlux, 2452.0, "LED lamp sold as 150 W equivalent (least allowed)", kEc244),
    Range(Q::kFlux, 800.0, 1099.0, "A-shape lamp, 60 W equivalent in the USA", kEnergyStar),
    Range(Q::kFlux, 1600.0, 1999.0, "A-shape lamp, 100 W equivalent in the USA", kEnergyStar),
    Range(Q::kFlux, 700.0, 870.0, "incandescent bulb 60 W (230 V low, 120 V high)", kCatalogues,
          600.0, "the seed's chapter 4 takes 60 W x 10 lm/W = 600 lm"),
    One(Q::kFlux, 12.566370614359172, "lamp of 1 cd in every direction (about a candle)",
        {B::kDerived, "4 pi x 1 cd, definition of the candela"}),
    Range(Q::kFlux, 1350.0, 1650.0, "halogen headlamp bulb H7, 12 V 55 W",
          {B::kStandard, "UN Regulation 37, category H7: 1500 lm +- 10 %"}),
    Range(Q::kFlux, 2750.0, 3650.0, "gas-discharge headlamp bulb D2S, 35 W",
          {B::kStandard, "UN Regulation 99, category D2S: 3200 lm +- 450 lm"}),
    Range(Q::kFlux, 3200.0, 3400.0, "fluorescent tube T8 36 W, triphosphor", kCatalogues),
    Range(Q::kFlux, 2600.0, 2900.0, "fluorescent tube T5 28 W", kCatalogues),
    One(Q::kIlluminance, 127500.0, "sun outside the atmosphere, facing it",
        {B::kPublished, "IES RP-21, solar illuminance constant 127.5 klx"}, {},
        "the seed (5.2.1) calls the sun's and moon's figures flux; they are illuminances in lx"),
    Range(Q::kIlluminance, 100000.0, 130000.0, "direct sun, facing it", kRca),
    Range(Q::kIlluminance, 10000.0, 20000.0, "full daylight without direct sun", kRca),
    One(Q::kIlluminance, 1000.0, "overcast day", kRca),
    One(Q::kIlluminance, 100.0, "very dark overcast day", kRca),
    One(Q::kIlluminance, 10.0, "twilight", kRca),
    One(Q::kIlluminance, 1.0, "deep twilight", kRca),
    Range(Q::kIlluminance, 0.05, 0.32, "full moon, clear night",
          {B::kPublished, "Kyba, Mohar & Posch, Astronomy & Geophysics 58 (2017) 1.31"}, 0.5,
          "the seed's chapter 4 says 0.5 lx, its 5.1.2 moonlight 0.1 lx"),
    One(Q::kIlluminance, 0.01, "quarter moon", kRca),
    One(Q::kIlluminance, 0.001, "starlight", kRca),
    One(Q::kIlluminance, 0.0001, "overcast starlight", kRca),
    One(Q::kIlluminance, 100.0, "corridors and circulation areas", kEn12464),
    One(Q::kIlluminance, 300.0, "filing, copying", kEn12464),
    One(Q::kIlluminance, 500.0, "office: writing, typing, reading", kEn12464),
    One(Q::kIlluminance, 500.0, "conference and meeting rooms", kEn12464),
    One(Q::kIlluminance, 750.0, "technical drawing", kEn12464),
    One(Q::kIlluminance, 1000.0, "operating theatre, general", kEn12464),
    Range(Q::kIlluminance, 10000.0, 100000.0, "operating cavity", kEn12464),
    One(Q::kIlluminance, 1.0, "escape route, centre line (least)", kEn1838),
    One(Q::kIlluminance, 0.5, "open area, anti-panic (least)", kEn1838),
    One(Q::kIlluminance, 50.0, "museum: very light-sensitive objects (most)", kCie157),
    One(Q::kIlluminance, 200.0, "museum: moderately light-sensitive objects (most)", kCie157),
    Range(Q::kIlluminance, 1500.0, 2500.0, "print viewing booth P1",
          {B::kStandard, "ISO 3664:2009, 2000 lx +- 500 lx"}),
    Range(Q::kIlluminance, 375.0, 625.0, "print viewing booth P2",
          {B::kStandard, "ISO 3664:2009, 500 lx +- 125 lx"}),
    Range(Q::kIlluminance, 50.0, 200.0, "living room in the evening", kRule),
    Range(Q::kIlluminance, 750.0, 2000.0, "television studio", kRule),
    One(Q::kLuminance, 1600000000.0, "sun high in the sky", kIesHandbook),
    One(Q::kLuminance, 2500.0, "moon, bright spot", kIesHandbook),
    One(Q::kLuminance, 8000.0, "clear sky, average", kIesHandbook),
    One(Q::kLuminance, 2000.0, "overcast sky, average", kIesHandbook),
    One(Q::kLuminance, 10000.0, "candle flame, bright spot", kIesHandbook),
    One(Q::kLuminance, 0.000174, "natural night sky",
        {B::kPublished, "Falchi et al., Science Advances 2 (2016) e1600377: 174 ucd/m2"}),
    Range(Q::kLuminance, 1000000.0, 20000000.0, "tungsten filament", kRule),
    Range(Q::kLuminance, 100000.0, 150000.0, "frosted incandescent bulb 60 W", kRule),
    Range(Q::kLuminance, 8000.0, 15000.0, "fluorescent tube T8", kRule),
    Range(Q::kLuminance, 0.005, 5.0, "mesopic vision, between rods and cones",
          {B::kStandard, "CIE 191:2010"}),
    One(Q::kLuminance, 2.0, "motorway surface at night, class M1 (least)", kEn13201),
    One(Q::kLuminance, 0.3, "quiet road surface at night, class M6 (least)", kEn13201),
    One(Q::kLuminance, 80.0, "sRGB reference display, white", {B::kStandard, "IEC 61966-2-1:1999"}),
    One(Q::kLuminance, 100.0, "television reference display, white",
        {B::kStandard, "Recommendation ITU-R BT.2035"}),
    One(Q::kLuminance, 203.0, "HDR reference white", {B::kStandard, "Report ITU-R BT.2408"}),
    One(Q::kLuminance, 48.0, "digital cinema screen, white",
        {B::kStandard, "SMPTE ST 431-1:2006 (14 fL)"}),
    One(Q::kLuminance, 10000.0, "PQ signal, most", {B::kStandard, "SMPTE ST 2084:2014"}),
    One(Q::kEfficacy, 683.0, "radiation at 540 THz (555 nm), per radiant watt",
        {B::kStandard, "SI Brochure, 9th edition, definition of the candela"}, {},
        "the seed's chapter 4 gives 683 lm for any 1 W; it holds at this frequency only"),
    Range(Q::kEfficacy, 250.0, 370.0, "white LED light, per radiant watt", kRule, 683.0,
          "the seed's chapter 4 gives 683 lm for any 1 W"),
    One(Q::kEfficacy, 16.45, "black body 2856 K, per radiant watt", kPlanck),
    One(Q::kEfficacy, 27.09, "black body 3200 K, per radiant watt", kPlanck),
    One(Q::kEfficacy, 92.03, "black body 5772 K, per radiant watt", kPlanck),
    Range(Q::kEfficacy, 100.0, 150.0, "daylight, per radiant watt", kRule),
    Range(Q::kEfficacy, 11.6, 14.5, "incandescent bulb 60 W, per electrical watt", kCatalogues,
          10.0, "the seed's chapter 4 says 10 lm/W, its own table 14-35 lm/W"),
    Range(Q::kEfficacy, 0.1, 0.3, "candle, per watt of fuel", kRule),
    Range(Q::kEfficacy, 12.0, 25.0, "tungsten halogen lamp", kRule),
    Range(Q::kEfficacy, 45.0, 70.0, "compact fluorescent lamp", kRule),
    One(Q::kEfficacy, 75.0, "fluorescent tube T8 18 W (least allowed)", kEc245),
    One(Q::kEfficacy, 93.0, "fluorescent tube T8 36 W (least allowed)", kEc245),
    One(Q::kEfficacy, 93.0, "fluorescent tube T5 28 W (least allowed)", kEc245),
    Range(Q::kEfficacy, 210.0, 683.0, "lamp of energy class A",
          {B::kStandard, "Regulation (EU) 2019/2015, annex II: 210 lm/W and above"}),
    Range(Q::kEfficacy, 110.0, 135.0, "lamp of energy class E",
          {B::kStandard, "Regulation (EU) 2019/2015, annex II"}),
    Range(Q::kEfficacy, 80.0, 120.0, "metal halide lamp", kRule),
    Range(Q::kEfficacy, 80.0, 150.0, "high-pressure sodium lamp", kRule),
    Range(Q::kEfficacy, 100.0, 200.0, "low-pressure sodium lamp", kRule),
    Range(Q::kEfficacy, 35.0, 60.0, "mercury vapour lamp", kRule),
    Range(Q::kEfficacy, 70.0, 150.0, "LED lamp for the household", kRule),
};

}  // namespace

std::span<const ReferenceValue> ReferenceValues() { return kValues; }

std::string_view ReferenceUnit(ReferenceQuantity quantity) {
  constexpr std::array<std::string_view, 4> kUnits = {"lm", "lx", "cd/m²", "lm/W"};
  return kUnits[static_cast<std::size_t>(quantity)];
}

std::string_view ReferenceQuantityName(ReferenceQuantity quantity) {
  constexpr std::array<std::string_view, 4> kNames = {"luminous flux", "illuminance", "luminance",
                                                      "luminous efficacy"};
  return kNames[static_cast<std::size_t>(quantity)];
}

std::string_view ReferenceBasisName(ReferenceBasis basis) {
  constexpr std::array<std::string_view, 4> kNames = {"standard", "published", "derived",
                                                      "rule of thumb"};
  return kNames[static_cast<std::size_t>(basis)];
}

}  // namespace lightcal
